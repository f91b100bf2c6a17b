#include <doctest/doctest.h>

#include "bspline/curve_ends.hpp"

#include <fixtures/airfoil.hpp>
#include <fixtures/section_families.hpp>
#include <fixtures/spline.hpp>
#include <fixtures/guarded.hpp>

#include <algorithm>

using namespace harmorph;
using fixtures::naca;
using fixtures::pi;

namespace {

struct Chosen {
    Course course;
    std::vector<Index> corners;  // positions
    Index dropped = 0;           // corners of facets
};

Chosen choose(std::vector<Vec2> const& points, Closure wanted, bool is_loop = true,
              Index most = 100) {
    auto const n = Index(points.size());
    Outline outline;
    auto const block = fixtures::laid_out_part(outline, n);
    outline.points = {points.data(), points.size()};
    outline.is_loop = is_loop;
    outline.measure();
    Chosen out;
    out.corners.resize(points.size());
    Span<Index> const corners{out.corners.data(), out.corners.size()};
    Index const n_found = find_corners(outline, corners);
    Index const n_corners = drop_facets(outline, corners, n_found);
    out.dropped = n_found - n_corners;
    out.course = choose_course(outline, corners.first(n_corners), wanted);
    out.corners.resize(
        std::size_t(corners_on(out.course, outline, corners.first(n_corners), most)));
    return out;
}

// Checks that the choice is the same wherever the loop begins, whichever way it runs, and however
// it lies. Returns the choice, with the first point as in the given list.
Chosen choose_always(std::vector<Vec2> points) {
    auto const n = Index(points.size());
    Vec2 centre;
    for (Vec2 const p : points) centre = centre + (1.0 / n) * p;
    for (Vec2& p : points) p = p - centre;
    Chosen const plain = choose(points, Closure::automatic);
    for (int const places : {1, 7, n / 3, n / 2, n - 1})
        for (double const angle : {0.0, 0.7, 2.5, -1.6}) {
            std::vector<Vec2> turned = fixtures::placed(points, angle, 1, {5 * angle, -3 * angle});
            std::rotate(turned.begin(), turned.begin() + places, turned.end());
            for (bool const backwards : {false, true}) {
                if (backwards) std::reverse(turned.begin(), turned.end());
                Course const course = choose(turned, Closure::automatic).course;
                CHECK(course.closure == plain.course.closure);
                CHECK(course.base_points == plain.course.base_points);
                bool const same_place =
                    !backwards || plain.course.base_points == 0;  // a base is left at its other end
                bool const anywhere = course.closure == Closure::periodic;
                auto const first = backwards ? n - 1 - course.first : course.first;
                if (same_place && !anywhere) CHECK((first + places) % n == plain.course.first);
            }
        }
    return plain;
}

std::vector<Vec2> turned_by(std::vector<Vec2> points, int places) {
    std::rotate(points.begin(), points.begin() + places, points.end());
    return points;
}

}  // namespace

TEST_CASE("an outline is periodic without a corner, tied with one, and open with a blunt base") {
    Chosen const round = choose(fixtures::ellipse(60, 0.2), Closure::automatic);
    CHECK(round.course.closure == Closure::periodic);
    CHECK(round.course.n_positions == 61);
    CHECK(round.course.first % 30 == 0);  // at one of the tips
    for (int const places : {0, 7, 50}) {
        auto const sharp = choose(turned_by(naca({}, 30), places), Closure::automatic);
        CHECK(sharp.course.closure == Closure::tied);
        CHECK(sharp.course.first == (60 - places) % 60);
        CHECK(sharp.corners.empty());
        auto const blunt = choose(turned_by(naca({0, 0.4, 0.12, true}, 30), places),
                                  Closure::automatic);  // 64 points, 5 of them on the base
        CHECK(blunt.course.closure == Closure::open);
        CHECK(blunt.course.first == (68 - places) % 64);
        CHECK(blunt.course.base_points == 5);
        CHECK(blunt.course.n_positions == 61);
        CHECK(blunt.corners.empty());
    }
}

TEST_CASE("other corners lie on the course, and only the sharpest if there is no room for all") {
    std::vector<Vec2> const kite =
        fixtures::polygon({{0.6, 0}, {0, 0.1}, {-0.4, 0}, {0, -0.1}}, 10);
    Chosen const all = choose(turned_by(kite, 5), Closure::automatic);
    CHECK(all.course.closure == Closure::tied);
    CHECK(all.course.first == 35);
    CHECK(all.corners == std::vector<Index>{10, 20, 30});
    CHECK(choose(kite, Closure::automatic, true, 1).corners == std::vector<Index>{20});
    CHECK(choose(kite, Closure::automatic, true, 0).corners.empty());
}

TEST_CASE("the closure that the caller asks for is used") {
    std::vector<Vec2> const blunt = naca({0, 0.4, 0.12, true}, 30);
    Chosen const tied = choose(blunt, Closure::tied);
    CHECK(tied.course.closure == Closure::tied);
    CHECK(tied.course.first == 0);
    CHECK(tied.corners == std::vector<Index>{4});
    Chosen const smooth = choose(blunt, Closure::periodic);
    CHECK(smooth.course.closure == Closure::periodic);
    CHECK(smooth.corners.empty());
    Chosen const open = choose(blunt, Closure::open);
    CHECK(open.course.closure == Closure::open);
    CHECK(open.course.first == 0);
    CHECK(open.course.n_positions == 64);
    CHECK(open.corners == std::vector<Index>{4});
    Chosen const edge = choose(fixtures::rounded_edge(100, 2e-3, 8), Closure::tied);
    CHECK(edge.course.first ==
          204);  // the middle of the rounded edge: the edge has points 200 to 207, and 0
    CHECK(choose({{0, 0}, {1, 0}, {2, 1}}, Closure::automatic, false).course.closure ==
          Closure::open);
}

namespace {

// NACA 00xx, closed, with points in geometric progression from the trailing edge, and one straight
// facet across the leading edge that is `longer` times as long as the ones beside it.
std::vector<Vec2> with_leading_facet(double thickness, int n_side, double longer) {
    fixtures::Naca4 const shape{0, 0.4, thickness, false};
    std::vector<Vec2> points = {{1, 0}};
    double const half = 0.004;  // half the height of the section at the facet
    double x_leading = 0;
    while (fixtures::naca4_point(shape, x_leading, 1).y < half) x_leading += 1e-6;
    std::vector<double> x;
    double step = 2 * half / longer, at = x_leading;
    while (at < 1) {
        x.push_back(at);
        at += step;
        step *= 1 + 4.0 / n_side;
    }
    for (std::size_t k = x.size(); k-- > 0;) {
        auto const p = fixtures::naca4_point(shape, x[k], 1);
        points.push_back({p.x, p.y});
    }
    for (double const column : x) {
        auto const p = fixtures::naca4_point(shape, column, -1);
        points.push_back({p.x, p.y});
    }
    return points;
}

// A turbine blade: a circular arc as camber line that turns by `turning`, half circles of n_cap
// edges at both ends.
std::vector<Vec2> blade(double turning, double thickness, double tail, int n_side, int n_cap) {
    double const radius = 0.5 / std::sin(0.5 * turning);
    auto const on_line = [&](double s) {  // 0: leading edge, 1: trailing edge
        double const a = turning * (s - 0.5);
        return Vec2{radius * std::sin(a), radius * std::cos(a)};
    };
    auto const half_of = [&](double s) {
        return tail + (thickness - tail) * std::sin(pi * s) + 0.03 * (1 - s) * (1 - s);
    };
    auto const normal = [&](double s) {
        double const a = turning * (s - 0.5);
        return Vec2{std::sin(a), std::cos(a)};
    };
    auto const ahead = [&](double s) { return Vec2{normal(s).y, -normal(s).x}; };
    std::vector<Vec2> out;
    for (int k = 0; k <= n_side; ++k) {
        double const s = 1 - 1.0 * k / n_side;
        out.push_back(on_line(s) + half_of(s) * normal(s));
    }
    for (int k = 1; k < n_cap; ++k) {
        double const a = pi * k / n_cap;
        out.push_back(on_line(0) + half_of(0) * (std::cos(a) * normal(0) - std::sin(a) * ahead(0)));
    }
    for (int k = 0; k <= n_side; ++k) {
        double const s = 1.0 * k / n_side;
        out.push_back(on_line(s) - half_of(s) * normal(s));
    }
    for (int k = 1; k < n_cap; ++k) {
        double const a = pi * k / n_cap;
        out.push_back(on_line(1) +
                      half_of(1) * (-std::cos(a) * normal(1) + std::sin(a) * ahead(1)));
    }
    return out;
}

// A NACA 4-digit section cut off straight, `height` thick at its end, the cut turned by `slant`.
std::vector<Vec2> cut_off(double height, double slant, int n_side, int n_base) {
    std::vector<Vec2> out = naca({0.02, 0.4, 0.12, false}, n_side);
    out.erase(out.begin());
    for (Vec2& p : out) {
        bool const above = &p < &out[out.size() / 2];
        p.y += 0.5 * height * p.x * (above ? 1 : -1);
        if (above) p.x *= 1 - slant * height;
    }
    Vec2 const low{1, -0.5 * height}, high{1 - slant * height, 0.5 * height};
    std::vector<Vec2> base;
    for (int k = 0; k <= n_base; ++k) base.push_back(low + (double(k) / n_base) * (high - low));
    out.insert(out.begin(), base.begin(), base.end());
    return out;
}

}  // namespace

TEST_CASE("a facet across a leading edge is no base and no corner, however coarse") {
    Index dropped = 0;
    for (double const thickness : {0.06, 0.12, 0.2})
        for (int const n_side : {10, 40, 200})
            for (double const longer : {1.0, 2.0, 5.0, 20.0}) {
                INFO("thickness = " << thickness << ", n_side = " << n_side
                                    << ", longer = " << longer);
                Chosen const chosen = choose_always(with_leading_facet(thickness, n_side, longer));
                CHECK(chosen.course.closure == Closure::tied);
                CHECK(chosen.course.first == 0);
                CHECK(chosen.corners.empty());
                dropped += chosen.dropped;
            }
    CHECK(dropped > 0);  // some of these do look like corners
}

TEST_CASE("a turbine blade with round ends has no base") {
    for (double const turning : {0.3, 1.0, 2.0})
        for (double const tail : {0.004, 0.01, 0.02})
            for (int const n_cap : {4, 5, 8, 20})
                for (int const n_side : {20, 60}) {
                    INFO("turning = " << turning << ", tail = " << tail << ", n_cap = " << n_cap
                                      << ", n_side = " << n_side);
                    CHECK(choose_always(blade(turning, 0.08, tail, n_side, n_cap))
                              .course.base_points == 0);
                }
}

TEST_CASE("blunt bases of any thickness and slant are found at the end opposite the leading edge") {
    for (double const height : {2e-4, 1e-3, 1e-2, 0.05, 0.1})
        for (double const slant : {0.0, 0.5, -0.3})
            for (int const n_base : {1, 2, 6})
                for (int const n_side : {30, 100}) {
                    INFO("height = " << height << ", slant = " << slant << ", n_base = " << n_base
                                     << ", n_side = " << n_side);
                    Chosen const chosen = choose_always(cut_off(height, slant, n_side, n_base));
                    CHECK(chosen.course.closure == Closure::open);
                    CHECK(chosen.course.base_points == n_base + 1);
                    CHECK(chosen.course.first == n_base);
                    CHECK(chosen.corners.empty());
                }
}

TEST_CASE("ends of a plate, a step on a side and chamfers are no base") {
    std::vector<Vec2> const plate =
        fixtures::polygon({{0.5, 0.02}, {-0.5, 0.025}, {-0.48, -0.02}, {0.5, -0.02}}, 8);
    Chosen const chosen = choose_always(plate);
    CHECK(chosen.course.closure == Closure::tied);
    CHECK(chosen.corners.size() == 3);
    // This section has a step down at half chord, as in a cove, and a sharp trailing edge.
    Chosen const step =
        choose_always(fixtures::polygon({{1, 0}, {0.5, 0.02}, {0.5, 0.06}, {0, 0}}, 10));
    CHECK(step.course.base_points == 0);
    CHECK(step.corners.size() >= 2);
}

// An airfoil with a horn of ice on its upper side: straight, two points across its tip.
static std::vector<Vec2> with_horn(double degrees, double reach, int base) {
    fixtures::Naca4 naca;
    naca.blunt = base > 1;
    fixtures::Outline const clean = fixtures::naca4(naca, 80, 0.8, base);
    std::vector<Vec2> out;
    double const angle = degrees * pi / 180, half_width = 0.003;
    Vec2 const along{std::cos(angle), std::sin(angle)}, across{along.y, -along.x};
    bool done = false;
    for (fixtures::Point const p : clean.points) {
        bool const is_root = p.y > 0 && p.x > 0.005 && p.x < 0.03;
        if (!is_root) out.push_back({p.x, p.y});
        if (!is_root || done) continue;
        done = true;
        Vec2 const tip = Vec2{0.015, 0.02} + reach * along, left = tip + half_width * across;
        Vec2 const right = tip - half_width * across, begin = out.back(), end{0.004, 0.0105};
        for (int k = 1; k <= 12; ++k) out.push_back(begin + (k / 12.0) * (left - begin));
        for (int k = 0; k <= 11; ++k) out.push_back(right + (k / 12.0) * (end - right));
    }
    return out;
}

TEST_CASE("the tip of a horn of ice is no base, and the curve begins at the trailing edge") {
    for (double const degrees : {110.0, 130.0, 150.0, 170.0})
        for (double const reach : {0.04, 0.08}) {
            INFO(degrees << " degrees, " << reach);
            Chosen const sharp = choose_always(with_horn(degrees, reach, 1));
            CHECK(sharp.course.closure == Closure::tied);
            CHECK(sharp.course.first == 0);
            Chosen const blunt = choose_always(with_horn(degrees, reach, 4));
            CHECK(blunt.course.closure == Closure::open);
            CHECK(blunt.course.base_points == 5);
        }
}

// A NACA 4-digit section with one point at the trailing edge, at the end of one side. Where the
// thickness there is not zero, the last panel of the other side closes the base. Panels at the
// trailing edge have the length `last`.
static std::vector<Vec2> with_one_point_at_the_edge(fixtures::Naca4 const& naca, bool above,
                                                    double last, int n_side) {
    std::vector<Vec2> out;
    fixtures::Point const edge = fixtures::naca4_point(naca, 1, above ? -1 : 1);
    out.push_back({edge.x, edge.y});
    for (int k = 0; k < 2 * n_side + 1; ++k) {
        double const x = (1 - last) * 0.5 * (1 + std::cos(pi * k / n_side));
        fixtures::Point const p = fixtures::naca4_point(naca, x, k <= n_side ? 1 : -1);
        out.push_back({p.x, p.y});
    }
    return out;
}

TEST_CASE("a trailing edge of one point is no base, though the last panel turns by 24 degrees") {
    double largest = 0;
    int blunt_sections = 0;
    for (bool const blunt : {false, true})
        for (double const thickness : {0.06, 0.12, 0.18, 0.24})
            for (double const camber : {0.0, 0.02, 0.06})
                for (double const last : {0.005, 0.01, 0.0212, 0.05, 0.1})
                    for (int const n_side : {12, 25, 60})
                        for (bool const above : {true, false}) {
                            auto const section = with_one_point_at_the_edge(
                                {camber, 0.4, thickness, blunt}, above, last, n_side);
                            std::size_t const n = section.size();
                            Vec2 const panel = section[0] - section[above ? 1 : n - 1];
                            Vec2 const before =
                                section[above ? 1 : n - 1] - section[above ? 2 : n - 2];
                            double const turn = std::asin(std::abs(cross(before, panel)) /
                                                          (length(before) * length(panel)));
                            if (turn > 0.42) continue;  // like a slanted base
                            INFO("blunt = " << blunt << ", thickness = " << thickness
                                            << ", camber = " << camber << ", last = " << last
                                            << ", n_side = " << n_side << ", above = " << above);
                            Chosen const chosen = choose_always(section);
                            CHECK(chosen.course.closure == Closure::tied);
                            CHECK(chosen.course.first == 0);
                            CHECK(chosen.corners.size() <= 1);  // at the other end of the panel
                            largest = std::fmax(largest, turn);
                            blunt_sections += blunt;
                        }
    CHECK(largest > 0.35);
    CHECK(blunt_sections > 200);
}

namespace {

std::vector<Vec2> loop_of(fixtures::SectionSides const& sides) {
    std::vector<Vec2> out;
    for (fixtures::Point const p : sides.loop()) out.push_back({p.x, p.y});
    return out;
}

// The angle between the last panels of both sides, in degrees.
double wedge_of(fixtures::SectionSides const& sides) {
    auto const last = [](std::vector<fixtures::Point> const& side) {
        fixtures::Point const a = side[side.size() - 2], b = side.back();
        return std::atan2(b.y - a.y, b.x - a.x);
    };
    return std::fabs(last(sides.upper) - last(sides.lower)) * 180 / pi;
}

Course course_of(fixtures::SectionSides const& sides) {
    std::vector<Vec2> points = loop_of(sides);
    Vec2 centre;
    for (Vec2 const p : points) centre = centre + (1.0 / double(points.size())) * p;
    for (Vec2& p : points) p = p - centre;
    return choose(points, Closure::automatic).course;
}

}  // namespace

TEST_CASE("the facet across the nose of a cusped or sharp section of few points is no base") {
    for (double const thick : {0.04, 0.08, 0.12, 0.16})
        for (double const camber : {0.0, 0.06, 0.12})
            for (double const wedge : {0.0, 0.2})
                for (int const n : {5, 6, 8, 10, 16})
                    for (bool const even : {false, true}) {
                        CAPTURE(thick);
                        CAPTURE(camber);
                        CAPTURE(wedge);
                        CAPTURE(n);
                        auto const sides =
                            fixtures::circle_section(thick, camber, wedge, n, 0.8, even);
                        Course const course = course_of(sides);
                        CHECK(course.base_points == 0);
                        CHECK(course.closure == Closure::tied);
                        CHECK(course.first == 0);
                    }
}

TEST_CASE("sharp and blunt trailing edges of nine families of sections, rounded as files are") {
    for (int family = 0; family < int(fixtures::Family::count); ++family)
        for (int const n : {12, 30, 120})
            for (double const clustering : {0.0, 0.8, 1.0})
                for (unsigned seed = 0; seed < 12; ++seed) {
                    auto const kind = static_cast<fixtures::Family>(family);
                    CAPTURE(fixtures::family_name(kind));
                    CAPTURE(n);
                    CAPTURE(clustering);
                    CAPTURE(seed);
                    fixtures::SectionRandom random(seed);
                    auto const sides = fixtures::rounded(
                        fixtures::random_section(kind, random, n, clustering), 5 + seed % 4);
                    if (sides.is_blunt() && wedge_of(sides) > 44) continue;  // tied at one end
                    Course const course = course_of(sides);
                    CHECK(course.closure == (sides.is_blunt() ? Closure::open : Closure::tied));
                    CHECK(course.base_points == (sides.is_blunt() ? 2 : 0));
                    if (!sides.is_blunt()) CHECK(course.first == 0);
                }
}
