#include "curves/section_checks.hpp"

#include "basics/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cli {

namespace {

constexpr double much_longer = 10;          // than the segments beside a jump
constexpr double cosine_of_return = -.866;  // a stray point turns the outline by 150 degrees
constexpr double rounded_crossing = 2e-4;   // [chord] the width of a loop that rounding makes
constexpr double least_area = 1e-6;         // [chord^2]
constexpr double long_way = .25;            // [chord] a way back that counts for the leading edges
constexpr std::size_t least_points = 8;     // with fewer points no point is called stray

struct SectionStep {
    double x, y;
};
SectionStep from_to(const SectionPoint& a, const SectionPoint& b) { return {b.x - a.x, b.y - a.y}; }
double dot_of(SectionStep a, SectionStep b) { return a.x * b.x + a.y * b.y; }
double cross_of(SectionStep a, SectionStep b) { return a.x * b.y - a.y * b.x; }
double length_of_step(SectionStep a) { return std::sqrt(dot_of(a, a)); }
double step_length(const SectionPoint& a, const SectionPoint& b) {
    return length_of_step(from_to(a, b));
}

const SectionPoint& farthest_point(const SectionOutline& outline, const SectionPoint& from) {
    const SectionPoint* found = &outline[0];
    for (const SectionPoint& point : outline)
        if (step_length(point, from) > step_length(*found, from)) found = &point;
    return *found;
}

struct SectionLoop {
    const SectionOutline& points;
    std::size_t n = points.size();
    const SectionPoint& at(std::size_t k) const { return points[k % n]; }
    double step(std::size_t k) const { return step_length(at(k), at(k + 1)); }  // from k to k + 1
};

class SectionChecker {
public:
    SectionChecker(const TextFile& file, const SectionOutline& outline)
        : file_(file), loop_{outline}, extent_(extent_of(outline)) {}

    SectionFindings run() {
        const std::size_t stray = stray_point(loop_.points);
        if (stray < loop_.n) refuse_stray(stray);
        else check_steps();
        if (found_.refusal.empty()) check_crossings();
        if (found_.refusal.empty()) check_area();
        if (found_.refusal.empty()) count_leading_edges();
        return std::move(found_);
    }

private:
    std::string place(std::size_t k) const {
        const SectionPoint& point = loop_.at(k);
        const std::string line = file_.place(point.offset);
        return "(" + brief(point.x) + ", " + brief(point.y) + ") in line " +
               line.substr(line.rfind(':') + 1);
    }
    std::string segment(std::size_t k) const { return place(k) + " to " + place(k + 1); }

    void refuse(std::size_t at, const std::string& why) {
        found_.refusal = why;
        found_.at = at % loop_.n;
    }

    void refuse_stray(std::size_t k) {
        const bool at_end = k == 0 || k + 1 == loop_.n;
        refuse(k, "the outline jumps: " + place(k) + " is far from its neighbours " +
                      place(k + loop_.n - 1) + " and " + place(k + 1) +
                      (at_end ? "; remove the line if the point is no point of the outline"
                              : "; correct the point"));
    }

    void check_steps() {
        const SectionPoint& end = farthest_point(loop_.points, loop_.at(0));
        const SectionStep chord = from_to(end, farthest_point(loop_.points, end));
        for (std::size_t k = 0; k < loop_.n; ++k) {
            const double step = loop_.step(k);
            if (!(step > .5 * extent_)) continue;
            const bool jumps = step > much_longer * loop_.step(k + loop_.n - 1) &&
                               step > much_longer * loop_.step(k + 1);
            const bool is_base =
                k + 1 == loop_.n &&
                std::fabs(dot_of(from_to(loop_.at(k), loop_.at(0)), chord)) < .5 * step * extent_;
            if (jumps && !is_base) {
                return refuse(k + 1, "the outline jumps from " + segment(k) + ", by " +
                                         brief(step / extent_) +
                                         " chords; a side may be missing, or its points may be "
                                         "in another order");
            }
            found_.warnings.push_back("the outline has a straight segment of " +
                                      brief(step / extent_) + " chords from " + segment(k));
        }
    }

    bool cross_each_other(std::size_t i, std::size_t j) const {
        const SectionPoint &a = loop_.at(i), &b = loop_.at(i + 1), &c = loop_.at(j),
                           &d = loop_.at(j + 1);
        const SectionStep first = from_to(a, b), second = from_to(c, d);
        return cross_of(first, from_to(a, c)) * cross_of(first, from_to(a, d)) < 0 &&
               cross_of(second, from_to(c, a)) * cross_of(second, from_to(c, b)) < 0;
    }

    // The mean width of the narrower of the two loops that the crossing of segments i < j makes.
    double width_of_loop(std::size_t i, std::size_t j) const {
        const auto width = [&](std::size_t from, std::size_t to) {
            SectionOutline part;
            for (std::size_t k = from; k <= to; ++k) part.push_back(loop_.at(k));
            double around = 0;
            const SectionLoop own{part};
            for (std::size_t k = 0; k < own.n; ++k) around += own.step(k);
            return around > 0 ? 2 * std::fabs(area_of(part)) / around : 0;
        };
        return std::min(width(i + 1, j), width(j + 1, i + loop_.n));
    }

    // Segments in the order of their least x are compared with those that begin before their end.
    void check_crossings() {
        const auto low = [&](std::size_t k) { return std::min(loop_.at(k).x, loop_.at(k + 1).x); };
        const auto high = [&](std::size_t k) { return std::max(loop_.at(k).x, loop_.at(k + 1).x); };
        std::vector<std::size_t> order(loop_.n);
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return low(a) != low(b) ? low(a) < low(b) : a < b;
        });
        bool has_warned = false;
        for (std::size_t a = 0; a < loop_.n; ++a) {
            for (std::size_t b = a + 1; b < loop_.n && low(order[b]) <= high(order[a]); ++b) {
                const std::size_t i = std::min(order[a], order[b]),
                                  j = std::max(order[a], order[b]);
                if (!cross_each_other(i, j)) continue;
                const std::string where = segment(i) + ", and " + segment(j);
                if (width_of_loop(i, j) > rounded_crossing * extent_)
                    return refuse(i, "the outline crosses itself: from " + where);
                if (!has_warned)
                    found_.warnings.push_back("the outline crosses itself by rounding: from " +
                                              where);
                has_warned = true;
            }
        }
    }

    void check_area() {
        if (std::fabs(area_of(loop_.points)) > least_area * extent_ * extent_) return;
        refuse(0, "the outline encloses no area; it goes back on the way it came, from " +
                      place(0) + " to " + place(loop_.n / 2));
    }

    // Along the chord, the outline goes once to one end and once back.
    void count_leading_edges() {
        const SectionPoint& end = farthest_point(loop_.points, loop_.at(0));
        const SectionPoint& start = farthest_point(loop_.points, end);
        const SectionStep chord = from_to(end, start);
        const auto begin = static_cast<std::size_t>(&end - loop_.points.data());
        int turns = 0, direction = 1;
        double extreme = 0;
        for (std::size_t k = 0; k <= loop_.n; ++k) {
            const double at =
                dot_of(from_to(end, loop_.at(begin + k)), chord) / (extent_ * extent_);
            const double ahead = direction * (at - extreme);
            if (ahead < -long_way) {
                direction = -direction;
                ++turns;
                extreme = at;
            }
            if (ahead > 0) extreme = at;
        }
        if (turns < 2) return;
        found_.warnings.push_back("along its chord the outline goes " + std::to_string(turns + 1) +
                                  " times from end to end; a section goes to the leading edge and "
                                  "back, with one leading edge");
    }

    const TextFile& file_;
    SectionLoop loop_;
    double extent_;
    SectionFindings found_;
};

}  // namespace

double extent_of(const SectionOutline& outline) {
    const SectionPoint& end = farthest_point(outline, outline[0]);
    return step_length(end, farthest_point(outline, end));
}

double area_of(const SectionOutline& outline) {
    double sum = 0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const SectionStep a = from_to(outline[0], outline[k]),
                          b = from_to(outline[0], outline[(k + 1) % outline.size()]);
        sum += cross_of(a, b);
    }
    return sum / 2;
}

std::size_t stray_point(const SectionOutline& outline) {
    const SectionLoop loop{outline};
    if (loop.n < least_points) return loop.n;
    std::vector<double> steps;
    for (std::size_t k = 0; k < loop.n; ++k) steps.push_back(loop.step(k));
    std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(loop.n / 2),
                     steps.end());
    const double usual = steps[loop.n / 2];
    for (std::size_t k = 0; k < loop.n; ++k) {
        const double in = loop.step(k + loop.n - 1), out = loop.step(k);
        const double beside_in = loop.step(k + loop.n - 2), beside_out = loop.step(k + 1);
        if (in < much_longer * std::max(beside_in, usual) ||
            out < much_longer * std::max(beside_out, usual))
            continue;
        SectionOutline others = outline;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        const double extent = extent_of(others), least = std::min(in, out);
        const bool returns =
            dot_of(from_to(loop.at(k + loop.n - 1), loop.at(k)),
                   from_to(loop.at(k), loop.at(k + 1))) < cosine_of_return * in * out;
        if (least > .5 * extent || (least > .1 * extent && returns)) return k;
    }
    return loop.n;
}

SectionFindings check_section(const TextFile& file, const SectionOutline& outline) {
    return SectionChecker(file, outline).run();
}

}  // namespace cli
