// The distance between two bodies: known for circles, negative where they overlap, with derivatives
// by the control points of both.
#include <harmorph_design.h>
#include <doctest/doctest.h>

#include <fixtures/curves.hpp>
#include <fixtures/perturb.hpp>
#include <fixtures/guarded.hpp>

using namespace fixtures;

namespace {

struct Result {
    hm_status status;
    double value = 0, at[2] = {};
    std::vector<double> gradient;
};

Result distance_of(CurveSet& set, double sharpness = 0, bool swapped = false) {
    auto asked = sized<hm_quantity>();
    asked.kind = HM_DISTANCE;
    asked.sharpness = sharpness;
    asked.other_curve = swapped ? 0 : 1;
    asked.n_other = 1;
    auto section = sized<hm_section>();
    section.first_curve = swapped ? 1 : 0;
    section.n_curves = 1;
    Result out;
    out.gradient.assign(set.control.size(), -7);
    out.status = hm_measure(&set.view(), &section, 1, &asked, &out.value, out.at,
                            out.gradient.data(), nullptr);
    REQUIRE(out.status == HM_OK);
    return out;
}

}  // namespace

TEST_CASE("circles: the distance of the centres minus both radii, also where they overlap") {
    for (double const x : {5.0, 3.3, 3.0, 2.5}) {
        for (double const angle : {0.0, 0.3, 2.0, 5.0}) {
            CurveSet set(exact_circle(2, 0, 0));
            set.add(exact_circle(1, x * std::cos(angle), x * std::sin(angle)));
            for (bool const swapped : {false, true}) {
                Result const found = distance_of(set, 0, swapped);
                CHECK(std::fabs(found.value - (x - 3)) < 1e-10);
                // The nearest places are on the line of the centres, if the circles are apart.
                if (x > 3)
                    CHECK(std::fabs(found.at[0] * std::sin(angle) - found.at[1] * std::cos(angle)) <
                          1e-6);
                for (double const sharpness : {3.0, 100.0}) {
                    Result const smooth = distance_of(set, sharpness, swapped);
                    CHECK(smooth.value < found.value + 0.02);
                    CHECK(smooth.value > found.value - std::log(64.0) / sharpness - 1e-9);
                }
            }
        }
    }
    // A body inside the other one.
    CurveSet inside(exact_circle(2, 0, 0));
    inside.add(exact_circle(0.5, 0.3, 0));
    CHECK(distance_of(inside).value < -0.5);
    CHECK(distance_of(inside, 0, true).value < -0.5);
}

TEST_CASE("derivatives by the control points of both bodies agree with differences") {
    std::mt19937 random(4);
    for (double const y : {1.7, 0.6, 0.5}) {
        CurveSet set(ring(3, 11, 2, 0.4));
        set.add(ring(3, 9, 1, 0.5, 0.7, y));
        for (std::size_t k = 0; k < set.control.size(); ++k)
            set.control[k] += 0.03 * (2 * uniform(random) - 1);
        for (double const sharpness : {0.0, 8.0, 200.0}) {
            Result const here = distance_of(set, sharpness);
            std::vector<double> const start = set.control;
            double sum[2] = {0, 0}, worst = 0;
            for (std::size_t k = 0; k < start.size(); ++k) sum[k % 2] += here.gradient[k];
            for (int trial = 0; trial < 4; ++trial) {
                std::vector<double> direction;
                double slope = 0;
                for (std::size_t k = 0; k < start.size(); ++k) {
                    direction.push_back(2 * uniform(random) - 1);
                    slope += direction[k] * here.gradient[k];
                }
                auto const value = [&](double h) {
                    for (std::size_t k = 0; k < start.size(); ++k)
                        set.control[k] = start[k] + h * direction[k];
                    return distance_of(set, sharpness).value;
                };
                double const h = 1e-5;
                worst = std::fmax(worst, std::fabs((value(h) - value(-h)) / (2 * h) - slope));
                set.control = start;
            }
            INFO("y " << y << ", sharpness " << sharpness << ", value " << here.value);
            CHECK(worst < 1e-5);
            // Both bodies together may move freely.
            CHECK(std::fabs(sum[0]) + std::fabs(sum[1]) < 1e-12);
        }
    }
}
