#include "harmorph/safe/corner_map.hpp"

namespace harmorph {
namespace {

constexpr Vec2 times_i(Vec2 a) noexcept { return {-a.y, a.x}; }
Vec2 direction_or_x(Vec2 a) noexcept {
    Real const size = length(a);
    return size > 0 ? 1 / size * a : Vec2{1, 0};
}

// Eigenvalues of a symmetric 2 x 2 matrix, and the first one's direction.
struct Eigen {
    Real value[2];
    Vec2 axis;

    Eigen(Real a, Real b, Real c) noexcept {  // a b; b c
        Real const mean = 0.5 * (a + c), whole = 0.5 * (a - c);
        // Of cells that have nearly collapsed derivatives are so large that their squares would overflow.
        Real const unit = larger(absolute(whole), absolute(b)) > 0x1p500 ? 0x1p512 : 1;
        Real const half = whole / unit, radius = square_root(half * half + (b / unit) * (b / unit));
        value[0] = mean + unit * radius;
        value[1] = mean - unit * radius;
        b /= unit;
        axis = direction_or_x(half >= 0 ? Vec2{half + radius, b} : Vec2{b, radius - half});
    }
};

}  // namespace

CornerMap::CornerMap(Triangle const& reference) noexcept : twice_area_(reference.twice_area()) {
    Vec2 const side = reference.at[1] - reference.at[0], next = reference.at[2] - reference.at[1];
    Real const half = 0.5 / twice_area_;
    first_ = half * times_i(conjugate(next));
    second_ = -half * times_i(conjugate(side));
}

// A change of z and w as one of the points: the transpose of the map from points to z and w.
void CornerMap::pull_back(Vec2 by_z, Vec2 by_w, Vec2 (&at)[3]) const noexcept {
    Vec2 const by_side = product(conjugate(first_), by_z) + product(first_, by_w);
    Vec2 const by_next = product(conjugate(second_), by_z) + product(second_, by_w);
    at[0] = -1 * by_side;
    at[1] = by_side - by_next;
    at[2] = by_next;
}

void CornerMap::differentiate(Triangle const& now, DensityDerivatives const& by, Real least, Vec2 (&gradient)[3],
                              CornerMode (&mode)[4]) const noexcept {
    Vec2 const z_now = z(now), w_now = w(now);
    Real const p = square(z_now), q = square(w_now);
    pull_back(2 * by.by_p * z_now, 2 * by.by_q * w_now, gradient);

    // Turning z or w leaves p and q; growing them couples the two.
    Vec2 const along_z = direction_or_x(z_now), along_w = direction_or_x(w_now);
    Eigen const growth(2 * by.by_p + 4 * p * by.by_pp, 4 * square_root(p * q) * by.by_pq,
                       2 * by.by_q + 4 * q * by.by_qq);
    Real const curvature[4] = {2 * by.by_p, 2 * by.by_q, growth.value[0], growth.value[1]};
    for (Index k = 0; k < 4; ++k) mode[k].curvature = larger(curvature[k], least);
    pull_back(times_i(along_z), {}, mode[0].at);
    pull_back({}, times_i(along_w), mode[1].at);
    pull_back(growth.axis.x * along_z, growth.axis.y * along_w, mode[2].at);
    pull_back(-growth.axis.y * along_z, growth.axis.x * along_w, mode[3].at);
}

}  // namespace harmorph
