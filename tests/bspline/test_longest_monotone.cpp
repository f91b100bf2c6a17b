#include <doctest/doctest.h>

#include "bspline/projection.hpp"

#include <algorithm>
#include <random>
#include <vector>

using namespace harmorph;

namespace {

std::vector<Index> run_of(std::vector<double> const& values) {
    std::vector<Index> previous(values.size()), run(values.size());
    std::size_t const n = values.size();
    Index const length = longest_run({values.data(), n}, {previous.data(), n}, {run.data(), n});
    run.resize(std::size_t(length));
    return run;
}

// Finds the length by dynamic programming.
std::size_t longest(std::vector<double> const& values) {
    std::vector<std::size_t> length(values.size(), 1);
    for (std::size_t k = 0; k < values.size(); ++k)
        for (std::size_t j = 0; j < k; ++j)
            if (values[j] <= values[k]) length[k] = std::max(length[k], length[j] + 1);
    return values.empty() ? 0 : *std::max_element(length.begin(), length.end());
}

}  // namespace

TEST_CASE("the longest run is non-decreasing, in order, and as long as possible") {
    std::mt19937 random(1);
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<double> values(random() % 40);
        for (double& value : values) value = double(random() % 20);
        std::vector<Index> const run = run_of(values);
        CHECK(run.size() == longest(values));
        for (std::size_t l = 1; l < run.size(); ++l) {
            CHECK(run[l - 1] < run[l]);
            CHECK(values[std::size_t(run[l - 1])] <= values[std::size_t(run[l])]);
        }
    }
}

TEST_CASE("one wrong value does not spoil the others") {
    CHECK(run_of({0, 1, 9, 2, 3}) == std::vector<Index>{0, 1, 3, 4});
    CHECK(run_of({5, 0, 1, 2}) == std::vector<Index>{1, 2, 3});
    CHECK(run_of({2, 2, 2}) == std::vector<Index>{0, 1, 2});
}
