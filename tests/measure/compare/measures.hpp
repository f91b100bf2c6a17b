// Measures the effect of a deformation on a mesh without the library: quality of cells, angles and
// heights at the wall.
#pragma once

#include "motion.hpp"

#include <algorithm>
#include <cmath>

namespace compare {

struct Measures {
    double min_quality = 1, mean_quality = 0;  // size-skew, relative to the start
    double angle = 0;  // [degrees] mean change between wall and first-layer edges
    double min_height = 1e300, max_height = 0,
           height_error = 0;  // ratios of first-layer heights; mean |ratio - 1|
};

inline double size_skew(const Cells& cells, std::int32_t cell, const std::vector<Point>& before,
                        const std::vector<Point>& now) {
    const std::int32_t n = cells.size(cell);
    const auto area = [&](const std::vector<Point>& at) {
        double sum = 0;
        for (std::int32_t k = 1; k + 1 < n; ++k)
            sum +=
                twice_area(at[cells.at(cell, 0)], at[cells.at(cell, k)], at[cells.at(cell, k + 1)]);
        return sum;
    };
    double squares = 0, sines = 0;
    for (std::int32_t k = 0; k < n; ++k) {
        const Point corner_at = now[cells.at(cell, k)];
        const Point back = now[cells.at(cell, k + n - 1)] - corner_at,
                    on = now[cells.at(cell, k + 1)] - corner_at;
        const double corner = (std::conj(on) * back).imag();
        if (!(corner > 0)) return 0;
        squares += std::norm(on);
        sines += std::abs(on) * std::abs(back) / corner;
    }
    const double size = area(now) / area(before),
                 skew = n == 3 ? 2 * std::sqrt(3) * area(now) / squares : 4 / sines;
    return skew * std::sqrt(std::min(size, 1 / size));
}

inline Measures measure(const Motion& motion, const std::vector<Point>& now) {
    Measures out;
    const Cells& cells = motion.cells;
    for (std::int32_t cell = 0; cell < cells.count(); ++cell) {
        const double quality = size_skew(cells, cell, motion.start, now);
        out.min_quality = std::min(out.min_quality, quality);
        out.mean_quality += quality / cells.count();
    }
    // For each wall point, the edge into the mesh that is most normal to the wall.
    const std::vector<Point>& before = motion.start;
    std::vector<std::int32_t> previous(before.size(), -1), above(before.size(), -1);
    std::vector<char> on_wall(before.size(), 0);
    for (std::size_t k = 0; k < before.size(); ++k)
        if (motion.next[k] >= 0) previous[motion.next[k]] = static_cast<std::int32_t>(k);
    for (const std::int32_t point : motion.wall) on_wall[point] = 1;
    const auto tangent = [&](std::int32_t k,
                             const std::vector<Point>& at) {  // mean direction of the faces
        Point sum = 0;
        if (motion.next[k] >= 0)
            sum += (at[motion.next[k]] - at[k]) / std::abs(at[motion.next[k]] - at[k]);
        if (previous[k] >= 0) sum += (at[k] - at[previous[k]]) / std::abs(at[k] - at[previous[k]]);
        return sum / std::abs(sum);
    };
    const auto rise = [&](std::int32_t k, std::int32_t to, const std::vector<Point>& at) {
        return (at[to] - at[k]) / tangent(k, at);  // along and normal to the wall
    };
    for (std::int32_t cell = 0; cell < cells.count(); ++cell)
        for (std::int32_t k = 0; k < cells.size(cell); ++k) {
            const std::int32_t foot = cells.at(cell, k);
            if (on_wall[foot] == 0) continue;
            for (const std::int32_t to :
                 {cells.at(cell, k + 1), cells.at(cell, k + cells.size(cell) - 1)}) {
                if (on_wall[to] != 0) continue;
                const auto slope = [&](std::int32_t end) {
                    return std::arg(rise(foot, end, before) / Point(0, 1));
                };
                if (above[foot] < 0 || std::fabs(slope(to)) < std::fabs(slope(above[foot])))
                    above[foot] = to;
            }
        }
    double count = 0;
    for (const std::int32_t foot : motion.wall) {
        if (above[foot] < 0) continue;
        const Point was = rise(foot, above[foot], before), is_now = rise(foot, above[foot], now);
        const double ratio = is_now.imag() / was.imag();
        out.angle += std::fabs(std::arg(is_now / was)) * 180 / 3.14159265358979323846;
        out.height_error += std::fabs(ratio - 1);
        out.min_height = std::min(out.min_height, ratio);
        out.max_height = std::max(out.max_height, ratio);
        ++count;
    }
    out.angle /= count;
    out.height_error /= count;
    return out;
}

}  // namespace compare
