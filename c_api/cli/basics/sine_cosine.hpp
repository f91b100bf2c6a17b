// The sine and the cosine of an angle from operations that are rounded alike everywhere. The pages
// turn bodies by the same numbers: page/sine_cosine.js has the same operations.
#pragma once

namespace cli {

struct SineCosine {
    double sine, cosine;
};

// The series for the sum x = high + low with |x| <= pi/4 + 1e-9; low is below half a unit in the
// last place of high.
inline SineCosine sine_cosine_near_zero(double high, double low) {
    const double z = high * high, half = z / 2, first = 1 - half;
    double odd = 0, even = 0;  // the rest of the sine, and of the cosine behind two terms
    for (int k = 18; k >= 4; k -= 2) {
        even = z / ((k + 1) * (k + 2)) * (1 - even);
        odd = z / (k * (k + 1)) * (1 - odd);
    }
    odd = z / 6 * (1 - odd);
    even = z * z / 24 * (1 - even);
    return {high + (low * first - high * odd),
            first + (((1 - first) - half) + (even - high * low))};
}

// Takes an angle [radians] up to 1e5 in magnitude. The error is about half a unit in the last
// place.
inline SineCosine sine_cosine(double angle) {
    // The sum is pi / 2; multiples of the first two numbers by n are exact.
    constexpr double parts[] = {0x1.921fb544p+0, 0x1.0b4611a4p-34, 0x1.13198a2e03707p-65};
    constexpr double grid = 0x1.8p52;
    const double quarters = angle * 0.63661977236758138;
    const double n = (quarters + grid) - grid;
    const double first = angle - n * parts[0], second = first - n * parts[1],
                 high = second - n * parts[2];
    const double low = ((first - second) - n * parts[1]) + ((second - high) - n * parts[2]);
    const SineCosine r = sine_cosine_near_zero(high, low);
    const int quarter = static_cast<int>(n) & 3;
    const double s = quarter % 2 == 0 ? r.sine : r.cosine, c = quarter % 2 == 0 ? r.cosine : r.sine;
    return {quarter < 2 ? s : -s, quarter == 1 || quarter == 2 ? -c : c};
}

}  // namespace cli
