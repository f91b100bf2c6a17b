// Deforms a mesh as an elastic solid whose stiffness is the inverse of the cell's area, as SU2_DEF
// does: linear triangles, plane strain, quadrilaterals as the mean of their two splits. R. P.
// Dwight, Robust mesh deformation using the linear elasticity equations, Computational Fluid
// Dynamics 2006.
#pragma once

#include "motion.hpp"

#include <Eigen/Sparse>

#include <array>

namespace compare {

class Elasticity {
public:
    static constexpr double poisson = 0.35;

    // Assembles the stiffness of the mesh `at` and factorises the part of the inner points.
    Elasticity(const Motion& motion, const std::vector<Point>& at)
        : motion_(motion), at_(at), unknown_(at.size(), 0) {
        for (const std::int32_t point : motion.wall) unknown_[point] = -1;
        for (const std::int32_t point : motion.outer) unknown_[point] = -1;
        for (std::int32_t& number : unknown_)
            if (number == 0) number = unknowns_++;
        std::vector<Eigen::Triplet<double>> inner, outer;
        const Cells& cells = motion.cells;
        for (std::int32_t cell = 0; cell < cells.count(); ++cell) {
            const std::int32_t size = cells.size(cell);
            for (std::int32_t k = 0; k < (size == 3 ? 1 : 4); ++k)
                add({cells.at(cell, k + size - 1), cells.at(cell, k), cells.at(cell, k + 1)},
                    size == 3 ? 1 : 0.5, inner, outer);
        }
        Eigen::SparseMatrix<double> matrix(2 * unknowns_, 2 * unknowns_);
        matrix.setFromTriplets(inner.begin(), inner.end());
        boundary_.resize(2 * unknowns_, static_cast<Eigen::Index>(2 * at.size()));
        boundary_.setFromTriplets(outer.begin(), outer.end());
        factor_.compute(matrix);
    }
    // The mesh for these positions of the wall points.
    std::vector<Point> moved(const std::vector<Point>& wall) const {
        Eigen::VectorXd known = Eigen::VectorXd::Zero(boundary_.cols());
        for (std::size_t k = 0; k < wall.size(); ++k) {
            const Point move = wall[k] - at_[motion_.wall[k]];
            known(2 * motion_.wall[k]) = move.real();
            known(2 * motion_.wall[k] + 1) = move.imag();
        }
        const Eigen::VectorXd solution = factor_.solve(-(boundary_ * known));
        std::vector<Point> out = at_;
        for (std::size_t k = 0; k < out.size(); ++k)
            if (unknown_[k] >= 0)
                out[k] += Point(solution(2 * unknown_[k]), solution(2 * unknown_[k] + 1));
        for (std::size_t k = 0; k < wall.size(); ++k) out[motion_.wall[k]] = wall[k];
        return out;
    }

private:
    using Entries = std::vector<Eigen::Triplet<double>>;

    // Adds the integral of stress times strain over a triangle, times the stiffness 1 / area.
    void add(const std::array<std::int32_t, 3>& corner, double part, Entries& inner,
             Entries& outer) const {
        const double area = 0.5 * twice_area(at_[corner[0]], at_[corner[1]], at_[corner[2]]);
        Eigen::Matrix<double, 3, 6> strain = Eigen::Matrix<double, 3, 6>::Zero();
        for (int k = 0; k < 3; ++k) {
            const Point opposite =
                (at_[corner[(k + 2) % 3]] - at_[corner[(k + 1) % 3]]) / (2 * area);
            const double by_x = -opposite.imag(), by_y = opposite.real();
            strain(0, 2 * k) = strain(2, 2 * k + 1) = by_x;
            strain(1, 2 * k + 1) = strain(2, 2 * k) = by_y;
        }
        const double scale = 1 / ((1 + poisson) * (1 - 2 * poisson));
        Eigen::Matrix3d law;
        law << 1 - poisson, poisson, 0, poisson, 1 - poisson, 0, 0, 0, 0.5 - poisson;
        const Eigen::Matrix<double, 6, 6> local = part * scale * strain.transpose() * law * strain;
        for (int i = 0; i < 6; ++i) {
            const std::int32_t row = unknown_[corner[i / 2]];
            for (int j = 0; j < 6 && row >= 0; ++j) {
                const std::int32_t column = unknown_[corner[j / 2]];
                if (column >= 0)
                    inner.emplace_back(2 * row + i % 2, 2 * column + j % 2, local(i, j));
                else outer.emplace_back(2 * row + i % 2, 2 * corner[j / 2] + j % 2, local(i, j));
            }
        }
    }

    const Motion& motion_;
    const std::vector<Point>& at_;
    std::vector<std::int32_t> unknown_;  // numbers of inner points, -1 for boundary points
    std::int32_t unknowns_ = 0;
    Eigen::SparseMatrix<double> boundary_;  // forces on inner points from boundary points
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace compare
