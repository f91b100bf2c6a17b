// Better cells in meshes whose outer boundary slips along a curve: the points there go along the
// curve, too.
#include <fixtures/spline.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/mangle.hpp>
#include <fixtures/safe.hpp>
#include <fixtures/memory.hpp>

using namespace fixtures;

namespace {

// A ring whose outer circle slips along the circle itself, or along the curve through its points;
// or is fixed.
enum class Outer { circle, points, fixed };

struct Ring {
    Case setup = ring_case(8, 32, 0.5, 2, Cells::hybrid);
    CurveSet along;
    std::vector<double> x, y;  // before, and then after the improvement
    hm_improve_report report{};
    hm_error error{};

    explicit Ring(Outer outer) {
        along.add(circle(2, 11));
        if (outer != Outer::fixed) setup.set_slip(far_field);
        if (outer == Outer::circle) {
            setup.conditions.back().along = &along.view();
            setup.conditions.back().n_curves = along.view().n_curves;
        }
        for (double& number : setup.curves.control) number *= 0.5 / 0.445;
        // Outer points go along the circle by up to a third of a face, inner points anywhere.
        Mesh scattered = setup.mesh;
        std::mt19937 random(7);
        for (std::int32_t const point : points_on(setup.mesh, far_field)) {
            auto const k = std::size_t(point);
            Complex const at = Complex(scattered.x[k], scattered.y[k]) *
                               std::polar(1.0, (2 * uniform(random) - 1) * 0.065);
            scattered.x[k] = at.real() * (2 / std::abs(at));
            scattered.y[k] = at.imag() * (2 / std::abs(at));
        }
        perturb(scattered, 0.2, 3);
        x = scattered.x;
        y = scattered.y;
    }
    hm_status improve(hm_executor const* executor = nullptr,
                      std::int32_t operator_kind = HM_CONFORMAL) {
        Options options = options_of(operator_kind);
        if (executor != nullptr) options.executor = executor;
        Solved const solved(setup, &options);
        Guarded work = block_of(fixtures::improve_size, solved.plan);
        report.struct_size = sizeof report;
        hm_status const status =
            hm_improve(solved.plan, points_in(x, y), points_out(x, y),
                       fixtures::Memory(work.data(), work.size()), nullptr, &report, &error);
        CHECK(work.guards_intact());
        return status;
    }
    double off_circle() const {
        double off = 0;
        for (std::int32_t const point : points_on(setup.mesh, far_field)) {
            auto const k = std::size_t(point);
            off = std::fmax(off, std::fabs(std::hypot(x[k], y[k]) - 2));
        }
        return off;
    }
    double smallest_corner() const {
        Mesh moved = setup.mesh;
        moved.x = x;
        moved.y = y;
        return check(moved).min_corner;
    }
    int changed(std::vector<double> const& old_x) const {
        int n = 0;
        for (std::int32_t const k : points_on(setup.mesh, far_field))
            n += x[std::size_t(k)] != old_x[std::size_t(k)];
        return n;
    }
};

}  // namespace

TEST_CASE("outer points follow their curve, and the cells are better than with fixed points") {
    Ring held(Outer::fixed), start(Outer::fixed);
    std::vector<double> const before = held.x;
    REQUIRE(held.improve() == HM_OK);
    start.x = start.setup.mesh.x;
    start.y = start.setup.mesh.y;
    REQUIRE(start.improve() == HM_OK);
    CHECK(held.changed(before) == 0);
    for (Outer const outer : {Outer::circle, Outer::points}) {
        for (std::int32_t const kind : {HM_CONFORMAL, HM_LAPLACE}) {
            Ring slips(outer);
            REQUIRE(slips.improve(nullptr, kind) == HM_OK);
            CHECK(slips.changed(before) == 32);
            CHECK(slips.smallest_corner() > 0);
            CHECK(slips.off_circle() < (outer == Outer::circle ? 1e-12 : 2e-8));
            CHECK(slips.report.min_quality_before == held.report.min_quality_before);
            CHECK(slips.report.min_quality > 0.98 * start.report.min_quality);
            CHECK(held.report.min_quality < 0.9 * start.report.min_quality);
            CHECK(slips.report.mean_quality > 0.99 * start.report.mean_quality);
            CHECK(slips.report.mean_quality > held.report.mean_quality);
            CHECK(slips.report.movable == held.report.movable + 32);
        }
    }
}

TEST_CASE("any number of threads improves a slipping mesh to the same bits") {
    Ring one(Outer::circle);
    REQUIRE(one.improve() == HM_OK);
    for (std::int32_t const n_threads : {2, 3}) {
        Ring several(Outer::circle);
        Backwards backwards;
        hm_executor const executor = backwards.executor(n_threads);
        REQUIRE(several.improve(&executor) == HM_OK);
        CHECK(same_bits(one.x, several.x));
        CHECK(same_bits(one.y, several.y));
    }
}

TEST_CASE("a point that is not on its curve is held, and the others slip") {
    Ring ring(Outer::circle);
    auto const off = std::size_t(points_on(ring.setup.mesh, far_field)[5]);
    ring.x[off] *= 1.00001;
    ring.y[off] *= 1.00001;
    std::vector<double> const x = ring.x, y = ring.y;
    REQUIRE(ring.improve() == HM_OK);
    CHECK(ring.x[off] == x[off]);
    CHECK(ring.y[off] == y[off]);
    CHECK(ring.changed(x) == 31);
    CHECK(ring.smallest_corner() > 0);
    CHECK(ring.report.min_quality >= ring.report.min_quality_before);
}

TEST_CASE("a reference that is improved does not change, though outer points could slip") {
    Ring ring(Outer::circle);
    ring.x = ring.setup.mesh.x;
    ring.y = ring.setup.mesh.y;
    REQUIRE(ring.improve() == HM_OK);
    CHECK(same_bits(ring.x, ring.setup.mesh.x));
    CHECK(same_bits(ring.y, ring.setup.mesh.y));
}
