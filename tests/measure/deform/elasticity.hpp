// Deforms a mesh as an elastic solid whose stiffness is the inverse of the cell's area, as SU2_DEF
// does: linear triangles, plane strain, quadrilaterals as the mean of their two splits. R. P.
// Dwight, Robust mesh deformation using the linear elasticity equations, Computational Fluid
// Dynamics 2006.
#pragma once

#include "motion.hpp"

#include <Eigen/Sparse>

namespace deform {

class Elasticity {
public:
    static constexpr double poisson = 0.35;

    // One linear step: wall points from `at` to `wall`.
    static std::vector<Point> step(const Motion& motion, const std::vector<Point>& at,
                                   const std::vector<Point>& wall) {
        const auto n = static_cast<std::int32_t>(at.size());
        std::vector<Point> moved(at.size());
        std::vector<std::int32_t> unknown(at.size(), 0);
        for (std::size_t k = 0; k < motion.wall.size(); ++k)
            moved[motion.wall[k]] = wall[k] - at[motion.wall[k]];
        for (const std::int32_t point : motion.wall) unknown[point] = -1;
        for (const std::int32_t point : motion.outer) unknown[point] = -1;
        std::int32_t unknowns = 0;
        for (std::int32_t k = 0; k < n; ++k)
            if (unknown[k] == 0) unknown[k] = unknowns++;
        std::vector<Eigen::Triplet<double>> entries;
        Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * unknowns);
        const auto add = [&](const std::int32_t(&corner)[3], double part) {
            const double area = 0.5 * twice_area(at[corner[0]], at[corner[1]], at[corner[2]]);
            Eigen::Matrix<double, 3, 6> strain = Eigen::Matrix<double, 3, 6>::Zero();
            for (int k = 0; k < 3; ++k) {
                const Point opposite =
                    (at[corner[(k + 2) % 3]] - at[corner[(k + 1) % 3]]) / (2 * area);
                const double by_x = -opposite.imag(), by_y = opposite.real();
                strain(0, 2 * k) = strain(2, 2 * k + 1) = by_x;
                strain(1, 2 * k + 1) = strain(2, 2 * k) = by_y;
            }
            const double scale = 1 / ((1 + poisson) * (1 - 2 * poisson));
            Eigen::Matrix3d law;
            law << 1 - poisson, poisson, 0, poisson, 1 - poisson, 0, 0, 0, 0.5 - poisson;
            // integral of stress strain over the area, times the stiffness 1 / area
            const Eigen::Matrix<double, 6, 6> local =
                part * scale * strain.transpose() * law * strain;
            for (int i = 0; i < 6; ++i) {
                const std::int32_t row = unknown[corner[i / 2]];
                if (row < 0) continue;
                for (int j = 0; j < 6; ++j) {
                    const std::int32_t column = unknown[corner[j / 2]];
                    const Point known = moved[corner[j / 2]];
                    if (column >= 0)
                        entries.emplace_back(2 * row + i % 2, 2 * column + j % 2, local(i, j));
                    else
                        right(2 * row + i % 2) -=
                            local(i, j) * (j % 2 == 0 ? known.real() : known.imag());
                }
            }
        };
        const Cells& cells = motion.cells;
        for (std::int32_t cell = 0; cell < cells.count(); ++cell) {
            const std::int32_t size = cells.size(cell);
            for (std::int32_t k = 0; k < (size == 3 ? 1 : 4); ++k) {
                const std::int32_t corner[3] = {cells.at(cell, k + size - 1), cells.at(cell, k),
                                                cells.at(cell, k + 1)};
                add(corner, size == 3 ? 1 : 0.5);
            }
        }
        Eigen::SparseMatrix<double> matrix(2 * unknowns, 2 * unknowns);
        matrix.setFromTriplets(entries.begin(), entries.end());
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
        const Eigen::VectorXd solution = factor.solve(right);
        std::vector<Point> out = at;
        for (std::int32_t k = 0; k < n; ++k)
            out[k] += unknown[k] < 0
                          ? moved[k]
                          : Point(solution(2 * unknown[k]), solution(2 * unknown[k] + 1));
        return out;
    }
};

}  // namespace deform
