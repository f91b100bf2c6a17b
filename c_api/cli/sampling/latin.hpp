// Latin hypercube: of n points, one is in each of n equal intervals in every dimension. Any point
// is computed alone, so the memory does not depend on n. (M. McKay, R. Beckman, W. Conover,
// Technometrics 21 (1979) 239.)
#pragma once

#include <cstddef>
#include <cstdint>

namespace cli {

class LatinHypercube {
public:
    LatinHypercube(std::uint64_t n, std::uint64_t seed);

    // Returns a number in [0, 1). index: 0 .. n - 1.
    double at(std::uint64_t index, std::size_t dimension) const;

private:
    std::uint64_t permuted(std::uint64_t index, std::uint64_t key) const;

    std::uint64_t n_, seed_;
    int half_bits_ = 1;  // 2^(2 half_bits) >= n
};

}  // namespace cli
