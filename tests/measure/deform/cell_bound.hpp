// The largest quality that one cell can have of which only a side, an angle,
// or points that it must not contain are known.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace deform {

inline double const pi = std::acos(-1.);

// The smallest angle that a cell of n corners with the skew quality q can have. A triangle with
// sides a, b about the angle t has the quality sqrt(3) a b sin t / (a^2 + b^2 - a b cos t), at most
// sqrt(3) sin t / (2 - cos t); a quadrilateral, 4 / sum of 1 / sin of its angles, has at most 4 /
// (3 + 1 / sin t).
inline double min_angle(int n, double q) {
    if (q >= 1) return n == 3 ? std::acos(.5) : std::acos(0.);
    if (n != 3) return std::asin(1 / (4 / q - 3));
    // sqrt(3) sin t + q cos t = 2 q
    double const size = std::sqrt(3 + q * q);
    return std::asin(2 * q / size) - std::atan2(q, std::sqrt(3.));
}

// The largest quality that all cells of n_triangles and n_quads can have whose corners together
// fill an angle.
inline double best_quality(double angle, int n_triangles, int n_quads) {
    double low = 0, high = 1;
    for (int k = 0; k < 60; ++k) {
        double const q = .5 * (low + high);
        (n_triangles * min_angle(3, q) + n_quads * min_angle(4, q) <= angle ? low : high) = q;
    }
    return high;
}

// The largest skew quality of a cell of n corners with an angle of at least this, which is more
// than in an equilateral triangle or a square.
inline double best_with_wide_angle(int n, double angle) {
    if (angle >= pi) return 0;
    if (angle <= (n == 3 ? pi / 3 : pi / 2)) return 1;
    return n == 3 ? std::sqrt(3.) * std::sin(angle) / (2 - std::cos(angle))
                  : 4 / (3 + 1 / std::sin(angle));
}

// The root of the ratio of the smaller area to the larger one.
inline double size_quality(double area, double other) {
    return std::sqrt(std::min(area / other, other / area));
}

// Does the same for a quadrilateral with a side of this length at the angle, and for the size-skew
// quality relative to a cell of this area. With the angle pi - e, the other angles a at the side
// and b at the other neighbour of the corner, the quadrilateral contains the triangle on the side
// with the angles a and b - e there: area l^2 / 2 / (cot a + cot (b - e)). The maximum over a and
// b, of bounds in cells of a grid.
inline double best_quad_with_wide_angle(double angle, double length, double area) {
    double const e = pi - angle;
    if (e >= .5 * pi) return 1;
    if (e <= 0) return 0;
    // Angles from e to pi, the finer the nearer they are to either.
    std::vector<double> grid = {0, e};
    for (double step = .02 * e; grid.back() < .5 * pi; step *= 1.02)
        grid.push_back(grid.back() + step);
    for (std::size_t k = grid.size(); k-- > 0;) {
        if (grid[k] < .5 * pi) grid.push_back(pi - grid[k]);
    }
    std::sort(grid.begin(), grid.end());
    auto const cot = [](double t) { return std::cos(t) / std::sin(t); };
    auto const largest_sine = [](double low, double high) {
        if (low <= .5 * pi && high >= .5 * pi) return 1.;
        return std::max(std::sin(low), std::sin(high));
    };
    double best = 0;
    for (std::size_t i = 0; i + 1 < grid.size(); ++i) {
        double const one = 1 / largest_sine(grid[i], grid[i + 1]);
        for (std::size_t j = 0; j + 1 < grid.size(); ++j) {
            if (grid[i] + grid[j] >= pi + e) break;
            double bound = 4 / (1 + 1 / std::sin(e) + one + 1 / largest_sine(grid[j], grid[j + 1]));
            if (grid[i] > 0 && grid[j] > e) {
                double const sum = cot(grid[i]) + cot(grid[j] - e),
                             least = sum > 0 ? .5 * length * length / sum : 0;
                if (sum <= 0) continue;  // no such quadrilateral
                if (least > area) bound *= size_quality(area, least);
            }
            best = std::max(best, bound);
        }
    }
    return best;
}

// The largest size-skew quality of a triangle with a side of this length, relative to a cell of
// this area, that contains none of some points inside. A triangle by the cotangents x, y of its
// angles at the side: the skew quality is sqrt(3) / (3/4 s + (1 + d^2) / s), s = x + y, d = (x - y)
// / 2, and the area is l^2 / (2 s). A point whose triangle on the side has the cotangents (u, v) is
// inside if x < u and y < v, that is s/2 - v < d < u - s/2. So the best triangle of each s has the
// smallest d outside these intervals. The maximum over s, of bounds in short ranges of s; below
// 2e-3 is not looked.
inline double best_on_side(double length, double area,
                           std::vector<std::pair<double, double>> const& points = {}) {
    double best = 2e-3;
    constexpr double ratio = 1.005;
    for (double low = 1e-3; low < 1e3; low *= ratio) {
        double const high = ratio * low;
        double left = 0, right = 0;  // d from left to right is inside a point's interval
        bool is_free = true;
        for (bool changed = true; changed;) {
            changed = false;
            for (auto const& [u, v] : points) {
                double const begin = .5 * high - v, end = u - .5 * high;
                bool const meets =
                    begin < end && (is_free ? begin < 0 && end > 0 : begin < right && end > left);
                if (!meets || (!is_free && begin >= left && end <= right)) continue;
                left = std::min(left, begin);
                right = std::max(right, end);
                is_free = false;
                changed = true;
            }
        }
        double const d = std::min(-left, right), smallest = .5 * length * length / high,
                     largest = smallest * ratio;
        double size = 1;
        if (smallest > area) size = size_quality(smallest, area);
        if (largest < area) size = size_quality(largest, area);
        best = std::max(best, size * std::sqrt(3.) / (.75 * low + (1 + d * d) / high));
    }
    return std::min(best, 1.);
}

}  // namespace deform
