// The C interface: computes one field of given displacements in a part.
#include "base/vec2.hpp"
#include "operators/right_hand_sides.hpp"
#include "part_handles.hpp"
#include "views.hpp"

namespace harmorph {
namespace {

// One field of displacements, in the caller's working memory: two numbers, x and y, for each point.
struct FieldCall {
    PartEquations* equations = nullptr;
    Span<Real> rows;

    Status open_field(hm_private_equations* handle, double* work, CallFault& fault) noexcept {
        HARMORPH_TRY(open(handle, "equations", equations, fault));
        HARMORPH_TRY(require({{"work", work}}, fault));
        rows = {work, 2 * static_cast<Size>(equations->part.own().n_points)};
        return Status::ok;
    }
    DofValues values() const noexcept {
        return {rows,
                0,
                1,
                equations->dof_of,
                equations->wall.point.first(equations->wall.count),
                equations->matrix.components()};
    }
    // Calls body(column, numbers of that column) for each column.
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

hm_status hm_private_field_init(hm_private_equations* equations, const hm_points* displacement,
                                double* work, double* right_hand_sides, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        FieldCall call;
        Points given;
        HARMORPH_TRY(call.open_field(equations, work, fault));
        HARMORPH_TRY(require({{"right_hand_sides", right_hand_sides}}, fault));
        HARMORPH_TRY(view_points(displacement, "displacement", given, fault));
        PartEquations const& opened = *call.equations;
        Index const kind = opened.shared.curves.count() + opened.problem.demands.bodies;
        fill(call.rows, 0.0);
        for (Index k = 0; k < opened.wall.count; ++k) {
            Index const point = opened.wall.point[k];
            if (opened.wall.curve[k] != kind) continue;
            if (!is_coordinate(given[point])) {
                return fault.refuse(Status::bad_argument,
                                    "the displacement of point # is not finite or beyond 1e100",
                                    point_item(point));
            }
            call.rows[2 * Offset{point}] = given[point].x;
            call.rows[2 * Offset{point} + 1] = given[point].y;
        }
        subtract_couplings(opened.matrix, call.values());
        call.for_each_column(right_hand_sides, [&](Index column, double* to) {
            opened.get(call.values(), column, to);
        });
        return Status::ok;
    });
}

hm_status hm_private_field_residual(hm_private_equations* equations, double* work,
                                    const double* values, double* residuals, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        FieldCall call;
        HARMORPH_TRY(call.open_field(equations, work, fault));
        HARMORPH_TRY(require({{"values", values}, {"residuals", residuals}}, fault));
        PartEquations const& opened = *call.equations;
        call.for_each_column(values, [&](Index column, const double* from) {
            opened.set(call.values(), column, from);
        });
        call.for_each_column(residuals, [&](Index column, double* to) {
            opened.find_residual(call.values(), column, to);
        });
        return Status::ok;
    });
}

hm_status hm_private_field_finish(hm_private_equations* equations, double* work,
                                  const double* values, const hm_points_out* displacement,
                                  hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        FieldCall call;
        MutablePoints to;
        HARMORPH_TRY(call.open_field(equations, work, fault));
        HARMORPH_TRY(require({{"values", values}}, fault));
        HARMORPH_TRY(view_points(displacement, "displacement", to, fault));
        PartEquations const& opened = *call.equations;
        call.for_each_column(values, [&](Index column, const double* from) {
            opened.set(call.values(), column, from);
        });
        opened.finish(call.values());
        for (Index k = 0; k < opened.part.own().n_points; ++k) {
            to.set(k, {call.rows[2 * Offset{k}], call.rows[2 * Offset{k} + 1]});
        }
        return Status::ok;
    });
}

}  // extern "C"
