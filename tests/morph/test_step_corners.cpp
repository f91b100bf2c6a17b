// The derivative of the admissible step: that of hm_assess, and one-sided where corners compete.
#include <fixtures/bounded.hpp>
#include <fixtures/polygons.hpp>

using namespace fixtures;

namespace {

double step_of(Bounded const& mesh, Field const& from, Field const& displacement) {
    auto report = sized<hm_step_report>();
    hm_points const start = pairs_in(from), change = pairs_in(displacement);
    REQUIRE(hm_assess(mesh.attempt.basis, &mesh.mesh, &start, &change, nullptr, nullptr, &report,
                      nullptr, nullptr) == HM_OK);
    return report.admissible;
}

std::vector<hm_step_corner> corners_at(Bounded const& mesh, Field const& from,
                                       Field const& displacement, double closeness = 0,
                                       std::int32_t capacity = 50) {
    std::vector<hm_step_corner> out(static_cast<std::size_t>(capacity));
    hm_points const start = pairs_in(from), change = pairs_in(displacement);
    std::int32_t n = -1;
    hm_error error{};
    hm_status const status = hm_step_gradient(mesh.attempt.basis, &mesh.mesh, &start, &change,
                                              closeness, capacity, out.data(), &n, nullptr, &error);
    INFO(error.text);
    REQUIRE(status == HM_OK);
    out.resize(std::size_t(std::min(n, capacity)));
    return out;
}

// The change of the step of a corner when points move by p and the displacement changes by w.
double slope_of(hm_step_corner const& corner, Field const& p, Field const& w) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        std::size_t const point = std::size_t(corner.points[k]);
        std::complex<double> const change = p[point] + corner.step * w[point];
        sum += corner.by_from[2 * k] * change.real() + corner.by_from[2 * k + 1] * change.imag();
    }
    return sum;
}

}  // namespace

TEST_CASE("the derivative of the admissible step agrees with differences") {
    std::vector<Case> cases;
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid})
        cases.push_back(ring_case(6, 24, 0.5, 2, kind));
    for (NamedCase const& given : polygon_cases()) {
        cases.push_back(given.setup);
        cases.back().mesh.cell_layout = HM_CELLS_POLYGONS;
    }
    for (Case const& given : cases) {
        Bounded const mesh(given);
        Field const from = mesh.start();
        for (unsigned seed = 1; seed < 6; ++seed) {
            Field const displacement = some_field(from.size(), seed, 0.1);
            std::vector<hm_step_corner> const found = corners_at(mesh, from, displacement);
            REQUIRE(found.size() == 1);
            CHECK(found[0].step ==
                  doctest::Approx(step_of(mesh, from, displacement)).epsilon(1e-13));
            Field const p = some_field(from.size(), seed + 20, 0.003),
                        w = some_field(from.size(), seed + 30, 0.01);
            double const slope = slope_of(found[0], p, w);
            double const least = check_slope(slope, 0.01, [&](double t) {
                return step_of(mesh, along(from, p, t), along(displacement, w, t));
            });
            CHECK(least < 1e-6);
        }
    }
}

TEST_CASE("a finite step has a corner, also where rounding decides between a corner and a piece") {
    for (NamedCase const& given : polygon_cases()) {
        Case setup = given.setup;
        setup.mesh.cell_layout = HM_CELLS_POLYGONS;
        Bounded const mesh(setup);
        Field const from = mesh.start();
        int without = 0;
        for (unsigned seed = 1; seed < 400; ++seed)
            without += corners_at(mesh, from, some_field(from.size(), seed, 0.1)).empty();
        CHECK(without == 0);
    }
}

// All areas grow in proportion to the step, but for rounding, which makes some of them 0 far away.
TEST_CASE("a finite step has a corner, also where rounding alone makes the area 0") {
    Case setup = ring_case(6, 24, 0.5, 2, Cells::triangles);
    Bounded const mesh(setup);
    Field const from = mesh.start();
    int finite = 0, without = 0;
    for (int k = 1; k < 400; ++k) {
        std::complex<double> const ahead = std::polar(1.0, 0.01 * k);
        Field stretched;
        for (std::complex<double> const point : from)
            stretched.push_back(ahead * (1 + std::real(point * std::conj(ahead))));
        double const step = step_of(mesh, from, stretched);
        if (!std::isfinite(step)) continue;
        ++finite;
        without += corners_at(mesh, from, stretched).empty();
    }
    CHECK(finite > 0);
    CHECK(without == 0);
}

TEST_CASE("where cells compete, the step has the one-sided derivatives of the header") {
    // All columns of a ring compete when the wall grows; a change that breaks the symmetry then
    // lowers the step to both sides.
    Case setup = ring_case(6, 24, 0.5, 2);
    Bounded const mesh(setup);
    Field const from = mesh.start();
    Field displacement(from.size());
    for (std::size_t k = 0; k < from.size(); ++k)
        if (std::abs(from[k]) < 0.5 * (1 + 1e-9)) displacement[k] = from[k];
    std::vector<hm_step_corner> const found = corners_at(mesh, from, displacement, 1e-10, 1000);
    CHECK(found.size() >= 24);
    for (std::size_t k = 1; k < found.size(); ++k) CHECK(found[k - 1].step <= found[k].step);
    Field const p(from.size()), w = some_field(from.size(), 4, 0.01);
    double ahead = HUGE_VAL, back = -HUGE_VAL;
    for (hm_step_corner const& corner : found) {
        ahead = std::fmin(ahead, slope_of(corner, p, w));
        back = std::fmax(back, slope_of(corner, p, w));
    }
    CHECK(ahead < 0);
    CHECK(back > 0);
    double const here = step_of(mesh, from, displacement), t = 1e-7;
    CHECK((step_of(mesh, from, along(displacement, w, t)) - here) / t ==
          doctest::Approx(ahead).epsilon(1e-4));
    CHECK((here - step_of(mesh, from, along(displacement, w, -t))) / t ==
          doctest::Approx(back).epsilon(1e-4));

    // A short list has the first of them.
    std::vector<hm_step_corner> const few = corners_at(mesh, from, displacement, 1e-10, 3);
    REQUIRE(few.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) CHECK(few[k].step == found[k].step);
    std::vector<hm_step_corner> const one = corners_at(mesh, from, displacement, 0, 3);
    CHECK(one.size() >= 1);
    CHECK(one[0].step == doctest::Approx(here).epsilon(1e-14));
}

TEST_CASE("no limit, and what is refused") {
    Case setup = ring_case(6, 24, 0.5, 2, Cells::triangles);
    Bounded const mesh(setup);
    Field const from = mesh.start();
    CHECK(corners_at(mesh, from, Field(from.size(), {1, 2})).empty());

    hm_step_corner corner{};
    corner.cell = -7;
    std::int32_t n = -7;
    hm_error error{};
    hm_points const start = pairs_in(from);
    auto const status = [&](Field const& at, double closeness, std::int32_t capacity) {
        hm_points const points = pairs_in(at);
        hm_status const out = hm_step_gradient(mesh.attempt.basis, &mesh.mesh, &points, &start,
                                               closeness, capacity, &corner, &n, nullptr, &error);
        CHECK(corner.cell == -7);
        CHECK(n == -7);
        return out;
    };
    CHECK(status(from, -1, 1) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "closeness must be between 0 and 1, not -1");
    CHECK(status(from, 0, 0) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "capacity must be at least 1, not 0");
    Field inverted = from;
    inverted[60] += 1.0;
    CHECK(status(inverted, 0, 1) == HM_BAD_MESH);
    CHECK(says(error, "is inverted at `from`"));

    // The corner of the square passes through the line of its neighbours' and back: at s = 1 the
    // area is (1 - s)^2.
    Case square_case;
    square_case.mesh = square(2, Cells::triangles);
    square_case.set_given(body);
    square_case.conditions[0].marker = square_case.mesh.face_markers[0];
    Bounded const square_mesh(square_case);
    Field const at = square_mesh.start();
    Field shrinks = at;
    for (std::complex<double>& z : shrinks) z = -z;
    hm_points const points = pairs_in(at), change = pairs_in(shrinks);
    CHECK(hm_step_gradient(square_mesh.attempt.basis, &square_mesh.mesh, &points, &change, 0, 1,
                           &corner, &n, nullptr, &error) == HM_BAD_MESH);
    CHECK(says(error, "only touches 0"));
    CHECK(n == -7);
}
