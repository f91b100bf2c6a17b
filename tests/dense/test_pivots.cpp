// Pivots that are no good, and those that only look as if they were not.
#include <fixtures/front.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/traps.hpp>

using namespace fixtures;
using namespace fixtures::fronts;

TEST_CASE_TEMPLATE("a pivot that is not positive is found and named, wherever it is", Its,
                   ALL_ARITHMETICS) {
    Untrapped const untrapped;
    for (Kernel const kernel : fixtures::usable_kernels())
        for (Index const n : {1, 5, 8, 9, 64, 100, 130, 260})
            for (Index const bad : {Index{0}, n / 3, n / 2, n - 1})
                for (double const value : {-1.0, 0.0, double(Its::poison)}) {
                    auto a = some_matrix<Its>(std::size_t(n) + 4, 3);
                    std::size_t const at = std::size_t(bad);
                    if (value == 0)
                        for (std::size_t k = 0; k < a.n; ++k) a.at(at, k) = a.at(k, at) = 0;
                    a.at(at, at) = value;
                    Front<Its> front(kernel, a, n);
                    INFO("kernel " << int(kernel) << ", n " << n << ", bad " << bad << ", value "
                                   << value);
                    CHECK(front.factor() == bad);
                }
}

TEST_CASE_TEMPLATE("a singular matrix is found up to rounding", Its, ALL_ARITHMETICS) {
    for (Kernel const kernel : fixtures::usable_kernels())
        for (std::size_t const n : {2u, 8u, 9u, 32u, 33u, 100u}) {
            typename Its::Matrix a(n);
            for (std::size_t k = 0; k + 1 < n; ++k) {
                double const stiffness = 1 + double(k % 3) / 3;
                a.at(k, k) += stiffness;
                a.at(k + 1, k + 1) += stiffness;
                a.at(k, k + 1) -= stiffness;
            }
            Front<Its> front(kernel, a, Index(n));
            INFO("kernel " << int(kernel) << ", " << n << " points");
            Index const found = front.factor();
            CHECK((found == Index(n) - 1));
        }
}

// Conductances over 30 orders of magnitude, ties to the ground weaker than all of them: the
// solution for a load of what ties each is 1 everywhere. With stored diagonals, not a digit of it
// would be left.
TEST_CASE_TEMPLATE("uneven conductances lose no accuracy", Its, Arithmetic<false>) {
    using Number = typename Its::Number;
    Index const sizes[][2] = {{1, 0}, {9, 0}, {40, 0}, {150, 0}, {300, 0}};
    for (Kernel const kernel : fixtures::usable_kernels())
        for (auto const& size : sizes) {
            std::size_t const n = std::size_t(size[0]);
            typename Its::Matrix a(n);
            std::mt19937 random(static_cast<unsigned>(n));
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t j = i + 1; j < n; ++j)
                    if (j == i + 1 || uniform(random) < 0.2)
                        a.at(i, j) = -std::pow(10.0, 24 * uniform(random) - 12);
            Front<Its> front(kernel, a, size[0]);
            std::size_t const row = dense::slab;
            std::vector<Number> y(row * n, Number{0});
            for (std::size_t i = 0; i < n; ++i) {
                Number const tie = static_cast<Number>(std::pow(10.0, -15 - 3 * uniform(random)));
                *front.panel().at(Index(i), Index(i)) = y[row * i] = tie;
            }
            INFO("kernel " << int(kernel) << ", " << n << " points");
            REQUIRE(front.factor() == harmorph::none);
            CHECK(front.min_pivot_ratio > 0.9);
            dense::solve_forward(kernel, front.panel(), y.data(), dense::slab, front.executor);
            dense::solve_backward(kernel, front.panel(), y.data(), dense::slab, front.executor);
            double worst = 0;
            for (std::size_t i = 0; i < n; ++i)
                worst = std::max(worst, std::abs(double(y[row * i]) - 1));
            CHECK(worst < 20 * std::sqrt(double(n)) * std::numeric_limits<Number>::epsilon());
        }
}
