#include "basics/numbers.hpp"

#include "basics/decimals.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace cli {

namespace {

std::string formatted(char style, int precision, double value) {
    std::string text;
    append_number(text, style, precision, value);
    return text;
}

}  // namespace

void append_number(std::string& text, char style, int precision, double value) {
    char quickly[longest_decimal];
    if (const char* const end = print_decimal(quickly, style, precision, value)) {
        text.append(quickly, static_cast<std::size_t>(end - quickly));
        return;
    }
    char slowly[512];
    const char format[] = {'%', '.', '*', style, '\0'};
    std::snprintf(slowly, sizeof slowly, format, precision, value);
    text += slowly;
}

bool parse(std::string_view word, std::int32_t& value) {
    const char* end = word.data() + word.size();
    const auto result = std::from_chars(word.data(), end, value);
    return result.ec == std::errc() && result.ptr == end;
}

bool parse(std::string_view word, std::int64_t& value) {
    const char* end = word.data() + word.size();
    const auto result = std::from_chars(word.data(), end, value);
    return result.ec == std::errc() && result.ptr == end;
}

// strtod needs a terminated string, and e for the D of Fortran.
static bool parse_slowly(std::string_view word, double& value) {
    char text[64];
    if (word.empty() || word.size() >= sizeof text) return false;
    std::memcpy(text, word.data(), word.size());
    text[word.size()] = '\0';
    for (char* c = text; *c; ++c) {
        if (*c == 'd' || *c == 'D') *c = 'e';
        if (*c == 'x' || *c == 'X') return false;
    }
    char* end = nullptr;
    value = std::strtod(text, &end);
    return end == text + word.size() && std::isfinite(value);
}

bool parse(std::string_view word, double& value) {
#if defined(__cpp_lib_to_chars)  // std::from_chars is faster; some libraries lack it for doubles
    const char* end = word.data() + word.size();
    const auto result = std::from_chars(word.data(), end, value);
    if (result.ec == std::errc() && result.ptr == end) return std::isfinite(value);
#endif
    return parse_slowly(word, value);
}

std::string exact(double value) { return formatted('g', 17, value); }
std::string scientific(double value) {
    std::string text = formatted('e', 16, value);
    std::replace(text.begin(), text.end(), 'e', 'E');
    return text;
}

std::string brief(double value) { return formatted('g', 4, value); }

std::string plural(std::int64_t count, std::string_view noun) {
    return (std::to_string(count) + " ").append(noun) + (count == 1 ? "" : "s");
}

}  // namespace cli
