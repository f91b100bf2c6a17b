#include "formats/number_style.hpp"

#include "basics/numbers.hpp"

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
    int digits = 0, decimals = 0;
    bool after_point = false, has_exponent = false;
    std::size_t at = !word.empty() && (word[0] == '-' || word[0] == '+') ? 1 : 0;
    const char first = at < word.size() ? word[at] : 'e';
    for (; at < word.size(); ++at) {
        const char c = word[at];
        if (c == 'e' || c == 'E' || c == 'd' || c == 'D') {
            has_exponent = true;
            exponent_ = c;
            break;
        }
        if (c == '.') {
            after_point = true;
        } else {
            decimals += after_point ? 1 : 0;
            digits += digits > 0 || c != '0' ? 1 : 0;  // zeros in front do not count
        }
    }
    ++words_;
    if (has_exponent) {
        ++with_exponent_;
        // Zero counts as written in both ways.
        leading_zero_ += digits == 0 || first == '0' || first == '.' ? 1 : 0;
    }
    min_decimals_ = std::min(min_decimals_, decimals);
    max_decimals_ = std::max(max_decimals_, decimals);
    max_digits_ = std::max(max_digits_, digits);
}

void NumberStyle::see(const NumberStyle& later) {
    if (later.with_exponent_ > 0) exponent_ = later.exponent_;
    words_ += later.words_;
    with_exponent_ += later.with_exponent_;
    leading_zero_ += later.leading_zero_;
    min_decimals_ = std::min(min_decimals_, later.min_decimals_);
    max_decimals_ = std::max(max_decimals_, later.max_decimals_);
    max_digits_ = std::max(max_digits_, later.max_digits_);
}

bool NumberStyle::fixed() const {
    return with_exponent_ == 0 && min_decimals_ == max_decimals_ && max_decimals_ >= evident_digits;
}

bool NumberStyle::needs_tolerance() const { return fixed() || digits() < exact_digits; }

bool NumberStyle::scientific() const {
    return with_exponent_ == words_ && max_digits_ >= evident_digits;
}

int NumberStyle::digits() const {
    if (fixed()) return max_decimals_;
    const bool evident = scientific() || max_digits_ > evident_digits + 2;
    return evident ? max_digits_ : exact_digits;
}

void NumberStyle::append(std::string& text, double value, double tolerance) const {
    // Half a unit of the last digit, 0.5 * 10^-decimals, must not be above the tolerance.
    const auto decimals = [&] {
        return static_cast<int>(
            std::ceil(-std::log10(2 * std::min(std::max(tolerance, 1e-300), 1e300))));
    };
    const auto magnitude = [&](int of_zero) {
        return value == 0 ? of_zero
                          : static_cast<int>(std::floor(std::log10(std::fabs(value)))) + 1;
    };
    if (fixed()) {
        const int wanted =
            std::min(decimals(), exact_digits - std::min(magnitude(0), exact_digits));
        return append_number(text, 'f', std::min(std::max(max_decimals_, wanted), 40), value);
    }
    int significant = digits();
    if (significant < exact_digits)
        significant = std::min(std::max(significant, magnitude(-400) + decimals()), exact_digits);
    significant = std::min(std::max(significant, 1), 40);
    const std::size_t begin = text.size();
    if (!scientific()) {
        append_number(text, 'g', significant, value);
    } else {
        append_number(text, 'e', significant - 1, value);
        if (leading_zero_ == with_exponent_) {
            const std::string number = with_leading_zero(text.substr(begin));
            text.resize(begin);
            text += number;
        }
    }
    if (exponent_ == 'e') return;
    const std::size_t e = text.find('e', begin);
    if (e != std::string::npos) text[e] = exponent_;
}

}  // namespace cli
