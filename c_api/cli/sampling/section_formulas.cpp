#include "sampling/section_formulas.hpp"

#include "basics/geometry.hpp"

#include <cmath>

namespace cli {

namespace {

constexpr int section_panels = 80;  // on each side of the section

// Calls take(x, side) for the points in order, with side 1 above and -1 below. A sharp trailing
// edge is one point.
template <class Take>
void walk(bool is_sharp, const Take& take) {
    const auto place = [](int k) {
        return k == section_panels ? 1 : .5 * (1 - std::cos(pi * k / section_panels));
    };
    for (int k = section_panels; k >= 0; --k) take(place(k), 1);
    for (int k = 1; k <= section_panels - (is_sharp ? 1 : 0); ++k) take(place(k), -1);
}

double bernstein(const std::vector<double>& weights, double x) {  // de Casteljau
    std::vector<double> row = weights;
    for (std::size_t n = row.size(); n > 1; --n)
        for (std::size_t k = 0; k + 1 < n; ++k) row[k] = (1 - x) * row[k] + x * row[k + 1];
    return row.front();
}

}  // namespace

Section naca_section(double camber, double camber_at, double thickness) {
    Section section;
    walk(true, [&](double x, int side) {
        const double p = camber_at, q = x < p ? p : 1 - p, start = x < p ? 0 : 1 - 2 * p;
        const double line = camber / (q * q) * (start + x * (2 * p - x));
        const double slope = 2 * camber / (q * q) * (p - x);
        const double height =
            x == 1
                ? 0
                : 5 * thickness *
                      (.2969 * std::sqrt(x) - x * (.126 + x * (.3516 - x * (.2843 - x * .1036))));
        const double across = side * height / std::sqrt(1 + slope * slope);
        section.x.push_back(x - across * slope);
        section.y.push_back(line + across);
    });
    return section;
}

Section cst_section(const std::vector<double>& upper, const std::vector<double>& lower,
                    double base) {
    Section section;
    walk(base == 0, [&](double x, int side) {
        const std::vector<double>& weights = side > 0 ? upper : lower;
        section.x.push_back(x);
        section.y.push_back(std::sqrt(x) * (1 - x) * bernstein(weights, x) + .5 * side * base * x);
    });
    return section;
}

}  // namespace cli
