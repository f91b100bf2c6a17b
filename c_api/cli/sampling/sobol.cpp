#include "sampling/sobol.hpp"

#include "sampling/mixed_bits.hpp"

namespace cli {

namespace {

// A polynomial over the field of two elements; bit k is the coefficient of x^k.
using Polynomial = std::uint32_t;

int degree_of(Polynomial p) {
    int degree = -1;
    for (; p != 0; p >>= 1) ++degree;
    return degree;
}

// Returns whether the powers of x modulo p are all polynomials of a lower degree except 0.
bool is_primitive(Polynomial p) {
    const int degree = degree_of(p);
    const std::uint32_t order = (std::uint32_t{1} << degree) - 1;
    Polynomial power = 1;
    for (std::uint32_t k = 1; k <= order; ++k) {
        power <<= 1;
        if ((power >> degree) & 1) power ^= p;
        if (power == 1) return k == order;
    }
    return false;
}

}  // namespace

Sobol::Sobol(std::size_t dimensions, std::uint64_t seed) {
    Polynomial next = 3;  // x + 1
    for (std::size_t dimension = 0; dimension < dimensions; ++dimension) {
        std::array<std::uint32_t, bits> v = {};
        shift_.push_back(static_cast<std::uint32_t>(mixed_bits(seed, dimension) >> 32));
        if (dimension == 0) {
            for (std::size_t k = 0; k < bits; ++k) v[k] = std::uint32_t{1} << (bits - 1 - k);
            directions_.push_back(v);
            continue;
        }
        while (!is_primitive(next)) next += 2;
        const auto degree = static_cast<std::size_t>(degree_of(next));
        for (std::size_t k = 0; k < bits; ++k) {
            if (k < degree) {  // any odd number below 2^(k+1)
                const auto below = (std::uint32_t{1} << (k + 1)) - 1;
                const auto odd = static_cast<std::uint32_t>(mixed_bits(dimension, k)) & below;
                v[k] = (odd | 1) << (bits - 1 - k);
                continue;
            }
            v[k] = v[k - degree] ^ (v[k - degree] >> degree);
            for (std::size_t j = 1; j < degree; ++j)
                if ((next >> (degree - j)) & 1) v[k] ^= v[k - j];
        }
        directions_.push_back(v);
        next += 2;
    }
}

double Sobol::at(std::uint64_t index, std::size_t dimension) const {
    std::uint32_t value = shift_[dimension];
    for (std::size_t k = 0; k < bits; ++k)
        if ((index >> k) & 1) value ^= directions_[dimension][k];
    return (value + .5) / 4294967296.0;
}

}  // namespace cli
