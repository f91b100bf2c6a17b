#include "bspline/unit_points.hpp"

namespace harmorph {

Status UnitPoints::take(Points points, Index n, bool is_loop, Fault& fault) noexcept {
    Vec2 sum;
    for (Index k = 0; k < n; ++k) {
        if (!is_finite(points[k].x) || !is_finite(points[k].y))
            return fault.refuse(Status::bad_curve, "point # has a coordinate that is not finite",
                                point_item(k));
        if (!is_in_range(points[k]))
            return fault.refuse(Status::bad_curve, "point # has a coordinate beyond 1e100",
                                point_item(k));
        sum = sum + (points[k] - points[0]);
    }
    centre = points[0] + (1 / static_cast<Real>(n)) * sum;
    auto const farthest_from = [&](Vec2 p) {
        Vec2 farthest = p;
        for (Index k = 0; k < n; ++k)
            if (square(points[k] - p) > square(farthest - p)) farthest = points[k];
        return farthest;
    };
    Vec2 const end = farthest_from(centre);
    extent = length(farthest_from(end) - end);
    if (!is_finite(extent))
        return fault.refuse(Status::bad_curve, "the distances between the points are too large");
    if (extent == 0) return fault.refuse(Status::bad_curve, "all points are in the same place");
    for (Index k = 0; k < n; ++k) at[k] = to_unit(points[k]);
    for (Index k = 0; k + (is_loop ? 0 : 1) < n; ++k) {
        Index const next = k + 1 == n ? 0 : k + 1;
        if (square(at[next] - at[k]) == 0)
            return fault.refuse(Status::bad_curve, "the consecutive points # and @ are equal",
                                point_item(k), point_item(next));
    }
    Vec2 const first = points[0], last = points[n - 1];
    if (!is_loop && first.x == last.x && first.y == last.y)
        return fault.refuse(
            Status::bad_curve,
            "the first point and the last point, #, are equal; fit a loop without the last point",
            point_item(n - 1));
    return Status::ok;
}

}  // namespace harmorph
