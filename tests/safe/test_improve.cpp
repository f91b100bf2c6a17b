// Improving valid meshes: better cells, walls as they were, and never an inverted one.
#include <fixtures/annulus.hpp>
#include <fixtures/c_mesh.hpp>
#include <fixtures/airfoil.hpp>
#include <fixtures/core.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/guarded.hpp>
#include <fixtures/mangle.hpp>
#include <fixtures/square.hpp>
#include <fixtures/laid_out.hpp>

#include "morph/quality.hpp"
#include "safe/improve.hpp"

using namespace fixtures;
using harmorph::Improvement;
using harmorph::ImproveOptions;
using harmorph::ImproveReport;
using harmorph::Index;
using harmorph::Quality;
using harmorph::Vec2;

namespace {

// A reference mesh and where its points are; boundary points are held, and others by request.
struct Task {
    Mesh reference, now;
    std::vector<std::uint8_t> held;
    std::vector<Vec2> line;

    explicit Task(Mesh const& mesh) : reference(mesh), now(mesh), held(mesh.x.size(), 0) {
        for (std::int32_t const point : mesh.faces) held[std::size_t(point)] = 1;
    }
    // Inner points are thrown about by up to `part` of what keeps every corner positive, with the
    // given seed.
    void scatter(double part, unsigned seed) { perturb(now, part, seed); }
};

// Lays out, links and runs; every check that holds for any improvement is made here.
struct Improved {
    Mesh mesh;
    ImproveReport report;
    Analysed analysed;
    harmorph::Mesh view;
    Quality before, after;
    std::unique_ptr<Guarded> block;
    Improvement improvement;
    harmorph::FaceDistance walls;

    explicit Improved(Task const& task, harmorph::Executor const& executor = {}, bool runs = true,
                      ImproveOptions const& options = {})
        : mesh(task.now), analysed(task.reference), view(core_mesh(task.reference)) {
        auto const counts = harmorph::RegionCounts::of(analysed->topology());
        auto const lay_out = [&](harmorph::Arena& arena) {
            walls.lay_out(arena, task.reference.face_markers.size());
            improvement.lay_out(arena, counts);
        };
        block = laid_out(lay_out);
        walls.choose(analysed->boundary(),
                     [&](Index face) { return analysed->boundary().marker[face] == body; });
        walls.build(view.points);
        improvement.tangle = {view,
                              view.points,
                              analysed->topology().reversed,
                              analysed->topology().representative,
                              span(task.held),
                              span(task.line)};
        improvement.executor = executor;
        improvement.targets.find(analysed->topology(), walls, view.points, at(), executor);
        before = quality();
        if (!runs) return;
        improvement.run(options, at(), {mesh.x.data(), mesh.y.data(), 1}, report);
        after = quality();
        CHECK(block->guards_intact());
        CHECK(after.inverted == 0);
        for (std::size_t k = 0; k < task.held.size(); ++k) {
            if (task.held[k] == 0) continue;
            CHECK(mesh.x[k] == task.now.x[k]);
            CHECK(mesh.y[k] == task.now.y[k]);
        }
    }
    harmorph::Points at() const { return {mesh.x.data(), mesh.y.data(), 1}; }
    Quality quality() const {
        return harmorph::measure_quality(analysed->topology(), at(), view.points, {});
    }
    bool same_bits(Mesh const& other) const { return mesh.x == other.x && mesh.y == other.y; }
};

// The inner circle turns and what is between shears: valid, but poor.
Task sheared_annulus(Cells kind, double angle, int n = 12) {
    Task task(annulus(n, 3 * n, 0.5, 2, kind, true));
    for (std::size_t k = 0; k < task.held.size(); ++k) {
        double const radius = std::hypot(task.now.x[k], task.now.y[k]),
                     turn = angle * (2 - radius) / 1.5;
        double const c = std::cos(turn), s = std::sin(turn), x = task.reference.x[k],
                     y = task.reference.y[k];
        task.now.x[k] = c * x - s * y;
        task.now.y[k] = s * x + c * y;
    }
    return task;
}

}  // namespace

TEST_CASE("a mesh that is its own target does not change in any bit, however bad the mesh is") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Mesh mesh = square(12, kind);
        perturb(mesh, 0.6, 3);
        Improved const out{Task(mesh)};
        CHECK(out.same_bits(mesh));
        CHECK(out.report.iterations == 1);
    }
}

TEST_CASE("displaced points return to the mesh that was their target") {
    for (Cells const kind : {Cells::triangles, Cells::hybrid}) {
        Task task(square(12, kind));
        task.scatter(0.5, 4);
        ImproveOptions options;
        options.max_products = 500;
        Improved out(task, {}, false);
        out.improvement.begin(out.at());
        double before = HUGE_VAL, after = out.improvement.energy(0);
        while (after < before) {
            before = after;
            after = out.improvement.step(options, 0, before, out.report);
        }
        for (std::size_t k = 0; k < task.held.size(); ++k) {
            out.mesh.x[k] = out.improvement.now[Index(k)].x;
            out.mesh.y[k] = out.improvement.now[Index(k)].y;
        }
        INFO(out.report.iterations);
        CHECK(largest_distance(task.now, task.reference) > 0.02);
        CHECK(largest_distance(out.mesh, task.reference) < 1e-5);
    }
}

TEST_CASE(
    "the smallest quality of sheared rings rises, and the mean of fine rings loses at most 3 %") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid})
        for (bool const fine : {false, true}) {
            Improved const out(fine ? sheared_annulus(kind, 0.8, 40) : sheared_annulus(kind, 1.2));
            INFO(out.before.min_quality << " " << out.before.mean_quality() << " "
                                        << out.after.min_quality << " "
                                        << out.after.mean_quality());
            CHECK(out.after.min_quality > (fine ? 1.2 : 1.3) * out.before.min_quality);
            if (fine) CHECK(out.after.mean_quality() > 0.97 * out.before.mean_quality());
        }
}

TEST_CASE("the work of all steps is limited, and a larger limit does not give a worse mesh") {
    Task const task = sheared_annulus(Cells::quads, 2);
    double smallest = 0, mean = 0;
    for (double const work : {0.1, 10.0, 54.0, 200.0}) {
        ImproveOptions options;
        options.max_work = work;
        Improved const out(task, {}, true, options);
        // A step begins only below the limit: after the first product, a step is 4 blocks or more
        // for each point, and the whole mesh has at most 5.
        Index const n = out.report.unknowns;
        double const limit = work * options.max_iterations * n;
        CHECK(4.0 * n * (out.report.iterations - 1) < limit);
        if (work == 0.1) CHECK(out.report.iterations == 1);
        double const value = out.after.min_quality * out.after.mean_quality();
        CHECK(value >= (1 - 1e-12) * smallest * mean);
        smallest = out.after.min_quality;
        mean = out.after.mean_quality();
    }
}

TEST_CASE("only points near a cell that is not good enough move, until it is") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Task task(square(40, kind));
        std::size_t const middle = 20 * 41 + 20;  // its cells are still valid
        task.now.x[middle] += 0.95 / 40;
        ImproveOptions options;
        options.max_iterations = 0;
        Improved const still(task, {}, true, options);
        CHECK(still.same_bits(task.now));
        CHECK(still.before.min_quality < 0.75);
        options.enough = 0.75;
        Improved const out(task, {}, true, options);
        INFO(out.before.min_quality << " " << out.after.min_quality << " "
                                    << out.report.iterations);
        CHECK(out.after.min_quality >= 0.75);
        int n_moved = 0, n_far = 0;
        for (std::size_t k = 0; k < out.mesh.x.size(); ++k) {
            if (out.mesh.x[k] == task.now.x[k] && out.mesh.y[k] == task.now.y[k]) continue;
            ++n_moved;
            double const dx = task.reference.x[k] - task.reference.x[middle],
                         dy = task.reference.y[k] - task.reference.y[middle];
            n_far += std::fmax(std::fabs(dx), std::fabs(dy)) > 8.5 / 40 ? 1 : 0;
        }
        CHECK(n_moved > 1);
        CHECK(n_far == 0);
    }
}

TEST_CASE("every step lowers the energy of its power and leaves no cell inverted") {
    Task task = sheared_annulus(Cells::hybrid, 1.5);
    Improved out(task, {}, false);
    out.improvement.begin(out.at());
    int steps = 0;
    for (Index const power : {0, 2, 8, 32}) {
        double before = out.improvement.energy(power);
        for (int k = 0; k < 6; ++k) {
            double const after = out.improvement.step({}, power, before, out.report);
            CHECK(after <= before);
            CHECK(after == out.improvement.energy(power));
            steps += after < before;
            before = after;
            harmorph::Points const now = harmorph::as_points(out.improvement.now);
            CHECK(harmorph::measure_quality(out.analysed->topology(), now, {}, {}).inverted == 0);
        }
    }
    CHECK(steps > 12);
}

TEST_CASE("the gradient is that of the energy, also where targets depend on the mesh") {
    Task task(annulus(10, 30, 1, 1.8, Cells::hybrid));
    task.scatter(0.2, 6);
    for (std::size_t k = 0; k < 30; ++k) task.now.x[k] *= 0.98;
    Improved out(task, {}, false);
    for (Index const power : {0, 2, 8, 32}) {
        out.improvement.begin(out.at());
        double const energy = out.improvement.energy(power);
        out.improvement.step({}, power, energy, out.report);
        std::vector<Vec2> const gradient(out.improvement.system.gradient.begin(),
                                         out.improvement.system.gradient.end());
        double largest = 0;
        for (Vec2 const by : gradient) largest = std::fmax(largest, length(by));
        for (Index u = 0; u < out.improvement.region.n; u += 17) {
            auto const point = std::size_t(out.improvement.region.point[u]);
            auto const slope = [&](double& number) {
                double const old = number, h = 1e-7;
                number = old + h;
                out.improvement.begin(out.at());
                double const ahead = out.improvement.energy(power);
                number = old - h;
                out.improvement.begin(out.at());
                double const behind = out.improvement.energy(power);
                number = old;
                return (ahead - behind) / (2 * h);
            };
            Vec2 const by = gradient[std::size_t(u)];
            CHECK(std::fabs(by.x - slope(out.mesh.x[point])) < 1e-5 * largest);
            CHECK(std::fabs(by.y - slope(out.mesh.y[point])) < 1e-5 * largest);
        }
    }
}

TEST_CASE("turned, moved and scaled meshes are improved alike, and a power of two changes no bit") {
    Task const task = sheared_annulus(Cells::hybrid, 1.2);
    Improved const expected(task);
    for (Similarity const by :
         {Similarity{1, 1.1, 0, 0}, Similarity{1, 0, 3, -2}, Similarity{1e4, 0, 0, 0},
          Similarity{1e-7, 2, 1e-7, 0}, Similarity{0x1p20, 0, 0, 0}}) {
        Task moved = task;
        moved.reference = by.image(task.reference);
        moved.now = by.image(task.now);
        Improved const found(moved);
        CHECK(found.report.iterations == expected.report.iterations);
        CHECK(largest_distance(found.mesh, by.image(expected.mesh)) < 1e-8 * by.scale);
        if (by.scale == 0x1p20) CHECK(found.same_bits(by.image(expected.mesh)));
    }
}

TEST_CASE("numbering, first corners and orientation change an improved mesh by rounding only") {
    Task const plain = sheared_annulus(Cells::hybrid, 1.2);
    Improved const expected(plain);
    for (unsigned seed = 1; seed <= 3; ++seed) {
        Mesh reference = plain.reference, now = plain.now, wanted = expected.mesh;
        for (Mesh* const mesh : {&reference, &now, &wanted}) {
            renumber_points(*mesh, seed);
            shuffle_cells(*mesh, seed);
            rotate_starts(*mesh, seed);
            reverse_some(*mesh, seed);
        }
        Task task(reference);
        task.now = now;
        Improved const out(task);
        CHECK(largest_distance(out.mesh, wanted) < 1e-6);
    }
}

TEST_CASE("the number of threads changes no bit of an improved mesh") {
    Task const task = sheared_annulus(Cells::hybrid, 1.2);
    Improved const expected(task);
    for (std::int32_t const threads : {2, 3, 8}) {
        Backwards order;
        CHECK(Improved(task, {Backwards::run, &order, threads}).same_bits(expected.mesh));
        CHECK(order.tasks > 100);
    }
}

TEST_CASE("the points of a cut are improved as one") {
    CMesh const c = c_mesh(naca4({}, 24), 12, 3, stretched(1e-2, 4, 16));
    Task task(c.mesh);
    std::size_t const ni = std::size_t(c.ni);
    for (std::size_t k = 4; k < 8; ++k) {  // both copies of four points in the wake
        for (std::size_t const point : {k, ni - 1 - k}) task.now.y[point] += 0.004;
    }
    Improved const out(task);
    bool moved = false;
    for (std::size_t k = 0; k < 12; ++k) {
        CHECK(out.mesh.x[k] == out.mesh.x[ni - 1 - k]);
        CHECK(out.mesh.y[k] == out.mesh.y[ni - 1 - k]);
        moved = moved || out.mesh.y[k] != task.now.y[k];
    }
    CHECK(moved);
}

TEST_CASE("points that slip along an inclined line stay on the line and find better places") {
    double const c = std::cos(0.4), s = std::sin(0.4);
    Task task(square(10, Cells::hybrid));
    task.line.assign(task.held.size(), Vec2{});
    std::vector<std::size_t> slipping;
    for (std::size_t k = 0; k < task.held.size(); ++k) {
        double const x = task.reference.x[k], y = task.reference.y[k];
        task.now.x[k] =
            x + (y < 1 ? 0 : 0.25 * x * (1 - x));  // the top is squeezed to the right, and slips
        if (y == 1 && x > 0 && x < 1) {
            task.held[k] = 0;
            task.line[k] = {c, s};
            slipping.push_back(k);
        }
    }
    for (Mesh* const mesh : {&task.reference, &task.now}) {
        for (std::size_t k = 0; k < task.held.size(); ++k) {
            double const x = mesh->x[k], y = mesh->y[k];
            mesh->x[k] = c * x - s * y;
            mesh->y[k] = s * x + c * y;
        }
    }
    Task held = task;
    for (std::size_t const k : slipping) held.held[k] = 1;
    held.line.clear();
    Improved const out(task), stiff(held);
    double moved = 0;
    for (std::size_t const k : slipping) {
        double const height = -s * out.mesh.x[k] + c * out.mesh.y[k];
        CHECK(height == doctest::Approx(1).epsilon(1e-14));
        moved = std::fmax(moved,
                          std::hypot(out.mesh.x[k] - task.now.x[k], out.mesh.y[k] - task.now.y[k]));
    }
    CHECK(moved > 0.04);
    CHECK(out.after.min_quality > stiff.after.min_quality);
}
