// Interpolates the displacement of the boundary by radial basis functions: Wendland's C2 function
// with compact support, no polynomial. A. de Boer, M. S. van der Schoot, H. Bijl, Comput. Struct.
// 85 (2007) 784.
#pragma once

#include "motion.hpp"

#include <Eigen/Dense>

namespace compare {

class RadialBasis {
public:
    static constexpr double radius = 10;  // chords

    static double wendland(double x) {
        const double rest = x < 1 ? 1 - x : 0;
        return rest * rest * rest * rest * (4 * x + 1);
    }
    // Factorises the matrix of all pairs of boundary points.
    RadialBasis(const Motion& motion, const std::vector<Point>& at) : motion_(motion), at_(at) {
        for (const std::int32_t point : motion.wall) centre_.push_back(at[point]);
        for (const std::int32_t point : motion.outer) centre_.push_back(at[point]);
        const auto n = static_cast<Eigen::Index>(centre_.size());
        Eigen::MatrixXd matrix(n, n);
        for (Eigen::Index i = 0; i < n; ++i)
            for (Eigen::Index j = 0; j < n; ++j)
                matrix(i, j) = wendland(std::abs(centre_[i] - centre_[j]) / radius);
        factor_.compute(matrix);
    }
    // The mesh for these positions of the wall points.
    std::vector<Point> moved(const std::vector<Point>& wall) const {
        Eigen::MatrixXd right = Eigen::MatrixXd::Zero(factor_.rows(), 2);
        for (std::size_t k = 0; k < wall.size(); ++k) {
            const Point move = wall[k] - at_[motion_.wall[k]];
            right(static_cast<Eigen::Index>(k), 0) = move.real();
            right(static_cast<Eigen::Index>(k), 1) = move.imag();
        }
        const Eigen::MatrixXd weight = factor_.solve(right);
        std::vector<Point> out = at_;
        for (Point& point : out) {
            Point sum = 0;
            for (Eigen::Index j = 0; j < weight.rows(); ++j)
                sum += wendland(std::abs(point - centre_[j]) / radius) *
                       Point(weight(j, 0), weight(j, 1));
            point += sum;
        }
        for (std::size_t k = 0; k < wall.size(); ++k) out[motion_.wall[k]] = wall[k];
        for (const std::int32_t point : motion_.outer) out[point] = at_[point];
        return out;
    }

private:
    const Motion& motion_;
    const std::vector<Point>& at_;
    std::vector<Point> centre_;
    Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
};

}  // namespace compare
