// The bytes of numbers as text, the lowest byte first on any processor, for the scripts of pages.
#pragma once

#include "formats/bytes.hpp"

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace cli {

template <class Number>
std::string numbers_as_text(const Number* numbers, std::size_t n) {
    using Bits = std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t>;
    std::string bytes;
    bytes.reserve(n * sizeof(Bits));
    for (std::size_t k = 0; k < n; ++k) {
        Bits bits;
        std::memcpy(&bits, numbers + k, sizeof bits);
        for (std::size_t i = 0; i < sizeof bits; ++i)
            bytes += static_cast<char>(bits >> (8 * i) & 255u);
    }
    return encode_base64(bytes);
}

template <class Number>
std::string numbers_as_text(const std::vector<Number>& numbers) {
    return numbers_as_text(numbers.data(), numbers.size());
}

// Escapes "<", because a tag in the name of a marker could end the script.
inline std::string for_script(std::string json) {
    for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos;)
        json.replace(at, 1, "\\u003c");
    return json;
}

}  // namespace cli
