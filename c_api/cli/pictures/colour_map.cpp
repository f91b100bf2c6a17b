#include "pictures/colour_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cli {

namespace {

struct Colour {
    double red, green, blue;
};

// The colours at equal distances from 0 on. Colours between two of them are interpolated.
constexpr Colour upwards[] = {{250, 252, 247}, {214, 239, 209}, {150, 213, 195}, {78, 175, 195},
                              {40, 125, 182},  {35, 74, 147},   {20, 28, 84}};
constexpr Colour downwards[] = {{250, 252, 247}, {254, 226, 190}, {252, 187, 120}, {238, 137, 58},
                                {204, 90, 20},   {150, 56, 8},    {92, 30, 4}};
constexpr int n_intervals = sizeof upwards / sizeof upwards[0] - 1;

std::string hexadecimal(const Colour& colour) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x",
                  static_cast<unsigned>(std::lround(colour.red)) & 255u,
                  static_cast<unsigned>(std::lround(colour.green)) & 255u,
                  static_cast<unsigned>(std::lround(colour.blue)) & 255u);
    return text;
}

}  // namespace

std::string colour(double value) {
    const Colour* const anchors = value < 0 ? downwards : upwards;
    const double position = std::min(std::fabs(value), 1.0) * n_intervals;
    const int interval = std::min(static_cast<int>(position), n_intervals - 1);
    const Colour& a = anchors[interval];
    const Colour& b = anchors[interval + 1];
    const double t = position - interval;
    return hexadecimal({a.red + t * (b.red - a.red), a.green + t * (b.green - a.green),
                        a.blue + t * (b.blue - a.blue)});
}

double colour_place(double value, double max) {
    return max > 0 ? std::copysign(std::pow(std::min(std::fabs(value) / max, 1.0), 2. / 3), value)
                   : 0;
}

}  // namespace cli
