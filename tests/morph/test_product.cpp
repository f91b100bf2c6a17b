// The products of morphing against plain loops, and kernel against kernel to the bit.
#include <doctest/doctest.h>

#include <fixtures/core.hpp>
#include <fixtures/kernels.hpp>

#include <harmorph/morph/product.hpp>

#include <cmath>
#include <limits>

using namespace fixtures;
using harmorph::Index;
using harmorph::Kernel;
using harmorph::Movements;
using harmorph::Vec2;

namespace {

struct Product {
    Index points, functions;
    std::vector<double> values;   // rows side by side; what follows the last one is poisoned
    Movements by{};
    std::vector<Vec2> weight;

    Product(Index n_points, Index n_functions, unsigned seed) : points(n_points), functions(n_functions) {
        std::mt19937 random(seed);
        for (Index k = 0; k < points * functions; ++k) values.push_back(2 * uniform(random) - 1);
        for (Index k = 0; k < functions; ++k) {
            by.x[k] = 2 * uniform(random) - 1;
            by.y[k] = 2 * uniform(random) - 1;
        }
        for (Index p = 0; p < points; ++p) weight.push_back({2 * uniform(random) - 1, 2 * uniform(random) - 1});
    }
    harmorph::ValueRows<double> rows() const { return {values.data(), functions, points, functions}; }
    double value(Index p, Index k) const { return values[static_cast<std::size_t>(p * functions + k)]; }

    // All x, then all y.
    std::vector<double> multiply(Kernel kernel) const { return multiply(kernel, rows()); }
    template <class Number>
    std::vector<double> multiply(Kernel kernel, harmorph::ValueRows<Number> const& its) const {
        std::vector<double> x(static_cast<std::size_t>(points), 0.5), y(x.size(), -0.25);   // is added to
        harmorph::product_kernels(kernel).of(its).multiply(its, by, {x.data(), y.data()});
        x.insert(x.end(), y.begin(), y.end());
        return x;
    }
    std::vector<double> transposed(Kernel kernel) const { return transposed(kernel, rows()); }
    template <class Number>
    std::vector<double> transposed(Kernel kernel, harmorph::ValueRows<Number> const& its) const {
        std::vector<Vec2> in_units;
        for (Vec2 const w : weight) in_units.push_back({std::ldexp(w.x, 63), std::ldexp(w.y, 63)});
        harmorph::FixedSums total{};
        harmorph::product_kernels(kernel).of(its).multiply_transposed(its, in_units.data(), total);
        std::vector<double> out;
        for (Index k = 0; k < functions; ++k) out.push_back(total.x[k].value());
        for (Index k = 0; k < functions; ++k) out.push_back(total.y[k].value());
        for (Index k = functions; k < Movements::most; ++k) {
            CHECK(total.x[k].value() == 0);
            CHECK(total.y[k].value() == 0);
        }
        return out;
    }
};

}  // namespace

TEST_CASE("any number of functions and points: right to rounding, and the same bits from every kernel") {
    for (Index functions = 1; functions <= Movements::most; functions += functions < 40 ? 1 : 11)
        for (Index const points : {1, 2, 3, 4, 5, 9, 15, 64}) {
            Product const product(points, functions, static_cast<unsigned>(functions));
            INFO(functions << " functions, " << points << " points");
            std::vector<double> exact(2 * static_cast<std::size_t>(points)),
                exact_transposed(2 * static_cast<std::size_t>(functions));
            for (Index p = 0; p < points; ++p) {
                long double x = 0.5L, y = -0.25L;
                for (Index k = 0; k < functions; ++k) {
                    x += static_cast<long double>(product.value(p, k)) * product.by.x[k];
                    y += static_cast<long double>(product.value(p, k)) * product.by.y[k];
                }
                exact[static_cast<std::size_t>(p)] = static_cast<double>(x);
                exact[static_cast<std::size_t>(points + p)] = static_cast<double>(y);
            }
            for (Index k = 0; k < functions; ++k) {
                long double x = 0, y = 0;
                for (Index p = 0; p < points; ++p) {
                    x += static_cast<long double>(product.value(p, k)) * product.weight[static_cast<std::size_t>(p)].x;
                    y += static_cast<long double>(product.value(p, k)) * product.weight[static_cast<std::size_t>(p)].y;
                }
                exact_transposed[static_cast<std::size_t>(k)] = static_cast<double>(x);
                exact_transposed[static_cast<std::size_t>(functions + k)] = static_cast<double>(y);
            }
            std::vector<double> const there = product.multiply(Kernel::baseline),
                                      back = product.transposed(Kernel::baseline);
            CHECK(largest_difference(there, exact) < 1e-15 * (1 + functions));
            CHECK(largest_difference(back, exact_transposed) < 1.2e-16 * (1 + points));   // each product rounded once
            for (Kernel const kernel : usable_kernels()) {
                CHECK(same_bits(product.multiply(kernel), there));
                CHECK(same_bits(product.transposed(kernel), back));
            }
        }
}

TEST_CASE("numbers behind the last one are not read, at any address") {
    // A heap block that ends with the last value: AddressSanitizer sees reads beyond it. Without it, NaN would spread.
    for (Index const functions : {1, 3, 5, 7, 8, 9, 15, 17})
        for (Kernel const kernel : usable_kernels()) {
            Product product(3, functions, 1);
            std::vector<double> const expected = product.multiply(kernel), back = product.transposed(kernel);
            std::vector<double> shifted(1, std::numeric_limits<double>::quiet_NaN());
            shifted.insert(shifted.end(), product.values.begin(), product.values.end());
            shifted.resize(shifted.size() + 16, std::numeric_limits<double>::quiet_NaN());
            harmorph::ValueRows<double> const its{shifted.data() + 1, functions, 3, functions};
            CHECK(same_bits(product.multiply(kernel, its), expected));
            CHECK(same_bits(product.transposed(kernel, its), back));
        }
}

TEST_CASE("rows may be longer than what is used of them") {
    Product const product(6, 20, 2);
    Product used(6, 13, 2);
    used.values.clear();
    for (Index p = 0; p < 6; ++p)
        for (Index k = 0; k < 13; ++k) used.values.push_back(product.value(p, k));
    for (Kernel const kernel : usable_kernels()) {
        harmorph::ValueRows<double> const its{product.values.data(), 20, 6, 13};
        CHECK(same_bits(used.multiply(kernel, its), used.multiply(kernel)));
        CHECK(same_bits(used.transposed(kernel, its), used.transposed(kernel)));
    }
}

TEST_CASE("numbers that cancel, and as many as a call may add: the sum of the rounded products, from every kernel") {
    // Each product is a multiple of 2^-63 near 1 or -1, so that all sums are exact, and their whole parts large.
    Index const points = 4096;
    for (int const signs : {1, 2, 3}) {
        Product product(points, 3, 5);
        std::int64_t units[3] = {};
        for (Index p = 0; p < points; ++p) {
            double const w = 1 - 0x1p-30;
            product.weight[static_cast<std::size_t>(p)] = {w, -w};
            for (Index k = 0; k < 3; ++k) {
                double const f = (p % signs == 0 ? 1 : -1) * (1 - 0x1p-20 * ((p + k) % 7));
                product.values[static_cast<std::size_t>(3 * p + k)] = f;
                units[k] += static_cast<std::int64_t>(std::ldexp(f * w, 50));   // 2^-50: their last bit
            }
        }
        for (Kernel const kernel : usable_kernels()) {
            std::vector<double> const found = product.transposed(kernel);
            for (std::size_t k = 0; k < 3; ++k) {
                CHECK(found[k] == std::ldexp(static_cast<double>(units[k]), -50));
                CHECK(found[3 + k] == -found[k]);
            }
        }
    }
}

TEST_CASE("sums are added in place or elsewhere; where they are 0 all bits are kept") {
    std::vector<double> const from{1, -0.0, 0, std::nan(""), 2, -0.0, 5, 7, -0.0, 3, -0.0},
        sum{0.5, 0, -0.0, 0, -2, -0.0, 0x1p-60, 1, 3, -0.0, 0};
    for (Index n = 0; n <= 11; ++n)
        for (Kernel const kernel : usable_kernels()) {
            std::vector<double> in_place = from, elsewhere(from.size(), -7), expected = from;
            for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k)
                if (sum[k] != 0) expected[k] += sum[k];
            harmorph::product_kernels(kernel).add_sums(in_place.data(), in_place.data(), sum.data(), n);
            harmorph::product_kernels(kernel).add_sums(from.data(), elsewhere.data(), sum.data(), n);
            CHECK(same_bits(in_place, expected));
            for (std::size_t k = static_cast<std::size_t>(n); k < from.size(); ++k) expected[k] = -7;
            CHECK(same_bits(elsewhere, expected));
        }
}

TEST_CASE("numbers in single precision give the bits that they give as double ones, and none behind the last is read") {
    for (Index functions = 1; functions <= Movements::most; functions += functions < 40 ? 1 : 11)
        for (Index const points : {1, 3, 4, 9}) {
            Product product(points, functions, static_cast<unsigned>(functions));
            std::vector<float> singles(1, std::numeric_limits<float>::quiet_NaN());   // so that rows begin at odd places
            for (double& value : product.values) {
                singles.push_back(static_cast<float>(value));
                value = static_cast<double>(singles.back());
            }
            for (Kernel const kernel : usable_kernels()) {
                for (std::size_t const behind : {std::size_t{0}, std::size_t{16}}) {   // the heap's end, or NaN
                    std::vector<float> rows = singles;
                    rows.resize(rows.size() + behind, std::numeric_limits<float>::quiet_NaN());
                    rows.shrink_to_fit();
                    harmorph::ValueRows<float> const its{rows.data() + 1, functions, points, functions};
                    CHECK(same_bits(product.multiply(kernel, its), product.multiply(kernel)));
                    CHECK(same_bits(product.transposed(kernel, its), product.transposed(kernel)));
                }
            }
        }
}
