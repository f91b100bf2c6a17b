#include <harmorph_design.h>
#include "curves/section.hpp"

#include "basics/library.hpp"
#include "basics/numbers.hpp"
#include "basics/text_file.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace cli {

namespace {

class SectionReader {
public:
    explicit SectionReader(const std::string& path) : file_(path), lines_(file_, '#') {}

    Section read() {
        if (!lines_.next()) lines_.expected("the name of an airfoil, or x and y of a point");
        double x = 0, y = 0;
        bool is_point = read_pair(x, y);
        if (!is_point && !lines_.next()) lines_.expected("x and y of a point");
        if (!is_point && !read_pair(x, y)) lines_.expected("x and y of a point");
        const bool has_counts =
            !is_point && std::floor(x) == x && std::floor(y) == y && x > 1.5 && y > 1.5;
        if (has_counts) {
            read_side(x, "upper");
            std::reverse(section_.x.begin(), section_.x.end());
            std::reverse(section_.y.begin(), section_.y.end());
            read_side(y, "lower");
            if (lines_.next()) lines_.expected("the end of the file");
        } else {
            do {
                if (!read_pair(x, y)) lines_.expected("x and y of a point");
                add(x, y);
            } while (lines_.next());
        }
        close();
        return section_;
    }

private:
    bool read_pair(double& x, double& y) {
        const auto& words = lines_.words();
        return words.size() == 2 && parse(words[0], x) && parse(words[1], y);
    }

    void add(double x, double y) {
        const bool repeats =
            !section_.x.empty() && section_.x.back() == x && section_.y.back() == y;
        if (repeats) return;  // some files repeat the leading edge
        section_.x.push_back(x);
        section_.y.push_back(y);
    }

    void read_side(double count, const char* side) {
        for (std::int32_t point = 1; point <= count; ++point) {
            double x = 0, y = 0;
            const bool found = lines_.next();
            if (!found || !read_pair(x, y)) {
                lines_.expected("x and y of point " + std::to_string(point) + " of " +
                                brief(count) + " of the " + side + " side");
            }
            add(x, y);
        }
    }

    void close() {
        const bool ends_meet = section_.x.size() > 1 && section_.x.front() == section_.x.back() &&
                               section_.y.front() == section_.y.back();
        if (ends_meet) {
            section_.x.pop_back();
            section_.y.pop_back();
        }
        if (section_.x.size() < 3)
            lines_.fail("the section has only " + plural(std::int64_t(section_.x.size()), "point") +
                        "; 3 are needed at least");
    }

    TextFile file_;
    LineReader lines_;
    Section section_;
};

double area_of(const Section& section) {
    double sum = 0;
    for (std::size_t k = 0; k < section.x.size(); ++k) {
        const std::size_t next = (k + 1) % section.x.size();
        sum += section.x[k] * section.y[next] - section.x[next] * section.y[k];
    }
    return sum / 2;
}

}  // namespace

Section read_section(const std::string& path) { return SectionReader(path).read(); }

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
    const bool clockwise = area_of(section) < 0;
    out << "harmorph\n";
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t point = clockwise ? n - 1 - k : k;
        out << exact(section.x[point]) << ' ' << exact(section.y[point]) << '\n';
    }
}

}  // namespace cli
