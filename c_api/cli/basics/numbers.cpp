#include "basics/numbers.hpp"

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

#if defined(__SIZEOF_INT128__)
constexpr int most_digits = 18, most_powers = 27;  // 10^18 < 2^63, 5^27 < 2^63

struct Powers {
    std::uint64_t of5[most_powers + 1] = {1}, of10[most_digits + 1] = {1};
    constexpr Powers() {
        for (int k = 1; k <= most_powers; ++k) of5[k] = 5 * of5[k - 1];
        for (int k = 1; k <= most_digits; ++k) of10[k] = 10 * of10[k - 1];
    }
};
constexpr Powers powers;

// A positive number, mantissa 2^exponent.
struct Binary {
    std::uint64_t mantissa;
    int exponent;

    // Rounds the number times 10^k to a whole number, of two equally near ones to the even one. The
    // product with 5^k is exact in 128 bits. Returns false if k or the result is out of range.
    bool scaled(int k, std::uint64_t& result) const {
        __extension__ using Wide = unsigned __int128;
        if (k < 0 || k > most_powers) return false;
        const Wide product = Wide{mantissa} * powers.of5[k];
        const int shift = -(exponent + k);
        if (shift < 1 || shift > 126) return false;
        const Wide whole = product >> shift, half = Wide{1} << (shift - 1);
        const Wide rest = product - (whole << shift);
        const bool up = rest > half || (rest == half && (whole & 1) != 0);
        if (whole >= powers.of10[most_digits]) return false;
        result = static_cast<std::uint64_t>(whole) + (up ? 1 : 0);
        return true;
    }
};

// Appends digits[0].digits[1] ... with `decimals` digits behind the point; there are enough digits.
void append_digits(std::string& text, const char* digits, std::size_t whole, std::size_t decimals) {
    text.append(digits, whole);
    if (decimals == 0) return;
    text += '.';
    text.append(digits + whole, decimals);
}

// Returns false for numbers out of the range of exact arithmetic.
bool append_quickly(std::string& text, char style, int precision, double value) {
    std::uint64_t bits, rounded = 0;
    std::memcpy(&bits, &value, sizeof bits);
    const std::uint64_t hidden_bit = std::uint64_t{1} << 52;
    const int exponent = static_cast<int>(bits >> 52 & 2047) - 1023;
    if (exponent < -1022 || exponent > 1023) return false;  // subnormal, or not finite
    const Binary number = {(bits & (hidden_bit - 1)) | hidden_bit, exponent - 52};
    char digits[48];
    if (style == 'f') {
        if (precision > most_digits || !number.scaled(precision, rounded)) return false;
        char* const end = std::to_chars(digits + 20, digits + sizeof digits, rounded).ptr;
        char* begin = digits + 20;
        while (end - begin <= precision) *--begin = '0';
        if (std::signbit(value)) text += '-';
        append_digits(text, begin, static_cast<std::size_t>(end - begin - precision),
                      static_cast<std::size_t>(precision));
        return true;
    }
    const int significant = style == 'e' ? precision + 1 : precision;
    if (significant < 1 || significant > most_digits) return false;
    // The decimal exponent, or one less than that: log10(2) is 1233 / 4096 rounded down.
    int power = exponent * 1233 >> 12;
    if (!number.scaled(significant - 1 - power, rounded)) return false;
    if (rounded >= powers.of10[significant] && !number.scaled(significant - 1 - ++power, rounded))
        return false;
    if (rounded < powers.of10[significant - 1] || rounded >= powers.of10[significant]) return false;
    std::to_chars(digits, digits + sizeof digits, rounded);
    if (std::signbit(value)) text += '-';
    int used = significant;
    const bool is_plain = style == 'g' && power >= -4 && power < significant;
    while (style == 'g' && used > 1 && digits[used - 1] == '0') --used;
    if (is_plain && power >= 0) {
        const int whole = power + 1;
        append_digits(text, digits, static_cast<std::size_t>(whole),
                      static_cast<std::size_t>(used > whole ? used - whole : 0));
    } else if (is_plain) {
        text.append("0.000", static_cast<std::size_t>(1 - power));
        text.append(digits, static_cast<std::size_t>(used));
    } else {
        append_digits(text, digits, 1, static_cast<std::size_t>(used - 1));
        const int size = power < 0 ? -power : power;  // below 100, as 10^27 is the largest factor
        const char tail[] = {'e', power < 0 ? '-' : '+', static_cast<char>('0' + size / 10),
                             static_cast<char>('0' + size % 10)};
        text.append(tail, sizeof tail);
    }
    return true;
}
#else
bool append_quickly(std::string&, char, int, double) { return false; }
#endif

}  // namespace

void append_number(std::string& text, char style, int precision, double value) {
    if (append_quickly(text, style, precision, value)) return;
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
#if defined(__cpp_lib_to_chars)  // several times as fast, but some C++17 libraries lack it for real
                                 // numbers
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
