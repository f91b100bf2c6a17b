#include "elasticity.hpp"

#include "clock.hpp"

#include <stdexcept>

#ifdef HAVE_EIGEN
// Warnings of this package are not ours.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <eigen3/Eigen/IterativeLinearSolvers>
#include <eigen3/Eigen/SparseCore>
#endif

namespace bench {

#ifdef HAVE_EIGEN
namespace {

constexpr double tolerance = 1e-6, poisson = 0.3;

// The unknowns are the points that are on no boundary, two each.
class Elasticity {
public:
    explicit Elasticity(fixtures::Mesh const& mesh) : mesh_(mesh), unknown_(mesh.x.size(), 0) {
        for (Index const point : mesh.faces) unknown_[at(point)] = -1;
        for (Index& number : unknown_) number = number < 0 ? -1 : n_++;
    }

    // Known displacements go to the right-hand side.
    void assemble(std::vector<double> const& known) {
        known_ = &known;
        entries_.reserve(at(n_) * 32);
        right_ = Eigen::VectorXd::Zero(2 * n_);
        for (std::size_t cell = 0; cell + 1 < mesh_.cell_start.size(); ++cell) {
            Index const* const p = &mesh_.cells[at(mesh_.cell_start[cell])];
            add_triangle({p[0], p[1], p[2]});
            if (mesh_.cell_start[cell + 1] - mesh_.cell_start[cell] == 4)
                add_triangle({p[0], p[2], p[3]});
        }
        matrix_.resize(2 * n_, 2 * n_);
        matrix_.setFromTriplets(entries_.begin(), entries_.end());
        entries_ = {};
    }
    Eigen::SparseMatrix<double> const& matrix() const { return matrix_; }
    Eigen::VectorXd const& right() const { return right_; }

private:
    struct Triangle {
        Index point[3];
    };

    // Plane strain, Young's modulus 1/area: gradients of the shape functions are g / (2 area),
    // so the area cancels once.
    void add_triangle(Triangle const& triangle) {
        double g[3][2];
        auto const x = [&](int k) { return mesh_.x[at(triangle.point[k % 3])]; };
        auto const y = [&](int k) { return mesh_.y[at(triangle.point[k % 3])]; };
        for (int k = 0; k < 3; ++k) {
            g[k][0] = y(k + 1) - y(k + 2);
            g[k][1] = x(k + 2) - x(k + 1);
        }
        double const area = 0.5 * std::fabs(g[0][0] * g[1][1] - g[0][1] * g[1][0]);
        double const young = 1 / area, shear = young / (2 * (1 + poisson));
        double const lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
                for (int i = 0; i < 2; ++i)
                    for (int j = 0; j < 2; ++j) {
                        double const gradients = i == j ? g[a][0] * g[b][0] + g[a][1] * g[b][1] : 0;
                        double const entry =
                            lame * g[a][i] * g[b][j] + shear * (g[a][j] * g[b][i] + gradients);
                        add(triangle.point[a], i, triangle.point[b], j, entry / (4 * area));
                    }
    }
    void add(Index point, int i, Index other, int j, double entry) {
        Index const row = unknown_[at(point)], column = unknown_[at(other)];
        if (row < 0) return;
        if (column < 0)
            right_[2 * row + i] -= entry * (*known_)[2 * at(other) + static_cast<std::size_t>(j)];
        else if (column <= row) entries_.emplace_back(2 * row + i, 2 * column + j, entry);
    }

    fixtures::Mesh const& mesh_;
    Index n_ = 0;
    std::vector<Index> unknown_;
    std::vector<double> const* known_ = nullptr;
    std::vector<Eigen::Triplet<double>> entries_;
    Eigen::SparseMatrix<double> matrix_;
    Eigen::VectorXd right_;
};

}  // namespace

ElasticTimes solve_elasticity(Case const& mesh_case, std::vector<Index> const& points,
                              std::vector<double> const& displacement) {
    std::vector<double> known(2 * mesh_case.mesh.x.size(), 0);
    for (std::size_t k = 0; k < points.size(); ++k)
        for (std::size_t i = 0; i < 2; ++i) known[2 * at(points[k]) + i] = displacement[2 * k + i];
    ElasticTimes times{};
    Stopwatch watch;
    Elasticity elasticity(mesh_case.mesh);
    elasticity.assemble(known);
    // The natural order of the mesh, as flow solvers keep it.
    using Preconditioner =
        Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>;
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower, Preconditioner> solver;
    solver.setTolerance(tolerance);
    solver.setMaxIterations(max_elastic_iterations);
    solver.compute(elasticity.matrix());
    if (solver.info() != Eigen::Success)
        throw std::runtime_error("the incomplete Cholesky factorisation failed");
    times.set_up = watch.lap();
    Eigen::VectorXd const solution = solver.solve(elasticity.right());
    times.solve = watch.seconds();
    times.iterations = static_cast<double>(solver.iterations());
    return times;
}

std::string elasticity_note() {
    return "Elasticity by Eigen: one run each, plane strain, Poisson's ratio 0.3, quads split; at "
           "most " +
           std::to_string(max_elastic_iterations) +
           " iterations: where there are so many, 1e-6 was not reached.";
}
#pragma GCC diagnostic pop
#else
ElasticTimes solve_elasticity(Case const&, std::vector<Index> const&, std::vector<double> const&) {
    return {not_measured, not_measured, not_measured};
}
std::string elasticity_note() { return "Eigen: not installed (libeigen3-dev)"; }
#endif

}  // namespace bench
