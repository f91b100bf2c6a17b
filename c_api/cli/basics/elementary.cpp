#include "basics/elementary.hpp"

#include "basics/geometry.hpp"
#include "basics/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace cli {

namespace {

// A number as the sum of two, the second one below half a unit in the last place of the first.
struct TwoNumbers {
    double high, low;
};

// T. J. Dekker, Numer. Math. 18 (1971) 224.
TwoNumbers exact_square(double x) {
    const double shifted = 134217729 * x, head = shifted - (shifted - x), tail = x - head;
    const double square = x * x;
    return {square, ((head * head - square) + 2 * head * tail) + tail * tail};
}

// The series of the sine and the cosine of r, |r| <= pi/4 + 1e-9; the rounding of r is r.low.
SineCosine near_zero(TwoNumbers r) {
    const double x = r.high, z = x * x;
    double odd = 0, even = 0;  // sums beyond the first term of the sine, and two of the cosine
    for (int k = 18; k >= 4; k -= 2) {
        even = z / ((k + 1) * (k + 2)) * (1 - even);
        odd = z / (k * (k + 1)) * (1 - odd);
    }
    odd = z / 6 * (1 - odd);
    even = z * z / 24 * (1 - even);
    const double half = z / 2, first = 1 - half;
    return {x + (r.low * (1 - half) - x * odd),
            first + (((1 - first) - half) + (even - x * r.low))};
}

}  // namespace

SineCosine sine_cosine(double angle) {
    // The sum is pi / 2; multiples of the first two numbers by n have no rounding.
    constexpr double parts[] = {0x1.921fb544p+0, 0x1.0b4611a4p-34, 0x1.13198a2e03707p-65};
    const double n = std::nearbyint(angle * (2 / pi));
    const double first = angle - n * parts[0], second = first - n * parts[1],
                 high = second - n * parts[2];
    const double low = ((first - second) - n * parts[1]) + ((second - high) - n * parts[2]);
    const SineCosine r = near_zero({high, low});
    switch (static_cast<int>(n - 4 * std::floor(n / 4))) {
        case 0: return r;
        case 1: return {r.cosine, -r.sine};
        case 2: return {-r.sine, -r.cosine};
        default: return {-r.cosine, r.sine};
    }
}

double angle_of(double x, double y) {
    const double across = std::fabs(y), along = std::fabs(x);
    if (across == 0 && along == 0) return 0;
    // Two steps of Newton's method, whose error is a third of the third power of the error before.
    const double t = std::min(across, along) / std::max(across, along);
    double angle = t * (1 - t * t * (0.3 - 0.0867 * t * t));  // the arc tangent within 0.01
    if (across > along) angle = pi / 2 - angle;
    const double size = std::max(across, along), u = along / size, v = across / size;
    for (int step = 0; step < 2; ++step) {
        const auto [sine, cosine] = sine_cosine(angle);
        angle += (v * cosine - u * sine) / (u * cosine + v * sine);
    }
    if (std::signbit(x)) angle = pi - angle;
    return std::signbit(y) ? -angle : angle;
}

double length_of(double x, double y) {
    const double larger = std::max(std::fabs(x), std::fabs(y)),
                 smaller = std::min(std::fabs(x), std::fabs(y));
    if (!(larger > 0) || !(larger <= std::numeric_limits<double>::max())) return larger + smaller;
    // Squares neither overflow nor lose digits.
    const double scale = larger > 0x1p400 ? 0x1p600 : larger < 0x1p-400 ? 0x1p-600 : 1;
    const double a = larger / scale, b = smaller / scale, length = std::sqrt(a * a + b * b);
    const TwoNumbers all = exact_square(length), one = exact_square(a), other = exact_square(b);
    const double excess = ((all.high - one.high) - other.high) + ((all.low - one.low) - other.low);
    return (length - excess / (2 * length)) * scale;
}

int decimal_exponent(double value) {
    constexpr int least = -323, most = 308;
    static const std::vector<double> powers = [] {
        std::vector<double> all;
        for (int k = least; k <= most; ++k) {
            all.push_back(0);
            parse("1e" + std::to_string(k), all.back());
        }
        return all;
    }();
    const double size = std::fabs(value);
    constexpr double log10_2 = 0.30102999566398;
    int exponent = static_cast<int>(std::floor(std::ilogb(size) * log10_2));
    exponent = std::min(std::max(exponent, least), most);
    while (exponent < most && size >= powers[place(exponent + 1 - least)]) ++exponent;
    return exponent;
}

}  // namespace cli
