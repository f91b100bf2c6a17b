// The bytes that decide about a case come from libFuzzer or from a seed. All bytes after the last
// one are 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>

namespace fuzz {

class Input {
public:
    Input(const unsigned char* begin, const unsigned char* end) : data_(begin), end_(end) {}

    std::uint32_t below(std::uint32_t n) {  // 0 .. n-1
        std::uint32_t bits = 0;
        for (std::uint32_t range = n - 1; range > 0; range >>= 8) bits = bits << 8 | byte();
        return n > 0 ? bits % n : 0;
    }
    std::int32_t from(std::int32_t low, std::int32_t high) {  // low .. high
        return low + static_cast<std::int32_t>(below(static_cast<std::uint32_t>(high - low) + 1));
    }
    bool one_in(std::uint32_t n) {
        return below(n) + 1 == n;
    }  // never behind the end of the bytes, unless n is 1
    double between(double low, double high) { return low + (high - low) * below(65536) / 65535; }
    template <class Value>
    Value any_of(std::initializer_list<Value> values) {
        return values.begin()[below(static_cast<std::uint32_t>(values.size()))];
    }
    std::string rest() { return {data_, end_}; }  // all bytes that are left, but not taken away
    double wild() {                               // a number that few expect
        using Limits = std::numeric_limits<double>;
        return any_of({Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(),
                       Limits::denorm_min(), -0.0, 0.0, Limits::max(), -Limits::max(),
                       Limits::min(), 1e100, 1.01e100, -1e160, 1e-100, 1e-160, 1e300, 1e16});
    }
    std::int32_t wild_index() {
        using Limits = std::numeric_limits<std::int32_t>;
        return any_of(
            {-1, 0, 1, 2, 7, 1000, Limits::max(), Limits::min(), Limits::max() - 1, 1 << 30});
    }

private:
    unsigned byte() { return data_ < end_ ? *data_++ : 0; }

    const unsigned char* data_;
    const unsigned char* end_;
};

}  // namespace fuzz
