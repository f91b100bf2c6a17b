#include "basics/print.hpp"

#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace cli {

namespace {

std::uint32_t bits(char byte) { return static_cast<unsigned char>(byte); }

bool is_readable(std::uint32_t code) {
    const bool is_control = code < 0x20 || (code >= 0x7F && code < 0xA0);
    const bool is_surrogate = code >= 0xD800 && code < 0xE000;
    return !is_control && !is_surrogate && code != 0xFFFE && code != 0xFFFF && code <= 0x10FFFF;
}

}  // namespace

std::size_t readable_character(std::string_view text) {
    if (text.empty()) return 0;
    const std::uint32_t first = bits(text[0]);
    const std::size_t bytes = first < 0x80             ? 1
                              : (first & 0xE0) == 0xC0 ? 2
                              : (first & 0xF0) == 0xE0 ? 3
                              : (first & 0xF8) == 0xF0 ? 4
                                                       : 0;
    if (bytes == 0 || text.size() < bytes) return 0;
    std::uint32_t code = bytes == 1 ? first : first & (0x7Fu >> bytes);
    for (std::size_t k = 1; k < bytes; ++k) {
        if ((bits(text[k]) & 0xC0) != 0x80) return 0;
        code = code << 6 | (bits(text[k]) & 0x3F);
    }
    constexpr std::uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
    return code >= smallest[bytes] && is_readable(code) ? bytes : 0;
}

std::string byte_in_hexadecimal(char byte) {
    char text[8];
    std::snprintf(text, sizeof text, "\\x%02X", static_cast<unsigned>(bits(byte)));
    return text;
}

std::string readable(std::string_view text, bool of_several_lines) {
    std::string result;
    while (!text.empty()) {
        const bool is_end_of_line = of_several_lines && text[0] == '\n';
        const std::size_t bytes = is_end_of_line ? 1 : readable_character(text);
        if (bytes == 0) result += byte_in_hexadecimal(text[0]);
        result += text.substr(0, bytes);
        text.remove_prefix(bytes > 0 ? bytes : 1);
    }
    return result;
}

void print(const char* format, ...) {
    std::va_list values, again;
    va_start(values, format);
    va_copy(again, values);
    const int length = std::vsnprintf(nullptr, 0, format, values);
    va_end(values);
    std::vector<char> text(static_cast<std::size_t>(length < 0 ? 0 : length) + 1);
    std::vsnprintf(text.data(), text.size(), format, again);
    va_end(again);
    std::fputs(readable({text.data(), text.size() - 1}, true).c_str(), stdout);
}

void print_error(const std::string& message) {
    std::fprintf(stderr, "harmorph: %s\n", readable(message, true).c_str());
}

void warn(const std::string& message) { print_error("warning: " + message); }

void warn_of(const std::string& path, const std::vector<std::string>& sentences) {
    for (const std::string& sentence : sentences) warn(path + ": " + sentence);
}

}  // namespace cli
