// Sobol's sequence: points that fill the unit cube evenly. The first 2^k points have one coordinate
// in each of the 2^k equal intervals, in every dimension. (I. M. Sobol, USSR Comput. Math. Math.
// Phys. 7 (1967) 86; P. Bratley, B. L. Fox, ACM Trans. Math. Softw. 14 (1988) 88.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cli {

class Sobol {
public:
    static constexpr std::size_t max_dimensions = 1000;

    // The seed shifts all points by exclusive or, which keeps the property above. The direction
    // numbers do not depend on the seed.
    Sobol(std::size_t dimensions, std::uint64_t seed);

    // Returns a number in (0, 1). index: 0 .. 2^32 - 1.
    double at(std::uint64_t index, std::size_t dimension) const;

private:
    static constexpr std::size_t bits = 32;

    std::vector<std::array<std::uint32_t, bits>> directions_;
    std::vector<std::uint32_t> shift_;
};

}  // namespace cli
