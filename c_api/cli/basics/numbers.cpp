#include "basics/numbers.hpp"

#include <algorithm>
#include <charconv>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace cli {

#if defined(__SIZEOF_INT128__)

namespace {

__extension__ using Wide = unsigned __int128;

constexpr int max_digits = 18, max_powers = 27;  // 10^18 < 2^63, 5^27 < 2^63
constexpr std::uint64_t hidden_bit = std::uint64_t{1} << 52;

struct Powers {
    std::uint64_t of5[max_powers + 1] = {1}, of10[max_digits + 1] = {1};
    char pairs[200] = {};  // the digits of 0 to 99
    constexpr Powers() {
        for (int k = 1; k <= max_powers; ++k) of5[k] = 5 * of5[k - 1];
        for (int k = 1; k <= max_digits; ++k) of10[k] = 10 * of10[k - 1];
        for (int k = 0; k < 100; ++k) {
            pairs[2 * k] = static_cast<char>('0' + k / 10);
            pairs[2 * k + 1] = static_cast<char>('0' + k % 10);
        }
    }
};
constexpr Powers powers;

// A positive number, mantissa 2^exponent.
struct Binary {
    std::uint64_t mantissa;
    int exponent;

    // Computes the number times 10^k, which is product / 2^shift. Returns false if k or the result
    // is out of range. The product with 5^k is exact in 128 bits.
    bool scale(int k, Wide& product, int& shift) const {
        if (k < 0 || k > max_powers) return false;
        product = Wide{mantissa} * powers.of5[k];
        shift = -(exponent + k);
        return shift >= 1 && shift <= 126;
    }

    // Rounds the number times 10^k to the nearest whole number; of two equally near ones, to the
    // even one.
    bool scaled(int k, std::uint64_t& result) const {
        Wide product = 0;
        int shift = 0;
        if (!scale(k, product, shift)) return false;
        const Wide whole = product >> shift, half = Wide{1} << (shift - 1);
        const Wide rest = product - (whole << shift);
        const bool up = rest > half || (rest == half && (whole & 1) != 0);
        if (whole >= powers.of10[max_digits]) return false;
        result = static_cast<std::uint64_t>(whole) + (up ? 1 : 0);
        return true;
    }
};

// Splits a number without its sign into mantissa and exponent, and finds the power of its first
// decimal digit, or one less than that: log10(2) is 1233 / 4096 rounded down. Returns false for
// numbers that are subnormal or not finite.
bool split(double value, Binary& number, int& power) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    const int exponent = static_cast<int>(bits >> 52 & 2047) - 1023;
    if (exponent < -1022 || exponent > 1023) return false;
    number = {(bits & (hidden_bit - 1)) | hidden_bit, exponent - 52};
    power = exponent * 1233 >> 12;
    return true;
}

void put_pair(char* to, std::uint32_t pair) { std::memcpy(to, powers.pairs + 2 * pair, 2); }

// Prints a whole number as n digits, with leading zeros if the number has fewer.
void put_whole(char* to, std::uint64_t whole, int n) {
    for (; n >= 8; n -= 8) {
        const std::uint64_t above = whole / 100000000;
        const auto eight = static_cast<std::uint32_t>(whole - above * 100000000);
        const std::uint32_t high = eight / 10000, low = eight % 10000;
        put_pair(to + n - 8, high / 100);
        put_pair(to + n - 6, high % 100);
        put_pair(to + n - 4, low / 100);
        put_pair(to + n - 2, low % 100);
        whole = above;
    }
    auto rest = static_cast<std::uint32_t>(whole);
    for (; n >= 2; n -= 2, rest /= 100) put_pair(to + n - 2, rest % 100);
    if (n == 1) *to = static_cast<char>('0' + rest);
}

// Prints digits * 10^-behind, as n digits with a point among them or in front of them.
char* put_fixed(char* to, std::uint64_t digits, int n, int behind) {
    if (behind >= n) {
        std::memset(to, '0', static_cast<std::size_t>(behind - n) + 2);
        to[1] = '.';
        put_whole(to + 2 + behind - n, digits, n);
        return to + 2 + behind;
    }
    if (behind == 0) {
        put_whole(to, digits, n);
        return to + n;
    }
    put_whole(to + 1, digits, n);
    for (int k = 0; k < n - behind; ++k) to[k] = to[k + 1];
    to[n - behind] = '.';
    return to + n + 1;
}

// Prints a whole number of n digits as d.ddde+XX, where XX is the power of the first digit.
char* put_scientific(char* to, std::uint64_t digits, int n, int power) {
    to = put_fixed(to, digits, n, n - 1);
    *to++ = 'e';
    *to++ = power < 0 ? '-' : '+';
    put_pair(to, static_cast<std::uint32_t>(power < 0 ? -power : power));  // below 100
    return to + 2;
}

}  // namespace

// The number, and the two numbers half way to the next doubles, are multiplied by 10^k, so that 17
// digits precede the point. Of all whole numbers between the two, the one with most trailing zeros
// is taken, and of several such numbers the nearest.
char* print_shortest(char* to, double value) {
    Binary number = {};
    int power = 0, shift = 0;
    if (std::signbit(value)) *to++ = '-';
    if (value == 0) {
        *to++ = '0';
        return to;
    }
    // The double below a power of two is nearer than the one above.
    if (!split(value, number, power) || number.mantissa == hidden_bit) return nullptr;
    Wide product = 0;
    int k = 16 - power;
    if (!number.scale(k, product, shift)) return nullptr;
    if (product >> shift >= Wide{powers.of10[17]} && !number.scale(--k, product, shift))
        return nullptr;
    // As the product is below 2^116, and 2^53 2^shift at least, the point can be moved to bit 64.
    product <<= 64 - shift;
    const Wide half_unit = Wide{powers.of5[k]} << (63 - shift);
    const Wide lower = product - half_unit, upper = product + half_unit;
    auto digits = static_cast<std::uint64_t>(product >> 64);
    auto low = static_cast<std::uint64_t>(lower >> 64);
    auto high = static_cast<std::uint64_t>(upper >> 64);
    const auto fraction = static_cast<std::uint64_t>(product);
    const bool is_even = (number.mantissa & 1) == 0;  // then the neighbours are read as the number
    if (is_even && static_cast<std::uint64_t>(lower) == 0) --low;
    if (!is_even && static_cast<std::uint64_t>(upper) == 0) --high;
    std::uint64_t half = std::uint64_t{1} << 63, last = fraction;
    bool has_rest = false;
    int n = 17;
    for (; high / 10 > low / 10; --n) {
        has_rest = has_rest || last != 0;
        last = digits % 10;
        half = 5;
        digits /= 10, high /= 10, low /= 10;
    }
    if (last > half || (last == half && (has_rest || (digits & 1) != 0))) ++digits;
    const int behind = k - (17 - n);  // digits behind the point
    if (behind < 0) return nullptr;
    // All 17 digits of a number just below a power of 10 were dropped: the 1 is what they round to.
    if (n == 0) n = 1;
    if (behind > n + (n == 1 ? 2 : 3)) return put_scientific(to, digits, n, n - 1 - behind);
    return put_fixed(to, digits, n, behind);
}

char* print_decimal(char* to, char style, int precision, double value) {
    Binary number = {};
    int power = 0;
    std::uint64_t digits = 0;
    if (!split(value, number, power)) return nullptr;
    if (std::signbit(value)) *to++ = '-';
    if (style == 'f') {
        if (precision > max_digits || !number.scaled(precision, digits)) return nullptr;
        int n = precision + 1;
        while (n < max_digits && digits >= powers.of10[n]) ++n;
        return put_fixed(to, digits, n, precision);
    }
    int n = style == 'e' ? precision + 1 : precision;
    if (n < 1 || n > max_digits) return nullptr;
    if (!number.scaled(n - 1 - power, digits)) return nullptr;
    if (digits >= powers.of10[n] && !number.scaled(n - 1 - ++power, digits)) return nullptr;
    if (digits < powers.of10[n - 1] || digits >= powers.of10[n]) return nullptr;
    const bool is_plain = style == 'g' && power >= -4 && power < n;
    const int least = is_plain && power > 0 ? power + 1 : 1;  // digits
    for (; style == 'g' && n > least && digits % 10 == 0; --n) digits /= 10;
    return is_plain ? put_fixed(to, digits, n, n - 1 - power)
                    : put_scientific(to, digits, n, power);
}

#else
char* print_shortest(char*, double) { return nullptr; }
char* print_decimal(char*, char, int, double) { return nullptr; }
#endif

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

std::size_t parse_front(std::string_view text, std::int64_t& value, int base) {
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value, base);
    return result.ec == std::errc() ? static_cast<std::size_t>(result.ptr - text.data()) : 0;
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

std::size_t parse_front(std::string_view text, double& value) {
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = result.ec == std::errc() && std::isfinite(value);
    return is_number ? static_cast<std::size_t>(result.ptr - text.data()) : 0;
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

std::size_t parse_front(std::string_view text, double& value) {
    const std::size_t end = std::min(text.find_first_not_of("0123456789.+-eE"), text.size());
    return parse(text.substr(0, end), value) ? end : 0;
}

#endif

namespace {

template <class Number>
bool parse_numbers(std::string_view text, char separator, std::vector<Number>& values) {
    values.clear();
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        Number value = 0;
        if (!parse(text.substr(begin, end - begin), value)) return false;
        values.push_back(value);
        begin = end + 1;
    }
    return true;
}

}  // namespace

bool parse_list(std::string_view text, std::vector<double>& values, char separator) {
    return parse_numbers(text, separator, values);
}

bool parse_list(std::string_view text, std::vector<std::int32_t>& values) {
    return parse_numbers(text, ',', values);
}

std::string padded(std::int64_t number, std::size_t width, char fill) {
    const std::string digits = std::to_string(number);
    return std::string(width - std::min(width, digits.size()), fill) + digits;
}

std::string hexadecimal(std::uint32_t number, std::size_t digits) {
    std::string text(digits, '0');
    for (std::size_t k = digits; k-- > 0; number >>= 4) text[k] = "0123456789abcdef"[number & 15];
    return text;
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
