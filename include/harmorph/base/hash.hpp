// 64-bit fingerprints of numbers: they tell a damaged or foreign block, not an attacker.
#pragma once

#include <cstring>

#include "harmorph/base/types.hpp"

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

// Four interleaved hashes keep up with memory; `bytes` must be a multiple of 8.
inline std::uint64_t hash_of_block(const void* block, Size bytes) noexcept {
    const unsigned char* const data = static_cast<const unsigned char*>(block);
    Hash interleaved[4];
    Size const words = bytes / 8;
    for (Size i = 0; i < words; ++i) {
        std::uint64_t word;
        std::memcpy(&word, data + 8 * i, sizeof word);
        interleaved[i % 4].add(word);
    }
    Hash all;
    for (Hash const& one : interleaved) all.add(one.value());
    all.add(words);
    return all.value();
}

}  // namespace harmorph
