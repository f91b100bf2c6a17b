// Interpolates the displacement of the boundary by radial basis functions: Wendland's C2 function
// with compact support, no polynomial. A. de Boer, M. S. van der Schoot, H. Bijl, Comput. Struct.
// 85 (2007) 784.
#pragma once

#include "motion.hpp"

#include <Eigen/Dense>

namespace deform {

class RadialBasis {
public:
    static constexpr double radius = 10;  // chords

    static double wendland(double x) {
        const double rest = x < 1 ? 1 - x : 0;
        return rest * rest * rest * rest * (4 * x + 1);
    }
    static std::vector<Point> step(const Motion& motion, const std::vector<Point>& at,
                                   const std::vector<Point>& wall) {
        std::vector<Point> centre, move;
        for (std::size_t k = 0; k < motion.wall.size(); ++k) {
            centre.push_back(at[motion.wall[k]]);
            move.push_back(wall[k] - at[motion.wall[k]]);
        }
        for (const std::int32_t point : motion.outer) {
            centre.push_back(at[point]);
            move.push_back(0);
        }
        const auto n = static_cast<Eigen::Index>(centre.size());
        Eigen::MatrixXd matrix(n, n);
        Eigen::MatrixXd right(n, 2);
        for (Eigen::Index i = 0; i < n; ++i) {
            for (Eigen::Index j = 0; j < n; ++j)
                matrix(i, j) = wendland(std::abs(centre[i] - centre[j]) / radius);
            right(i, 0) = move[i].real();
            right(i, 1) = move[i].imag();
        }
        const Eigen::MatrixXd weight = matrix.partialPivLu().solve(right);
        std::vector<Point> out = at;
        for (Point& point : out) {
            Point sum = 0;
            for (Eigen::Index j = 0; j < n; ++j)
                sum += wendland(std::abs(point - centre[j]) / radius) *
                       Point(weight(j, 0), weight(j, 1));
            point += sum;
        }
        for (std::size_t k = 0; k < motion.wall.size(); ++k) out[motion.wall[k]] = wall[k];
        for (const std::int32_t point : motion.outer) out[point] = at[point];
        return out;
    }
};

}  // namespace deform
