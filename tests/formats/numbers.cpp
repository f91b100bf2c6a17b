// Compares append_number() with printf: bits at random, round numbers, ties, and neighbours of
// powers of ten, in all styles and precisions.
#include "basics/numbers.hpp"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>

int main() {
    std::mt19937_64 random(1);
    const auto below = [&random](int n) {
        return static_cast<int>(random() % static_cast<unsigned>(n));
    };
    int different = 0;
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
        std::string found = "x";
        cli::append_number(found, style, precision, value);
        if (found.compare(1, found.npos, wanted) == 0) continue;
        if (++different <= 5) std::printf("%s instead of %s\n", found.c_str() + 1, wanted);
    }
    return different > 0;
}
