// The C interface: makes the equations of a part, and gives their matrix entries.
#include "part_handles.hpp"
#include "request.hpp"

namespace harmorph {
namespace {

struct EquationsRequest : Request {
    const Part* part = nullptr;
    Index n_edges = 0;

    Status read_all(const hm_private_part* opened, Index edges, const hm_problem* given,
                    const hm_options* options, CallFault& fault) noexcept {
        HARMORPH_TRY(open_part(opened, part, fault));
        n_edges = edges;
        if (edges < 0 || edges > Mesh::max_points / 2) {
            return fault.refuse(Status::bad_argument, "n_edges must be between 0 and 2^29, not #",
                                plain(edges));
        }
        HARMORPH_TRY(read_without_mesh(given, options, fault));
        Method const& method = problem.method;
        const char* wrong = nullptr;
        if (method.scheme != Scheme::compact)
            wrong = "a mesh in parts needs the compact scheme (HM_COMPACT)";
        if (method.engine != Engine::direct)
            wrong = "options.engine must be HM_DIRECT for a mesh in parts";
        if (problem.demands.rotation) {
            wrong = "HM_ROTATION_PAIR is not available for a mesh in parts; HM_PERIODIC_PAIR is";
        }
        if (problem.demands.slip_curves > 0) {
            wrong = "hm_condition.along is not available for a mesh in parts; leave it NULL";
        }
        if (problem.fluxes.count() > 0) wrong = "problem.n_fluxes must be 0 for a mesh in parts";
        if (!problem.given.point.empty()) wrong = "problem.n_known must be 0 for a mesh in parts";
        if (wrong != nullptr) return fault.refuse(Status::unsupported, wrong);
        if (n_conditions > 0) return Status::ok;
        return fault.refuse(Status::bad_condition,
                            "there is nothing to solve, because the problem has no curves, rigid "
                            "bodies or given displacements");
    }
    PartProblem asked() const noexcept {
        return {problem.method, problem.demands, problem.executor, problem.max_curve_distance};
    }
    void lay_out(Arena& arena, InBlock<PartEquations>& made) const noexcept {
        made.lay_out(arena, *part, asked(), n_edges, n_curves, n_conditions, n_control());
    }
};

hm_private_equations_info info_of(PartEquations const& equations) noexcept {
    hm_private_equations_info filled = {};
    BasisCounts const counts = equations.basis_source().counts();
    filled.unknowns = equations.matrix.n;
    filled.numbers = equations.numbers();
    filled.functions = counts.functions();
    filled.columns = equations.matrix.is_complex() ? counts.functions()
                                                   : numbers_of(counts.kind) * counts.functions() /
                                                         equations.matrix.components();
    filled.field_columns = equations.matrix.kind() == MatrixKind::real ? 2 : 1;
    filled.unknown = equations.unknown_number.data();
    filled.own = equations.is_own.data();
    return filled;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_private_equations_size(const hm_private_part* part, int32_t n_edges,
                                    const hm_problem* problem, const hm_options* options,
                                    size_t* bytes, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        EquationsRequest request;
        HARMORPH_TRY(request.read_all(part, n_edges, problem, options, fault));
        InBlock<PartEquations> made;
        return count_bytes(bytes, fault, [&](Arena& arena) { request.lay_out(arena, made); });
    });
}

hm_status hm_private_equations_init(hm_private_equations** equations, void* block, size_t bytes,
                                    const hm_private_part* part, int32_t n_edges,
                                    const hm_private_edge* edges, const hm_problem* problem,
                                    const hm_options* options, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        EquationsRequest request;
        HARMORPH_TRY(require({{"equations", equations}}, fault));
        HARMORPH_TRY(request.read_all(part, n_edges, problem, options, fault));
        if (n_edges > 0) HARMORPH_TRY(require({{"edges", edges}}, fault));
        InBlock<PartEquations> made;
        HARMORPH_TRY(
            place(block, bytes, fault, [&](Arena& arena) { request.lay_out(arena, made); }));
        HARMORPH_TRY(
            request.copy_to(made.object.shared.curves, {}, made.object.shared.conditions, fault));
        Span<const OpenEdge> const all(reinterpret_cast<const OpenEdge*>(edges),
                                       static_cast<Size>(n_edges));
        HARMORPH_TRY(made.object.run(all, fault));
        made.give(equations);
        return fault.status;
    });
}

hm_status hm_private_equations_info_get(const hm_private_equations* equations,
                                        hm_private_equations_info* info, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const PartEquations* opened = nullptr;
        HARMORPH_TRY(open(equations, "equations", opened, fault));
        HARMORPH_TRY(check_report(info, "info", fault));
        write_struct(info_of(*opened), info);
        return Status::ok;
    });
}

hm_status hm_private_equations_entries(const hm_private_equations* equations, int32_t first,
                                       int32_t n, int32_t* row, int32_t* column, double* values,
                                       int64_t capacity, int64_t* n_entries, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const PartEquations* opened = nullptr;
        HARMORPH_TRY(open(equations, "equations", opened, fault));
        HARMORPH_TRY(require({{"n_entries", n_entries}}, fault));
        if (first < 0 || n < 0 || n > opened->matrix.n - first) {
            return fault.refuse(Status::bad_argument,
                                "first is # and n is @, but unknowns first to first + n - 1 must "
                                "exist in this part",
                                entry_item(first), plain(n));
        }
        if (capacity > 0)
            HARMORPH_TRY(require({{"row", row}, {"column", column}, {"values", values}}, fault));
        *n_entries = 0;
        opened->for_each_entry(first, n, [&](Index, Index, Real, Real) { ++*n_entries; });
        if (capacity < *n_entries) {
            return fault.refuse(
                Status::bad_argument,
                "capacity is smaller than the number of entries, which *n_entries now contains");
        }
        opened->for_each_entry(first, n, [&](Index i, Index j, Real re, Real im) {
            *row++ = i;
            *column++ = j;
            *values++ = re;
            if (opened->numbers() == 1) return;
            *values++ = -im;
            *values++ = im;
            *values++ = re;
        });
        return Status::ok;
    });
}

}  // extern "C"
