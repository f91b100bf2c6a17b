// The C interface: finds the movement that a mesh has made since its basis was made.
#include "base/vec2.hpp"
#include "basis/wall_movement.hpp"
#include "handles.hpp"

namespace harmorph {
namespace {

Status check_wall(Basis const& basis, Points at, Fault& fault) noexcept {
    for (Index const point : basis.wall_point) {
        if (is_coordinate(at[point])) continue;
        return fault.refuse(
            Status::bad_mesh,
            "point # of the wall has a coordinate that is not finite or beyond 1e100",
            point_item(point));
    }
    return Status::ok;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_recover_movement(const hm_basis* basis, const hm_points* at, double tolerance,
                              double* move, hm_recover_report* report, hm_memory* memory,
                              hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        Points now;
        WallMovement found;
        HARMORPH_TRY(open_basis(basis, b, fault));
        HARMORPH_TRY(
            place(memory, fault, [&](Arena& arena) { found.lay_out(arena, b.header->counts); }));
        HARMORPH_TRY(require({{"move", move}}, fault));
        HARMORPH_TRY(check_report_if(report, "report", fault));
        HARMORPH_TRY(open_complete(basis, b, fault));
        HARMORPH_TRY(view_points(at, "at", now, fault, b.n_points()));
        if (!(tolerance >= 0)) {
            return fault.refuse(Status::bad_argument, "tolerance must be at least 0, not ~", {}, {},
                                tolerance);
        }
        HARMORPH_TRY(check_wall(b, now, fault));
        found.find(b, now);
        BoundaryError const worst = found.following;
        Real const max_error = tolerance > 0
                                   ? tolerance
                                   : WallMovement::default_tolerance * WallMovement::extent(b, now);
        if (!(worst.error <= max_error)) {
            Vec2 const place = now[worst.point];
            return fault.refuse_at(place.x, place.y, Status::bad_mesh,
                                   "the wall is on no curve of this basis: point # at $ is ~ away "
                                   "from the best-fitting curve",
                                   point_item(worst.point), {}, worst.error);
        }
        for (Index i = 0; i < b.n_functions(); ++i) {
            move[2 * i] = found.unknown[i].x;
            move[2 * i + 1] = found.unknown[i].y;
        }
        if (report == nullptr) return Status::ok;
        hm_recover_report filled = {};
        filled.residual = found.residual.error;
        filled.rotated_offset = found.rotated_offset;
        filled.point = numbered(found.residual.point, b.header->index_base);
        write_struct(filled, report);
        return Status::ok;
    });
}

}  // extern "C"
