// Newton's method for the smallest and the mean quality: energies that fall, gradients against
// differences, factored systems, and independence of threads and units.
#include <fixtures/core.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/guarded.hpp>
#include <fixtures/mangle.hpp>
#include <fixtures/operators.hpp>

#include "safe/mesh_improvement.hpp"

using namespace fixtures;
using harmorph::Index;
using harmorph::Vec2;

namespace {

// A mesh and where its points are after a movement.
struct Task {
    Case setup;
    Mesh now;
};

// A ring between two circles that is turned by an angle which falls towards the outer circle.
Task sheared_ring(Cells kind, double angle = 1.2) {
    Task task{ring_case(12, 36, 0.5, 2, kind), {}};
    task.now = task.setup.mesh;
    for (std::size_t k = 0; k < task.now.x.size(); ++k) {
        double const x = task.now.x[k], y = task.now.y[k],
                     turn = angle * (2 - std::hypot(x, y)) / 1.5;
        task.now.x[k] = std::cos(turn) * x - std::sin(turn) * y;
        task.now.y[k] = std::sin(turn) * x + std::cos(turn) * y;
    }
    return task;
}

struct Sheared {
    Case setup;
    Options options;
    Solved solved;
    harmorph::Plan& plan;
    Mesh now;
    harmorph::Mobility mobility;
    harmorph::Improvement improvement;
    std::unique_ptr<Guarded> block;

    explicit Sheared(Cells kind, std::int32_t operator_kind = HM_CONFORMAL)
        : Sheared(sheared_ring(kind), operator_kind) {}
    explicit Sheared(Task const& task, std::int32_t operator_kind = HM_CONFORMAL)
        : setup(task.setup),
          options(options_of(operator_kind)),
          solved(setup, &options),
          plan(*reinterpret_cast<harmorph::Plan*>(solved.plan)),
          now(task.now) {
        block = laid_out([&](harmorph::Arena& arena) {
            mobility.lay_out(arena, plan);
            improvement.lay_out(arena, plan);
        });
        mobility.find(plan, at());
        improvement.tangle = mobility.tangle(plan, plan.mesh().points);
        improvement.executor = plan.executor();
    }
    harmorph::Points at() const { return {now.x.data(), now.y.data(), 1}; }
    harmorph::Quality quality() const {
        return harmorph::measure_quality(plan.equations().cells(), at(), plan.mesh().points, {});
    }
    harmorph::ImproveReport run(Index max_solutions = 20) {
        harmorph::ImproveReport report;
        harmorph::ImproveOptions asked;
        asked.max_solutions = max_solutions;
        improvement.run(plan, asked, 0, at(), {now.x.data(), now.y.data(), 1}, report,
                        [] { return harmorph::Prepared::nothing; });
        CHECK(block->guards_intact());
        return report;
    }
};

}  // namespace

TEST_CASE("smallest and mean quality of sheared rings rise, with few solutions") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Sheared task(kind);
        auto const before = task.quality();
        auto const report = task.run();
        auto const after = task.quality();
        INFO(before.min_quality << " " << before.mean_quality() << " " << after.min_quality << " "
                                << after.mean_quality() << " " << report.solutions);
        CHECK(after.inverted == 0);
        CHECK(after.min_quality > 1.3 * before.min_quality);
        CHECK(after.mean_quality() > 0.95 * before.mean_quality());
        CHECK(report.solutions <= 20);
    }
}

TEST_CASE("each step lowers the energy and leaves no cell inverted; more solutions are not worse") {
    Sheared task(Cells::hybrid);
    task.improvement.begin(task.plan, task.at());
    int steps = 0;
    for (int k = 0; k < 8; ++k) {
        double const before = task.improvement.energy();
        bool const moved = task.improvement.step();
        CHECK(task.improvement.energy() <= before);
        steps += moved ? 1 : 0;
        CHECK(harmorph::count_inverted(task.plan.equations().cells(),
                                       harmorph::as_points(task.improvement.now), {}) == 0);
        task.improvement.sharpen(true);
    }
    CHECK(steps > 4);
    double last = 0;
    for (Index const work : {1, 4, 12}) {
        Sheared other(Cells::hybrid);
        CHECK(other.run(work).solutions <= work);
        double const value = other.quality().min_quality * other.quality().mean_quality();
        CHECK(value >= last);
        last = value;
    }
}

TEST_CASE("the gradient is that of the energy") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        Sheared task(kind);
        harmorph::Improvement& improvement = task.improvement;
        improvement.begin(task.plan, task.at());
        std::vector<Vec2> const start(improvement.now.begin(), improvement.now.end());
        std::vector<double> slopes;
        auto const energy = [&](Index point, Vec2 by) {
            improvement.now[point] = start[std::size_t(point)] + by;
            double const found = improvement.energy();
            improvement.now[point] = start[std::size_t(point)];
            return found;
        };
        double const h = 1e-6;
        for (Index u = 0; u < improvement.region.n; u += 13) {
            Index const point = improvement.region.point[u];
            slopes.push_back((energy(point, {h, 0}) - energy(point, {-h, 0})) / (2 * h));
            slopes.push_back((energy(point, {0, h}) - energy(point, {0, -h})) / (2 * h));
        }
        improvement.step();
        double largest = 0;
        for (Index u = 0; u < improvement.region.n; ++u)
            largest = std::fmax(largest, length(improvement.system.gradient[u]) / improvement.unit);
        std::size_t k = 0;
        for (Index u = 0; u < improvement.region.n; u += 13) {
            Vec2 const by = 1 / improvement.unit * improvement.system.gradient[u];
            CHECK(std::fabs(by.x - slopes[k++]) < 1e-5 * largest);
            CHECK(std::fabs(by.y - slopes[k++]) < 1e-5 * largest);
        }
    }
}

TEST_CASE("the factor solves the system, in the order of real and of complex equations") {
    for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL}) {
        for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
            Sheared task(kind, operator_kind);
            harmorph::Improvement& improvement = task.improvement;
            improvement.begin(task.plan, task.at());
            improvement.step();
            harmorph::Region const& region = improvement.region;
            harmorph::NewtonSystem& system = improvement.system;
            std::vector<Vec2> right(system.gradient.begin(), system.gradient.begin() + region.n),
                other(system.border.begin(), system.border.begin() + region.n);
            std::vector<Vec2> const wanted = right, wanted_other = other;
            REQUIRE(improvement.factor.factorise(task.plan, improvement.tangle, region, system) ==
                    harmorph::Status::ok);
            improvement.factor.solve(task.plan, improvement.tangle, region, span(right),
                                     span(other));
            for (auto const* const pair : {&right, &other}) {
                std::vector<Vec2> const& solved = *pair;
                std::vector<Vec2> const& known = pair == &right ? wanted : wanted_other;
                std::vector<Vec2> image(solved.size());
                for (Index range = 0; range < harmorph::reduced_ranges; ++range) {
                    system.multiply(region, harmorph::range_start(region.n, range),
                                    harmorph::range_start(region.n, range + 1), span(solved),
                                    span(image));
                }
                double off = 0, size = 0;
                for (std::size_t u = 0; u < known.size(); ++u) {
                    off = std::fmax(off, length(image[u] - known[u]));
                    size = std::fmax(size, length(known[u]));
                }
                CHECK(off < 1e-9 * size);
            }
        }
    }
}

TEST_CASE("the number of threads changes no bit") {
    Sheared plain(Cells::hybrid);
    plain.run();
    for (std::int32_t const threads : {2, 5}) {
        Backwards order;
        Sheared task(Cells::hybrid);
        task.improvement.executor = {Backwards::run, &order, threads};
        task.run();
        CHECK(task.now.x == plain.now.x);
        CHECK(task.now.y == plain.now.y);
        CHECK(order.tasks > 100);
    }
}

TEST_CASE("a unit that is a power of two changes no bit, also far from 1") {
    Task const task = sheared_ring(Cells::hybrid);
    Sheared plain(task);
    plain.run();
    for (double const unit : {0x1p-310, 0x1p-20, 0x1p1, 0x1p320}) {
        INFO(unit);
        Task scaled = task;
        scaled.setup = similar(task.setup, unit, 0);
        scaled.now = Similarity{unit, 0, 0, 0}.image(task.now);
        Sheared out(scaled);
        out.run();
        CHECK(out.now.x == Similarity{unit, 0, 0, 0}.image(plain.now).x);
        CHECK(out.now.y == Similarity{unit, 0, 0, 0}.image(plain.now).y);
    }
}

TEST_CASE("the quality of turned, moved, scaled and renumbered meshes is the same") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Task const task = sheared_ring(kind);
        Sheared plain(task);
        plain.run();
        harmorph::Quality const wanted = plain.quality();
        auto const is_alike = [&](Task const& other) {
            Sheared out(other);
            out.run();
            harmorph::Quality const found = out.quality();
            CHECK(found.min_quality == doctest::Approx(wanted.min_quality).epsilon(1e-6));
            CHECK(found.mean_quality() == doctest::Approx(wanted.mean_quality()).epsilon(1e-6));
        };
        for (Similarity const by : {Similarity{1, 1.1, 0, 0}, Similarity{1, 0, 3, -2},
                                    Similarity{1e4, 0, 0, 0}, Similarity{1e-7, 2, 1e-7, 0}}) {
            INFO("scale " << by.scale << ", angle " << by.angle);
            Task moved = task;
            moved.setup = similar(task.setup, std::polar(by.scale, by.angle), {by.x, by.y});
            moved.now = by.image(task.now);
            is_alike(moved);
        }
        for (unsigned seed = 1; seed <= 3; ++seed) {
            INFO("seed " << seed);
            Task other = task;
            std::vector<std::int32_t> new_of;
            for (Mesh* const mesh : {&other.setup.mesh, &other.now}) {
                new_of = renumber_points(*mesh, seed);
                shuffle_cells(*mesh, seed);
                rotate_starts(*mesh, seed);
                reverse_some(*mesh, seed);
            }
            for (std::int32_t& point : other.setup.known_points) point = new_of[std::size_t(point)];
            is_alike(other);
        }
    }
}
