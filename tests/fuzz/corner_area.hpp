// The area of a corner while its points move, in more digits than the library has.
#pragma once

#include "reference.hpp"
#include "solution.hpp"

namespace fuzz {

// The area of a corner, turned if the header says so, at points + s * by, and the rate at which it
// changes with s.
struct Area {
    Wide value = 0, rate = 0;
    Wide by_point[6] = {};  // derivatives by x and y of the three points
    Wide rounding = 0;      // what the library may lose: the sides are much longer than high
};

inline Area area_of(JudgedCorner const& corner, std::vector<Point> const& from,
                    std::vector<Point> const& by, Wide s) {
    Point const p = from[at(corner.before)], q = from[at(corner.here)], r = from[at(corner.after)],
                u = by[at(corner.before)], v = by[at(corner.here)], w = by[at(corner.after)];
    Wide const c = corner.cosine, d = corner.sine;
    Wide const ux = Wide(v.x) - u.x, uy = Wide(v.y) - u.y, vx = Wide(w.x) - v.x,
               vy = Wide(w.y) - v.y;
    Wide const ax = Wide(q.x) - p.x + s * ux, ay = Wide(q.y) - p.y + s * uy,
               bx = Wide(r.x) - q.x + s * vx, by_ = Wide(r.y) - q.y + s * vy;
    Area out;
    out.value = c * (ax * by_ - ay * bx) + d * (ax * bx + ay * by_);
    Wide const by_ax = c * by_ + d * bx, by_ay = -c * bx + d * by_, by_bx = -c * ay + d * ax,
               by_by = c * ax + d * ay;
    out.rate = by_ax * ux + by_ay * uy + by_bx * vx + by_by * vy;
    Wide const gradient[6] = {-by_ax, -by_ay, by_ax - by_bx, by_ay - by_by, by_bx, by_by};
    std::copy(gradient, gradient + 6, out.by_point);
    out.rounding = 0x1p-50L * std::hypot(ax, ay) * std::hypot(bx, by_);
    return out;
}

// The corners that limit the step along `by`, and the derivatives of the step by their points: the
// areas of these corners become 0. step: the admissible one of hm_assess.
void check_step_corners(Solution& solved, Judged const& judged, std::vector<Point> const& by,
                        double step, Input& input);

}  // namespace fuzz
