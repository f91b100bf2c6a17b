// One pass says what the admissible step and the quality say each for itself.
#include <cmath>
#include <doctest/doctest.h>

#include <fixtures/core.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/solved.hpp>

using namespace fixtures;

namespace {

struct Both {
    hm_step_report step = sized<hm_step_report>();
    hm_quality_report quality = sized<hm_quality_report>();
    // Equal but for rounding: one call takes areas of reference from diagonals, the other one from
    // corners.
    bool agrees_with(Both const& other) const {
        auto const near = [](double a, double b) {
            return a == doctest::Approx(b).epsilon(1e-12) || a == b;
        };
        hm_quality_report const &a = quality, &b = other.quality;
        return std::memcmp(&step, &other.step, sizeof step) == 0 && a.inverted == b.inverted &&
               a.first_inverted == b.first_inverted && a.min_area == b.min_area &&
               near(a.min_quality, b.min_quality) && near(a.mean_quality, b.mean_quality) &&
               a.min_quality_cell == b.min_quality_cell && a.self_crossing == b.self_crossing &&
               std::memcmp(a.crossing_points, b.crossing_points, sizeof a.crossing_points) == 0;
    }
    bool same_as(Both const& other) const {
        return std::memcmp(&step, &other.step, sizeof step) == 0 &&
               std::memcmp(&quality, &other.quality, sizeof quality) == 0;
    }
};

}  // namespace

TEST_CASE("one assessment has the step and the quality of two calls in turn") {
    for (std::int32_t const base : {0, 1})
        for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid})
            for (double const size : {0.0, 1e-5, 1.0}) {  // from nothing at all to a tangle
                Case setup = airfoil_case(40, 12, kind);
                setup.index_base = base;
                if (base == 1) reverse_some(setup.mesh, 3);
                Solved const solved(setup);
                hm_mesh const mesh = setup.mesh_view();
                std::vector<double> const move = some_move(setup.curves.n_control(), size, 5);
                Moved const by = displaced(solved.basis, move),
                            to = morphed(solved.basis, setup.mesh, move);
                Both apart, together;
                apart.step = step_of(solved.basis, mesh, by);
                apart.quality = quality_of(solved.basis, mesh, to, &mesh.points);
                together.step = step_of(solved.basis, mesh, by, &together.quality);
                CHECK(together.agrees_with(apart));
                CHECK((together.quality.inverted > 0) == (size == 1.0));
                CHECK((together.step.admissible < 1) == (size == 1.0));
                Backwards order;
                hm_executor const executor = order.executor(4);
                Both threaded;
                REQUIRE(hm_assess(solved.basis, &mesh, nullptr, points_in(by.x, by.y), nullptr,
                                  &executor, &threaded.step, &threaded.quality, nullptr) == HM_OK);
                CHECK(threaded.same_as(together));
                CHECK(order.tasks > 1);
            }
}

TEST_CASE("each report alone, and a reference of its own: what both calls in turn say") {
    Case setup = two_body_case(Cells::quads, 8, 6);
    Solved const solved(setup);
    hm_mesh const mesh = setup.mesh.view();
    std::size_t const n = setup.mesh.x.size();
    std::vector<double> dx(n), dy(n), x(setup.mesh.x), y(setup.mesh.y);
    for (std::size_t k = 0; k < n; ++k) {
        dx[k] = 1e-3 * std::sin(3 * x[k] + y[k]);
        dy[k] = 1e-3 * std::cos(2 * y[k] - x[k]);
        x[k] += dx[k];
        y[k] += dy[k];
    }
    Both together, referred, moved;
    together.step = step_of(solved.basis, mesh, Moved{dx, dy}, &together.quality);
    CHECK(step_of(solved.basis, mesh, Moved{dx, dy}).admissible == together.step.admissible);
    // The reference is the mesh itself: the same quality, whether the mesh has moved or will move.
    CHECK(hm_assess(solved.basis, &mesh, nullptr, points_in(dx, dy), &mesh.points, nullptr, nullptr,
                    &referred.quality, nullptr) == HM_OK);
    moved.quality = quality_of(solved.basis, mesh, Moved{x, y}, &mesh.points);
    for (hm_quality_report const& quality : {referred.quality, moved.quality}) {
        CHECK(quality.mean_quality ==
              doctest::Approx(together.quality.mean_quality).epsilon(1e-14));
        CHECK(quality.min_quality == doctest::Approx(together.quality.min_quality).epsilon(1e-14));
        CHECK(quality.min_quality_cell == together.quality.min_quality_cell);
    }
}
