#include <doctest/doctest.h>

#include "bspline/knots.hpp"

#include <fixtures/spline.hpp>

#include <algorithm>
#include <numeric>

using namespace harmorph;

namespace {

struct Sites {
    std::vector<double> u, mass, capped;
    std::vector<Index> corner, section_spans;

    Sites(int n, std::vector<Index> const& corners)
        : corner(corners), section_spans(corners.size() + 1) {
        for (int k = 0; k < n; ++k) u.push_back(k / (n - 1.0));
        mass.assign(std::size_t(n - 1), 1);
        capped = mass;
    }
    KnotSites view() {
        return {{u.data(), u.size()},
                {mass.data(), mass.size()},
                {capped.data(), capped.size()},
                {corner.data(), corner.size()},
                {section_spans.data(), section_spans.size()}};
    }
    std::vector<double> place(int degree, int n_indices, bool periodic) {
        std::vector<double> knots(std::size_t(n_indices + degree + 1));
        place_knots(view(), degree, n_indices, periodic, {knots.data(), knots.size()});
        return knots;
    }
};

bool is_well_formed(std::vector<double> const& knots, int degree) {
    std::vector<double> control(2 * knots.size());
    Curve curve;
    curve.degree = degree;
    curve.n_indices = curve.n_control = Index(knots.size()) - degree - 1;
    curve.knots = knots.data();
    curve.control = control.data();
    Fault fault;
    return check_curve(curve, 0, fault) == Status::ok;
}

}  // namespace

TEST_CASE("even mass gives even knots") {
    std::vector<double> const clamped = Sites(101, {}).place(3, 8, false);
    double const expected[] = {0, 0, 0, 0, 0.2, 0.4, 0.6, 0.8, 1, 1, 1, 1};
    for (std::size_t k = 0; k < 12; ++k)
        CHECK(clamped[k] == doctest::Approx(expected[k]).epsilon(1e-14));
    std::vector<double> const periodic = Sites(101, {}).place(2, 12, true);
    for (int k = 0; k < 15; ++k)
        CHECK(periodic[std::size_t(k)] == doctest::Approx((k - 2) / 10.0).epsilon(1e-14));
}

TEST_CASE("knots follow the mass, but each span keeps a point") {
    Sites sites(41, {});
    sites.mass[20] = 1e6;
    for (int const n_indices : {10, 20, 41}) {
        std::vector<double> const knots = sites.place(3, n_indices, false);
        CHECK(is_well_formed(knots, 3));
        for (std::size_t k = 3; k < std::size_t(n_indices); ++k)
            CHECK(std::any_of(sites.u.begin(), sites.u.end(), [&](double u) {
                return u > knots[k] - 1e-6 && u < knots[k + 1] + 1e-6;
            }));
    }
    Sites uneven(1001, {});
    for (std::size_t k = 0; k < 500; ++k) uneven.mass[k] = 3;
    std::vector<double> const knots = uneven.place(3, 43, false);  // 39 knots inside
    CHECK(std::count_if(knots.begin(), knots.end(), [](double u) { return u > 0 && u < 0.5001; }) ==
          30);
}

TEST_CASE("a corner has as many knots as the degree, and every section has a span") {
    for (int degree = 1; degree <= 5; ++degree) {
        Sites sites(61, {6, 30});
        for (std::size_t k = 0; k < 6; ++k) sites.mass[k] = 1e-3;
        std::vector<double> const knots = sites.place(degree, 3 * degree + 8, false);
        CHECK(is_well_formed(knots, degree));
        for (std::size_t const corner : {6u, 30u})
            CHECK(std::count(knots.begin(), knots.end(), sites.u[corner]) == degree);
        CHECK(sites.section_spans[0] == 1);
        CHECK(std::accumulate(sites.section_spans.begin(), sites.section_spans.end(), 0) == 10);
        CHECK(corners_possible(degree, 3 * degree + 1) == 2);
        CHECK(corners_possible(degree, 3 * degree) == 1);
    }
}

TEST_CASE("the mass by curvature is 1 + 8 sqrt(curvature)") {
    double const arc[] = {0, 1, 3}, curvature[] = {4, 4, 0};
    double mass[2];
    weigh_by_curvature({arc, 3}, {curvature, 3}, {mass, 2});
    CHECK(mass[0] == doctest::Approx(17));
    CHECK(mass[1] == doctest::Approx(2 * (1 + 8 * std::sqrt(2.0))));
}

TEST_CASE("mass moves to the span with the error, by the root of the error of order degree + 1") {
    Sites sites(41, {});
    std::vector<double> const knots = sites.place(3, 7, false);  // four spans, ten intervals each
    std::vector<double> control(14), error(41, 1e-4), work(7);
    error[15] = 16e-4;  // in the middle of the second span, far from the others
    Curve curve;
    curve.degree = 3;
    curve.n_indices = curve.n_control = 7;
    curve.knots = knots.data();
    curve.control = control.data();
    weigh_by_error(curve, {sites.u.data(), 41}, {error.data(), 41}, sites.view(), 1,
                   {work.data(), 7});
    CHECK(sites.mass[15] / sites.mass[5] == doctest::Approx(2).epsilon(1e-9));
    CHECK(sites.mass[25] == doctest::Approx(sites.mass[5]));
}
