#include "curves/section.hpp"

#include "basics/library.hpp"
#include "basics/numbers.hpp"

#include <harmorph_design.h>

#include <algorithm>
#include <ostream>

namespace cli {

namespace {

double area_inside(const Section& section) {
    double sum = 0;
    for (std::size_t k = 0; k < section.x.size(); ++k) {
        const std::size_t next = (k + 1) % section.x.size();
        sum += section.x[k] * section.y[next] - section.x[next] * section.y[k];
    }
    return sum / 2;
}

}  // namespace

Section sampled(const Curves& curves) {
    constexpr int points_per_span = 10;
    const CurvesView view(curves);
    const Curve& curve = curves.curves.front();
    const auto degree = static_cast<std::size_t>(curve.degree);
    Section section;
    const auto add = [&](double u) {
        double xy[2] = {0, 0};
        call("curve", hm_curve_point, view.get(), std::int32_t{0}, u, std::int32_t{0}, xy);
        section.x.push_back(xy[0]);
        section.y.push_back(xy[1]);
    };
    const std::size_t last = curve.knots.size() - 1 - degree;
    for (std::size_t k = degree; k < last; ++k) {
        const double begin = curve.knots[k], end = curve.knots[k + 1];
        for (int i = 0; end > begin && i < points_per_span; ++i)
            add(begin + (end - begin) * i / points_per_span);
    }
    if (curve.closed == HM_OPEN) add(curve.knots[last]);
    // If there is a second curve, it is the base, which closes the section.
    section.is_loop = curve.closed != HM_OPEN || curves.curves.size() > 1;
    return section;
}

void write_selig(std::ostream& out, const Curves& curves) {
    Section section = sampled(curves);
    std::size_t n = section.x.size();
    if (curves.curves.front().closed == HM_PERIODIC) {
        const auto first = std::max_element(section.x.begin(), section.x.end()) - section.x.begin();
        std::rotate(section.x.begin(), section.x.begin() + first, section.x.end());
        std::rotate(section.y.begin(), section.y.begin() + first, section.y.end());
    }
    if (curves.curves.front().closed != HM_OPEN) {  // closed sections repeat the first point
        section.x.push_back(section.x[0]);
        section.y.push_back(section.y[0]);
        ++n;
    }
    const bool clockwise = area_inside(section) < 0;
    out << "harmorph\n";
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t point = clockwise ? n - 1 - k : k;
        out << exact(section.x[point]) << ' ' << exact(section.y[point]) << '\n';
    }
}

}  // namespace cli
