// Smooth bounds of the quality and of corner areas: below the smallest value, with derivatives that
// agree with differences, and independent of units, orientation, numbering, threads and kernels.
#include <fixtures/bounded.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/polygons.hpp>

#include <algorithm>
#include <numeric>

using namespace fixtures;

namespace {

std::vector<NamedCase> cases() {
    std::vector<NamedCase> out;
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        out.push_back({"ring", ring_case(6, 24, 0.5, 2, kind)});
        out.back().setup.known_points.clear();
        out.back().setup.known_curves.clear();
        out.back().setup.known_u.clear();
    }
    out.push_back({"airfoil", airfoil_case(16)});
    for (NamedCase const& polygons : polygon_cases()) {
        out.push_back(polygons);
        out.back().setup.mesh.cell_layout = HM_CELLS_POLYGONS;
    }
    return out;
}

// The corners of a cell now and at the start, counter-clockwise.
struct Outlines {
    std::vector<Point> now, before;

    Outlines(Mesh const& mesh, std::int32_t cell, Field const& at)
        : before(outline(mesh, cell, mesh.x, mesh.y)) {
        for (std::int32_t const k : corners_of(mesh, cell)) {
            std::complex<double> const z = at[std::size_t(k)];
            now.push_back({z.real(), z.imag()});
        }
        if (shoelace(before) > 0) return;
        std::reverse(before.begin(), before.end());
        std::reverse(now.begin(), now.end());
    }
    double sine(std::size_t k, bool of_before = false) const {
        return std::sin(exterior_angle(of_before ? before : now, k));
    }
};

// The skew quality of a cell that is not inverted, by the formulas of the header.
double skew_of(Outlines const& cell, bool of_before) {
    std::vector<Point> const& p = of_before ? cell.before : cell.now;
    std::size_t const n = p.size();
    if (n == 3) {
        double squares = 0;
        for (std::size_t k = 0; k < 3; ++k) squares += std::pow(distance(p[k], p[(k + 1) % 3]), 2);
        return 4 * std::sqrt(3.0) * shoelace(p) / squares;
    }
    double sum = 0;
    int m = 0;
    for (std::size_t k = 0; k < n; ++k) {
        if (n > 4 && !is_convex_corner(cell.before, k)) continue;
        sum += 1 / cell.sine(k, of_before);
        ++m;
    }
    if (n > 4 && m < 3) return 1;
    return m / (std::sin(2 * pi / m) * sum);
}

double smooth_quality_of(Outlines const& cell, bool kept) {
    double const t = shoelace(cell.now) / shoelace(cell.before);
    double const size = std::sqrt(2 * t / (1 + t * t));
    return skew_of(cell, false) * size / (kept ? skew_of(cell, true) : 1);
}

double aggregate(std::vector<double> const& values, double sharpness) {
    double const least = *std::min_element(values.begin(), values.end());
    long double sum = 0;
    for (double const v : values)
        sum += std::exp(-static_cast<long double>(sharpness * (v - least)));
    return least - double(std::log(sum)) / sharpness;
}

double largest(Field const& field) {
    double out = 0;
    for (std::complex<double> const z : field) out = std::fmax(out, std::abs(z));
    return out;
}
std::vector<std::int32_t> const cell_kinds = {HM_BOUND_QUALITY, HM_BOUND_KEPT_QUALITY,
                                              HM_BOUND_AREA};

// The length below which random movements keep the cells of these cases valid.
double rough(NamedCase const& given) {
    std::string const name = given.name;
    return name == "airfoil" ? 1e-5 : name == "hanging nodes" ? 1e-3 : 0.006;
}

}  // namespace

TEST_CASE("the values are those of the header, and the bounds their aggregates") {
    for (NamedCase const& given : cases()) {
        INFO(std::string(given.name));
        Bounded const mesh(given.setup);
        Field const at = moved(mesh.start(), 0.1, 3, rough(given));
        std::vector<double> quality, kept;
        for (std::int32_t cell = 0; cell < mesh.setup.mesh.n_cells(); ++cell) {
            Outlines const both(mesh.setup.mesh, cell, at);
            quality.push_back(smooth_quality_of(both, false));
            kept.push_back(smooth_quality_of(both, true));
        }
        for (double const sharpness : {1.0, 50.0, 200.0, 3000.0, 1e6}) {
            std::vector<BoundResult> const found = bounds_of(mesh, at, cell_kinds, sharpness);
            for (std::size_t k = 0; k < 2; ++k) {
                std::vector<double> const& values = k == 0 ? quality : kept;
                auto const least = std::min_element(values.begin(), values.end());
                REQUIRE(*least > 0.01);
                CHECK(found[k].value.count == std::int64_t(values.size()));
                CHECK(found[k].value.item == least - values.begin());
                CHECK(found[k].value.item_kind == HM_ITEM_CELL);
                CHECK(found[k].value.extreme == doctest::Approx(*least).epsilon(1e-11));
                CHECK(found[k].value.bound ==
                      doctest::Approx(aggregate(values, sharpness)).epsilon(1e-11));
            }
            for (BoundResult const& one : found) {
                double const n = double(one.value.count);
                CHECK(one.value.bound <= one.value.extreme);
                CHECK(one.value.extreme - one.value.bound <=
                      std::log(n) / sharpness * (1 + 1e-12) + 1e-15);
            }
        }
        // Below hm_assess, by the factor of the header.
        auto report = sized<hm_quality_report>();
        hm_points const points = pairs_in(at),
                        start = {mesh.setup.mesh.x.data(), mesh.setup.mesh.y.data(), 1};
        REQUIRE(hm_assess(mesh.attempt.basis, &mesh.mesh, &points, nullptr, &start, nullptr,
                          nullptr, &report, nullptr) == HM_OK);
        hm_bound_value const sharp = bound_of(mesh, at, HM_BOUND_QUALITY, 1e5).value;
        CHECK(std::sqrt(0.5) * sharp.bound <= report.min_quality);
        CHECK(sharp.extreme >= report.min_quality * (1 - 1e-12));
    }
}

TEST_CASE("areas are compared with the start corner by corner, positive or not") {
    for (NamedCase const& given : cases()) {
        if (given.setup.mesh.cell_layout == HM_CELLS_POLYGONS) continue;
        INFO(std::string(given.name));
        Bounded const mesh(given.setup);
        for (double const amount : {0.0, 0.1, 2.0}) {
            Field const at = moved(mesh.start(), amount, 3, amount > 1 ? 0.1 : 0);
            std::vector<double> ratios;
            for (std::int32_t cell = 0; cell < mesh.setup.mesh.n_cells(); ++cell) {
                Outlines const both(mesh.setup.mesh, cell, at);
                std::size_t const n = both.now.size();
                for (std::size_t k = n == 3 ? 2 : 0; k < n; ++k) {
                    std::size_t const b = (k + 1) % n, c = (k + 2) % n;
                    ratios.push_back(twice_area(both.now[k], both.now[b], both.now[c]) /
                                     twice_area(both.before[k], both.before[b], both.before[c]));
                }
            }
            double const least = *std::min_element(ratios.begin(), ratios.end());
            CHECK((least < 0) == (amount > 1));
            for (double const sharpness : {1.0, 200.0, 1e5}) {
                hm_bound_value const found = bound_of(mesh, at, HM_BOUND_AREA, sharpness).value;
                double const slack = 1e-10 * std::fmax(1.0, std::fabs(least));
                CHECK(found.count == std::int64_t(ratios.size()));
                CHECK(std::fabs(found.extreme - least) <= slack);
                CHECK(std::fabs(found.bound - aggregate(ratios, sharpness)) <= slack);
            }
        }
    }
}

TEST_CASE("a mesh that has not moved: areas and kept quality are 1, the gap is ln(N) / rho") {
    for (NamedCase const& given : cases()) {
        INFO(std::string(given.name));
        Bounded const mesh(given.setup);
        for (BoundResult const& found :
             bounds_of(mesh, mesh.start(), {HM_BOUND_KEPT_QUALITY, HM_BOUND_AREA}, 100)) {
            CHECK(found.value.extreme == doctest::Approx(1).epsilon(1e-12));
            CHECK(found.value.extreme - found.value.bound ==
                  doctest::Approx(std::log(double(found.value.count)) / 100).epsilon(1e-10));
        }
    }
}

TEST_CASE("derivatives agree with differences, of second order, also at the start mesh") {
    for (NamedCase const& given : cases()) {
        INFO(std::string(given.name));
        Bounded const mesh(given.setup);
        double const size = rough(given);
        for (double const amount : {0.0, 0.1}) {
            Field const at = moved(mesh.start(), amount, 3, amount * size);
            Field const direction = some_field(at.size(), 11, size);
            for (std::int32_t const kind : cell_kinds) {
                for (double const sharpness : {20.0, 200.0}) {
                    double const slope =
                        dot(bound_of(mesh, at, kind, sharpness).gradient, direction);
                    double const least = check_slope(slope, 0.003, [&](double step) {
                        return bound_of(mesh, along(at, direction, step), kind, sharpness)
                            .value.bound;
                    });
                    INFO("kind " << kind << ", sharpness " << sharpness);
                    CHECK(least < 1e-6);
                }
            }
        }
    }
}

TEST_CASE("derivatives of inverted cells agree with differences") {
    for (NamedCase const& given : cases()) {
        INFO(std::string(given.name));
        Bounded const mesh(given.setup);
        Field at = mesh.start();
        Field const noise =
            some_field(at.size(), 21, std::string(given.name) == "airfoil" ? 0.02 : 0.2);
        at = along(at, noise, 1);
        Field const direction = some_field(at.size(), 12, 1e-3 * largest(noise));
        for (std::int32_t const kind : cell_kinds) {
            // Only the smallest values count, which belong to cells that remain inverted.
            double const sharpness = kind == HM_BOUND_AREA ? 2 : 50;
            BoundResult const here = bound_of(mesh, at, kind, sharpness);
            CHECK(here.value.extreme < 0);
            double const slope = dot(here.gradient, direction);
            double least = HUGE_VAL;
            for (double const step : {1e-1, 1e-2, 1e-3}) {
                double const up =
                    bound_of(mesh, along(at, direction, step), kind, sharpness).value.bound;
                double const down =
                    bound_of(mesh, along(at, direction, -step), kind, sharpness).value.bound;
                least = std::fmin(least, std::fabs((up - down) / (2 * step) - slope));
            }
            INFO("kind " << kind);
            CHECK(least < 1e-6 * std::fabs(slope) + 1e-9);
        }
    }
}

TEST_CASE("no value depends on the unit of length, on turns or translations") {
    std::complex<double> const turn = std::polar(1.0, 0.7);
    for (NamedCase const& given : cases()) {
        INFO(std::string(given.name));
        Bounded const mesh(given.setup);
        Field const at = moved(mesh.start(), 0.1, 3, rough(given));
        std::vector<BoundResult> const expected = bounds_of(mesh, at, cell_kinds);
        for (double const unit : {0x1p-40, 1e3, 1e-85, 1e85}) {
            Case scaled = similar(given.setup, unit * turn, 0);
            Field there = at;
            for (std::complex<double>& z : there) z *= unit * turn;
            scaled.curves = CurveSet();
            scaled.conditions.clear();
            scaled.set_given(body);
            Bounded const other(scaled);
            std::vector<BoundResult> const found = bounds_of(other, there, cell_kinds);
            for (std::size_t k = 0; k < found.size(); ++k) {
                CHECK(found[k].value.bound ==
                      doctest::Approx(expected[k].value.bound).epsilon(1e-9));
                Field back = found[k].gradient;
                for (std::complex<double>& z : back) z *= unit / turn;
                CHECK(largest_difference(back, expected[k].gradient) <=
                      1e-6 * largest(expected[k].gradient));
            }
        }
    }
}

TEST_CASE("no value depends on the orientation of cells or the numbering of cells and points") {
    for (NamedCase const& given : cases()) {
        INFO(std::string(given.name));
        Bounded const mesh(given.setup);
        Field const at = moved(mesh.start(), 0.1, 3, rough(given));
        std::vector<BoundResult> const expected = bounds_of(mesh, at, cell_kinds);
        // Point k becomes point n - 1 - k; cells are listed backwards, and every one is reversed.
        Case other = given.setup;
        std::int32_t const n = given.setup.mesh.n_points();
        Mesh renamed;
        renamed.cell_layout = given.setup.mesh.cell_layout;
        for (std::int32_t k = n; k-- > 0;) renamed.add_point(given.setup.mesh.point(k));
        for (std::int32_t cell = given.setup.mesh.n_cells(); cell-- > 0;) {
            std::vector<std::int32_t> points = corners_of(given.setup.mesh, cell);
            for (auto p = points.rbegin(); p != points.rend(); ++p)
                renamed.cells.push_back(n - 1 - *p);
            renamed.cell_start.push_back(std::int32_t(renamed.cells.size()));
        }
        for (std::int32_t face = 0; face < given.setup.mesh.n_faces(); ++face) {
            std::size_t const k = 2 * std::size_t(face);
            renamed.add_face(n - 1 - given.setup.mesh.faces[k],
                             n - 1 - given.setup.mesh.faces[k + 1],
                             given.setup.mesh.face_markers[std::size_t(face)]);
        }
        other.mesh = renamed;
        other.index_base = 1;
        Bounded const again(other);
        Field const there(at.rbegin(), at.rend());
        std::vector<BoundResult> const found = bounds_of(again, there, cell_kinds);
        for (std::size_t k = 0; k < found.size(); ++k) {
            CHECK(found[k].value.bound == doctest::Approx(expected[k].value.bound).epsilon(1e-12));
            Field const back(found[k].gradient.rbegin(), found[k].gradient.rend());
            CHECK(largest_difference(back, expected[k].gradient) <=
                  1e-9 * largest(expected[k].gradient));
        }
        CHECK(found[0].value.item - 1 ==
              given.setup.mesh.n_cells() - 1 - expected[0].value.item);  // counted from 1
    }
}

TEST_CASE("the bits do not depend on threads, kernels, layouts, or on which bounds are wanted") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Case setup = ring_case(60, 120, 0.5, 4, kind);
        Bounded const mesh(setup);
        Field at = moved(mesh.start(), 0.1, 3, 1e-3);
        at[3000] += 0.1;  // some cells are inverted
        std::vector<BoundResult> const expected = bounds_of(mesh, at, cell_kinds);
        for (harmorph::Kernel const kernel : usable_kernels()) {
            for (std::int32_t const threads : {1, 2, 3, 7}) {
                Backwards order;
                hm_executor executor = order.executor(threads);
                executor.kernel = std::int32_t(kernel);
                std::vector<BoundResult> const found =
                    bounds_of(mesh, at, cell_kinds, 0, &executor);
                for (std::size_t k = 0; k < found.size(); ++k) {
                    CHECK(std::memcmp(&found[k].value, &expected[k].value, sizeof found[k].value) ==
                          0);
                    CHECK(same_bits(found[k].gradient, expected[k].gradient));
                }
                CHECK((threads == 1 || order.tasks > 2));
            }
        }
        for (std::size_t k = 0; k < cell_kinds.size(); ++k) {
            BoundResult const alone = bound_of(mesh, at, cell_kinds[k]);
            CHECK(alone.value.bound == expected[k].value.bound);
            CHECK(same_bits(alone.gradient, expected[k].gradient));
        }
        std::vector<BoundResult> const no_gradients =
            bounds_of(mesh, at, cell_kinds, 0, nullptr, false);
        for (std::size_t k = 0; k < cell_kinds.size(); ++k) {
            CHECK(no_gradients[k].value.bound == expected[k].value.bound);
            CHECK(no_gradients[k].gradient[0] == std::complex<double>(-7, -7));
        }
    }
    // Polygons with up to four corners have the values of other layouts.
    Case setup = ring_case(20, 40, 0.5, 4, Cells::hybrid);
    Bounded const rows(setup);
    setup.known_points.clear();
    setup.known_curves.clear();
    setup.known_u.clear();
    setup.mesh.cell_layout = HM_CELLS_POLYGONS;
    Bounded const polygons(setup);
    Field const at = moved(rows.start(), 0.1, 3, 1e-3);
    std::vector<BoundResult> const expected = bounds_of(rows, at, cell_kinds),
                                   found = bounds_of(polygons, at, cell_kinds);
    for (std::size_t k = 0; k < found.size(); ++k) {
        CHECK(found[k].value.bound == doctest::Approx(expected[k].value.bound).epsilon(1e-13));
        CHECK(found[k].value.item == expected[k].value.item);
        CHECK(largest_difference(found[k].gradient, expected[k].gradient) <=
              1e-13 * largest(expected[k].gradient));
    }
}
