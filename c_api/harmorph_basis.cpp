// The C interface, part 3: everything that needs only a solved basis and the mesh.
#include "fault_text.hpp"
#include "harmorph/morph/adjoint.hpp"
#include "harmorph/morph/assessment.hpp"
#include "harmorph/morph/crossing.hpp"
#include "harmorph/morph/morph.hpp"
#include "open_basis.hpp"

namespace harmorph {
namespace {

// Basis and mesh that belong together, as far as counts and layout tell.
Status open_pair(const hm_basis* basis, const hm_mesh* given, Basis& out, Mesh& mesh, Fault& fault) noexcept {
    HARMORPH_TRY(open_basis(basis, out, fault));
    HARMORPH_TRY(view_mesh(given, mesh, fault));
    HARMORPH_TRY(check_layout(mesh, fault));
    if (out.header->counts.cells == 0) {
        return fault.refuse(Status::bad_basis, "the basis is of a list of points: it knows no cells and goes with no mesh");
    }
    if (mesh.n_points == out.n_points() && mesh.n_cells == out.header->counts.cells) return Status::ok;
    return fault.refuse(Status::bad_basis, "the basis belongs to another mesh: it has # points and @ cells", Counts::from_zero,
                        out.n_points(), out.header->counts.cells);
}

Status check_finite(const double* numbers, Index n, const char* sentence, Fault& fault) noexcept {
    if (numbers == nullptr) return fault.refuse(Status::bad_argument, "an argument is NULL");
    for (Index k = 0; k < n; ++k) {
        if (!is_finite(numbers[k])) return fault.refuse(Status::bad_argument, sentence, Counts::from_zero, k / 2);
    }
    return Status::ok;
}

Status check_move(Basis const& basis, const double* move, Fault& fault) noexcept {
    return check_finite(move, 2 * basis.header->counts.functions(), "the movement of function # (from 0) is not finite", fault);
}

// Coordinates of the mesh's points that the call gives; NULL: the mesh's own.
Status view_coordinates(const hm_points* given, const char* name, Mesh const& mesh, Points& points, Fault& fault) noexcept {
    hm_points const own = {mesh.points.x, mesh.points.y, mesh.points.stride};
    return given != nullptr ? view_points(given, name, points, fault) : view_points(&own, "mesh.points", points, fault);
}

Bases bases_of(Basis const& basis) noexcept { return {basis.header != nullptr ? basis.header->index_base : 0, 0}; }

Index numbered(Index item, Index base) noexcept { return item == none ? none : item + base; }

hm_step_report report_of(AdmissibleStep const& limit, Mesh const& mesh, Basis const& basis) noexcept {
    hm_step_report filled = {};
    filled.admissible = limit.step;
    filled.cell = numbered(limit.cell, mesh.index_base);
    filled.point = numbered(limiting_point(mesh, limit, basis.reversed), mesh.index_base);
    return filled;
}

hm_quality_report report_of(Quality const& quality, Crossing const& crossing, Mesh const& mesh) noexcept {
    hm_quality_report filled = {};
    filled.inverted = quality.inverted;
    filled.first_inverted = numbered(quality.first_inverted, mesh.index_base);
    filled.min_area = quality.min_area;
    filled.min_quality = quality.min_quality;
    filled.mean_quality = quality.mean_quality();
    filled.min_quality_cell = numbered(quality.min_quality_cell, mesh.index_base);
    filled.self_crossing = crossing.found ? 1 : 0;
    for (Index k = 0; k < 2; ++k) {
        filled.crossing_points[k] = numbered(crossing.first[k], mesh.index_base);
        filled.crossing_points[2 + k] = numbered(crossing.second[k], mesh.index_base);
    }
    return filled;
}

// The basis, and room for all of its curves.
Status open_curves(const hm_basis* basis, hm_curves* out, const hm_curve* curve, Index capacity, Basis& b,
                   Fault& fault) noexcept {
    if (curve == nullptr) return fault.refuse(Status::bad_argument, "curve is NULL");
    HARMORPH_TRY(check_report(out, fault));
    HARMORPH_TRY(open_basis(basis, b, fault));
    Index const n = b.header->counts.curves;
    if (capacity >= n) return Status::ok;
    return fault.refuse(Status::bad_argument, "curve has room for #, the basis has @", Counts::from_zero, capacity, n);
}

hm_curves curves_of(Basis const& basis, const double* control, hm_curve* curve) noexcept {
    Index const n = basis.header->counts.curves;
    for (Index i = 0; i < n; ++i) {
        Curve const its = basis.curve(i);
        curve[i] = {sizeof(hm_curve), its.degree, its.n_indices, its.indices, its.knots};
    }
    return {sizeof(hm_curves), 0, basis.header->counts.control, control,
            basis.weights.empty() ? nullptr : basis.weights.data(), n, curve};
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_basis_attach(const hm_basis** basis, const void* block, size_t bytes, const hm_mesh* mesh, hm_error* err) {
    Fault fault;
    Mesh view;
    if (basis == nullptr || block == nullptr) {
        fault.refuse(Status::bad_argument, "basis or block is NULL");
    } else if (reinterpret_cast<std::uintptr_t>(block) % 8 != 0) {
        fault.refuse(Status::bad_argument, "the block of a basis must be aligned to 8 bytes");
    } else if (mesh == nullptr || !failed(view_mesh(mesh, view, fault))) {
        if (mesh == nullptr || !failed(check_mesh(view, fault))) {
            check_basis(block, bytes, mesh != nullptr ? &view : nullptr, fault);
        }
    }
    if (!failed(fault.status)) *basis = static_cast<const hm_basis*>(block);
    return tell(err, fault, {view.index_base, 0});
}

hm_status hm_basis_info_get(const hm_basis* basis, hm_basis_info* info, hm_error* err) {
    Fault fault;
    Basis b;
    if (!failed(check_report(info, fault)) && !failed(open_basis(basis, b, fault))) {
        BasisHeader const& header = *b.header;
        hm_basis_info filled = {};
        filled.bytes = header.bytes;
        filled.solved = header.solved;
        filled.points = header.counts.points;
        filled.cells = header.counts.cells;
        filled.functions = header.counts.functions();
        filled.curves = header.counts.curves;
        filled.curve_points = header.counts.wall;
        filled.numbers_per_value = numbers_of(header.counts.kind);
        filled.operator_kind = static_cast<std::int32_t>(header.method.operator_kind);
        filled.scheme = static_cast<std::int32_t>(header.method.scheme);
        filled.engine = static_cast<std::int32_t>(header.method.engine);
        filled.exponent_quarters = header.method.quarters;
        filled.bodies = header.counts.bodies;
        filled.offset_correction = header.method.offset_correction;
        filled.storage = static_cast<std::int32_t>(header.counts.storage);
        filled.index_base = header.index_base;
        filled.curve_point = b.wall_point.data();
        filled.point_curve = b.wall_curve.data();
        filled.point_u = b.wall_u.data();
        write_struct(filled, info);
    }
    return tell(err, fault);
}

hm_status hm_basis_curves(const hm_basis* basis, hm_curves* out, hm_curve* curve, int32_t capacity, hm_error* err) {
    Fault fault;
    Basis b;
    if (!failed(open_curves(basis, out, curve, capacity, b, fault))) {
        write_struct(curves_of(b, b.control.data(), curve), out);
    }
    return tell(err, fault);
}

hm_status hm_moved_curves(const hm_basis* basis, const double* move, double* control, hm_curves* out, hm_curve* curve,
                          int32_t capacity, hm_error* err) {
    Fault fault;
    Basis b;
    if (control == nullptr) fault.refuse(Status::bad_argument, "control is NULL");
    if (!failed(fault.status) && !failed(open_curves(basis, out, curve, capacity, b, fault)) &&
        !failed(check_move(b, move, fault))) {
        for (Index k = 0; k < b.control.count(); ++k) control[k] = b.control[k] + move[k];
        write_struct(curves_of(b, control, curve), out);
    }
    return tell(err, fault);
}

hm_status hm_basis_conditions(const hm_basis* basis, hm_condition* out, int32_t capacity, int32_t* n, hm_error* err) {
    Fault fault;
    Basis b;
    if (n == nullptr || capacity < 0) fault.refuse(Status::bad_argument, "n is NULL or capacity negative");
    if (!failed(fault.status) && (capacity == 0 || !failed(check_report(out, fault))) && !failed(open_basis(basis, b, fault))) {
        *n = b.conditions.count();
        if (*n > capacity) {
            fault.refuse(Status::bad_argument, "out has room for #, the basis has @ conditions", Counts::from_zero, capacity, *n);
        } else {
            for (Index i = *n; i-- > 0;) {  // the first one tells the size of all
                Condition const& its = b.conditions[i];
                hm_condition* const to = element(out, i);
                to->struct_size = out->struct_size;
                write_struct(hm_condition{0, its.marker, static_cast<std::int32_t>(its.kind), its.first_curve, its.n_curves,
                                          its.body, its.partner, its.centre.x, its.centre.y}, to);
            }
        }
    }
    return tell(err, fault);
}

hm_status hm_basis_values(const hm_basis* basis, int32_t function, int32_t number, double* values, hm_error* err) {
    Fault fault;
    Basis b;
    if (values == nullptr) fault.refuse(Status::bad_argument, "values is NULL");
    if (!failed(fault.status) && !failed(open_solved(basis, b, fault))) {
        Index const held = function - b.header->counts.first_held;
        if (function < 0 || held < 0 || held >= b.n_functions()) {
            fault.refuse(Status::bad_argument, "there is no function # (from 0); the basis has @", Counts::from_zero, function,
                         b.n_functions());
        } else if (number < 0 || number >= numbers_of(b.kind())) {
            fault.refuse(Status::bad_argument, "values have no number # (from 0); they have @", Counts::from_zero, number,
                         numbers_of(b.kind()));
        } else {
            b.column(number * b.n_functions() + held, values);
        }
    }
    return tell(err, fault);
}

hm_status hm_morph(const hm_basis* basis, const double* move, const hm_points* from, const hm_points_out* to,
                   const hm_executor* executor, hm_error* err) {
    Fault fault;
    Basis b;
    Executor threads;
    Points before;
    MutablePoints after;
    if (!failed(open_complete(basis, b, fault)) && !failed(view_executor(executor, threads, fault)) &&
        !failed(check_move(b, move, fault)) && !failed(view_points_if(from, "from", before, fault)) &&
        !failed(view_points(to, "to", after, fault))) {
        morph(b, move, before, after, threads);
    }
    return tell(err, fault);
}

hm_status hm_adjoint(const hm_basis* basis, const hm_points* dj, double* gradient, const hm_executor* executor,
                     hm_error* err) {
    Fault fault;
    Basis b;
    Executor threads;
    Points by_points;
    if (gradient == nullptr) fault.refuse(Status::bad_argument, "gradient is NULL");
    if (!failed(fault.status) && !failed(open_complete(basis, b, fault)) &&
        !failed(view_points(dj, "dj", by_points, fault)) && !failed(view_executor(executor, threads, fault))) {
        adjoint_morph(b, by_points, gradient, threads);
    }
    return tell(err, fault);
}

hm_status hm_boundary_error(const hm_basis* basis, const double* move, const hm_points* from, const hm_points* to,
                            double* error, int32_t* point, hm_error* err) {
    Fault fault;
    Basis b;
    Points before, after;
    if (error == nullptr) fault.refuse(Status::bad_argument, "error is NULL");
    if (!failed(fault.status) && !failed(open_basis(basis, b, fault)) && !failed(check_move(b, move, fault)) &&
        !failed(view_points(from, "from", before, fault)) && !failed(view_points(to, "to", after, fault))) {
        BoundaryError const worst = boundary_error(b, move, before, after);
        *error = worst.error;
        if (point != nullptr) *point = numbered(worst.point, b.header->index_base);
    }
    return tell(err, fault, bases_of(b));
}

hm_status hm_admissible_step(const hm_basis* basis, const hm_mesh* mesh, const hm_points* from,
                             const hm_points* displacement, const hm_executor* executor, hm_step_report* report,
                             hm_error* err) {
    Fault fault;
    Basis b;
    Executor threads;
    Mesh view;
    Points start, change;
    if (!failed(check_report(report, fault)) && !failed(open_pair(basis, mesh, b, view, fault)) &&
        !failed(view_coordinates(from, "from", view, start, fault)) &&
        !failed(view_points(displacement, "displacement", change, fault)) &&
        !failed(view_executor(executor, threads, fault))) {
        AdmissibleStep const limit = admissible_step(view, start, change, b.reversed, threads);
        hm_step_report const filled = report_of(limit, view, b);
        write_struct(filled, report);
    }
    return tell(err, fault, {view.index_base, 0});
}

hm_status hm_quality(const hm_basis* basis, const hm_mesh* mesh, const hm_points* at, const hm_points* reference,
                     const hm_executor* executor, hm_quality_report* report, hm_error* err) {
    Fault fault;
    Basis b;
    Executor threads;
    Mesh view;
    Points points, undeformed;
    if (!failed(check_report(report, fault)) && !failed(open_pair(basis, mesh, b, view, fault)) &&
        !failed(view_coordinates(at, "at", view, points, fault)) &&
        !failed(view_points_if(reference, "reference", undeformed, fault)) && !failed(view_executor(executor, threads, fault))) {
        Quality const quality = measure_quality(view, points, undeformed, b.reversed, threads);
        Crossing const crossing = find_crossing(b.boundary_point, b.loop_start, points);
        hm_quality_report const filled = report_of(quality, crossing, view);
        write_struct(filled, report);
    }
    return tell(err, fault, {view.index_base, 0});
}

hm_status hm_assess(const hm_basis* basis, const hm_mesh* mesh, const hm_points* from, const hm_points* displacement,
                    const hm_executor* executor, hm_step_report* step, hm_quality_report* quality, hm_error* err) {
    Fault fault;
    Basis b;
    Executor threads;
    Mesh view;
    Points start, change;
    if (!failed(check_report(step, fault)) && !failed(check_report(quality, fault)) &&
        !failed(open_pair(basis, mesh, b, view, fault)) &&
        !failed(view_coordinates(from, "from", view, start, fault)) &&
        !failed(view_points(displacement, "displacement", change, fault)) &&
        !failed(view_executor(executor, threads, fault))) {
        Assessment const assessment = assess(view, start, change, b.reversed, threads);
        Crossing const crossing = find_crossing(b.boundary_point, b.loop_start, start, change);
        write_struct(report_of(assessment.limit, view, b), step);
        write_struct(report_of(assessment.quality, crossing, view), quality);
    }
    return tell(err, fault, {view.index_base, 0});
}

}  // extern "C"
