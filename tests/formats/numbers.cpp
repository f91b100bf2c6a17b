// Compares append_number() with printf in all styles and precisions, and the shortest digits with
// std::to_chars: bits at random, round numbers, ties, and neighbours of powers of ten.
#include "basics/text_out.hpp"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>

int main() {
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
