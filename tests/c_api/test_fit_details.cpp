#include <harmorph_design.h>
#include <doctest/doctest.h>

#include <fixtures/guarded.hpp>
#include <fixtures/memory.hpp>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace {

double const pi = std::acos(-1.0);

struct Line {
    std::vector<double> x, y;
    bool is_loop = false;

    std::int32_t n() const { return std::int32_t(x.size()); }
    void add(double at_x, double at_y) {
        x.push_back(at_x);
        y.push_back(at_y);
    }
};

// Half a circle with waves of twenty points.
Line wavy(double amplitude) {
    Line line;
    for (int k = 0; k <= 140; ++k) {
        double const angle = pi * k / 140, r = 1 + amplitude * std::sin(2 * pi * k / 20);
        line.add(r * std::cos(angle), r * std::sin(angle));
    }
    return line;
}

Line ellipse() {
    Line line;
    line.is_loop = true;
    for (int k = 0; k < 120; ++k) line.add(2 * std::cos(pi * k / 60), std::sin(pi * k / 60));
    return line;
}

struct Fitted {
    hm_status status;
    hm_error error{};
    hm_fit_report report{};
    std::vector<double> control, knots;
    int degree = 0;
};

hm_fit_details details() {
    hm_fit_details out{};
    out.struct_size = sizeof out;
    return out;
}

Fitted fitted(Line const& line, const hm_fit_details* wishes, int n_control = 20,
              std::int32_t closed = HM_CLOSED_AUTO, int degree = 3) {
    Fitted out;
    hm_fit_options options{};
    options.struct_size = sizeof options;
    options.n_control = n_control;
    options.degree = degree;
    options.closed = closed;
    options.details = wishes;
    out.report.struct_size = sizeof out.report;
    std::size_t bytes = 0;
    out.status = fixtures::fit_size(line.n(), &options, &bytes, &out.error);
    if (out.status < 0) return out;
    fixtures::Guarded block(bytes);
    hm_points const points{line.x.data(), line.y.data(), 1};
    const hm_curves* curves = nullptr;
    out.status = hm_fit(&curves, fixtures::Memory(block.data(), bytes), &points, line.n(),
                        line.is_loop, &options, &out.report, &out.error);
    CHECK(block.guards_intact());
    if (out.status < 0) return out;
    out.control.assign(curves->control, curves->control + 2 * curves->n_control);
    hm_curve const& curve = curves->curve[0];
    out.degree = curve.degree;
    out.knots.assign(curve.knots, curve.knots + curve.n_indices + curve.degree + 1);
    CHECK(hm_curves_check(curves, nullptr) == HM_OK);
    return out;
}

// The integral of |C''|^2 by the parameter of an open curve, by the trapezoidal rule.
double bending(Fitted const& fit) {
    hm_curve const curve = {sizeof(hm_curve), fit.degree, std::int32_t(fit.control.size() / 2),
                            nullptr, fit.knots.data()};
    hm_curves const set = {sizeof set, 0, curve.n_indices, fit.control.data(), nullptr, 1, &curve};
    double sum = 0;
    for (int k = 0; k <= 2000; ++k) {
        double c[6];
        REQUIRE(hm_curve_point(&set, 0, k / 2000.0, 2, c, nullptr) == HM_OK);
        sum += (c[4] * c[4] + c[5] * c[5]) / 2000;
    }
    return sum;
}

}  // namespace

TEST_CASE("details that ask for nothing, and equal weights, leave the fit as it is") {
    Line const line = wavy(0.01);
    Fitted const plain = fitted(line, nullptr);
    REQUIRE(plain.status == HM_OK);
    hm_fit_details none = details();
    Fitted const same = fitted(line, &none);
    CHECK(same.control == plain.control);
    CHECK(same.knots == plain.knots);
    std::vector<double> const four(line.x.size(), 4);
    none.weights = four.data();
    none.n_weights = line.n();
    Fitted const weighted = fitted(line, &none);
    REQUIRE(weighted.status == HM_OK);
    CHECK(weighted.control == plain.control);  // powers of two change no digit
}

TEST_CASE("a heavy point pulls the curve to it, and a point without weight does not count") {
    Line line;
    for (int k = 0; k <= 100; ++k) line.add(2 * std::cos(pi * k / 100), std::sin(pi * k / 100));
    std::vector<double> weight(line.x.size(), 1);
    hm_fit_details wishes = details();
    wishes.weights = weight.data();
    wishes.n_weights = line.n();
    Fitted const plain = fitted(line, &wishes, 5);
    REQUIRE(plain.status == HM_OK);
    auto const worst = std::size_t(plain.report.max_error_point);
    auto const distance = [&](Fitted const& fit) {
        hm_curve const curve = {sizeof(hm_curve), 3, 5, nullptr, fit.knots.data()};
        hm_curves const set = {sizeof set, 0, 5, fit.control.data(), nullptr, 1, &curve};
        double u = 0, found = 0;
        REQUIRE(hm_curve_project(&set, 0, line.x[worst], line.y[worst], &u, &found, nullptr) ==
                HM_OK);
        return found;
    };
    weight[worst] = 1e5;
    Fitted const heavy = fitted(line, &wishes, 5);
    REQUIRE(heavy.status == HM_OK);
    CHECK(distance(heavy) < 0.01 * distance(plain));
    weight[worst] = 0;
    Fitted const without = fitted(line, &wishes, 5);
    REQUIRE(without.status == HM_OK);
    CHECK(without.report.max_error_point != std::int32_t(worst));
}

TEST_CASE("the curve has the end tangents that are given, to rounding") {
    for (bool const loop : {false, true}) {
        Line line;
        line.is_loop = loop;
        // A half of a circle, or a drop with its corner at (1, 0).
        for (int k = 0; k < 100; ++k) {
            double const t = pi * k / 99, drop = 2 * pi * k / 100;
            if (loop) line.add(std::cos(drop), std::sin(drop) * std::sin(0.5 * drop));
            else line.add(std::cos(t), std::sin(t));
        }
        // Directions that are a little beside those of the points.
        double const bx = loop ? -1 : -0.02, by = loop ? 1.1 : 1, ex = loop ? 1 : 0.05,
                     ey = loop ? 1.1 : -2;
        hm_fit_details wishes = details();
        wishes.begin_x = bx;
        wishes.begin_y = by;
        wishes.end_x = ex;
        wishes.end_y = ey;
        std::int32_t const closed = loop ? HM_TIED : HM_OPEN;
        Fitted const fit = fitted(line, &wishes, 10, closed);
        INFO(std::string(fit.error.text));
        REQUIRE(fit.status == HM_OK);
        std::size_t const n = fit.control.size();
        auto const beside = [&](std::size_t from, std::size_t to, double x, double y) {
            double const dx = fit.control[to] - fit.control[from],
                         dy = fit.control[to + 1] - fit.control[from + 1];
            CHECK(dx * x + dy * y > 0);
            return std::fabs(dx * y - dy * x) / std::hypot(dx, dy);
        };
        std::size_t const last = loop ? 0 : n - 2, before = loop ? n - 2 : n - 4;
        CHECK(beside(0, 2, bx, by) < 1e-12);
        CHECK(beside(before, last, ex, ey) < 1e-12);
        CHECK(fit.report.max_error < 0.05);
        wishes.begin_y = -1;
        wishes.begin_x = 0;
        Fitted const against = fitted(line, &wishes, 10, closed);
        CHECK(against.status == HM_BAD_CURVE);
        CHECK(std::string(against.error.text).find("against the tangent") != std::string::npos);
    }
}

TEST_CASE("smoothing damps waves, and leads to the straight line between the ends") {
    Line const line = wavy(0.005);
    hm_fit_details wishes = details();
    double before = bending(fitted(line, nullptr, 60));
    for (double const length : {0.05, 0.2, 0.8}) {
        wishes.smoothing = length;
        Fitted const fit = fitted(line, &wishes, 60);
        REQUIRE(fit.status == HM_OK);
        double const now = bending(fit);
        CHECK(now < before);
        before = now;
    }
    wishes.smoothing = 1e4;
    Fitted const straight = fitted(line, &wishes, 20);
    REQUIRE(straight.status >= 0);
    for (std::size_t k = 1; k < straight.control.size(); k += 2)
        CHECK(std::fabs(straight.control[k]) < 1e-6);
}

TEST_CASE("control points are inserted until the tolerance is reached") {
    for (Line const& line : {wavy(0), ellipse()}) {
        double fewest = 0;
        for (double const tolerance : {1e-2, 1e-4, 1e-5}) {
            hm_fit_details wishes = details();
            wishes.tolerance = tolerance;
            Fitted const fit = fitted(line, &wishes, 60);
            REQUIRE(fit.status == HM_OK);
            CHECK(fit.report.max_error <= tolerance);
            auto const n = int(fit.control.size() / 2);
            CHECK(n > fewest);  // the least is 4
            CHECK(n < 60);
            fewest = n;
            // One step before, the tolerance is not reached.
            int before = 4;
            while (before + std::max(1, before / 8) < n) before += std::max(1, before / 8);
            Fitted const fewer = fitted(line, nullptr, before);
            CHECK((n == 4 || fewer.status != HM_OK || fewer.report.max_error > tolerance));
        }
    }
    hm_fit_details wishes = details();
    wishes.tolerance = 1e-9;
    Fitted const few = fitted(ellipse(), &wishes, 8);
    CHECK(few.status == HM_FAR_FROM_POINTS);
    CHECK(few.control.size() == 16);
    CHECK(few.error.value == few.report.max_error);
}

TEST_CASE("details that are wrong are refused") {
    Line const line = wavy(0);
    std::vector<double> weight(line.x.size(), 1), zero(line.x.size());
    struct Refused {
        std::function<void(hm_fit_details&)> spoil;
        const char* text;
        int degree;
        bool loop;
        hm_status status;
    };
    double const nan = std::nan("");
    std::vector<Refused> const table = {
        {[](auto& d) { d.struct_size = 1; }, "hm_fit_details", 3, false, HM_BAD_ARGUMENT},
        {[](auto& d) { d.smoothing = -1; }, "lengths of 0 or above", 3, false, HM_BAD_ARGUMENT},
        {[&](auto& d) { d.tolerance = nan; }, "lengths of 0 or above", 3, false, HM_BAD_ARGUMENT},
        {[](auto& d) { d.smoothing = 1; }, "degree 2 or above", 1, false, HM_BAD_ARGUMENT},
        {[&](auto& d) { d.begin_x = nan; }, "an end tangent", 3, false, HM_BAD_ARGUMENT},
        {[](auto& d) { d.n_weights = 3; }, "must be 0 if details.weights is NULL", 3, false,
         HM_BAD_ARGUMENT},
        {[&](auto& d) { d.weights = weight.data(), d.n_weights = 3; }, "n_weights is 3, but", 3,
         false, HM_BAD_ARGUMENT},
        {[&](auto& d) { d.weights = zero.data(), d.n_weights = 141; }, "all weights", 3, false,
         HM_BAD_ARGUMENT},
        {[](auto& d) { d.begin_y = 1; }, "degree of at least 2", 1, false, HM_BAD_CURVE},
        {[](auto& d) { d.begin_y = 1; }, "no ends", 3, true, HM_BAD_CURVE}};
    for (Refused const& one : table) {
        hm_fit_details wishes = details();
        one.spoil(wishes);
        Fitted const fit =
            fitted(one.loop ? ellipse() : line, &wishes, 20, HM_CLOSED_AUTO, one.degree);
        INFO(one.text << " <> " << std::string(fit.error.text));
        CHECK(fit.status == one.status);
        CHECK(std::string(fit.error.text).find(one.text) != std::string::npos);
    }
    weight[5] = nan;
    hm_fit_details wishes = details();
    wishes.weights = weight.data();
    wishes.n_weights = 141;
    Fitted const fit = fitted(line, &wishes);
    CHECK(fit.status == HM_BAD_ARGUMENT);
    CHECK(fit.error.item == 5);
}
