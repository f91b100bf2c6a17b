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

}  // namespace

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
