#include "sampling/latin.hpp"

#include "sampling/mixed_bits.hpp"

namespace cli {

LatinHypercube::LatinHypercube(std::uint64_t n, std::uint64_t seed) : n_(n), seed_(seed) {
    while ((std::uint64_t{1} << (2 * half_bits_)) < n) ++half_bits_;
}

// A Feistel network permutes the numbers of 2 half_bits bits. It is applied until the number is
// below n, which makes a permutation of these numbers.
std::uint64_t LatinHypercube::permuted(std::uint64_t index, std::uint64_t key) const {
    constexpr std::uint64_t rounds = 6;
    const std::uint64_t mask = (std::uint64_t{1} << half_bits_) - 1;
    do {
        std::uint64_t left = index >> half_bits_, right = index & mask;
        for (std::uint64_t round = 0; round < rounds; ++round) {
            const std::uint64_t next = left ^ (mixed_bits(key + round, right) & mask);
            left = right;
            right = next;
        }
        index = (left << half_bits_) | right;
    } while (index >= n_);
    return index;
}

double LatinHypercube::at(std::uint64_t index, std::size_t dimension) const {
    const std::uint64_t key = mixed_bits(seed_, dimension);
    const auto interval = static_cast<double>(permuted(index, key));
    return (interval + unit_number(mixed_bits(key, ~index))) / static_cast<double>(n_);
}

}  // namespace cli
