#include "colour_map.hpp"

#include "svg.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cli {

namespace {

struct Colour {
    double red, green, blue;
};

// Of the map "viridis" (public domain, CC0), at equal distances; linear in between.
constexpr Colour anchors[] = {{68, 1, 84},    {72, 40, 120},  {62, 74, 137},  {49, 104, 142}, {38, 130, 142},
                              {31, 158, 137}, {53, 183, 121}, {109, 205, 89}, {180, 222, 44}, {253, 231, 37}};
constexpr int n_intervals = sizeof anchors / sizeof anchors[0] - 1;

std::string hexadecimal(const Colour& colour) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(std::lround(colour.red)) & 255u,
                  static_cast<unsigned>(std::lround(colour.green)) & 255u,
                  static_cast<unsigned>(std::lround(colour.blue)) & 255u);
    return text;
}

} // namespace

std::string colour(double value) {
    const double position = std::clamp(value, 0.0, 1.0) * n_intervals;
    const int interval = std::min(static_cast<int>(position), n_intervals - 1);
    const Colour& a = anchors[interval];
    const Colour& b = anchors[interval + 1];
    const double t = position - interval;
    return hexadecimal({a.red + t * (b.red - a.red), a.green + t * (b.green - a.green), a.blue + t * (b.blue - a.blue)});
}

std::string colour_gradient_stops() {
    std::string stops;
    for (int i = 0; i <= n_intervals; ++i) {
        const std::string offset = pixels(100.0 * i / n_intervals);
        stops += "<stop offset=\"" + offset + "%\" stop-color=\"" + hexadecimal(anchors[i]) + "\"/>\n";
    }
    return stops;
}

} // namespace cli
