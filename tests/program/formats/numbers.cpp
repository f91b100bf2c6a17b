// usage: numbers [LOCALE]   Compares append_number() with printf in all styles and precisions, and
// the shortest digits with std::to_chars: bits at random, round numbers, ties, and neighbours of
// powers of ten. Compares the digits of numbers with all 617 decimal exponents with exact
// arithmetic, and reads them again; in this locale, if one is named.
#include "basics/numbers.hpp"
#include "basics/text_out.hpp"

#include <clocale>
#include <vector>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>

namespace {

// The decimal digits of a positive double, without rounding: mantissa 2^exponent is a whole number,
// or, with 2^-k = 5^k / 10^k, a whole number divided by 10^k.
struct ExactDecimal {
    std::string digits;  // the first one is not 0
    int power = 0;       // of the first digit

    explicit ExactDecimal(double value) {
        int exponent = 0;
        const double fraction = std::frexp(value, &exponent);
        auto mantissa = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
        exponent -= 53;
        std::vector<std::uint32_t> limbs;  // base 10^9, the lowest first
        for (; mantissa > 0; mantissa /= 1000000000)
            limbs.push_back(static_cast<std::uint32_t>(mantissa % 1000000000));
        for (int k = std::abs(exponent); k > 0; --k) {
            std::uint64_t carry = 0;
            for (std::uint32_t& limb : limbs) {
                carry += std::uint64_t{limb} * (exponent < 0 ? 5 : 2);
                limb = static_cast<std::uint32_t>(carry % 1000000000);
                carry /= 1000000000;
            }
            if (carry > 0) limbs.push_back(static_cast<std::uint32_t>(carry));
        }
        for (std::size_t k = limbs.size(); k-- > 0;) {
            const std::string text = std::to_string(limbs[k]);
            digits += digits.empty() ? text : std::string(9 - text.size(), '0') + text;
        }
        power = static_cast<int>(digits.size()) - 1 + (exponent < 0 ? exponent : 0);
    }

    // Rounds to n digits; of two equally near numbers, to the even one. d.ddde+XX.
    std::string rounded(std::size_t n) const {
        std::string kept =
            digits.substr(0, n) + std::string(n > digits.size() ? n - digits.size() : 0, '0');
        const std::string rest = n < digits.size() ? digits.substr(n) : "";
        const bool is_tie =
            !rest.empty() && rest.find_first_not_of('0', 1) == std::string::npos && rest[0] == '5';
        int up = !rest.empty() && (is_tie ? (kept.back() - '0') % 2 == 1 : rest[0] >= '5'),
            first = power;
        for (std::size_t k = n; up != 0 && k-- > 0;) {
            up = kept[k] == '9';
            kept[k] = kept[k] == '9' ? '0' : static_cast<char>(kept[k] + 1);
        }
        if (up != 0) kept = "1" + kept.substr(0, n - 1), ++first;
        std::string text = kept.substr(0, 1) + (n > 1 ? "." + kept.substr(1) : "");
        text += first < 0 ? "e-" : "e+";
        const int size = std::abs(first);
        return text + (size < 10 ? "0" : "") + std::to_string(size);
    }
};

// Returns how many numbers are printed or read wrongly, over all exponents of normal doubles.
int wrong_in_all_exponents() {
    std::mt19937_64 random(2);
    int wrong = 0, seen = 0;
    for (int exponent = -308; exponent <= 308; ++exponent, ++seen)
        for (int k = 0; k < 6; ++k) {
            double value = 0;
            const std::string word = "1." + std::to_string(random() % 10000000000000000) +
                                     (k % 3 == 0 ? "D" : "e") + std::to_string(exponent);
            if (!cli::parse(word, value) || !(value > 0)) ++wrong;
            for (const std::size_t n : {1, 5, 16, 17, 20}) {
                std::string found;
                cli::append_number(found, 'e', static_cast<int>(n) - 1, value);
                if (found != ExactDecimal(value).rounded(n)) {
                    if (++wrong <= 5)
                        std::printf("%s instead of %s\n", found.c_str(),
                                    ExactDecimal(value).rounded(n).c_str());
                }
                double again = 0;
                if (n >= 17 && (!cli::parse(found, again) || again != value)) ++wrong;
            }
        }
    double value = 1;
    for (const char* const word : {"0,5", "1,5e3", "1.5,", ",", "1,", "0,5D0"})
        if (cli::parse(word, value)) std::printf("%s is read\n", word), ++wrong;
    for (const char* const word : {"0.5D0", "+0.5", "5e-1", ".5", "+.5d0", "0.05E+1"})
        if (!cli::parse(word, value) || value != .5) std::printf("%s is not read\n", word), ++wrong;
    for (const char* const word :
         {"1e-400", "-1D-999", "1e400", "nan", "inf", "0x1p3", "+-1", "1e"}) {
        const bool is_tiny = word[1] == 'e' ? word[2] == '-' : word[2] == 'D';
        if (cli::parse(word, value) != is_tiny || (is_tiny && value != 0))
            std::printf("%s\n", word), ++wrong;
    }
    // The shortest digits of powers of ten, which are doubles just below or above the power.
    for (int exponent = -323; exponent <= 308; ++exponent)
        for (const char* const sign : {"", "-"}) {
            const std::string word = sign + std::string("1e") + std::to_string(exponent);
            std::string found;
            double again = 0;
            if (!cli::parse(word, value)) continue;
            cli::TextOut(found) << value;
            if (!cli::parse(found, again) || again != value) ++wrong;
        }
    return seen == 617 ? wrong : 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1) {
        if (std::setlocale(LC_ALL, argv[1]) == nullptr) return 2;
        if (std::localeconv()->decimal_point[0] != ',') return 3;
        return wrong_in_all_exponents() > 0;
    }
    if (wrong_in_all_exponents() > 0) return 1;
    std::mt19937_64 random(1);
    const auto below = [&random](int n) {
        return static_cast<int>(random() % static_cast<unsigned>(n));
    };
    int different = 0, short_ones = 0;
    const auto compare = [&different](const std::string& found, const std::string& wanted) {
        if (found == wanted) return;
        if (++different <= 5) std::printf("%s instead of %s\n", found.c_str(), wanted.c_str());
    };
    for (int i = 0; i < 600000; ++i) {
        double value = 0;
        const std::uint64_t bits = random();
        if (i % 5 == 0) std::memcpy(&value, &bits, sizeof value);
        if (i % 5 == 1) value = std::uniform_real_distribution<double>(-30, 30)(random);
        if (i % 5 == 2) value = std::ldexp(below(2001) - 1000, -below(40));
        if (i % 5 == 3) value = (below(2000001) - 1000000) / 1e4;
        if (i % 5 == 4) value = std::nextafter(std::pow(10.0, below(40) - 20), below(2) * 1e300);
        const char style = "efg"[below(3)], format[] = {'%', '.', '*', style, '\0'};
        const int precision = below(20);
        char wanted[512];
        std::snprintf(wanted, sizeof wanted, format, precision, value);
        std::string found;
        cli::append_number(found, style, precision, value);
        compare(found, wanted);

#if defined(__cpp_lib_to_chars)
        char shortest[64], quickly[cli::longest_decimal];
        *std::to_chars(shortest, shortest + sizeof shortest, value).ptr = '\0';
        found.clear();
        cli::TextOut(found) << value;
        compare(found, shortest);
        short_ones += cli::print_shortest(quickly, value) != nullptr ? 1 : 0;
#endif
    }
#if defined(__cpp_lib_to_chars) && defined(__SIZEOF_INT128__)
    if (short_ones < 400000) return 1;  // most numbers are in the range of exact arithmetic
#endif
    return different > 0;
}
