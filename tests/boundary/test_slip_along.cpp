// Boundaries that slide along B-splines that are given.
#include <harmorph_design.h>
#include <cstring>

#include <fixtures/spline.hpp>
#include <fixtures/core.hpp>
#include <fixtures/safe.hpp>

using namespace fixtures;

namespace {

// A ring of few faces, whose outer circle slides along curves.
struct Along {
    Case setup = ring_case(4, 12, 0.5, 2, Cells::hybrid);
    CurveSet curves;

    explicit Along(Spline const& first) {
        curves.add(first);
        setup.set_slip(far_field);
        for (double& number : setup.curves.control) number *= 0.5 / 0.445;
    }
    hm_condition& condition() {
        hm_condition& last = setup.conditions.back();
        last.along = &curves.view();
        last.n_curves = last.along->n_curves;
        return last;
    }
    bool is_outer(std::size_t k) const {
        return std::hypot(setup.mesh.x[k], setup.mesh.y[k]) > 1.99;
    }
    // The largest distance of outer points from the circle, after a random movement and hm_slip.
    double off_circle() {
        Attempt attempt;
        Options const options = options_of(HM_CONFORMAL);
        REQUIRE(attempt.analyse(setup.problem(), &options));
        std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
        REQUIRE(hm_slip(attempt.analysis, points_in(x, y), points_out(x, y), nullptr) == HM_OK);
        CHECK(same_bits(x, setup.mesh.x));
        CHECK(same_bits(y, setup.mesh.y));
        std::vector<double> const by = some_move(std::int32_t(x.size()), 0.3, 4);
        for (std::size_t k = 0; k < x.size(); ++k) {
            x[k] += by[2 * k];
            y[k] += by[2 * k + 1];
        }
        REQUIRE(hm_slip(attempt.analysis, points_in(x, y), points_out(x, y), nullptr) == HM_OK);
        double off = 0;
        for (std::size_t k = 0; k < x.size(); ++k) {
            if (is_outer(k)) off = std::fmax(off, std::fabs(std::hypot(x[k], y[k]) - 2));
        }
        return off;
    }
};

hm_error refusal(Along& along) {
    Attempt attempt;
    Options const options = options_of(HM_CONFORMAL);
    CHECK(!attempt.analyse(along.setup.problem(), &options));
    return attempt.error;
}

}  // namespace

TEST_CASE("points slide along the given curve, whatever its beginning and direction") {
    Along without(circle(2, 0));
    CHECK(without.off_circle() > 1e-8);  // the curve through twelve points
    for (double const begin : {0.0, 17.0, 90.0, 181.0}) {
        for (bool const backwards : {false, true}) {
            Along along(circle(2, begin, 4, backwards));
            along.condition();
            CHECK(along.off_circle() < 1e-11);
        }
    }
}

TEST_CASE("points that are beside their curve keep their offset") {
    Along along(circle(2.03, 11));
    along.condition();
    CHECK(along.off_circle() <
          1.1 * 0.03 * (1 - std::cos(pi / 12)));  // between two points offsets are linear
    CHECK(along.off_circle() > 1e-5);
}

TEST_CASE("the outer points slide along the given circle with a body that turns") {
    Along along(circle(2, 11));
    along.condition();
    Safe safe(along.setup);
    std::vector<double> const move =
        similarity_move(along.setup.curves, std::polar(1.0, 60 * pi / 180), 0, 0);
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_LINEAR});
    REQUIRE(safe.run(move) >= HM_OK);
    CHECK(safe.is_valid());
    double off = 0, turned = 0;
    for (std::size_t k = 0; k < safe.x.size(); ++k) {
        if (!along.is_outer(k)) continue;
        off = std::fmax(off, std::fabs(std::hypot(safe.x[k], safe.y[k]) - 2));
        turned += std::arg(Complex(safe.x[k], safe.y[k]) /
                           Complex(along.setup.mesh.x[k], along.setup.mesh.y[k])) /
                  12;
    }
    CHECK(off < 1e-11);
    CHECK(turned > 0.5);
}

TEST_CASE("points where two arcs end are fixed, and the others slide along their own arc") {
    Along along(circle(2, 0, 2));
    along.curves.add(circle(2, 180, 2));
    along.condition();
    CHECK(along.off_circle() > 0.01);  // of the two that do not slide
    Safe safe(along.setup);
    REQUIRE(safe.run(similarity_move(along.setup.curves, std::polar(1.0, 20 * pi / 180), 0, 0)) >=
            HM_OK);
    int n_fixed = 0;
    for (std::size_t k = 0; k < safe.x.size(); ++k) {
        if (!along.is_outer(k)) continue;
        bool const stays = safe.x[k] == along.setup.mesh.x[k] && safe.y[k] == along.setup.mesh.y[k];
        CHECK(stays == (std::fabs(along.setup.mesh.y[k]) < 1e-9));
        n_fixed += stays ? 1 : 0;
    }
    CHECK(n_fixed == 2);
}

TEST_CASE("the conditions of a basis state the number of curves, and need them again") {
    Along along(circle(2, 11));
    along.condition();
    Options const options = options_of(HM_CONFORMAL);
    Solved solved(along.setup.problem(), &options);
    std::vector<hm_condition> back(2);
    for (hm_condition& condition : back) condition.struct_size = sizeof condition;
    std::int32_t n = 0;
    REQUIRE(hm_basis_conditions(solved.basis, back.data(), 2, &n, nullptr) == HM_OK);
    CHECK(back[1].kind == HM_SLIP);
    CHECK(back[1].first_curve == 0);
    CHECK(back[1].n_curves == 1);
    CHECK(back[1].along == nullptr);
    along.setup.conditions = back;
    hm_error const error = refusal(along);
    CHECK(error.code == HM_BAD_CONDITION);
    CHECK(std::string(error.text) ==
          "condition 1 slips along 1 curves, but its `along` is NULL; give the curves again, "
          "which hm_basis_along takes from a basis");
    along.condition();
    CHECK(along.off_circle() < 1e-11);
}

TEST_CASE("a copy of a basis gives back the curves along which points slip") {
    Along along(circle(2, 11));
    along.condition();
    hm_curves const given = *along.setup.conditions[1].along;
    Options const options = options_of(HM_CONFORMAL);
    Solved solved(along.setup.problem(), &options);
    hm_basis_info info;
    HM_INIT(info);
    REQUIRE(hm_basis_info_get(solved.basis, &info, nullptr) == HM_OK);
    const char* const bytes = reinterpret_cast<const char*>(solved.basis);
    std::vector<double> copy(info.bytes / sizeof(double) + 1);
    std::memcpy(copy.data(), bytes, info.bytes);
    const hm_basis* attached = nullptr;
    hm_error error;
    REQUIRE(hm_basis_attach(&attached, copy.data(), info.bytes, nullptr, &error) == HM_OK);

    std::vector<hm_condition> back(2);
    for (hm_condition& each : back) each.struct_size = sizeof each;
    std::int32_t n = 0;
    REQUIRE(hm_basis_conditions(attached, back.data(), 2, &n, nullptr) == HM_OK);
    hm_curves found;
    HM_INIT(found);
    std::vector<hm_curve> curve(std::size_t(back[1].n_curves));
    REQUIRE(hm_basis_along(attached, 1, &found, curve.data(), back[1].n_curves, &error) == HM_OK);
    CHECK(found.n_control == given.n_control);
    CHECK(std::equal(given.control, given.control + 2 * given.n_control, found.control));
    REQUIRE(found.weights != nullptr);
    CHECK(std::equal(given.weights, given.weights + given.n_control, found.weights));
    CHECK(hm_curves_check(&found, &error) == HM_OK);
    back[1].along = &found;
    along.setup.conditions = back;
    Solved again(along.setup.problem(), &options);
    // The same conditions: the plan of one takes the basis of the other.
    CHECK(hm_plan_solve(again.plan, solved.basis, nullptr, nullptr) == HM_OK);

    CHECK(hm_basis_along(attached, 1, &found, curve.data(), 0, &error) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "curve has room for 0 curves, but the condition has 1");
    CHECK(hm_basis_along(attached, 0, &found, curve.data(), 1, &error) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) ==
          "condition 0 of the basis has no curves along which points slip");
    CHECK(hm_basis_along(attached, 2, &found, curve.data(), 1, &error) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "condition 2 does not exist; the basis has 2");
}

TEST_CASE("a plan accepts functions of its own sliding curves only") {
    Along one(circle(2, 11)), other(circle(2, 11));
    one.condition();
    other.condition();
    Options const options = options_of(HM_CONFORMAL);
    Solved solved(one.setup.problem(), &options), same(other.setup.problem(), &options);
    CHECK(hm_plan_solve(same.plan, solved.basis, nullptr, nullptr) == HM_OK);
    Along farther(circle(2.03, 11)), without(circle(2, 11));
    farther.condition();
    for (Along* foreign_along : {&farther, &without}) {
        Solved foreign(foreign_along->setup.problem(), &options);
        CHECK(hm_plan_solve(foreign.plan, solved.basis, nullptr, nullptr) == HM_BAD_BASIS);
    }
}

TEST_CASE("curves that do not fit are refused with the point") {
    Along far(circle(3, 0));
    far.condition();
    hm_error error = refusal(far);
    CHECK(error.code == HM_BAD_CONDITION);
    CHECK(
        std::string(error.text)
            .find("away from the curve along which it slips; check the marker of the condition") !=
        std::string::npos);
    CHECK(error.value == doctest::Approx(1));
    CHECK(far.is_outer(std::size_t(error.item)));

    Spline octagon;  // in which the curve turns by 45 degrees, between points
    octagon.degree = 1;
    for (int k = 0; k <= 8; ++k) {
        double const angle = pi * (k + 0.3) / 4;
        if (k < 8)
            octagon.control.insert(octagon.control.end(),
                                   {2.05 * std::cos(angle), 2.05 * std::sin(angle)});
        octagon.indices.push_back(k % 8);
    }
    octagon.knots = {0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 8};
    Along corners(octagon);
    corners.condition();
    error = refusal(corners);
    CHECK(error.code == HM_BAD_CONDITION);
    CHECK(says(error, "and the following points slip has a corner between them"));

    Along along(circle(2, 0));
    along.condition().n_curves = 2;
    CHECK(std::string(refusal(along).text) ==
          "n_curves of condition 1 is 2, but its `along` has another number of curves");
    along.condition().kind = HM_FIXED;
    along.setup.conditions.back().n_curves = 0;
    CHECK(std::string(refusal(along).text) ==
          "along of condition 1 is set, but the kind of the condition is 2, not HM_SLIP");
    along.condition().kind = HM_SLIP;
    along.curves.shapes[0].knots[1] = 9;  // not in order
    CHECK(refusal(along).code == HM_BAD_CURVE);
}
