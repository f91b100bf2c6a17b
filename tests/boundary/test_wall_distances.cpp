// Points of a wall that do not lie on the curves that they were given.
#include <fixtures/core.hpp>

using namespace fixtures;

namespace {

// A square hole of .2 with points in the middle of its sides. Curve 0 has three of the sides, curve
// 1 the one at x = .4, as a blunt base has the ends of the section's curve.
Case hole() {
    Case out;
    out.mesh = square(10, Cells::quads, 2, 2);
    out.curves.control = {0.4, 0.4, 0.6, 0.4, 0.6, 0.6, 0.4, 0.6};
    out.curves.add_over(1, {0, 1, 2, 3}, {0, 0, 1, 2, 3, 3});
    out.curves.add_over(1, {3, 0}, {0, 0, 1, 1});
    return out;
}

bool is_middle_of_base(Mesh const& mesh, std::int32_t point) {
    std::size_t const k = std::size_t(point);
    return std::fabs(mesh.x[k] - 0.4) < 1e-12 && std::fabs(mesh.y[k] - 0.5) < 1e-12;
}

}  // namespace

TEST_CASE("a condition that omits the curve of the base is refused with the point and the curve") {
    Case setup = hole();
    setup.put_on_curves(body, 0, 2);
    CHECK(Attempt(setup.problem()).status == HM_OK);
    setup.conditions.clear();
    setup.put_on_curves(body);
    Attempt attempt;
    CHECK(!attempt.analyse(setup.problem()));
    CHECK(attempt.status == HM_BAD_CONDITION);
    INFO(attempt.error.text);
    CHECK(says(attempt.error, "on curve 1, which its condition does not name"));
    CHECK(is_middle_of_base(setup.mesh, attempt.error.item));
    CHECK(attempt.error.value == doctest::Approx(0.1));
}

TEST_CASE("points beyond the end of their curve, which would move as one, give a warning") {
    Case setup = hole();
    setup.curves.shapes.pop_back();
    setup.curves.control.insert(setup.curves.control.end(),
                                {3, 0, 3, 3});  // of curve 1, which is far away
    setup.curves.add_over(1, {4, 5}, {0, 0, 1, 1});
    setup.put_on_curves(body);
    for (double& x : setup.mesh.x)
        x = 0.4 + (x - 0.4) * (x < 0.4 ? 1 : 100);  // .1 is little of the extent then
    for (std::size_t k = 0; k < 8; k += 2)
        setup.curves.control[k] = 0.4 + (setup.curves.control[k] - 0.4) * 100;
    Attempt attempt;
    CHECK(attempt.analyse(setup.problem()));
    CHECK(attempt.status == HM_FAR_FROM_CURVE);
    INFO(attempt.error.text);
    CHECK(says(attempt.error, "beyond the end of its curve"));
    CHECK(is_middle_of_base(setup.mesh, attempt.error.item));
    CHECK(attempt.error.value == doctest::Approx(0.1));
}

TEST_CASE("a curve in another unit, much larger than the wall, is refused") {
    for (double const unit : {25.4, 1000.0}) {
        Case setup = hole();
        for (double& number : setup.curves.control) number = 0.5 + (number - 0.5) * unit;
        setup.put_on_curves(body, 0, 2);
        Attempt attempt;
        CHECK(!attempt.analyse(setup.problem()));
        CHECK(attempt.status == HM_BAD_CONDITION);
        CHECK(says(attempt.error, "more than the extent of the curve or wall"));
    }
}
