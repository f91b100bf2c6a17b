// Passes over half a matrix against dense ones: products, and the parts of a symmetric Gauss-Seidel
// sweep.
#include <doctest/doctest.h>

#include <fixtures/agglomerated.hpp>
#include <fixtures/traps.hpp>

#include "multigrid/block_rows.hpp"

#include "multigrid/iteration.hpp"

#include <string>

using namespace fixtures;
using harmorph::Index;
namespace block = harmorph::block;

namespace {

constexpr Index w = 4;

struct Setting {
    Case setup = two_body_case(Cells::hybrid, 10, 6);
    Analysed seen{setup};
    FrontMatrix front{*seen.operator->()};
    DenseMatrix dense = dense_of(front.rows);
    std::vector<double> x;

    Setting() {
        std::mt19937 random(8);
        for (std::size_t k = 0; k < w * dense.n; ++k) x.push_back(2 * uniform(random) - 1);
    }
};

// y_i = sum over the columns j that `takes` accepts of A_ij x_j.
template <class Takes>
std::vector<double> product(DenseMatrix const& a, std::vector<double> const& x, Takes takes) {
    std::vector<double> y(x.size(), 0.0);
    for (std::size_t i = 0; i < a.n; ++i)
        for (std::size_t j = 0; j < a.n; ++j)
            for (std::size_t k = 0; takes(i, j) && k < w; ++k)
                y[w * i + k] += a.at(i, j) * x[w * j + k];
    return y;
}
bool any(std::size_t, std::size_t) { return true; }
bool below(std::size_t i, std::size_t j) { return j < i; }
bool above(std::size_t i, std::size_t j) { return j > i; }
bool lower(std::size_t i, std::size_t j) { return j <= i; }
bool upper(std::size_t i, std::size_t j) { return j >= i; }

}  // namespace

TEST_CASE("products and energies are those of the whole matrix") {
    Setting const s;
    std::vector<double> y(s.x.size());
    block::PerFunction<w> const dots = block::multiply<w>(s.front.rows, s.x.data(), y.data());
    std::vector<double> const expected = product(s.dense, s.x, any);
    CHECK(largest_difference(y, expected) < 1e-13);
    block::PerFunction<w> const energies = block::energy<w>(s.front.rows, s.x.data());
    for (Index k = 0; k < w; ++k) {
        double sum = 0;
        for (std::size_t i = 0; i < s.dense.n; ++i)
            sum += s.x[w * i + static_cast<std::size_t>(k)] *
                   expected[w * i + static_cast<std::size_t>(k)];
        CHECK(dots[k] == doctest::Approx(sum).epsilon(1e-12));
        CHECK(energies[k] == doctest::Approx(sum).epsilon(1e-12));
    }
}

TEST_CASE("products of a Hermitian matrix are those of the whole complex matrix") {
    Setting const s;
    std::size_t const n = s.dense.n;
    // A matrix A + i S, with S antisymmetric but for the diagonal, which must be 0: the row sums of
    // S compensate its entries.
    std::mt19937 random(9);
    std::vector<double> entries, row_sums(n, 0.0);
    DenseMatrixOf<std::complex<double>> whole(n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) whole.at(i, j) = s.dense.at(i, j);
    s.front.rows.for_each([&](Index row, Index column, harmorph::Offset) {
        std::size_t const i = static_cast<std::size_t>(row), j = static_cast<std::size_t>(column);
        double const entry = 2 * uniform(random) - 1;
        entries.push_back(entry);
        row_sums[i] += entry;
        row_sums[j] -= entry;
        whole.at(i, j) += std::complex<double>(0, entry);
        whole.at(j, i) -= std::complex<double>(0, entry);
    });
    harmorph::ImaginaryRows const imaginary{{row_sums.data(), n}, {entries.data(), entries.size()}};
    std::vector<double> y(s.x.size());
    block::PerFunction<w> const dots =
        block::multiply<w>(s.front.rows, imaginary, s.x.data(), y.data());
    for (std::size_t k = 0; k < w / 2; ++k) {
        auto const value = [&](std::vector<double> const& v, std::size_t i) {
            return std::complex<double>(v[w * i + k], v[w * i + k + w / 2]);
        };
        double energy = 0;
        for (std::size_t i = 0; i < n; ++i) {
            std::complex<double> expected = 0;
            for (std::size_t j = 0; j < n; ++j) expected += whole.at(i, j) * value(s.x, j);
            CHECK(std::abs(expected - value(y, i)) < 1e-12);
            energy += std::real(std::conj(value(s.x, i)) * expected);
        }
        CHECK(dots[static_cast<Index>(k)] == doctest::Approx(energy).epsilon(1e-12));
        CHECK(dots[static_cast<Index>(k + w / 2)] == dots[static_cast<Index>(k)]);
    }
}

TEST_CASE("the triangular solves are inverses of the triangular products") {
    Setting const s;
    std::vector<double> x = product(s.dense, s.x, lower);
    block::forward<w>(s.front.rows, x.data());
    CHECK(largest_difference(x, s.x) < 1e-12);
    x = product(s.dense, s.x, upper);
    block::backward<w>(s.front.rows, x.data());
    CHECK(largest_difference(x, s.x) < 1e-12);
}

TEST_CASE("the defect after the forward sweep is that of the start 0 less A times the correction") {
    Setting const s;
    std::size_t const n = s.dense.n;
    // Row i has i % 4 weights.
    std::size_t const n_coarse = n / 3;
    std::vector<harmorph::Offset> start = {0};
    std::vector<Index> column;
    std::vector<double> weight;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i % 4; ++k) {
            column.push_back(static_cast<Index>((i / 3 + k) % n_coarse));
            weight.push_back(0.5 - 0.3 * static_cast<double>(k));
        }
        start.push_back(static_cast<harmorph::Offset>(column.size()));
    }
    harmorph::Prolongation const by{span(start), span(column), span(weight)};
    auto const for_each_weight = [&](auto const& visit) {
        for (std::size_t i = 0; i < n; ++i)
            for (auto e = static_cast<std::size_t>(start[i]);
                 e < static_cast<std::size_t>(start[i + 1]); ++e)
                for (std::size_t k = 0; k < w; ++k)
                    visit(w * i + k, w * static_cast<std::size_t>(column[e]) + k, weight[e]);
    };
    std::vector<double> z = s.x, defect(w * n_coarse);
    block::forward<w>(s.front.rows, z.data());
    std::vector<double> const swept = z, a_swept = product(s.dense, swept, any);
    block::to_defect<w>(s.front.rows, by, static_cast<Index>(n_coarse), z.data(), defect.data());
    std::vector<double> expected(w * n_coarse, 0.0);
    for_each_weight([&](std::size_t fine, std::size_t coarse, double factor) {
        expected[coarse] += factor * (s.x[fine] - a_swept[fine]);
    });
    CHECK(largest_difference(defect, expected) < 1e-12);

    // A whole symmetric sweep with a correction c: (D + L^T) z = r - L (swept + P c).
    std::vector<double> corrected = swept;
    std::vector<double> const c(expected.rbegin(), expected.rend());
    for_each_weight([&](std::size_t fine, std::size_t coarse, double factor) {
        corrected[fine] += factor * c[coarse];
    });
    std::vector<double> const lower_part = product(s.dense, corrected, below);
    block::correct<w>(s.front.rows, by, c.data(), z.data());
    block::backward<w>(s.front.rows, z.data());
    std::vector<double> left = product(s.dense, z, upper);
    for (std::size_t k = 0; k < left.size(); ++k) left[k] += lower_part[k];
    CHECK(largest_difference(left, s.x) < 1e-11);
    // Not trivially.
    CHECK(largest_difference(product(s.dense, z, above), std::vector<double>(left.size(), 0.0)) >
          1e-3);
}

TEST_CASE("the largest numbers of each function: NaN where there is one, wherever it is") {
    Untrapped const untrapped;
    double const nan = std::nan("");
    for (Index const row : {-1, 0, 1, 2}) {
        std::vector<double> x = {1, -2, 3, 0, -4, 1, 2, 0, 2, -1, -5, -0.0};
        if (row >= 0) x[static_cast<std::size_t>(w * row + 1)] = nan;
        block::PerFunction<w> const found = block::largest<w>(x.data(), 3);
        CHECK(found[0] == 4);
        CHECK((row < 0 ? found[1] == 2 : std::isnan(found[1])));
        CHECK(found[2] == 5);
        CHECK(found[3] == 0);
    }
}

TEST_CASE("a diagonal that is not positive is refused with its row") {
    for (double const bad : {0.0, -1.0}) {
        double diagonal[] = {1, 2, bad, 4};
        harmorph::SymmetricRows rows;
        rows.n = 4;
        rows.diagonal = {diagonal, 4};
        harmorph::Fault fault;
        CHECK(harmorph::BlockIteration::check_diagonals(rows, fault) ==
              harmorph::Status::not_positive);
        CHECK(std::string(fault.sentence) ==
              "the matrix of the equations is not positive definite at point #");
        CHECK(fault.item.number == 2);
        rows.n = 2;
        harmorph::Fault no_fault;
        CHECK(harmorph::BlockIteration::check_diagonals(rows, no_fault) == harmorph::Status::ok);
    }
}
