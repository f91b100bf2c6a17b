// The products of morphing, kernel by kernel: against plain loops, and kernel against kernel to the
// bit.
#include <doctest/doctest.h>

#include <fixtures/core.hpp>
#include <fixtures/executors.hpp>

#include "morph/morph.hpp"

#include <cmath>
#include <limits>

using namespace fixtures;
using harmorph::block_points;
using harmorph::Index;
using harmorph::Kernel;
using harmorph::Movements;
using harmorph::RowInBlock;

namespace {

struct Product {
    Index blocks, points, numbers;
    std::vector<double> values;
    Movements by{};
    std::vector<double> weight_x, weight_y;  // of each point

    Product(Index n_blocks, Index n_numbers, unsigned seed)
        : blocks(n_blocks), points(n_blocks * block_points), numbers(n_numbers) {
        std::mt19937 random(seed);
        auto const any = [&] { return 2 * uniform(random) - 1; };
        for (Index k = 0; k < points * numbers; ++k) values.push_back(any());
        for (Index k = 0; k < numbers; ++k) {
            by.x[k] = any();
            by.y[k] = any();
        }
        for (Index p = 0; p < points; ++p) {
            weight_x.push_back(any());
            weight_y.push_back(any());
        }
    }
    harmorph::ValueBlocks<double> whole() const {
        return {values.data(), numbers * block_points, blocks, numbers};
    }
    RowInBlock<const double> row(Index p) const { return {values.data(), numbers, p}; }
    RowInBlock<double> row(Index p) { return {values.data(), numbers, p}; }
    std::size_t n_points() const { return std::size_t(points); }

    // All x, then all y.
    std::vector<double> multiply(Kernel kernel) const { return multiply(kernel, whole()); }
    template <class Number>
    std::vector<double> multiply(Kernel kernel, harmorph::ValueBlocks<Number> const& factor) const {
        std::vector<double> x(n_points(), 0.5), y(n_points(), -0.25);  // is added to
        harmorph::product_kernels(kernel).of(factor).multiply(factor, by, {x.data(), y.data()});
        x.insert(x.end(), y.begin(), y.end());
        return x;
    }
    std::vector<double> transposed(Kernel kernel) const { return transposed(kernel, whole()); }
    template <class Number>
    std::vector<double> transposed(Kernel kernel,
                                   harmorph::ValueBlocks<Number> const& factor) const {
        std::vector<double> x, y, out;
        for (double const w : weight_x) x.push_back(std::ldexp(w, 63));
        for (double const w : weight_y) y.push_back(std::ldexp(w, 63));
        harmorph::FixedSums total{};
        harmorph::product_kernels(kernel).of(factor).multiply_transposed(
            factor, {x.data(), y.data()}, {0.5, 2}, total);
        for (Index k = 0; k < factor.n_numbers; ++k) out.push_back(total.x[k].value());
        for (Index k = 0; k < factor.n_numbers; ++k) out.push_back(total.y[k].value());
        for (Index k = factor.n_numbers; k < Movements::max_count; ++k) {
            CHECK(total.x[k].value() == 0);
            CHECK(total.y[k].value() == 0);
        }
        return out;
    }
};

}  // namespace

TEST_CASE("a point's products are added in the order of the numbers by every kernel") {
    for (Index numbers = 1; numbers <= Movements::max_count; numbers += numbers < 40 ? 1 : 11) {
        Product const product(3, numbers, static_cast<unsigned>(numbers));
        INFO(numbers << " numbers");
        std::vector<double> in_order(2 * product.n_points());
        for (Index p = 0; p < product.points; ++p) {
            double x = 0.5, y = -0.25;
            for (Index k = 0; k < numbers; ++k) {
                // No compiler may fuse product and sum here: the product is stored.
                double volatile const by_x = product.row(p)[k] * product.by.x[k],
                                      by_y = product.row(p)[k] * product.by.y[k];
                x += by_x;
                y += by_y;
            }
            in_order[std::size_t(p)] = x;
            in_order[std::size_t(product.points + p)] = y;
        }
        CHECK(same_bits(product.multiply(Kernel::baseline), in_order));
        for (Kernel const kernel : usable_kernels())
            CHECK(same_bits(product.multiply(kernel), in_order));
    }
}

TEST_CASE("the transpose is right to rounding and has the same bits from every kernel") {
    for (Index numbers = 1; numbers <= Movements::max_count; numbers += numbers < 40 ? 1 : 11)
        for (Index const blocks : {1, 2, 5, 8, 19}) {
            Product const product(blocks, numbers, static_cast<unsigned>(numbers));
            INFO(numbers << " numbers, " << blocks << " blocks");
            std::vector<double> exact(2 * std::size_t(numbers));
            for (Index k = 0; k < numbers; ++k) {
                long double x = 0, y = 0;
                for (Index p = 0; p < product.points; ++p) {
                    std::size_t const at = std::size_t(p);
                    x += static_cast<long double>(product.row(p)[k]) * product.weight_x[at];
                    y += static_cast<long double>(product.row(p)[k]) * product.weight_y[at];
                }
                exact[std::size_t(k)] = double(x);
                exact[std::size_t(numbers + k)] = double(y);
            }
            std::vector<double> const back = product.transposed(Kernel::baseline);
            CHECK(largest_difference(back, exact) < 1.2e-16 * (1 + product.points));
            for (Kernel const kernel : usable_kernels())
                CHECK(same_bits(product.transposed(kernel), back));
        }
}

TEST_CASE("of the numbers of a block some may be used, at any address; no others are read") {
    // A heap block that ends with the last value used: AddressSanitizer sees reads beyond it.
    // Without it, NaN would spread.
    Index const blocks = 2, numbers = 20;
    Product const product(blocks, numbers, 2);
    for (Index const first : {0, 3, 19})
        for (Index const n : {1, 2, 7, 17}) {
            if (first + n > numbers) continue;
            Product used(blocks, n, 2);
            used.weight_x = product.weight_x;
            used.weight_y = product.weight_y;
            std::size_t const one = 1, size = std::size_t(numbers * block_points);
            std::vector<double> shifted(one + size + std::size_t((first + n) * block_points),
                                        std::numeric_limits<double>::quiet_NaN());
            for (Index p = 0; p < product.points; ++p)
                for (Index k = 0; k < n; ++k) {
                    used.row(p)[k] = product.row(p)[first + k];
                    RowInBlock<double>(shifted.data() + 1, numbers, p)[first + k] =
                        product.row(p)[first + k];
                }
            harmorph::ValueBlocks<double> const part{shifted.data() + 1 + first * block_points,
                                                     numbers * block_points, blocks, n};
            for (Kernel const kernel : usable_kernels()) {
                CHECK(same_bits(used.multiply(kernel, part), used.multiply(kernel)));
                CHECK(same_bits(used.transposed(kernel, part), used.transposed(kernel)));
            }
        }
}

TEST_CASE("every kernel sums numbers that cancel, and as many as a call may add") {
    // Each product is a multiple of 2^-30 near 1 or -1, so that all sums are exact. Sums of
    // products near 2^63 are far beyond 64 bits, along x and along y each by its own multiple of
    // 2^64.
    Index const most = harmorph::BlockProducts<double>::max_blocks;
    for (Index const blocks : {256, most - 1, most})
        for (int const signs : {1, 2, 3, 4}) {
            Product product(blocks, 3, 5);
            std::int64_t units_x[3] = {}, units_y[3] = {};
            for (Index p = 0; p < product.points; ++p) {
                std::size_t const at = std::size_t(p);
                double const w = 1 - 0x1p-20;
                product.weight_x[at] = w;
                product.weight_y[at] = signs == 4 || p % 5 == 0 ? -w : w;
                for (Index k = 0; k < 3; ++k) {
                    double const f = (p % signs == 0 ? 1 : -1) * (1 - 0x1p-10 * ((p + k) % 7));
                    product.row(p)[k] = f;
                    units_x[k] += std::int64_t(std::ldexp(f * product.weight_x[at], 30));
                    units_y[k] += std::int64_t(std::ldexp(f * product.weight_y[at], 30));
                }
            }
            INFO(blocks << " blocks, signs " << signs);
            for (Kernel const kernel : usable_kernels()) {
                std::vector<double> const found = product.transposed(kernel);
                for (std::size_t k = 0; k < 3; ++k) {
                    CHECK(found[k] == std::ldexp(double(units_x[k]), -30));
                    CHECK(found[3 + k] == std::ldexp(double(units_y[k]), -30));
                }
            }
        }
}

TEST_CASE("points are moved in place, elsewhere or from 0, and keep their bits if the sum is 0") {
    for (Index const numbers : {1, 2, 9, 20})
        for (Kernel const kernel : usable_kernels()) {
            Product product(3, numbers, 7);
            for (Index k = 0; k < numbers; ++k)
                product.row(5)[k] = product.row(20)[k] = product.row(33)[k] = k % 2 ? 0.0 : -0.0;
            std::size_t const n = product.n_points();
            std::vector<double> from(2 * n, 3), sum(2 * n, 0.0), zero(2 * n, 0.0);
            from[5] = -0.0;
            from[n + 20] = std::nan("");
            harmorph::BlockProducts<double> const& products =
                harmorph::product_kernels(kernel).of(product.whole());
            products.multiply(product.whole(), product.by, {sum.data(), sum.data() + n});
            auto const expected = [&](std::vector<double> out) {
                for (std::size_t k = 0; k < 2 * n; ++k)
                    if (sum[k] != 0) out[k] += sum[k];
                return out;
            };
            std::vector<double> in_place = from, elsewhere(2 * n, -7), displacement(2 * n, -7);
            products.move(product.whole(), product.by, {in_place.data(), in_place.data() + n},
                          {in_place.data(), in_place.data() + n});
            products.move(product.whole(), product.by, {from.data(), from.data() + n},
                          {elsewhere.data(), elsewhere.data() + n});
            products.move(product.whole(), product.by, {nullptr, nullptr},
                          {displacement.data(), displacement.data() + n});
            CHECK(same_bits(in_place, expected(from)));
            CHECK(same_bits(elsewhere, expected(from)));
            CHECK(same_bits(displacement, expected(zero)));
        }
}

TEST_CASE("the largest number, infinities and NaN above all others, wherever it stands") {
    for (Index const n : {1, 3, 31, 32, 33, 100})
        for (double const largest :
             {-2.0, 3.0, -std::numeric_limits<double>::infinity(), std::nan("")})
            for (Index at = 0; at < n; ++at)
                for (Kernel const kernel : usable_kernels()) {
                    std::vector<double> numbers(std::size_t(n), -1);
                    numbers[std::size_t(at)] = largest;
                    harmorph::LargestMagnitude expected, found;
                    expected.include(largest);
                    found.include_bits(
                        harmorph::product_kernels(kernel).largest_bits(numbers.data(), n));
                    CHECK(same_bits<double>({found.value()}, {expected.value()}));
                }
}

TEST_CASE("numbers in single precision give the bits that they give as double ones") {
    for (Index numbers = 1; numbers <= Movements::max_count; numbers += numbers < 40 ? 1 : 11) {
        Product product(3, numbers, static_cast<unsigned>(numbers));
        std::vector<float> singles(
            1, std::numeric_limits<float>::quiet_NaN());  // so that blocks begin at odd places
        for (double& value : product.values) {
            singles.push_back(static_cast<float>(value));
            value = double(singles.back());
        }
        singles.shrink_to_fit();
        harmorph::ValueBlocks<float> const narrow{singles.data() + 1, numbers * block_points, 3,
                                                  numbers};
        for (Kernel const kernel : usable_kernels()) {
            CHECK(same_bits(product.multiply(kernel, narrow), product.multiply(kernel)));
            CHECK(same_bits(product.transposed(kernel, narrow), product.transposed(kernel)));
        }
    }
}
