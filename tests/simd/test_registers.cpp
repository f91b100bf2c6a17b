// The registers of every instruction set that this processor has, against plain numbers.
#include <fixtures/core.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/traps.hpp>

#include "base/scalar.hpp"
#include "simd/kernel_table.hpp"

#include <limits>

using harmorph::Index;
using harmorph::Kernel;

namespace fixtures {

constexpr Index max_lanes = 8;

template <class Number>
struct OperationsOf {
    Index lanes;
    void (*multiply_add)(const Number* a, const Number* b, const Number* c, Number* out, Index n);
    void (*multiply_subtract)(const Number* a, const Number* b, const Number* c, Number* out,
                              Index n);
    void (*all)(Number x, Number* out);
    void (*pick)(const Number* a, const Number* b, const Index* picked, Number* out);
    void (*load_part)(const Number* from, Index n, double* out);
};
struct Operations {
    OperationsOf<double> in_double;
    OperationsOf<float> in_single;
    void (*load_single)(const float* from, double* out);
    void (*max)(const double* a, const double* b, double* out, Index n);
    void (*min)(const double* a, const double* b, double* out, Index n);
    void (*sqrt)(const double* a, double* out, Index n);
    unsigned (*less)(const double* a, const double* b);
    void (*round)(const double* a, std::uint64_t* out, Index n);  // null: no such instruction

    OperationsOf<double> const& with(double) const { return in_double; }
    OperationsOf<float> const& with(float) const { return in_single; }
};

}  // namespace fixtures

#define HARMORPH_KERNELS "fixtures/register_operations.hpp"
#include "simd/for_each_set.hpp"

using namespace fixtures;

namespace {

Operations const& operations(Kernel kernel) { return harmorph::simd::table_of<Operations>(kernel); }

template <class Number>
std::vector<Number> some(std::size_t n, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Number> out;
    for (std::size_t k = 0; k < n; ++k) out.push_back(static_cast<Number>(2 * uniform(random) - 1));
    return out;
}

}  // namespace

TEST_CASE_TEMPLATE("sums c + a b and c - a b are contracted or rounded twice in all lanes alike",
                   Number, double, float) {
    constexpr Index n = 64;
    std::vector<Number> a = some<Number>(n, 1), b = some<Number>(n, 2), c = some<Number>(n, 3);
    // A little more than half the digits: products are rounded, and whole numbers are exact.
    // Not every C library's fma is.
    Number const units = static_cast<Number>(1 << (std::numeric_limits<Number>::digits / 2 + 2));
    for (std::vector<Number>* const numbers : {&a, &b, &c})
        for (Number& number : *numbers) number = std::round(number * units) / units;
    auto const whole = [&](Number number) { return std::int64_t(number * units); };
    auto const rounded_once = [&](std::int64_t sum) {
        return static_cast<Number>(sum) / (units * units);
    };
    for (Kernel const kernel : usable_kernels()) {
        INFO("kernel " << int(kernel));
        std::vector<Number> sum(n), rest(n);
        auto const& by = operations(kernel).with(Number{});
        by.multiply_add(a.data(), b.data(), c.data(), sum.data(), n);
        by.multiply_subtract(a.data(), b.data(), c.data(), rest.data(), n);
        bool const contracted = kernel != Kernel::baseline;
        for (std::size_t k = 0; k < n; ++k) {
            Number const product = a[k] * b[k];
            std::int64_t const exact = whole(a[k]) * whole(b[k]),
                               added = whole(c[k]) * std::int64_t(units);
            CHECK(sum[k] == (contracted ? rounded_once(added + exact) : c[k] + product));
            CHECK(rest[k] == (contracted ? rounded_once(added - exact) : c[k] - product));
        }
    }
}

TEST_CASE_TEMPLATE("one number in all lanes keeps its bits", Number, double, float) {
    for (Kernel const kernel : usable_kernels()) {
        auto const& by = operations(kernel).with(Number{});
        for (Number const x :
             {Number{0}, -Number{0}, Number{1.5}, -std::numeric_limits<Number>::infinity()}) {
            Number out[max_lanes];
            by.all(x, out);
            for (Index lane = 0; lane < by.lanes; ++lane) {
                CHECK(out[lane] == x);
                CHECK(std::signbit(out[lane]) == std::signbit(x));
            }
        }
    }
}

TEST_CASE_TEMPLATE("parts of a register are loaded with zeros behind, and nothing else is read",
                   Number, double, float) {
    for (Kernel const kernel : usable_kernels()) {
        Index const lanes = operations(kernel).in_double.lanes;
        for (Index n = 0; n < lanes; ++n) {
            // On the heap, so that a memory checker sees a number too many.
            std::vector<Number> const from = some<Number>(std::size_t(n), 4);
            double out[max_lanes];
            operations(kernel).with(Number{}).load_part(from.data(), n, out);
            for (Index lane = 0; lane < lanes; ++lane)
                CHECK(out[lane] == (lane < n ? double(from[std::size_t(lane)]) : 0));
        }
    }
}

TEST_CASE("single precision becomes double precision exactly") {
    std::vector<float> const from = some<float>(max_lanes, 5);
    for (Kernel const kernel : usable_kernels()) {
        double out[max_lanes];
        operations(kernel).load_single(from.data(), out);
        for (Index lane = 0; lane < operations(kernel).in_double.lanes; ++lane)
            CHECK(out[lane] == double(from[std::size_t(lane)]));
    }
}

TEST_CASE_TEMPLATE("lanes are picked from two registers or from none", Number, double, float) {
    std::mt19937 random(6);
    for (Kernel const kernel : usable_kernels()) {
        auto const& by = operations(kernel).with(Number{});
        for (int attempt = 0; attempt < 200; ++attempt) {
            std::vector<Number> const both = some<Number>(std::size_t(2 * by.lanes), 7);
            Index picked[max_lanes];
            for (Index& from : picked) from = Index(random() % unsigned(2 * by.lanes + 1)) - 1;
            Number out[max_lanes];
            by.pick(both.data(), both.data() + by.lanes, picked, out);
            for (Index lane = 0; lane < by.lanes; ++lane)
                CHECK(out[lane] == (picked[lane] < 0 ? 0 : both[std::size_t(picked[lane])]));
        }
    }
}

TEST_CASE("the functions max and min take the second number where one is NaN; NaN is not less") {
    Untrapped const untrapped;
    double const nan = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();
    std::vector<double> const a{1, 2, nan, 3, -infinity, infinity, -1, nan},
        b{2, 1, 3, nan, infinity, -infinity, -1, nan};
    for (Kernel const kernel : usable_kernels()) {
        Operations const& by = operations(kernel);
        double high[8], low[8];
        by.max(a.data(), b.data(), high, 8);
        by.min(a.data(), b.data(), low, 8);
        for (std::size_t k = 0; k < 8; ++k) {
            CHECK(harmorph::bits_of(high[k]) == harmorph::bits_of(a[k] > b[k] ? a[k] : b[k]));
            CHECK(harmorph::bits_of(low[k]) == harmorph::bits_of(a[k] < b[k] ? a[k] : b[k]));
        }
        for (Index first = 0; first < 8; first += by.in_double.lanes) {
            unsigned const mask = by.less(a.data() + first, b.data() + first);
            for (Index lane = 0; lane < by.in_double.lanes; ++lane) {
                std::size_t const k = std::size_t(first + lane);
                CHECK((mask >> lane & 1u) == (a[k] < b[k] ? 1u : 0u));
            }
            CHECK((mask >> by.in_double.lanes) == 0);
        }
    }
}

TEST_CASE("square roots are rounded correctly, and integers are the nearest with ties to even") {
    std::vector<double> const a{0, 2, 1e-300, 1e300, 0.25, 3, 1 / 3.0, 7};
    std::vector<double> const b{0.5, 1.5, -2.5, -0.75, 0x1p62, -0x1p62 - 1024, 2.4999, -3.5};
    for (Kernel const kernel : usable_kernels()) {
        Operations const& by = operations(kernel);
        double roots[8];
        by.sqrt(a.data(), roots, 8);
        for (std::size_t k = 0; k < 8; ++k) CHECK(roots[k] == std::sqrt(a[k]));
        if (by.round == nullptr) continue;
        std::uint64_t words[8];
        by.round(b.data(), words, 8);
        for (std::size_t k = 0; k < 8; ++k) CHECK(std::int64_t(words[k]) == std::llrint(b[k]));
    }
}
