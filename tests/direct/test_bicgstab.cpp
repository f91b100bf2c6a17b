// BiCGSTAB: solutions of unsymmetric equations, each column by itself; a breakdown leaves 0.
#include <doctest/doctest.h>

#include <fixtures/guarded.hpp>
#include <fixtures/perturb.hpp>

#include "direct/bicgstab.hpp"

#include <cmath>
#include <random>
#include <vector>

using namespace fixtures;
using harmorph::BiconjugateGradients;
using harmorph::Index;
using harmorph::Span;
using harmorph::Status;

namespace {

constexpr Index n = 12, width = 3;

// A dense matrix; rows of vectors hold `width` columns.
struct Dense {
    std::vector<double> entry = std::vector<double>(n * n);

    double& at(Index i, Index j) { return entry[static_cast<std::size_t>(i * n + j)]; }
    void times(const double* from, double* to) const {
        for (Index i = 0; i < n; ++i)
            for (Index k = 0; k < width; ++k) {
                double sum = 0;
                for (Index j = 0; j < n; ++j)
                    sum += entry[static_cast<std::size_t>(i * n + j)] * from[j * width + k];
                to[i * width + k] = sum;
            }
    }
};

std::vector<double> random_numbers(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<double> out(count);
    for (double& number : out) number = 2 * uniform(random) - 1;
    return out;
}

// Diagonally dominant, with a skew part as large as the symmetric one.
Dense unsymmetric(unsigned seed) {
    Dense out;
    out.entry = random_numbers(n * n, seed);
    for (Index i = 0; i < n; ++i) out.at(i, i) += 8;
    return out;
}

struct Solved {
    std::vector<double> x;
    Index iterations = 0;
    Status status = Status::ok;
};

Solved solve(Dense const& matrix, std::vector<double> const& right_hand_side, Index columns) {
    BiconjugateGradients engine;
    auto const block = laid_out_part(engine, n, width);
    Solved out{right_hand_side};
    auto const apply = [&](const double* from, double* to) { matrix.times(from, to); };
    auto const precondition = [&](double* rows) {
        for (Index k = 0; k < n * width; ++k) rows[k] *= 0.125;
        return Status::ok;
    };
    Span<double> const rows(out.x.data(), out.x.size());
    out.status = engine.run(rows, columns, 1e-10, 100, out.iterations, apply, precondition);
    CHECK(block->guards_intact());
    return out;
}

double column_norm(std::vector<double> const& rows, Index k) {
    double sum = 0;
    for (Index i = 0; i < n; ++i) sum += std::pow(rows[static_cast<std::size_t>(i * width + k)], 2);
    return std::sqrt(sum);
}

}  // namespace

TEST_CASE("residuals of unsymmetric equations are reduced in fewer iterations than unknowns") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        Dense const matrix = unsymmetric(seed);
        std::vector<double> const b = random_numbers(n * width, seed + 100);
        Solved const solved = solve(matrix, b, width);
        std::vector<double> rest(b.size());
        matrix.times(solved.x.data(), rest.data());
        for (std::size_t k = 0; k < b.size(); ++k) rest[k] = b[k] - rest[k];
        for (Index k = 0; k < width; ++k) CHECK(column_norm(rest, k) < 2e-10 * column_norm(b, k));
        CHECK(solved.iterations > 2);
        CHECK(solved.iterations <= n);
    }
}

TEST_CASE("the bits of a column do not depend on the other columns, and unwanted columns stay") {
    Dense const matrix = unsymmetric(3);
    std::vector<double> const b = random_numbers(n * width, 4);
    std::vector<double> alone(b.size());
    for (std::size_t k = 0; k < b.size(); k += width) alone[k] = b[k];
    std::vector<double> const all = solve(matrix, b, width).x, one = solve(matrix, alone, 1).x;
    for (std::size_t k = 0; k < b.size(); k += width) CHECK(all[k] == one[k]);
    CHECK(column_norm(one, 1) == 0);
}

TEST_CASE("a right-hand side of 0 has the solution 0, without an iteration") {
    Solved const solved = solve(unsymmetric(5), std::vector<double>(n * width), width);
    CHECK(solved.iterations == 0);
    for (Index k = 0; k < width; ++k) CHECK(column_norm(solved.x, k) == 0);
}

// Equations of pairs of unknowns: each image is orthogonal to what it is made of, but for a part
// `along`.
Dense quarter_turns(Index n_pairs, double along) {
    Dense out = unsymmetric(7);
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j)
            if (i < 2 * n_pairs || j < 2 * n_pairs) out.at(i, j) = 0;
    for (Index i = 0; i < 2 * n_pairs; i += 2) {
        out.at(i, i) = out.at(i + 1, i + 1) = along;
        out.at(i, i + 1) = 1;
        out.at(i + 1, i) = -1;
    }
    return out;
}

TEST_CASE("a breakdown: nothing is divided by 0, and the solution is 0") {
    std::vector<double> const b = random_numbers(n * width, 6);
    for (double const along : {0.0, 1e-300, 1e-40, 1e-20, 1e-10}) {
        Solved const solved = solve(quarter_turns(n / 2, along), b, width);
        CHECK(solved.status == Status::ok);
        for (Index k = 0; k < width; ++k) CHECK(column_norm(solved.x, k) == 0);
    }
}

TEST_CASE("where one column breaks down, the others are solved, with the same bits") {
    constexpr Index n_turned = 6;
    for (double const along : {0.0, 1e-20, 1e-10}) {
        Dense const matrix = quarter_turns(n_turned / 2, along);
        std::vector<double> const numbers = random_numbers(n * width, 9);
        std::vector<double> b(numbers.size()), rest(b.size());
        for (Index i = 0; i < n; ++i) {
            std::size_t const row = static_cast<std::size_t>(i * width);
            if (i < n_turned) b[row] = numbers[row];
            else b[row + 1] = numbers[row + 1], b[row + 2] = numbers[row + 2];
        }
        Solved const solved = solve(matrix, b, width);
        matrix.times(solved.x.data(), rest.data());
        for (std::size_t k = 0; k < b.size(); ++k) rest[k] = b[k] - rest[k];
        CHECK(column_norm(solved.x, 0) == 0);
        CHECK(column_norm(rest, 1) < 2e-10 * column_norm(b, 1));
        CHECK(column_norm(rest, 2) < 2e-10 * column_norm(b, 2));
        for (std::size_t k = 0; k < b.size(); k += width) b[k] = 0;
        std::vector<double> const without = solve(matrix, b, width).x;
        for (std::size_t k = 0; k < b.size(); ++k) CHECK(without[k] == solved.x[k]);
    }
}

TEST_CASE("a failure of the preconditioner ends the iteration") {
    BiconjugateGradients engine;
    std::vector<unsigned char> memory(100000);
    harmorph::Arena arena(memory.data(), memory.size());
    engine.lay_out(arena, n, width);
    std::vector<double> b = random_numbers(n * width, 10);
    Index iterations = 0;
    Status const status = engine.run(
        {b.data(), b.size()}, width, 1e-10, 100, iterations, [](const double*, double*) {},
        [](double*) { return Status::cancelled; });
    CHECK(status == Status::cancelled);
    CHECK(iterations == 0);
}
