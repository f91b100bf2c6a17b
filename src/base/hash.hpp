// Computes 64-bit fingerprints of numbers, which detect a damaged or foreign block,
// but do not protect against intended manipulation.
#pragma once

#include <cstring>

#include "base/executor.hpp"

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

// Each step of a hash waits for the step before it; eight interleaved hashes are as fast as the
// memory.
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

// `bytes` must be a multiple of 8. The block is divided into chunks that do not depend on the
// number of threads. The hash of each chunk includes the number of the chunk, and the hashes are
// added, so that their order does not matter.
inline std::uint64_t hash_of_block(const void* block, Size bytes,
                                   Executor const& executor = {}) noexcept {
    constexpr Size chunk_words = 8192;
    struct Terms {
        std::uint64_t sum = 0;
        void merge(Terms const& others) noexcept { sum += others.sum; }
    };
    const unsigned char* const data = static_cast<const unsigned char*>(block);
    Size const words = bytes / 8;
    Index const chunks = static_cast<Index>((words + (chunk_words - 1)) / chunk_words);
    Terms const terms =
        reduce_ranges<Terms>(chunks, executor, [&](Index begin, Index end, Terms& range) {
            for (Index chunk = begin; chunk < end; ++chunk) {
                Size const first = chunk_words * static_cast<Size>(chunk);
                Hash one;
                one.add(hash_of_words(data + 8 * first, min(chunk_words, words - first)));
                one.add(static_cast<std::uint64_t>(chunk));
                range.sum += one.value();
            }
        });
    Hash all;
    all.add(terms.sum);
    all.add(words);
    return all.value();
}

}  // namespace harmorph
