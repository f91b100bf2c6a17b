#include "formats/number_style.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace cli {

namespace {

constexpr int exact_digits = 17;   // identify any double
constexpr int evident_digits = 6;  // numbers with fewer digits may be round numbers

// C prints 1.23e+02; many Fortran programs print 0.123E+03.
std::string with_leading_zero(const std::string& text) {
    const std::size_t e = text.find('e'), first = text[0] == '-' ? 1 : 0;
    std::string digits =
        text.substr(first, 1) + (first + 2 < e ? text.substr(first + 2, e - first - 2) : "");
    const bool zero = digits.find_first_not_of('0') == std::string::npos;
    char exponent[16];
    std::snprintf(exponent, sizeof exponent, "e%+03d",
                  zero ? 0 : std::atoi(text.c_str() + e + 1) + 1);
    return text.substr(0, first) + "0." + digits + exponent;
}

}  // namespace

void NumberStyle::see(std::string_view word) {
    const std::size_t e = std::min(word.find_first_of("eEdD"), word.size());
    std::string_view mantissa = word.substr(0, e);
    if (!mantissa.empty() && (mantissa[0] == '-' || mantissa[0] == '+')) mantissa.remove_prefix(1);
    int digits = 0, decimals = 0;
    bool after_point = false;
    for (const char c : mantissa) {
        if (c == '.') {
            after_point = true;
        } else {
            decimals += after_point ? 1 : 0;
            digits += digits > 0 || c != '0' ? 1 : 0;  // zeros in front do not count
        }
    }
    ++words_;
    if (e < word.size()) {
        ++with_exponent_;
        exponent_ = word[e];
        // Zero counts as written in both ways.
        leading_zero_ +=
            digits == 0 || mantissa.substr(0, 1) == "0" || mantissa.substr(0, 1) == "." ? 1 : 0;
    }
    least_decimals_ = std::min(least_decimals_, decimals);
    most_decimals_ = std::max(most_decimals_, decimals);
    most_digits_ = std::max(most_digits_, digits);
}

bool NumberStyle::fixed() const {
    return with_exponent_ == 0 && least_decimals_ == most_decimals_ &&
           most_decimals_ >= evident_digits;
}

bool NumberStyle::scientific() const {
    return with_exponent_ == words_ && most_digits_ >= evident_digits;
}

int NumberStyle::digits() const {
    if (fixed()) return most_decimals_;
    const bool evident = scientific() || most_digits_ > evident_digits + 2;
    return evident ? most_digits_ : exact_digits;
}

std::string NumberStyle::print(double value, double tolerance) const {
    // Half a unit of the last digit, 0.5 * 10^-decimals, must not be above the tolerance.
    const double bounded = std::min(std::max(tolerance, 1e-300), 1e300);
    const int decimals = static_cast<int>(std::ceil(-std::log10(2 * bounded)));
    char text[512];
    if (fixed()) {
        const int magnitude =
            value == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::fabs(value)))) + 1;
        const int wanted = std::min(decimals, exact_digits - std::min(magnitude, exact_digits));
        std::snprintf(text, sizeof text, "%.*f", std::min(std::max(most_decimals_, wanted), 40),
                      value);
        return text;
    }
    const int magnitude =
        value == 0 ? -400 : static_cast<int>(std::floor(std::log10(std::fabs(value)))) + 1;
    const int wanted =
        std::min(std::max(digits(), magnitude + decimals), std::max(digits(), exact_digits));
    const int significant = std::min(std::max(wanted, 1), 40);
    if (!scientific()) {
        std::snprintf(text, sizeof text, "%.*g", significant, value);
    } else {
        std::snprintf(text, sizeof text, "%.*e", significant - 1, value);
    }
    std::string result =
        scientific() && leading_zero_ == with_exponent_ ? with_leading_zero(text) : text;
    const std::size_t e = result.find('e');
    if (e != std::string::npos) result[e] = exponent_;
    return result;
}

}  // namespace cli
