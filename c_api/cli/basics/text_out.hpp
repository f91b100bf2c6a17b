// Output of many numbers, several times as fast as the operators of a stream.
#pragma once

#include "basics/numbers.hpp"

#include <charconv>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>

namespace cli {

class TextOut {
public:
    explicit TextOut(std::ostream& stream) : stream_(stream) {}
    TextOut(const TextOut&) = delete;
    TextOut& operator=(const TextOut&) = delete;
    ~TextOut() { flush(); }

    TextOut& operator<<(std::string_view text) {
        text_ += text;
        if (text_.size() > 1 << 16) flush();
        return *this;
    }
    TextOut& operator<<(char c) { return *this << std::string_view(&c, 1); }
    template <class Whole, class = std::enable_if_t<std::is_integral<Whole>::value>>
    TextOut& operator<<(Whole value) {
        char digits[24];
        const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
        return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
    }
    // Writes as many digits as are needed to read back the same bits.
    TextOut& operator<<(double value) {
#if defined(__cpp_lib_to_chars)  // some C++17 libraries lack it for real numbers
        char digits[32];
        const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
        return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
#else
        return *this << std::string_view(exact(value));
#endif
    }

private:
    void flush() {
        stream_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
        text_.clear();
    }

    std::ostream& stream_;
    std::string text_;
};

}  // namespace cli
