#include "basics/numbers.hpp"

#include "basics/decimals.hpp"

#include <algorithm>
#include <charconv>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace cli {

namespace {

std::string formatted(char style, int precision, double value) {
    std::string text;
    append_number(text, style, precision, value);
    return text;
}

}  // namespace

// The functions of C follow the locale of the process, which is the caller's where these files
// are a part of the Python package. Those of <charconv> never do; some libraries lack them for
// doubles, and then the decimal point of the locale is replaced.
void append_number(std::string& text, char style, int precision, double value) {
    char quickly[longest_decimal];
    if (const char* const end = print_decimal(quickly, style, precision, value)) {
        text.append(quickly, static_cast<std::size_t>(end - quickly));
        return;
    }
    char slowly[512];
#if defined(__cpp_lib_to_chars)
    const std::chars_format format = style == 'e'   ? std::chars_format::scientific
                                     : style == 'f' ? std::chars_format::fixed
                                                    : std::chars_format::general;
    const auto result = std::to_chars(slowly, slowly + sizeof slowly, value, format, precision);
    text.append(slowly, static_cast<std::size_t>(result.ptr - slowly));
#else
    const char format[] = {'%', '.', '*', style, '\0'};
    std::snprintf(slowly, sizeof slowly, format, precision, value);
    std::string found = slowly;
    const std::string point = std::localeconv()->decimal_point;
    const std::size_t at = found.find(point);
    if (at != std::string::npos) found.replace(at, point.size(), ".");
    text += found;
#endif
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

// Writes e for the D of Fortran and removes a plus sign, which std::from_chars does not know.
// Returns false if the word is too long for a number in such a notation.
static bool in_notation_of_c(std::string_view word, char (&text)[64], std::size_t& length) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    if (word.empty() || word.size() >= sizeof text) return false;
    length = word.size();
    for (std::size_t k = 0; k < length; ++k)
        text[k] = word[k] == 'd' || word[k] == 'D' ? 'e' : word[k];
    text[length] = '\0';
    return true;
}

#if defined(__cpp_lib_to_chars)

static bool parse_as(std::string_view word, double& value) {
    const char* const end = word.data() + word.size();
    const auto result = std::from_chars(word.data(), end, value);
    if (result.ptr != end) return false;
    if (result.ec == std::errc()) return std::isfinite(value);
    // A number out of range with a negative exponent is smaller than all doubles but 0.
    const std::size_t exponent = word.find_first_of("eE");
    const bool is_tiny = exponent != std::string_view::npos && exponent + 1 < word.size() &&
                         word[exponent + 1] == '-';
    if (is_tiny) value = word[0] == '-' ? -0.0 : 0.0;
    return is_tiny;
}

bool parse(std::string_view word, double& value) {
    char text[64];
    std::size_t length = 0;
    return parse_as(word, value) ||
           (in_notation_of_c(word, text, length) && parse_as({text, length}, value));
}

#else

bool parse(std::string_view word, double& value) {
    char text[64];
    std::size_t length = 0;
    if (!in_notation_of_c(word, text, length)) return false;
    std::string found(text, length);
    if (found.find_first_not_of("0123456789.+-eE") != std::string::npos) return false;
    const std::size_t at = found.find('.');
    if (at != std::string::npos) found.replace(at, 1, std::localeconv()->decimal_point);
    char* end = nullptr;
    value = std::strtod(found.c_str(), &end);
    return end == found.c_str() + found.size() && std::isfinite(value);
}

#endif

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
