#include <doctest/doctest.h>

#include "bspline/envelope_cholesky.hpp"

#include <cmath>
#include <vector>

using namespace harmorph;

namespace {

struct Block {
    std::vector<unsigned char> bytes;
    EnvelopeMatrix matrix;
    Block(Index n, Index bandwidth, bool closes) {
        Arena counting;
        EnvelopeMatrix().lay_out(counting, n, bandwidth, closes);
        bytes.resize(counting.bytes());
        Arena placing(bytes.data(), bytes.size());
        matrix.lay_out(placing, n, bandwidth, closes);
        REQUIRE(!placing.overflown());
        matrix.shape(n, bandwidth, closes);
    }
};

// Rings and chains of springs: diagonally dominant.
double entry(Index i, Index j, Index n, Index bandwidth, bool closes) {
    Index const apart = std::abs(i - j), round = closes ? std::min(apart, n - apart) : apart;
    if (round > bandwidth) return 0;
    return round == 0 ? 2.5 * bandwidth : -1.0 / (1 + round + 0.1 * (i + j));
}

}  // namespace

TEST_CASE("banded and ring-shaped matrices are solved") {
    for (bool const closes : {false, true})
        for (Index const bandwidth : {1, 3, 5})
            for (Index const n : {2, 6, 7, 11, 40}) {
                Block block(n, bandwidth, closes);
                std::vector<double> x(static_cast<std::size_t>(n)), b(x.size());
                for (Index i = 0; i < n; ++i) x[std::size_t(i)] = std::sin(1.0 + i);
                for (Index i = 0; i < n; ++i)
                    for (Index j = 0; j < n; ++j) {
                        double const a = entry(i, j, n, bandwidth, closes);
                        if (j <= i && a != 0) block.matrix.add(i, j, a);
                        b[std::size_t(i)] += a * x[std::size_t(j)];
                    }
                REQUIRE(block.matrix.factor() == harmorph::none);
                block.matrix.solve({b.data(), b.size()});
                for (std::size_t i = 0; i < b.size(); ++i)
                    CHECK(b[i] == doctest::Approx(x[i]).epsilon(1e-12));
            }
}

TEST_CASE("a matrix that is not positive definite is noticed") {
    Block block(3, 1, false);
    for (Index i = 0; i < 3; ++i) block.matrix.add(i, i, 1);
    block.matrix.add(2, 1, 1);
    CHECK(block.matrix.factor() != harmorph::none);
}
