// The dense kernels against plain loops, real and complex, in double and in single precision, for every size up to 60
// and round the borders of blocks, tiles and strips, on every kind of processor at hand.
#include <doctest/doctest.h>

#include <fixtures/core.hpp>
#include <fixtures/dense_matrix.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/kernels.hpp>
#include <fixtures/traps.hpp>

#include <harmorph/dense/dense.hpp>

#include <limits>

using namespace fixtures;
using harmorph::Index;
using harmorph::Kernel;
namespace dense = harmorph::dense;

namespace {

template <class T, bool complex>
struct Arithmetic {
    using Number = T;
    static constexpr Index planes = complex ? 2 : 1;
    using Entry = std::conditional_t<complex, std::complex<double>, double>;
    using Matrix = DenseMatrixOf<Entry>;
    static constexpr double tolerance = sizeof(Number) == sizeof(double) ? 1e-13 : 5e-5;
    static constexpr Number poison = std::numeric_limits<Number>::quiet_NaN();

    // Numbers a single can hold.
    static Entry some_entry(std::mt19937& random) {
        auto const some = [&] { return static_cast<double>(static_cast<float>(2 * uniform(random) - 1)); };
        if constexpr (complex) {
            double const real = some();
            return {real, some()};
        } else {
            return some();
        }
    }
    static void put(Entry entry, Number* at, harmorph::Offset plane) {
        *at = static_cast<Number>(std::real(entry));
        if (complex) at[plane] = static_cast<Number>(std::imag(entry));
    }
    static Entry get(const Number* at, harmorph::Offset plane) {
        if constexpr (complex) {
            return {static_cast<double>(*at), static_cast<double>(at[plane])};
        } else {
            static_cast<void>(plane);
            return *at;
        }
    }
};
#define ALL_ARITHMETICS \
    Arithmetic<double, false>, Arithmetic<double, true>, Arithmetic<float, false>, Arithmetic<float, true>

TEST_CASE_TEMPLATE("panels and update matrices: a place of its own for every entry on and above the diagonal", Number,
                   double, float) {
    constexpr Index slab = dense::slab;
    for (Index const pivots : {1, 7, 8, 15, 16, 17, 33, 128, 300})
        for (Index const border : {0, 1, 8, 17, 33, 200}) {
            std::vector<Number> times(static_cast<std::size_t>(dense::panel_entries(pivots, border)), Number{0});
            dense::Panel<Number> const panel{times.data(), pivots, border};
            for (Index k = 0; k < pivots; ++k)
                for (Index c = k; c < panel.front(); ++c) {
                    REQUIRE(panel.at(k, c) < times.data() + times.size());
                    *panel.at(k, c) += 1;
                }
            CHECK(*std::max_element(times.begin(), times.end()) == 1);
            double const least = pivots * (panel.front() - (pivots - 1) / 2.0);
            CHECK(static_cast<double>(times.size()) <= least + pivots * 2.5 * slab);

            times.assign(static_cast<std::size_t>(dense::update_entries(pivots)), Number{0});
            dense::UpdateMatrix<Number> const update{times.data(), pivots};
            for (Index r = 0; r < pivots; ++r)
                for (Index c = r; c < pivots; ++c) {
                    REQUIRE(update.at(r, c) < times.data() + times.size());
                    *update.at(r, c) += 1;
                }
            CHECK(*std::max_element(times.begin(), times.end()) == 1);
            CHECK(static_cast<double>(times.size()) <= pivots * ((pivots + 1) / 2.0 + 1.5 * slab));
        }
}

// Hermitian and positive definite: diagonally dominant.
template <class Its>
typename Its::Matrix some_matrix(std::size_t n, unsigned seed) {
    std::mt19937 random(seed);
    typename Its::Matrix out(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            out.at(j, i) = Its::some_entry(random);
            out.at(i, j) = conjugate(out.at(j, i));
        }
        out.at(i, i) = 1.4 * static_cast<double>(n) + std::round(2 * uniform(random));
    }
    return out;
}

constexpr std::size_t behind = 64;   // numbers that nobody must touch

template <class Number>
bool tail_is_poisoned(std::vector<Number> const& array) {
    return std::all_of(array.end() - behind, array.end(), [](Number its) { return its != its; });
}

// A front and its update matrix, poisoned behind their ends and below the diagonal: nobody may use what is there.
template <class Its>
struct Front {
    using Number = typename Its::Number;
    static constexpr Index planes = Its::planes, slab = dense::slab;

    Kernel kernel;
    Index pivots, size;
    Backwards order;
    harmorph::Executor executor;   // one thread, unless set
    std::vector<Number> data, update, sums;
    Number least_left = 1;

    Front(Kernel its_kernel, typename Its::Matrix const& a, Index n_pivots, Index threads = 1)
        : kernel(its_kernel), pivots(n_pivots), size(static_cast<Index>(a.n)),
          data(static_cast<std::size_t>(planes * dense::panel_entries(pivots, size - pivots)) + behind, Its::poison),
          update(static_cast<std::size_t>(planes * dense::update_entries(size - pivots)) + behind, Its::poison),
          sums(static_cast<std::size_t>(planes * dense::sum_entries(pivots, size - pivots)) + behind, Its::poison) {
        if (threads > 1) executor = {Backwards::run, &order, threads};
        std::fill(data.begin(), data.end() - behind, Number{0});
        std::fill(update.begin(), update.end() - behind, Number{0});
        poison_below_diagonal(panel().own());
        poison_below_diagonal(update_matrix().all());
        auto const at = [&](Index i, Index j) {
            return a.at(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
        };
        auto const entry = [&](Index i, Index j) {
            if (i != j) return at(i, j);
            typename Its::Entry sum = 0;
            for (Index c = 0; c < size; ++c) sum += c < i ? conjugate(at(c, i)) : at(i, c);
            return sum;
        };
        for (Index k = 0; k < pivots; ++k)
            for (Index c = k; c < size; ++c) Its::put(entry(k, c), panel().at(k, c), slab);
        for (Index r = 0; r < size - pivots; ++r)
            for (Index c = r; c < size - pivots; ++c)
                Its::put(entry(pivots + r, pivots + c), update_matrix().at(r, c), slab);
    }
    dense::Panel<Number> panel() { return {data.data(), pivots, size - pivots, planes}; }
    dense::UpdateMatrix<Number> update_matrix() { return {update.data(), size - pivots, planes}; }
    Index factor() {
        Number const floor = 4 * std::numeric_limits<Number>::epsilon();
        return dense::factor(kernel, panel(), floor, workers());
    }
    void update_border() { dense::update_border(kernel, panel(), update_matrix(), workers()); }
    dense::Workers<Number> workers() { return {executor, sums.data(), &least_left}; }
    static void poison_below_diagonal(dense::Slabs<Number> const& slabs) {
        for (Index r = 0; r < slabs.rows; ++r)
            for (Index c = r / slab * slab; c < r; ++c)
                for (Index p = 0; p < planes; ++p) slabs.at(r, c)[p * slab] = Its::poison;
    }
    bool is_poisoned_behind() const {
        return tail_is_poisoned(data) && tail_is_poisoned(update) && tail_is_poisoned(sums);
    }
};

template <class Its>
class FrontCheck {
public:
    FrontCheck(Kernel kernel, Index pivots, Index border)
        : n_(static_cast<std::size_t>(pivots + border)), p_(static_cast<std::size_t>(pivots)),
          expected_(some_matrix<Its>(n_, static_cast<unsigned>(n_ * 1000 + p_))), front_(kernel, expected_, pivots) {
        REQUIRE(expected_.factor(p_));
        CHECK(front_.factor() == harmorph::none);
        front_.update_border();
        check_factor();
        for (Index const row : {1, 3, 5}) check_solves(row * dense::slab);
    }

private:
    using Number = typename Its::Number;
    using Entry = typename Its::Entry;
    static constexpr Index slab = dense::slab;

    void compare(const Number* found, harmorph::Offset plane, Entry exact) {
        double const error = std::abs(Its::get(found, plane) - exact) / std::sqrt(static_cast<double>(n_));
        if (!(error <= worst_)) worst_ = error;   // NaN stays
    }
    void check_factor() {
        worst_ = 0;
        auto const panel = front_.panel();
        for (Index k = 0; k < front_.pivots; ++k)   // behind each diagonal block, which holds its inverse
            for (Index c = std::min(panel.pivots, (k / slab + 1) * slab); c < front_.size; ++c)
                compare(panel.at(k, c), slab, expected_.at(static_cast<std::size_t>(k), static_cast<std::size_t>(c)));
        auto const update = front_.update_matrix();
        auto const left = [&](Index r, Index c) {
            return expected_.at(p_ + static_cast<std::size_t>(r), p_ + static_cast<std::size_t>(c));
        };
        for (Index r = 0; r < update.n; ++r) {
            Entry sum = 0;
            for (Index c = 0; c < update.n; ++c) sum += c < r ? conjugate(left(c, r)) : left(r, c);
            compare(update.at(r, r), slab, sum);
            for (Index c = r + 1; c < update.n; ++c) compare(update.at(r, c), slab, left(r, c));
        }
        CHECK(worst_ < Its::tolerance);
        CHECK(front_.is_poisoned_behind());
    }
    void check_solves(Index row) {
        std::size_t const width = static_cast<std::size_t>(row), length = Its::planes * width;
        std::vector<Entry> exact(n_ * width);
        std::vector<Number> y(n_ * length + behind, Its::poison);
        std::mt19937 random(9);
        auto const place = [&](std::size_t k) { return y.data() + k / width * length + k % width; };
        for (std::size_t k = 0; k < exact.size(); ++k) {
            exact[k] = Its::some_entry(random);
            Its::put(exact[k], place(k), row);
        }
        worst_ = 0;
        for (std::size_t k = 0; k < p_; ++k)
            for (std::size_t i = 0; i < width; ++i) {
                exact[k * width + i] /= expected_.at(k, k);
                for (std::size_t r = k + 1; r < n_; ++r)
                    exact[r * width + i] -= conjugate(expected_.at(k, r)) * exact[k * width + i];
            }
        dense::solve_forward(front_.kernel, front_.panel(), y.data(), row, front_.executor);
        for (std::size_t k = 0; k < exact.size(); ++k) compare(place(k), row, exact[k]);
        for (std::size_t k = p_; k-- > 0;)
            for (std::size_t i = 0; i < width; ++i) {
                for (std::size_t c = k + 1; c < n_; ++c)
                    exact[k * width + i] -= expected_.at(k, c) * exact[c * width + i];
                exact[k * width + i] /= expected_.at(k, k);
            }
        dense::solve_backward(front_.kernel, front_.panel(), y.data(), row, front_.executor);
        for (std::size_t k = 0; k < exact.size(); ++k) compare(place(k), row, exact[k]);
        CHECK(worst_ < Its::tolerance);
        CHECK(tail_is_poisoned(y));
    }

    std::size_t n_, p_;
    typename Its::Matrix expected_;
    Front<Its> front_;
    double worst_ = 0;
};

template <class Its>
void check_front(Kernel kernel, Index pivots, Index border) {
    INFO("kernel " << static_cast<int>(kernel) << ", " << pivots << " pivots, border " << border);
    FrontCheck<Its> const check(kernel, pivots, border);
}

}  // namespace

TEST_CASE_TEMPLATE("every number of pivots from 1 to 60, with and without a border", Its, ALL_ARITHMETICS) {
    for (Kernel const kernel : fixtures::usable_kernels())
        for (Index pivots = 1; pivots <= 60; ++pivots) {
            check_front<Its>(kernel, pivots, 0);
            check_front<Its>(kernel, pivots, pivots % 23 + 1);
        }
}

TEST_CASE_TEMPLATE("every border from 0 to 60, and those round whole tiles and bands", Its, ALL_ARITHMETICS) {
    for (Kernel const kernel : fixtures::usable_kernels()) {
        for (Index border = 0; border <= 60; ++border) check_front<Its>(kernel, border % 41 + 1, border);
        for (Index const border : {71, 72, 73, 95, 96, 97, 127, 128, 129, 136, 193})
            check_front<Its>(kernel, 9, border);
    }
}

TEST_CASE_TEMPLATE("large fronts: more than one strip of pivots, borders that fill several tiles", Its,
                   ALL_ARITHMETICS) {
    Index const sizes[][2] = {{127, 130}, {128, 0}, {129, 64}, {100, 203}, {256, 29}, {257, 3}};
    for (Kernel const kernel : fixtures::usable_kernels())
        for (auto const& size : sizes) check_front<Its>(kernel, size[0], size[1]);
}

TEST_CASE_TEMPLATE("any number of threads, in any order: the same bits", Its, ALL_ARITHMETICS) {
    using Number = typename Its::Number;
    Index const sizes[][2] = {{300, 600}, {600, 0}, {40, 900}, {128, 500}};
    for (auto const& size : sizes) {
        auto const a = some_matrix<Its>(static_cast<std::size_t>(size[0] + size[1]), 5);
        std::size_t const n = a.n * static_cast<std::size_t>(Its::planes) * 32;
        for (Kernel const kernel : fixtures::usable_kernels()) {
            std::vector<Number> first[3];
            for (Index const threads : {1, 2, 7}) {
                Front<Its> front(kernel, a, size[0], threads);
                REQUIRE(front.factor() == harmorph::none);
                front.update_border();
                std::vector<Number> y(n);
                for (std::size_t k = 0; k < n; ++k) y[k] = static_cast<Number>(std::sin(static_cast<double>(k)));
                dense::solve_forward(kernel, front.panel(), y.data(), 32, front.executor);
                dense::solve_backward(kernel, front.panel(), y.data(), 32, front.executor);
                for (std::vector<Number>* array : {&front.data, &front.update}) array->resize(array->size() - behind);
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
}

TEST_CASE_TEMPLATE("a child is added to its parent entry by entry, wherever its rows go", Its, ALL_ARITHMETICS) {
    std::mt19937 random(11);
    for (Kernel const kernel : fixtures::usable_kernels())
        for (int round = 0; round < 60; ++round) {
            Index const pivots = 1 + static_cast<Index>(random() % 40), border = static_cast<Index>(random() % 70);
            double const kept = uniform(random);   // runs of neighbours, or scattered rows
            std::vector<Index> targets;
            for (Index t = 0; t < pivots + border; ++t)
                if (uniform(random) < kept) targets.push_back(t);
            auto const parent = some_matrix<Its>(static_cast<std::size_t>(pivots + border), 1);
            auto const child = some_matrix<Its>(targets.size(), 2);
            Front<Its> from(kernel, child, 0), to(kernel, parent, pivots);
            Front<Its> const before = to;
            dense::extend_add(kernel, from.update_matrix(), targets.data(), to.panel(), to.update_matrix());
            double worst = 0;
            auto const compare = [&](auto const* found, auto const* old, Index i, Index j) {
                auto const row = std::find(targets.begin(), targets.end(), i),
                           column = std::find(targets.begin(), targets.end(), j);
                typename Its::Entry exact = Its::get(old, Front<Its>::slab);
                if (row != targets.end() && column != targets.end())
                    exact += Its::get(from.update_matrix().at(static_cast<Index>(row - targets.begin()),
                                                              static_cast<Index>(column - targets.begin())),
                                      Front<Its>::slab);
                worst = std::fmax(worst, std::abs(Its::get(found, Front<Its>::slab) - exact));
            };
            Front<Its> old = before;
            for (Index i = 0; i < pivots; ++i)
                for (Index j = i; j < pivots + border; ++j) compare(to.panel().at(i, j), old.panel().at(i, j), i, j);
            for (Index i = 0; i < border; ++i)
                for (Index j = i; j < border; ++j)
                    compare(to.update_matrix().at(i, j), old.update_matrix().at(i, j), pivots + i, pivots + j);
            INFO("kernel " << static_cast<int>(kernel) << ", " << pivots << " pivots, border " << border);
            CHECK(worst <= 1e3 * std::numeric_limits<typename Its::Number>::epsilon());
            CHECK(to.is_poisoned_behind());
            CHECK(from.is_poisoned_behind());
        }
}

TEST_CASE_TEMPLATE("a pivot that is not positive is found, wherever it is, and named", Its, ALL_ARITHMETICS) {
    Untrapped const untrapped;
    for (Kernel const kernel : fixtures::usable_kernels())
        for (Index const n : {1, 5, 8, 9, 64, 100, 130, 260})
            for (Index const bad : {Index{0}, n / 3, n / 2, n - 1})
                for (double const value : {-1.0, 0.0, static_cast<double>(Its::poison)}) {
                    auto a = some_matrix<Its>(static_cast<std::size_t>(n) + 4, 3);
                    std::size_t const at = static_cast<std::size_t>(bad);
                    if (value == 0)
                        for (std::size_t k = 0; k < a.n; ++k) a.at(at, k) = a.at(k, at) = 0;
                    a.at(at, at) = value;
                    Front<Its> front(kernel, a, n);
                    INFO("kernel " << static_cast<int>(kernel) << ", n " << n << ", bad " << bad << ", value "
                                   << value);
                    CHECK(front.factor() == bad);
                }
}

TEST_CASE_TEMPLATE("a singular matrix is found up to rounding: springs that are tied to nothing", Its,
                   ALL_ARITHMETICS) {
    for (Kernel const kernel : fixtures::usable_kernels())
        for (std::size_t const n : {2u, 8u, 9u, 32u, 33u, 100u}) {
            typename Its::Matrix a(n);
            for (std::size_t k = 0; k + 1 < n; ++k) {
                double const stiffness = 1 + static_cast<double>(k % 3) / 3;
                a.at(k, k) += stiffness;
                a.at(k + 1, k + 1) += stiffness;
                a.at(k, k + 1) -= stiffness;
            }
            Front<Its> front(kernel, a, static_cast<Index>(n));
            INFO("kernel " << static_cast<int>(kernel) << ", " << n << " points");
            Index const found = front.factor();
            CHECK((found == static_cast<Index>(n) - 1));
        }
}

// Conductances over 30 orders of magnitude, ties to the ground weaker than all of them: the solution for a load of what
// ties each is 1 everywhere. With stored diagonals, not a digit of it would be left.
TEST_CASE_TEMPLATE("conductances lose nothing, however uneven they are", Its, Arithmetic<double, false>,
                   Arithmetic<float, false>) {
    using Number = typename Its::Number;
    Index const sizes[][2] = {{1, 0}, {9, 0}, {40, 0}, {150, 0}, {300, 0}};
    for (Kernel const kernel : fixtures::usable_kernels())
        for (auto const& size : sizes) {
            std::size_t const n = static_cast<std::size_t>(size[0]);
            typename Its::Matrix a(n);
            std::mt19937 random(static_cast<unsigned>(n));
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t j = i + 1; j < n; ++j)
                    if (j == i + 1 || uniform(random) < 0.2) a.at(i, j) = -std::pow(10.0, 24 * uniform(random) - 12);
            Front<Its> front(kernel, a, size[0]);
            std::size_t const row = dense::slab;
            std::vector<Number> y(row * n, Number{0});
            for (std::size_t i = 0; i < n; ++i) {
                Number const tie = static_cast<Number>(std::pow(10.0, -15 - 3 * uniform(random)));
                *front.panel().at(static_cast<Index>(i), static_cast<Index>(i)) = y[row * i] = tie;
            }
            INFO("kernel " << static_cast<int>(kernel) << ", " << n << " points");
            REQUIRE(front.factor() == harmorph::none);
            CHECK(front.least_left > 0.9);
            dense::solve_forward(kernel, front.panel(), y.data(), dense::slab, front.executor);
            dense::solve_backward(kernel, front.panel(), y.data(), dense::slab, front.executor);
            double worst = 0;
            for (std::size_t i = 0; i < n; ++i) worst = std::max(worst, std::abs(static_cast<double>(y[row * i]) - 1));
            CHECK(worst < 20 * std::sqrt(static_cast<double>(n)) * std::numeric_limits<Number>::epsilon());
        }
}
