// The ring of quads that make_mesh writes: its coordinates, and numbers as text and bytes.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace ring {

constexpr int around = 24, outwards = 6;  // cells
inline std::vector<double> x, y;          // point (i, j) is number j * around + i

inline int point(int i, int j) { return j * around + i % around; }

inline void make_coordinates() {
    const double pi = std::acos(-1.0);
    for (int j = 0; j <= outwards; ++j) {
        for (int i = 0; i < around; ++i) {
            const double r = std::pow(4.0, double(j) / outwards),
                         angle = 2 * pi * (i + .25) / around;
            x.push_back(r * std::cos(angle));
            y.push_back(r * std::sin(angle));
        }
    }
}

inline void read_coordinates(const char* path) {
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line) && line.compare(0, 6, "NPOIN=") != 0) {}
    for (int k = 0; k < around * (outwards + 1) && std::getline(file, line); ++k) {
        std::istringstream words(line);
        double a = 0, b = 0;
        words >> a >> b;
        x.push_back(a);
        y.push_back(b);
    }
    if (x.size() != std::size_t(around * (outwards + 1))) std::exit(2);
    if (std::string(path).find("two-") == std::string::npos) return;
    // Points of a mesh of two blocks: those of the first, then those that the second has besides.
    const std::vector<double> from_x = x, from_y = y;
    const int half = around / 2;
    for (int j = 0; j <= outwards; ++j) {
        for (int i = 0; i < around; ++i) {
            const int second = (outwards + 1) * (half + 1) + j * (half - 1) + i - half - 1;
            const int from = i <= half ? j * (half + 1) + i : second;
            x[std::size_t(point(i, j))] = from_x[std::size_t(from)];
            y[std::size_t(point(i, j))] = from_y[std::size_t(from)];
        }
    }
}

// The number in a format of printf, or in Fortran's D17.9 where the format is "Fortran".
inline std::string print(const char* format, double value) {
    if (std::string(format) == "Fortran") {  // D17.9: 0.123456789D+01
        int exponent = 0;
        double mantissa = value;
        for (; std::fabs(mantissa) >= 1; ++exponent) mantissa /= 10;
        for (; mantissa != 0 && std::fabs(mantissa) < .1; --exponent) mantissa *= 10;
        char text[64];
        std::snprintf(text, sizeof text, "%.9fD%+03d", mantissa, exponent);
        return text;
    }
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

struct Bytes {
    bool swapped = false;
    std::string text = {};
    template <class Number>
    void put(Number value) {
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        for (std::size_t i = 0; i < sizeof value; ++i)
            text += bytes[swapped ? sizeof value - 1 - i : i];
    }
};

// The kinds of files: the text of each under the name of the file.
using Kinds = std::map<std::string, std::function<std::string()>>;

}  // namespace ring
