// Passes over half a matrix against dense ones.
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
