#include <harmorph_design.h>
#include "curves/airfoil_loop.hpp"

#include "curves/curves.hpp"
#include "basics/library.hpp"

#include <algorithm>

namespace cli {

AirfoilLoop::AirfoilLoop(const hm_curves& curves, std::int32_t curve) {
    constexpr int per_span = 40;
    const hm_curve& spline = curves.curve[curve];
    const Curve copy = copied(curves).curves[static_cast<std::size_t>(curve)];
    is_periodic = copy.closed == HM_PERIODIC;
    is_blunt = copy.closed == HM_OPEN;
    begin_ = spline.knots[spline.degree];
    end_ = spline.knots[spline.n_indices];
    const auto add = [&](double parameter) {
        double xy[2];
        call(std::string("curve"), hm_curve_point, &curves, curve, parameter, 0, xy);
        u.push_back(parameter);
        at.push_back({xy[0], xy[1]});
    };
    for (std::int32_t span = spline.degree; span < spline.n_indices; ++span) {
        const double from = spline.knots[span], to = spline.knots[span + 1];
        for (int i = 0; i < per_span && from < to; ++i) add(from + (to - from) * i / per_span);
    }
    if (is_periodic) {  // the loop begins at the largest x
        const auto least = [](Point a, Point b) { return a.x < b.x; };
        const auto first = std::max_element(at.begin(), at.end(), least) - at.begin();
        std::rotate(at.begin(), at.begin() + first, at.end());
        std::rotate(u.begin(), u.begin() + first, u.end());
        for (std::size_t k = 1; k < u.size(); ++k) u[k] += u[k] < u[0] ? end_ - begin_ : 0;
        at.push_back(at[0]);
        u.push_back(u[0] + end_ - begin_);
    } else {
        add(end_);
    }
    measure();
}

void AirfoilLoop::measure() {
    trailing = {(at.front().x + at.back().x) / 2, (at.front().y + at.back().y) / 2};
    std::size_t farthest = 0;
    std::vector<double> arc(at.size());
    for (std::size_t k = 1; k < at.size(); ++k) {
        arc[k] = arc[k - 1] + distance(at[k - 1], at[k]);
        if (distance(at[k], trailing) > distance(at[farthest], trailing)) farthest = k;
    }
    leading = at[farthest];
    part.resize(at.size());
    for (std::size_t k = 0; k < at.size(); ++k) {
        part[k] = k <= farthest ? arc[k] / arc[farthest]
                                : 1 + (arc[k] - arc[farthest]) / (arc.back() - arc[farthest]);
    }
}

bool AirfoilLoop::runs_clockwise() const {
    double area = 0;
    for (std::size_t k = 1; k < at.size(); ++k)
        area += at[k - 1].x * at[k].y - at[k].x * at[k - 1].y;
    return area < 0;
}

void AirfoilLoop::reverse() {
    std::reverse(at.begin(), at.end());
    measure();
}

double AirfoilLoop::u_at(double wanted) const {
    const auto next = std::upper_bound(part.begin() + 1, part.end() - 1, wanted) - part.begin();
    const auto k = static_cast<std::size_t>(next);
    const double length = part[k] - part[k - 1],
                 t = length > 0 ? (wanted - part[k - 1]) / length : 0;
    return u[k - 1] + std::clamp(t, 0.0, 1.0) * (u[k] - u[k - 1]);
}

double AirfoilLoop::within(double parameter) const {
    return parameter > end_ ? parameter - (end_ - begin_) : parameter;
}

}  // namespace cli
