// The dense kernels against plain loops, for every size up to 100 and some large ones, on every kind of processor at hand.
#include <doctest/doctest.h>

#include <fixtures/core.hpp>
#include <fixtures/dense_matrix.hpp>
#include <fixtures/executors.hpp>

#include <harmorph/dense.hpp>

#include <limits>

using namespace fixtures;
using harmorph::Index;
using harmorph::Kernel;
namespace dense = harmorph::dense;

namespace {

double const poison = std::numeric_limits<double>::quiet_NaN();

std::vector<Kernel> kernels() {
    std::vector<Kernel> out;
    for (Kernel const kernel : {Kernel::baseline, Kernel::avx2, Kernel::avx512})
        if (harmorph::has_kernel(kernel)) out.push_back(kernel);
    return out;
}

// Symmetric and positive definite: diagonally dominant.
DenseMatrix some_matrix(std::size_t n, unsigned seed) {
    std::mt19937 random(seed);
    DenseMatrix out(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < i; ++j) out.at(i, j) = out.at(j, i) = 2 * uniform(random) - 1;
        out.at(i, i) = 0.7 * static_cast<double>(n) + uniform(random);
    }
    return out;
}

// A front and its update matrix; what kernels may read but not use is poisoned, and so are places they must not touch.
struct Front {
    Kernel kernel;
    Index pivots, size;
    Backwards order;
    harmorph::Executor executor;   // one thread, unless set
    std::vector<double> data, update, packing;

    Front(Kernel its_kernel, DenseMatrix const& a, Index n_pivots, Index threads = 1)
        : kernel(its_kernel), pivots(n_pivots), size(static_cast<Index>(a.n)),
          data(static_cast<std::size_t>(dense::Panel::entries(pivots, size) + dense::overread), poison),
          update(static_cast<std::size_t>(dense::UpdateMatrix::entries(size - pivots) + dense::overread), poison),
          packing(static_cast<std::size_t>(threads * dense::packing_entries), poison) {
        if (threads > 1) executor = {Backwards::run, &order, threads};
        std::fill(data.begin(), data.end() - dense::overread, 0.0);
        std::fill(update.begin(), update.end() - dense::overread, 0.0);
        auto const entry = [&](Index i, Index j) { return a.at(static_cast<std::size_t>(i), static_cast<std::size_t>(j)); };
        for (Index k = 0; k < pivots; ++k)
            for (Index c = k; c < size; ++c) panel().row(k)[c] = entry(k, c);
        for (Index r = 0; r < size - pivots; ++r)
            for (Index c = r; c < size - pivots; ++c) update_matrix().row(r)[c] = entry(pivots + r, pivots + c);
    }
    dense::Panel panel() { return {data.data(), pivots, size}; }
    dense::UpdateMatrix update_matrix() { return {update.data(), size - pivots}; }
    Index factor() { return dense::factor(kernel, panel(), 1e-15, {executor, packing.data()}); }
    void update_border() { dense::update_border(kernel, panel(), update_matrix(), {executor, packing.data()}); }
    bool tail_is_poisoned(std::vector<double> const& array) const {
        for (std::size_t k = array.size() - static_cast<std::size_t>(dense::overread); k < array.size(); ++k)
            if (array[k] == array[k]) return false;
        return true;
    }
};

void check_front(Kernel kernel, Index pivots, Index border) {
    std::size_t const n = static_cast<std::size_t>(pivots + border), p = static_cast<std::size_t>(pivots);
    DenseMatrix expected = some_matrix(n, static_cast<unsigned>(n * 1000 + p));
    Front front(kernel, expected, pivots);
    REQUIRE(expected.factor(p));
    CHECK(front.factor() == harmorph::none);
    front.update_border();

    double worst = 0;
    auto const compare = [&](double found, double exact) {
        double const error = std::fabs(found - exact) / std::sqrt(static_cast<double>(n));
        if (!(error <= worst)) worst = error;   // NaN stays
    };
    for (std::size_t k = 0; k < p; ++k)   // behind each diagonal block, which holds its inverse
        for (std::size_t c = (k / dense::block + 1) * dense::block; c < n; ++c)
            compare(front.panel().row(static_cast<Index>(k))[c], expected.at(k, c));
    for (std::size_t r = p; r < n; ++r)
        for (std::size_t c = r; c < n; ++c)
            compare(front.update_matrix().row(static_cast<Index>(r - p))[c - p], expected.at(r, c));
    CHECK(worst < 1e-13);
    CHECK((front.tail_is_poisoned(front.data) && front.tail_is_poisoned(front.update)));

    for (Index const row : {8, 24}) {   // right-hand sides
        std::size_t const width = static_cast<std::size_t>(row);
        std::vector<double> y(n * width), exact;
        std::mt19937 random(9);
        for (double& value : y) value = 2 * uniform(random) - 1;
        exact = y;
        y.resize(y.size() + static_cast<std::size_t>(dense::overread), poison);
        worst = 0;
        auto const compare_all = [&] {
            for (std::size_t k = 0; k < exact.size(); ++k) compare(y[k], exact[k]);
        };
        for (std::size_t k = 0; k < p; ++k)
            for (std::size_t i = 0; i < width; ++i) {
                exact[k * width + i] /= expected.at(k, k);
                for (std::size_t r = k + 1; r < n; ++r) exact[r * width + i] -= expected.at(k, r) * exact[k * width + i];
            }
        dense::solve_forward(kernel, front.panel(), y.data(), row, front.executor);
        compare_all();
        for (std::size_t k = p; k-- > 0;)
            for (std::size_t i = 0; i < width; ++i) {
                for (std::size_t c = k + 1; c < n; ++c) exact[k * width + i] -= expected.at(k, c) * exact[c * width + i];
                exact[k * width + i] /= expected.at(k, k);
            }
        dense::solve_backward(kernel, front.panel(), y.data(), row, front.executor);
        compare_all();
        CHECK(worst < 1e-13);
        CHECK(front.tail_is_poisoned(y));
    }
}

}  // namespace

TEST_CASE("every number of pivots from 1 to 100, with and without a border") {
    for (Kernel const kernel : kernels())
        for (Index pivots = 1; pivots <= 100; ++pivots) {
            INFO("kernel " << static_cast<int>(kernel) << ", " << pivots << " pivots");
            check_front(kernel, pivots, 0);
            check_front(kernel, pivots, pivots % 23 + 1);
        }
}

TEST_CASE("every border from 0 to 100") {
    for (Kernel const kernel : kernels())
        for (Index border = 0; border <= 100; ++border) {
            INFO("kernel " << static_cast<int>(kernel) << ", border " << border);
            check_front(kernel, border % 41 + 1, border);
        }
}

TEST_CASE("large fronts: more than one strip of pivots, borders that fill several tiles") {
    Index const sizes[][2] = {{127, 130}, {128, 0}, {129, 64}, {160, 300}, {256, 129}, {257, 3}, {300, 200}, {400, 31}};
    for (Kernel const kernel : kernels())
        for (auto const& size : sizes) {
            INFO("kernel " << static_cast<int>(kernel) << ", " << size[0] << " pivots, border " << size[1]);
            check_front(kernel, size[0], size[1]);
        }
}

TEST_CASE("any number of threads, in any order: the same bits") {
    Index const sizes[][2] = {{300, 700}, {400, 0}, {40, 900}, {128, 500}};
    for (Kernel const kernel : kernels())
        for (auto const& size : sizes) {
            DenseMatrix const a = some_matrix(static_cast<std::size_t>(size[0] + size[1]), 5);
            std::vector<double> first[3];
            for (Index const threads : {1, 2, 3, 7}) {
                Front front(kernel, a, size[0], threads);
                REQUIRE(front.factor() == harmorph::none);
                front.update_border();
                std::vector<double> y(a.n * 32 + static_cast<std::size_t>(dense::overread), 0.0);
                for (std::size_t k = 0; k < a.n * 32; ++k) y[k] = std::sin(static_cast<double>(k));
                dense::solve_forward(kernel, front.panel(), y.data(), 32, front.executor);
                dense::solve_backward(kernel, front.panel(), y.data(), 32, front.executor);
                for (std::vector<double>* array : {&front.data, &front.update})
                    array->resize(array->size() - dense::overread);
                if (threads == 1) {
                    first[0] = front.data;
                    first[1] = front.update;
                    first[2] = y;
                }
                CHECK(same_bits(front.data, first[0]));
                CHECK(same_bits(front.update, first[1]));
                CHECK(same_bits(y, first[2]));
                CHECK((threads > 1) == (front.order.calls > 0));   // they were put to work
            }
        }
}

TEST_CASE("a pivot that is not positive is found, wherever it is, and named") {
    for (Kernel const kernel : kernels())
        for (Index const n : {1, 5, 32, 33, 64, 100, 130, 260})
            for (Index const bad : {Index{0}, n / 3, n / 2, n - 1})
                for (double const value : {-1.0, 0.0, poison}) {
                    DenseMatrix a = some_matrix(static_cast<std::size_t>(n) + 4, 3);
                    std::size_t const at = static_cast<std::size_t>(bad);
                    if (value == 0) {   // a row that repeats another one would do; its own row 0 is simplest
                        for (std::size_t k = 0; k < a.n; ++k) a.at(at, k) = a.at(k, at) = 0;
                    }
                    a.at(at, at) = value;
                    Front front(kernel, a, n);
                    INFO("kernel " << static_cast<int>(kernel) << ", n " << n << ", bad " << bad << ", value " << value);
                    CHECK(front.factor() == bad);
                }
}

TEST_CASE("a singular matrix is found up to rounding: rows of springs that are tied to nothing") {
    for (Kernel const kernel : kernels())
        for (std::size_t const n : {2u, 8u, 32u}) {
            DenseMatrix a(n);
            for (std::size_t k = 0; k + 1 < n; ++k) {   // small whole numbers: elimination is exact
                a.at(k, k) += 1;
                a.at(k + 1, k + 1) += 1;
                a.at(k, k + 1) -= 1;
            }
            Front front(kernel, a, static_cast<Index>(n));
            CHECK(front.factor() == static_cast<Index>(n) - 1);
        }
}

TEST_CASE("there is always a best kernel, and it can be used") {
    CHECK(harmorph::best_kernel() != Kernel::automatic);
    CHECK(harmorph::has_kernel(harmorph::best_kernel()));
    CHECK(harmorph::has_kernel(Kernel::baseline));
}
