#include <harmorph_design.h>
#include <doctest/doctest.h>

#include <fixtures/curves.hpp>
#include <fixtures/guarded.hpp>
#include <fixtures/traps.hpp>
#include <fixtures/memory.hpp>

#include <string>

using fixtures::CurveSet;
using fixtures::Spline;

namespace {

// Clamped, and its last control point is the first one again.
Spline tied(int degree, int n, unsigned seed) {
    Spline spline = fixtures::clamped(degree, n, seed);
    for (int k = 0; k < n; ++k) spline.indices.push_back(k % (n - 1));
    spline.control.resize(2 * std::size_t(n - 1));
    return spline;
}

struct Finer {
    std::vector<unsigned char> block;
    const hm_curves* curves = nullptr;
    const double* matrix = nullptr;
    hm_error error{};
    hm_status status = 0;

    double row_sum(int row, int n) const {
        double sum = 0;
        for (int i = 0; i < n; ++i) sum += matrix[row * n + i];
        return sum;
    }
};

// The curve with knots inserted at u, and of another degree unless `degree` is 0.
Finer refined(hm_curves const& curves, int curve, std::vector<double> const& u,
              std::int32_t degree = 0) {
    Finer out;
    std::size_t bytes = 0;
    int const n = int(u.size());
    out.status = fixtures::refine_size(&curves, curve, degree, n, u.data(), &bytes, &out.error);
    if (out.status < 0) return out;
    out.block.resize(bytes);
    out.status = hm_refine(&out.curves, &out.matrix, fixtures::Memory(out.block.data(), bytes),
                           &curves, curve, degree, n, u.data(), &out.error);
    return out;
}

Finer elevated(hm_curves const& curves, int curve) {
    return refined(curves, curve, {}, curves.curve[curve].degree + 1);
}

// The largest difference of points, and of first derivatives, of the same curve of two sets.
double difference(hm_curves const& a, hm_curves const& b, int curve) {
    int const p = a.curve[curve].degree;
    double const from = a.curve[curve].knots[p],
                 to = a.curve[curve].knots[a.curve[curve].n_indices];
    double largest = 0;
    for (int k = 0; k <= 211; ++k) {
        double const u = k == 211 ? to : from + (to - from) * k / 211.0;
        double at_a[4], at_b[4];
        REQUIRE(hm_curve_point(&a, curve, u, 1, at_a, nullptr) == HM_OK);
        REQUIRE(hm_curve_point(&b, curve, u, 1, at_b, nullptr) == HM_OK);
        for (int i = 0; i < 4; ++i) largest = std::max(largest, std::fabs(at_a[i] - at_b[i]));
    }
    return largest;
}

// The new set is the old one, its matrix maps the old control points to the new ones, also after
// they have moved.
void check_same(CurveSet& set, Finer const& finer) {
    REQUIRE_MESSAGE(finer.status == HM_OK, finer.error.text);
    hm_curves const old = set.view();
    CHECK(hm_curves_check(finer.curves, nullptr) == HM_OK);
    for (int c = 0; c < old.n_curves; ++c) CHECK(difference(old, *finer.curves, c) < 1e-12);
    for (int j = 0; j < finer.curves->n_control; ++j)
        CHECK(finer.row_sum(j, old.n_control) == doctest::Approx(1).epsilon(1e-13));

    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (double& number : set.control) number += 0.2 * uniform(random);
    hm_curves const moved_old = set.view();
    hm_curves moved = *finer.curves;
    std::vector<double> control(2 * std::size_t(moved.n_control));
    for (int j = 0; j < moved.n_control; ++j)
        for (int i = 0; i < old.n_control; ++i)
            for (int d = 0; d < 2; ++d)
                control[2 * j + d] += finer.matrix[j * old.n_control + i] * set.control[2 * i + d];
    moved.control = control.data();
    for (int c = 0; c < old.n_curves; ++c) CHECK(difference(moved_old, moved, c) < 1e-12);
}

int uses(hm_curves const& curves, int curve, int position) {
    return curves.curve[curve].indices[position] - curves.index_base;
}

}  // namespace

TEST_CASE("inserted knots and a higher degree change no point of a curve of any kind") {
    for (int degree = 1; degree <= 5; ++degree)
        for (bool const rational : {false, true})
            for (int kind = 0; kind < 3; ++kind) {
                int const n = 11;
                Spline spline = kind == 0   ? fixtures::clamped(degree, n, 1)
                                : kind == 1 ? fixtures::periodic(degree, n, 0.4, 2)
                                            : tied(degree, n, 3);
                if (rational) spline = fixtures::with_weights(spline);
                double const end = kind == 1 ? n : n - degree;
                INFO("degree " << degree << ", rational " << rational << ", kind " << kind);
                CurveSet set(spline);
                std::vector<double> const u = {0.37 * end, 0.02 * end, 0.98 * end, 0.71 * end};
                Finer const finer = refined(set.view(), 0, u);
                CHECK(finer.curves->n_control == set.n_control() + 4);
                check_same(set, finer);
                CurveSet again(spline);
                Finer const none = refined(again.view(), 0, {});
                CHECK(none.curves->n_control == again.n_control());
                CHECK(difference(again.view(), *none.curves, 0) == 0);
                if (degree == 5) continue;
                CurveSet third(spline);
                Finer const higher = elevated(third.view(), 0);
                CHECK(higher.curves->curve[0].degree == degree + 1);
                check_same(third, higher);
            }
}

TEST_CASE("a knot repeated as often as the degree makes the curve interpolate a control point") {
    for (int degree = 1; degree <= 5; ++degree) {
        CurveSet set(fixtures::clamped(degree, 9, 4));
        double const u = 1.7;
        Finer const finer = refined(set.view(), 0, std::vector<double>(std::size_t(degree), u));
        double at[2];
        REQUIRE(hm_curve_point(&set.view(), 0, u, 0, at, nullptr) == HM_OK);
        double nearest = 1;
        for (int j = 0; j < finer.curves->n_control; ++j)
            nearest = std::min(nearest, std::hypot(finer.curves->control[2 * j] - at[0],
                                                   finer.curves->control[2 * j + 1] - at[1]));
        CHECK(nearest < 1e-13);
        check_same(set, finer);
    }
}

TEST_CASE("a periodic curve stays periodic, also where the knot is inserted at its seam") {
    for (int degree = 1; degree <= 5; ++degree) {
        CurveSet set(fixtures::periodic(degree, 9, 0.3, 6));
        for (double const u : {0.0, 0.25, 4.5, 8.75}) {
            if (degree == 1 && u == 0) continue;  // there already
            Finer const finer = refined(set.view(), 0, {u});
            REQUIRE_MESSAGE(finer.status == HM_OK, finer.error.text);
            CHECK(finer.curves->n_control == 10);
            CHECK(difference(set.view(), *finer.curves, 0) < 1e-12);
            for (int k = 0; k < degree; ++k)
                CHECK(uses(*finer.curves, 0, k) == uses(*finer.curves, 0, k + 10));
            std::vector<double> const more = {u / 2 + 1.1, 3.3};
            Finer const finest = refined(*finer.curves, 0, more);
            REQUIRE_MESSAGE(finest.status == HM_OK, finest.error.text);
            CHECK(finest.curves->n_control == 12);
            CHECK(difference(set.view(), *finest.curves, 0) < 1e-12);
        }
        if (degree == 5) continue;
        Finer const higher = elevated(set.view(), 0);
        CHECK(higher.curves->n_control == 18);
        Finer const twice =
            degree < 4 ? elevated(*higher.curves, 0) : refined(*higher.curves, 0, {2.2});
        REQUIRE_MESSAGE(twice.status == HM_OK, twice.error.text);
        CHECK(twice.curves->n_control == (degree < 4 ? 27 : 19));
        CHECK(difference(set.view(), *twice.curves, 0) < 1e-12);
    }
}

TEST_CASE("points at the seam of a curve with close knots are found from the better end") {
    Spline spline = fixtures::periodic(5, 9, 0.3, 6);
    double const in_one_period[] = {0, 5e-5, 1.2e-4, 1.7e-4, 0.25, 0.5, 0.50008, 0.50015, 0.5002};
    for (std::size_t k = 0; k < spline.knots.size(); ++k)
        spline.knots[k] = in_one_period[(k + 4) % 9] + double((k + 4) / 9) - 1;
    CurveSet set(spline);
    for (double const u : {0.22, 0.4, 0.69, 0.95}) {
        INFO("knot " << u);
        Finer const finer = refined(set.view(), 0, {u});
        REQUIRE_MESSAGE(finer.status == HM_OK, finer.error.text);
        for (int k = 0; k <= 100; ++k) {
            double before[2], after[2];
            REQUIRE(hm_curve_point(&set.view(), 0, 0.01 * k, 0, before, nullptr) == HM_OK);
            REQUIRE(hm_curve_point(finer.curves, 0, 0.01 * k, 0, after, nullptr) == HM_OK);
            CHECK(std::hypot(after[0] - before[0], after[1] - before[1]) < 1e-11);
        }
    }
}

TEST_CASE("ties and common ends persist, and points outside the change keep their bits") {
    CurveSet set;
    set.index_base = 1;
    set.add(fixtures::clamped(3, 10, 7));
    set.add_over(1, {10, 1}, {0, 0, 1, 1});           // a base from the last to the first
    set.control.insert(set.control.end(), {20, 20});  // used by no curve
    Finer const finer = refined(set.view(), 0, {2.5});
    REQUIRE(finer.status == HM_OK);
    hm_curves const& made = *finer.curves;
    CHECK(made.index_base == 1);
    CHECK(made.n_control == 12);
    CHECK(uses(made, 1, 0) == uses(made, 0, 10));
    CHECK(uses(made, 1, 1) == uses(made, 0, 0));
    CHECK(std::memcmp(made.control, set.control.data(), 2 * sizeof(double)) == 0);
    CHECK(made.control[22] == 20);
    check_same(set, finer);

    CurveSet loop(tied(3, 12, 8));
    Finer const higher = elevated(loop.view(), 0);
    CHECK(uses(*higher.curves, 0, 0) ==
          uses(*higher.curves, 0, higher.curves->curve[0].n_indices - 1));
}

TEST_CASE("knots that cannot be inserted are refused by name, and nothing is written") {
    CurveSet set(fixtures::clamped(3, 9, 9));
    auto const refusal = [&](std::vector<double> const& u, std::string const& word) {
        Finer const finer = refined(set.view(), 0, u);
        CHECK_MESSAGE(std::string(finer.error.text).find(word) != std::string::npos,
                      finer.error.text);
        CHECK(finer.curves == nullptr);
        return finer.status;
    };
    double const nan = std::nan("");
    CHECK(refusal({1.5, nan}, "knot 1") == HM_BAD_ARGUMENT);
    CHECK(refusal({1.5, 1.5, 1.5, 1.5}, "repeated 4 times") == HM_BAD_CURVE);
    Finer const absent = refined(set.view(), 1, {1});
    CHECK(absent.status == HM_BAD_ARGUMENT);
    CurveSet fifth(fixtures::clamped(5, 9, 9));
    Finer const sixth = elevated(fifth.view(), 0);
    CHECK(sixth.status == HM_BAD_CURVE);
    CHECK(std::string(sixth.error.text) ==
          "the degree of curve 0 cannot be raised, because 5 is the largest degree");
}
