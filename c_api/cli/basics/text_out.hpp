// Appends many numbers to a text, several times as fast as the operators of a stream.
#pragma once

#include "basics/numbers.hpp"

#include <charconv>
#include <string>
#include <string_view>
#include <type_traits>

namespace cli {

class TextOut {
public:
    explicit TextOut(std::string& text) : text_(text) {}

    TextOut& operator<<(std::string_view text) {
        text_ += text;
        return *this;
    }
    TextOut& operator<<(char c) {
        text_ += c;
        return *this;
    }
    template <class Whole, class = std::enable_if_t<std::is_integral<Whole>::value>>
    TextOut& operator<<(Whole value) {
        char digits[24];
        const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
        text_.append(digits, static_cast<std::size_t>(end - digits));
        return *this;
    }
    // Writes as many digits as are needed to read back the same bits.
    TextOut& operator<<(double value) {
#if defined(__cpp_lib_to_chars)  // some C++17 libraries lack it for real numbers
        char digits[32];
        const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
        text_.append(digits, static_cast<std::size_t>(end - digits));
#else
        append_number(text_, 'g', 17, value);
#endif
        return *this;
    }
    TextOut& exact(double value) {  // 17 significant digits
        append_number(text_, 'g', 17, value);
        return *this;
    }

private:
    std::string& text_;
};

}  // namespace cli
