// Carries the boundary's displacement and rotation to the mesh by inverse distances, as IDWarp
// does: E. Luke, E. Collins, E. Blades, A fast mesh deformation method using explicit
// interpolation, J. Comput. Phys. 231 (2012) 586, with the exponents 3 and 5 and the fraction .25
// that are usual there.
#pragma once

#include "motion.hpp"

#include <algorithm>
#include <cmath>

namespace compare {

class InverseDistance {
public:
    static constexpr double alpha = 0.25;

    // Nothing is prepared: the weights follow from distances to the boundary points.
    InverseDistance(const Motion& motion, const std::vector<Point>& at)
        : motion_(motion), at_(at) {}
    // The mesh for these positions of the wall points.
    std::vector<Point> moved(const std::vector<Point>& wall) const {
        const Motion& motion = motion_;
        const std::vector<Point>& at = at_;
        struct Source {
            Point at, turn, shift;  // goes to turn z + shift
            double length;
        };
        std::vector<Point> now = at;
        for (std::size_t k = 0; k < motion.wall.size(); ++k) now[motion.wall[k]] = wall[k];
        std::vector<Source> sources;
        std::vector<std::int32_t> previous(at.size(), -1);
        for (std::size_t k = 0; k < at.size(); ++k)
            if (motion.next[k] >= 0) previous[motion.next[k]] = static_cast<std::int32_t>(k);
        double extent = 0;
        for (const std::int32_t point : motion.wall) {
            Point turn = 0;
            double length = 0;
            for (const std::int32_t other : {previous[point], motion.next[point]}) {
                if (other < 0) continue;
                const Point before = at[other] - at[point],
                            ratio = (now[other] - now[point]) / before;
                turn += std::abs(before) * ratio / std::abs(ratio);
                length += 0.5 * std::abs(before);
            }
            turn /= std::abs(turn);
            sources.push_back({at[point], turn, now[point] - turn * at[point], length});
            extent = std::max(extent, std::abs(at[point] - at[motion.wall[0]]));
        }
        Point centre = 0;
        for (const std::int32_t point : motion.outer)
            centre += at[point] / static_cast<double>(motion.outer.size());
        double size = 0;  // of the domain: its half width
        for (const std::int32_t point : motion.outer)
            size = std::max(size, std::abs(at[point] - centre));
        const double around =
            2 * 3.14159265358979323846 * size / static_cast<double>(motion.outer.size());
        for (const std::int32_t point : motion.outer) sources.push_back({at[point], 1, 0, around});
        std::vector<char> is_boundary(at.size(), 0);
        for (const std::int32_t point : motion.wall) is_boundary[point] = 1;
        for (const std::int32_t point : motion.outer) is_boundary[point] = 1;
        for (std::size_t k = 0; k < at.size(); ++k) {
            if (is_boundary[k] != 0) continue;
            Point sum = 0;
            double weights = 0;
            for (const Source& source : sources) {
                const double ratio = size / std::abs(at[k] - source.at), near = alpha * ratio;
                const double weight =
                    source.length * (ratio * ratio * ratio + near * near * near * near * near);
                sum += weight * (source.turn * at[k] + source.shift);
                weights += weight;
            }
            now[k] = sum / weights;
        }
        return now;
    }

private:
    const Motion& motion_;
    const std::vector<Point>& at_;
};

}  // namespace compare
