// The products of morphing against plain loops, and kernel against kernel to the bit.
#include <doctest/doctest.h>

#include <fixtures/core.hpp>

#include <harmorph/product.hpp>

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

    std::vector<double> multiply(Kernel kernel) const {
        std::vector<Vec2> sum(static_cast<std::size_t>(points), Vec2{0.5, -0.25});   // is added to
        multiply_rows(kernel, rows(), by, sum.data());
        std::vector<double> out;
        for (Vec2 const s : sum) out.insert(out.end(), {s.x, s.y});
        return out;
    }
    std::vector<double> transposed(Kernel kernel) const {
        harmorph::FixedSums total{};
        multiply_rows_transposed(kernel, rows(), weight.data(), total);
        std::vector<double> out;
        for (Index k = 0; k < functions; ++k) out.push_back(total.x(k).value());
        for (Index k = 0; k < functions; ++k) out.push_back(total.y(k).value());
        for (Index k = functions; k < Movements::most; ++k) CHECK((total.x(k).value() == 0 && total.y(k).value() == 0));
        return out;
    }
};

}  // namespace

TEST_CASE("any number of functions and points: right to rounding, and the same bits from every kernel") {
    for (Index functions = 1; functions <= Movements::most; functions += functions < 40 ? 1 : 11)
        for (Index const points : {1, 2, 3, 4, 5, 9, 64}) {
            Product const product(points, functions, static_cast<unsigned>(functions));
            INFO(functions << " functions, " << points << " points");
            std::vector<double> exact, exact_transposed(2 * static_cast<std::size_t>(functions));
            for (Index p = 0; p < points; ++p) {
                long double x = 0.5L, y = -0.25L;
                for (Index k = 0; k < functions; ++k) {
                    x += static_cast<long double>(product.value(p, k)) * product.by.x[k];
                    y += static_cast<long double>(product.value(p, k)) * product.by.y[k];
                }
                exact.insert(exact.end(), {static_cast<double>(x), static_cast<double>(y)});
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
            for (Kernel const kernel : {Kernel::avx2, Kernel::avx512}) {
                if (!harmorph::has_kernel(kernel)) continue;
                CHECK(same_bits(product.multiply(kernel), there));
                CHECK(same_bits(product.transposed(kernel), back));
            }
        }
}

TEST_CASE("numbers behind the last one are not read, at any address") {
    // A heap block that ends with the last value: AddressSanitizer sees reads beyond it. Without it, NaN would spread.
    for (Index const functions : {1, 3, 5, 7, 8, 9, 15, 17})
        for (Kernel const kernel : {Kernel::baseline, Kernel::avx2, Kernel::avx512}) {
            if (!harmorph::has_kernel(kernel)) continue;
            Product product(3, functions, 1);
            std::vector<double> const expected = product.multiply(kernel), back = product.transposed(kernel);
            std::vector<double> shifted(1, std::numeric_limits<double>::quiet_NaN());
            shifted.insert(shifted.end(), product.values.begin(), product.values.end());
            shifted.resize(shifted.size() + 16, std::numeric_limits<double>::quiet_NaN());
            std::vector<Vec2> sum(3, Vec2{0.5, -0.25});
            multiply_rows(kernel, {shifted.data() + 1, functions, 3, functions}, product.by, sum.data());
            for (std::size_t p = 0; p < 3; ++p) CHECK((sum[p].x == expected[2 * p] && sum[p].y == expected[2 * p + 1]));
            harmorph::FixedSums total{};
            multiply_rows_transposed(kernel, {shifted.data() + 1, functions, 3, functions}, product.weight.data(), total);
            for (Index k = 0; k < functions; ++k) CHECK(total.x(k).value() == back[static_cast<std::size_t>(k)]);
        }
}

TEST_CASE("rows may be longer than what is used of them") {
    Product const product(6, 20, 2);
    std::vector<Vec2> sum(6);
    Movements by = product.by;
    for (Index k = 13; k < Movements::most; ++k) by.x[k] = by.y[k] = 0;
    multiply_rows(Kernel::baseline, {product.values.data(), 20, 6, 13}, by, sum.data());
    for (Index p = 0; p < 6; ++p) {
        double x = 0;
        for (Index k = 0; k < 13; ++k) x += product.value(p, k) * by.x[k];
        CHECK(sum[static_cast<std::size_t>(p)].x == doctest::Approx(x).epsilon(1e-14));
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
            for (Kernel const kernel : {Kernel::baseline, Kernel::avx2, Kernel::avx512}) {
                if (!harmorph::has_kernel(kernel)) continue;
                for (std::size_t const behind : {std::size_t{0}, std::size_t{16}}) {   // the heap's end, or NaN
                    std::vector<float> rows = singles;
                    rows.resize(rows.size() + behind, std::numeric_limits<float>::quiet_NaN());
                    rows.shrink_to_fit();
                    harmorph::ValueRows<float> const its{rows.data() + 1, functions, points, functions};
                    std::vector<Vec2> sum(static_cast<std::size_t>(points), Vec2{0.5, -0.25});
                    multiply_rows(kernel, its, product.by, sum.data());
                    std::vector<double> there, back;
                    for (Vec2 const s : sum) there.insert(there.end(), {s.x, s.y});
                    CHECK(same_bits(there, product.multiply(kernel)));
                    harmorph::FixedSums total{};
                    multiply_rows_transposed(kernel, its, product.weight.data(), total);
                    for (Index k = 0; k < functions; ++k) back.push_back(total.x(k).value());
                    for (Index k = 0; k < functions; ++k) back.push_back(total.y(k).value());
                    CHECK(same_bits(back, product.transposed(kernel)));
                }
            }
        }
}
