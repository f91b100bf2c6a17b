// The C interface: equations of a part of a mesh that no process has as a whole.
#include "harmorph_distributed.h"

#include "harmorph/base/range.hpp"
#include "harmorph/operators/right_hand_sides.hpp"
#include "harmorph/parts/part_equations.hpp"
#include "request.hpp"

namespace harmorph {
namespace {

static_assert(sizeof(hm_edge) == sizeof(OpenEdge) && sizeof(hm_edge) == 56, "one is read as the other");

Status view_part_mesh(const hm_part_mesh* given, PartMesh& part, CallFault& fault) noexcept {
    HARMORPH_TRY(require({{"mesh", given}}, fault));
    hm_part_mesh p;
    if (!read_struct(given, p)) return fault.refuse(Status::bad_argument, "the struct_size of the part is not set");
    HARMORPH_TRY(require({{"part.numbers", p.numbers}}, fault));
    HARMORPH_TRY(view_mesh(p.mesh, part.mesh, fault));
    part.number = p.numbers;
    part.ghosts = p.ghosts;
    return Status::ok;
}

// hm_part, hm_equations: objects in their blocks.
template <class Object, class Handle>
Status open(Handle* handle, const char* name, Object*& object, Fault& fault) noexcept {
    if (handle == nullptr) return fault.refuse_argument(name, "% is NULL");
    object = reinterpret_cast<Object*>(handle);
    return Status::ok;
}

Status open_part(const hm_part* handle, const Part*& part, CallFault& fault) noexcept {
    HARMORPH_TRY(open(handle, "part", part, fault));
    fault.bases.mesh = part->own().index_base;
    return Status::ok;
}

struct EquationsRequest : Request {
    const Part* part = nullptr;
    Index n_edges = 0;

    Status read_all(const hm_part* of, Index edges, const hm_problem* given, const hm_options* options,
                    CallFault& fault) noexcept {
        HARMORPH_TRY(open_part(of, part, fault));
        n_edges = edges;
        if (edges < 0 || edges > Mesh::max_points / 2) {
            return fault.refuse(Status::bad_argument, "n_edges must be between 0 and 2^29, not #", Counts::from_zero,
                                edges);
        }
        HARMORPH_TRY(read_without_mesh(given, options, fault));
        Method const& method = problem.method;
        const char* wrong = nullptr;
        if (method.scheme != Scheme::compact) wrong = "meshes in parts go with the compact scheme only";
        if (method.engine != Engine::direct) wrong = "meshes in parts: options.engine must be HM_DIRECT";
        if (method.precision != Precision::in_double) wrong = "meshes in parts: options.precision must be HM_DOUBLE";
        if (!problem.given.point.empty()) wrong = "meshes in parts: problem.n_given must be 0";
        if (wrong != nullptr) return fault.refuse(Status::unsupported, wrong);
        if (n_conditions > 0) return Status::ok;
        return fault.refuse(Status::bad_condition, "there are no curves, no rigid bodies and no given displacements");
    }
    PartProblem asked() const noexcept { return {problem.method, problem.demands, problem.executor}; }
    void lay_out(Arena& arena, InBlock<PartEquations>& made) const noexcept {
        made.lay_out(arena, *part, asked(), n_edges, n_curves, n_conditions, n_control());
    }
};

hm_equations_info info_of(PartEquations const& equations) noexcept {
    hm_equations_info filled = {};
    BasisCounts const counts = equations.basis_source().counts();
    filled.unknowns = equations.matrix.n;
    filled.numbers = equations.numbers();
    filled.functions = counts.functions();
    filled.columns = equations.matrix.is_complex()
                         ? counts.functions()
                         : numbers_of(counts.kind) * counts.functions() / equations.matrix.components();
    filled.field_columns = equations.matrix.kind == MatrixKind::real ? 2 : 1;
    filled.unknown = equations.name.data();
    filled.own = equations.is_own.data();
    equations.for_each_entry(0, equations.matrix.n, [&](Index, Index, Real, Real) { ++filled.entries; });
    return filled;
}

// Equations and rows that were made of them.
struct RowsCall {
    const PartEquations* equations = nullptr;
    Basis basis;

    Status open_both(const hm_equations* handle, const hm_basis* rows, CallFault& fault) noexcept {
        HARMORPH_TRY(open(handle, "equations", equations, fault));
        HARMORPH_TRY(open_basis(rows, basis, fault));
        BasisCounts const counts = equations->basis_source().counts();
        bool const same = basis.n_points() == counts.points && !basis.in_single() && basis.kind() == counts.kind &&
                          basis.n_functions() == counts.functions();
        if (!same) return fault.refuse(Status::bad_basis, "the rows were made of other equations");
        if (basis.header->solved == 0) return Status::ok;
        return fault.refuse(Status::bad_basis, "the rows are finished: make new ones by hm_rows_init");
    }
    Status check_column(Index column, const double* numbers, Fault& fault) const noexcept {
        HARMORPH_TRY(require({{"numbers", numbers}}, fault));
        if (column >= 0 && column < equations->columns(basis)) return Status::ok;
        return fault.refuse(Status::bad_argument, "there is no column # (from 0) of @", Counts::from_zero, column,
                            equations->columns(basis));
    }
};

// One field of displacements: rows of two numbers, x and y.
struct FieldCall {
    PartEquations* equations = nullptr;
    Span<Real> rows;

    Status open_field(hm_equations* handle, double* work, CallFault& fault) noexcept {
        HARMORPH_TRY(open(handle, "equations", equations, fault));
        HARMORPH_TRY(require({{"work", work}}, fault));
        rows = {work, 2 * static_cast<Size>(equations->part.own().n_points)};
        return Status::ok;
    }
    DofValues values() const noexcept {
        return {rows, 0, 1, equations->dof_of, equations->wall.point.first(equations->wall.count),
                equations->matrix.components()};
    }
    // body(column, its numbers among those of all columns)
    template <class Number, class Body>
    void for_each_column(Number* numbers, Body const& body) const noexcept {
        Index const n = values().columns(equations->matrix);
        Offset const length = Offset{equations->matrix.n} * equations->numbers();
        for (Index column = 0; column < n; ++column) body(column, numbers + column * length);
    }
};

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_part_size(const hm_part_mesh* mesh, size_t* bytes, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        PartMesh view;
        HARMORPH_TRY(view_part_mesh(mesh, view, fault));
        InBlock<Part> made;
        return count_bytes(bytes, fault, [&](Arena& arena) { made.lay_out(arena, view); });
    });
}

hm_status hm_part_init(hm_part** part, void* block, size_t bytes, const hm_part_mesh* mesh, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        PartMesh view;
        HARMORPH_TRY(require({{"part", part}}, fault));
        HARMORPH_TRY(view_part_mesh(mesh, view, fault));
        InBlock<Part> made;
        HARMORPH_TRY(place(block, bytes, fault, [&](Arena& arena) { made.lay_out(arena, view); }));
        HARMORPH_TRY(made.object.init(view, fault));
        made.give(part);
        return Status::ok;
    });
}

hm_status hm_part_cells(const hm_part* part, hm_mesh* own, const int32_t** cell, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Part* of = nullptr;
        HARMORPH_TRY(open_part(part, of, fault));
        HARMORPH_TRY(require({{"cell", cell}}, fault));
        HARMORPH_TRY(check_report(own, fault));
        Mesh const& mesh = of->cells;
        hm_mesh filled = {};
        filled.index_base = mesh.index_base;
        filled.n_points = mesh.n_points;
        filled.points = {mesh.points.x, mesh.points.y, mesh.points.stride};
        filled.cell_layout = mesh.layout == CellLayout::polygons ? HM_CELLS_POLYGONS : HM_CELLS_QUADS;
        filled.n_cells = mesh.n_cells;
        filled.cell_start = mesh.cell_start;
        filled.cell_points = mesh.cell_points;
        write_struct(filled, own);
        *cell = of->given_cell.empty() ? nullptr : of->given_cell.data();
        return Status::ok;
    });
}

hm_status hm_part_points(const hm_part* part, uint8_t* role, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Part* of = nullptr;
        HARMORPH_TRY(open_part(part, of, fault));
        HARMORPH_TRY(require({{"role", role}}, fault));
        std::memcpy(role, of->in_cell.data(), of->in_cell.size());
        return Status::ok;
    });
}

hm_status hm_part_edges(const hm_part* part, hm_edge* edges, int32_t capacity, int32_t* n, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Part* of = nullptr;
        HARMORPH_TRY(open_part(part, of, fault));
        HARMORPH_TRY(require({{"n", n}}, fault));
        if (capacity > 0) HARMORPH_TRY(require({{"edges", edges}}, fault));
        *n = of->n_open;
        if (capacity < of->n_open) {
            return fault.refuse(Status::bad_argument, "edges has room for #, the part has @", Counts::from_zero,
                                capacity, of->n_open);
        }
        of->for_each_open([&](OpenEdge const& edge) { std::memcpy(static_cast<void*>(edges++), &edge, sizeof edge); });
        return Status::ok;
    });
}

hm_status hm_match_edges(hm_edge* edges, int64_t* n, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        HARMORPH_TRY(require({{"n", n}}, fault));
        if (*n < 0) return fault.refuse(Status::bad_argument, "the number of edges is negative");
        if (*n > 0) HARMORPH_TRY(require({{"edges", edges}}, fault));
        Offset left = 0;
        HARMORPH_TRY(match_edges({reinterpret_cast<OpenEdge*>(edges), static_cast<Size>(*n)}, left, fault));
        *n = left;
        return Status::ok;
    });
}

hm_status hm_equations_size(const hm_part* part, int32_t n_edges, const hm_problem* problem, const hm_options* options,
                            size_t* bytes, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        EquationsRequest request;
        HARMORPH_TRY(request.read_all(part, n_edges, problem, options, fault));
        InBlock<PartEquations> made;
        return count_bytes(bytes, fault, [&](Arena& arena) { request.lay_out(arena, made); });
    });
}

hm_status hm_equations_init(hm_equations** equations, void* block, size_t bytes, const hm_part* part, int32_t n_edges,
                            const hm_edge* edges, const hm_problem* problem, const hm_options* options, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        EquationsRequest request;
        HARMORPH_TRY(require({{"equations", equations}}, fault));
        HARMORPH_TRY(request.read_all(part, n_edges, problem, options, fault));
        if (n_edges > 0) HARMORPH_TRY(require({{"edges", edges}}, fault));
        InBlock<PartEquations> made;
        HARMORPH_TRY(place(block, bytes, fault, [&](Arena& arena) { request.lay_out(arena, made); }));
        HARMORPH_TRY(request.copy_to(made.object.shared.curves, made.object.shared.conditions, fault));
        Span<const OpenEdge> const all(reinterpret_cast<const OpenEdge*>(edges), static_cast<Size>(n_edges));
        HARMORPH_TRY(made.object.run(all, fault));
        made.give(equations);
        return fault.status;
    });
}

hm_status hm_equations_info_get(const hm_equations* equations, hm_equations_info* info, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const PartEquations* of = nullptr;
        HARMORPH_TRY(open(equations, "equations", of, fault));
        HARMORPH_TRY(check_report(info, fault));
        write_struct(info_of(*of), info);
        return Status::ok;
    });
}

hm_status hm_equations_entries(const hm_equations* equations, int32_t first, int32_t n, int32_t* row, int32_t* column,
                               double* values, int64_t capacity, int64_t* n_entries, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const PartEquations* of = nullptr;
        HARMORPH_TRY(open(equations, "equations", of, fault));
        HARMORPH_TRY(require({{"n_entries", n_entries}}, fault));
        if (first < 0 || n < 0 || n > of->matrix.n - first) {
            return fault.refuse(Status::bad_argument, "from unknown # (from 0) on there are no @ unknowns",
                                Counts::from_zero, first, n);
        }
        *n_entries = 0;
        of->for_each_entry(first, n, [&](Index, Index, Real, Real) { ++*n_entries; });
        if (capacity < *n_entries) {
            return fault.refuse(Status::bad_argument, "there is room for fewer entries than there are");
        }
        if (capacity > 0) HARMORPH_TRY(require({{"row", row}, {"column", column}, {"values", values}}, fault));
        of->for_each_entry(first, n, [&](Index i, Index j, Real re, Real im) {
            *row++ = i;
            *column++ = j;
            *values++ = re;
            if (of->numbers() == 1) return;
            *values++ = -im;
            *values++ = im;
            *values++ = re;
        });
        return Status::ok;
    });
}

hm_status hm_rows_size(const hm_equations* equations, size_t* bytes, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const PartEquations* of = nullptr;
        HARMORPH_TRY(open(equations, "equations", of, fault));
        Basis made;
        return count_bytes(bytes, fault, [&](Arena& arena) { made.lay_out(arena, of->basis_source().counts()); });
    });
}

hm_status hm_rows_init(hm_basis** rows, void* block, size_t bytes, const hm_equations* equations, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const PartEquations* of = nullptr;
        HARMORPH_TRY(require({{"rows", rows}}, fault));
        HARMORPH_TRY(open(equations, "equations", of, fault));
        BasisCounts const counts = of->basis_source().counts();
        Basis made;
        HARMORPH_TRY(place(block, bytes, fault, [&](Arena& arena) { made.lay_out(arena, counts); }));
        init_basis(made, counts, of->basis_source());
        set_right_hand_sides(of->matrix, made, of->dofs(made));
        *rows = reinterpret_cast<hm_basis*>(made.header);
        return Status::ok;
    });
}

hm_status hm_rows_get(const hm_equations* equations, const hm_basis* rows, int32_t column, double* numbers,
                      hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        RowsCall call;
        HARMORPH_TRY(call.open_both(equations, rows, fault));
        HARMORPH_TRY(call.check_column(column, numbers, fault));
        call.equations->get(call.equations->dofs(call.basis), column, numbers);
        return Status::ok;
    });
}

hm_status hm_rows_set(const hm_equations* equations, hm_basis* rows, int32_t column, const double* numbers,
                      hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        RowsCall call;
        HARMORPH_TRY(call.open_both(equations, rows, fault));
        HARMORPH_TRY(call.check_column(column, numbers, fault));
        call.equations->set(call.equations->dofs(call.basis), column, numbers);
        return Status::ok;
    });
}

hm_status hm_rows_residual(hm_equations* equations, const hm_basis* rows, int32_t column, double* residual,
                           hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        RowsCall call;
        HARMORPH_TRY(call.open_both(equations, rows, fault));
        HARMORPH_TRY(call.check_column(column, residual, fault));
        call.equations->find_residual(call.equations->dofs(call.basis), column, residual);
        return Status::ok;
    });
}

hm_status hm_rows_finish(hm_equations* equations, hm_basis* rows, double largest, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        RowsCall call;
        HARMORPH_TRY(call.open_both(equations, rows, fault));
        if (!is_finite(largest) || largest < 0) {
            return fault.refuse(Status::bad_argument, "largest must be finite and not negative, not ~",
                                Counts::from_zero, none, none, largest);
        }
        call.equations->finish(call.basis, largest);
        return Status::ok;
    });
}

hm_status hm_field_init(hm_equations* equations, const hm_points* displacement, double* work, double* right_hand_sides,
                        hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        FieldCall call;
        Points given;
        HARMORPH_TRY(call.open_field(equations, work, fault));
        HARMORPH_TRY(require({{"right_hand_sides", right_hand_sides}}, fault));
        HARMORPH_TRY(view_points(displacement, "displacement", given, fault));
        PartEquations const& of = *call.equations;
        Index const kind = of.shared.curves.count() + of.problem.demands.bodies;
        fill(call.rows, 0.0);
        for (Index k = 0; k < of.wall.count; ++k) {
            Index const point = of.wall.point[k];
            if (of.wall.curve[k] != kind) continue;
            if (!is_coordinate(given[point])) {
                return fault.refuse(Status::bad_argument, "the displacement of point # is not finite, or beyond 1e100",
                                    Counts::mesh, point);
            }
            call.rows[2 * Offset{point}] = given[point].x;
            call.rows[2 * Offset{point} + 1] = given[point].y;
        }
        subtract_couplings(of.matrix, call.values());
        call.for_each_column(right_hand_sides, [&](Index column, double* to) { of.get(call.values(), column, to); });
        return Status::ok;
    });
}

hm_status hm_field_residual(hm_equations* equations, double* work, const double* values, double* residuals,
                            hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        FieldCall call;
        HARMORPH_TRY(call.open_field(equations, work, fault));
        HARMORPH_TRY(require({{"values", values}, {"residuals", residuals}}, fault));
        PartEquations const& of = *call.equations;
        call.for_each_column(values, [&](Index column, const double* from) { of.set(call.values(), column, from); });
        call.for_each_column(residuals, [&](Index column, double* to) { of.find_residual(call.values(), column, to); });
        return Status::ok;
    });
}

hm_status hm_field_finish(hm_equations* equations, double* work, const double* values,
                          const hm_points_out* displacement, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        FieldCall call;
        MutablePoints to;
        HARMORPH_TRY(call.open_field(equations, work, fault));
        HARMORPH_TRY(require({{"values", values}}, fault));
        HARMORPH_TRY(view_points(displacement, "displacement", to, fault));
        PartEquations const& of = *call.equations;
        call.for_each_column(values, [&](Index column, const double* from) { of.set(call.values(), column, from); });
        of.finish(call.values());
        for (Index k = 0; k < of.part.own().n_points; ++k) {
            to.set(k, {call.rows[2 * Offset{k}], call.rows[2 * Offset{k} + 1]});
        }
        return Status::ok;
    });
}

}  // extern "C"
