// Appends many numbers to a text, several times as fast as the operators of a stream. The
// characters are collected in a small buffer, and are appended to the text when the buffer is full
// and when this object is destroyed.
#pragma once

#include "basics/numbers.hpp"

#include <charconv>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace cli {

class TextOut {
public:
    explicit TextOut(std::string& text) : text_(text) {}
    ~TextOut() { flush(); }
    TextOut(const TextOut&) = delete;
    TextOut& operator=(const TextOut&) = delete;

    TextOut& operator<<(std::string_view text) {
        if (text.size() > static_cast<std::size_t>(longest_decimal)) {
            flush();
            text_ += text;
            return *this;
        }
        make_room();
        std::memcpy(at_, text.data(), text.size());
        at_ += text.size();
        return *this;
    }
    TextOut& operator<<(char c) {
        make_room();
        *at_++ = c;
        return *this;
    }
    template <class Whole, class = std::enable_if_t<std::is_integral<Whole>::value>>
    TextOut& operator<<(Whole value) {
        make_room();
        at_ = std::to_chars(at_, end(), value).ptr;
        return *this;
    }
    // Writes as many digits as are needed to read back the same bits.
    TextOut& operator<<(double value) {
        make_room();
        if (char* const behind = print_shortest(at_, value)) {
            at_ = behind;
            return *this;
        }
#if defined(__cpp_lib_to_chars)  // some C++17 libraries lack it for real numbers
        at_ = std::to_chars(at_, end(), value).ptr;
        return *this;
#else
        return exact(value);
#endif
    }
    TextOut& exact(double value) {  // 17 significant digits
        make_room();
        if (char* const behind = print_decimal(at_, 'g', 17, value)) {
            at_ = behind;
            return *this;
        }
        flush();
        append_number(text_, 'g', 17, value);
        return *this;
    }

    // Returns the text with everything that has been written; the caller may append to the text.
    std::string& text() {
        flush();
        return text_;
    }

private:
    char* end() { return buffer_ + sizeof buffer_; }
    void make_room() {
        if (end() - at_ < longest_decimal) flush();
    }
    void flush() {
        text_.append(buffer_, static_cast<std::size_t>(at_ - buffer_));
        at_ = buffer_;
    }

    std::string& text_;
    char buffer_[4 * longest_decimal];
    char* at_ = buffer_;
};

}  // namespace cli
