// Random numbers that depend on a seed and on counters only, so that any of them can be computed
// alone. The function is the finaliser of SplitMix64 (G. Steele, D. Lea, C. Flood, 2014).
#pragma once

#include <cstdint>

namespace cli {

constexpr std::uint64_t mixed_bits(std::uint64_t bits) {
    bits += 0x9e3779b97f4a7c15u;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return bits ^ (bits >> 31);
}

constexpr std::uint64_t mixed_bits(std::uint64_t a, std::uint64_t b) {
    return mixed_bits(mixed_bits(a) ^ b);
}

// Returns a number in [0, 1), a multiple of 2^-53.
constexpr double unit_number(std::uint64_t bits) {
    return static_cast<double>(bits >> 11) * (1.0 / 9007199254740992.0);
}

}  // namespace cli
