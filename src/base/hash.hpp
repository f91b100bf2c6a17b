// 64-bit fingerprints of numbers: they tell a damaged or foreign block, not an attacker.
#pragma once

#include <cstring>

#include "base/parallel_reduce.hpp"

namespace harmorph {

class Hash {
public:
    void add(std::uint64_t word) noexcept {
        state_ = (state_ ^ word) * 0x9E3779B97F4A7C15u;  // 2^64 / golden ratio, odd
        state_ ^= state_ >> 29;
    }
    std::uint64_t value() const noexcept { return state_; }

private:
    std::uint64_t state_ = 0x6861726D6F727068u;
};

// Interleaved hashes, as each word waits for the one before: so many keep up with memory.
inline std::uint64_t hash_of_words(const unsigned char* data, Size words) noexcept {
    constexpr Size lanes = 8;
    Hash interleaved[lanes];
    auto const add = [&](Size lane, Size i) {
        std::uint64_t word;
        std::memcpy(&word, data + 8 * i, sizeof word);
        interleaved[lane].add(word);
    };
    Size const whole = words / lanes * lanes;
    for (Size i = 0; i < whole; i += lanes) {
#pragma GCC unroll 8
        for (Size lane = 0; lane < lanes; ++lane) add(lane, i + lane);
    }
    for (Size i = whole; i < words; ++i) add(i - whole, i);
    Hash all;
    for (Hash const& one : interleaved) all.add(one.value());
    return all.value();
}

// `bytes` must be a multiple of 8. The block is hashed in pieces, the same for any number of
// threads; with the number of each piece its hash becomes a term of a sum, which has no order.
inline std::uint64_t hash_of_block(const void* block, Size bytes,
                                   Executor const& executor = {}) noexcept {
    constexpr Size most = 8192;  // words of a piece
    struct Terms {
        std::uint64_t sum = 0;
        void merge(Terms const& others) noexcept { sum += others.sum; }
    };
    const unsigned char* const data = static_cast<const unsigned char*>(block);
    Size const words = bytes / 8;
    Index const pieces = static_cast<Index>((words + (most - 1)) / most);
    Terms const terms =
        reduce_ranges<Terms>(pieces, executor, [&](Index begin, Index end, Terms& its) {
            for (Index piece = begin; piece < end; ++piece) {
                Size const first = most * static_cast<Size>(piece);
                Hash one;
                one.add(hash_of_words(data + 8 * first, min(most, words - first)));
                one.add(static_cast<std::uint64_t>(piece));
                its.sum += one.value();
            }
        });
    Hash all;
    all.add(terms.sum);
    all.add(words);
    return all.value();
}

}  // namespace harmorph
