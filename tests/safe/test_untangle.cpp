// Untangling makes meshes with inverted cells valid and keeps their boundary; impossible cases are
// refused.
#include <fixtures/airfoil.hpp>
#include <fixtures/mesh.hpp>
#include <fixtures/o_mesh.hpp>
#include <fixtures/core.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/guarded.hpp>
#include <fixtures/mangle.hpp>
#include <fixtures/traps.hpp>

#include "safe/untangle.hpp"

using namespace fixtures;
using harmorph::Status;
using harmorph::UntangleOptions;
using harmorph::UntangleReport;
using harmorph::Untangling;

namespace {

// The target positions of the points of a mesh, and their present positions.
struct Tangled {
    Mesh reference, now;
    std::vector<std::uint8_t> held;

    explicit Tangled(Mesh const& mesh) : reference(mesh), now(mesh), held(mesh.x.size(), 0) {
        for (std::int32_t const point : mesh.faces) held[std::size_t(point)] = 1;
    }
    bool is_held(std::size_t k) const { return held[k] != 0; }
    // Inner points go anywhere within `reach`.
    void scatter(double reach, unsigned seed) {
        std::mt19937 random(seed);
        for (std::size_t k = 0; k < held.size(); ++k) {
            double const dx = 2 * uniform(random) - 1, dy = 2 * uniform(random) - 1;
            if (is_held(k)) continue;
            now.x[k] += reach * dx;
            now.y[k] += reach * dy;
        }
    }
    // The points of one marker turn about the origin; the others stay.
    void turn(std::int32_t marker, double angle) {
        double const c = std::cos(angle), s = std::sin(angle);
        std::vector<char> turned(held.size(), 0);
        for (std::size_t k = 0; k < now.faces.size(); ++k)
            if (now.face_markers[k / 2] == marker) turned[std::size_t(now.faces[k])] = 1;
        for (std::size_t k = 0; k < turned.size(); ++k) {
            if (turned[k] == 0) continue;
            Point const p = reference.point(std::int32_t(k));
            now.x[k] = c * p.x - s * p.y;
            now.y[k] = s * p.x + c * p.y;
        }
    }
};

struct Outcome {
    Status status = Status::ok;
    UntangleReport report;
    harmorph::Fault fault;
    Mesh mesh;  // afterwards
    Analysed analysed;

    explicit Outcome(Tangled const& tangled, UntangleOptions const& options = {},
                     harmorph::Executor const& executor = {})
        : mesh(tangled.now), analysed(tangled.reference) {
        harmorph::Mesh const view = core_mesh(tangled.reference);
        auto const counts = harmorph::RegionCounts::of(analysed->topology());
        Untangling untangling;
        auto const block = laid_out_part(untangling, counts);
        untangling.tangle = {view, view.points, analysed->topology().reversed,
                             analysed->topology().representative, span(tangled.held)};
        untangling.executor = executor;
        status = untangling.run(options, {mesh.x.data(), mesh.y.data(), 1}, report, fault);
        CHECK(block->guards_intact());
    }

    // Returns the smallest ratio of a corner area to that of the reference, among corners that can
    // move.
    double smallest(Tangled const& tangled) const {
        double least = HUGE_VAL;
        harmorph::Mesh const view = core_mesh(tangled.reference);
        for (std::int32_t i = 0; i < view.n_cells; ++i) {
            harmorph::Cell const cell = view.cell(i);
            for (std::int32_t k = 0; k < cell.n; ++k) {
                std::int32_t const a = cell.point[k], b = cell.next(k), c = cell.previous(k);
                auto const fixed = [&](std::int32_t p) { return tangled.is_held(std::size_t(p)); };
                if (fixed(a) && fixed(b) && fixed(c)) continue;
                auto const area = [&](Mesh const& one) {
                    return twice_area(one.point(a), one.point(b), one.point(c));
                };
                least = std::fmin(least, area(mesh) / area(tangled.reference));
            }
        }
        return least;
    }
    bool same_bits(Mesh const& other) const { return mesh.x == other.x && mesh.y == other.y; }
};

void check_repaired(Tangled const& tangled, Outcome const& out, int at_least_inverted) {
    INFO("inverted " << out.report.inverted_before << ", iterations " << out.report.iterations
                     << ", smallest " << out.report.smallest);
    CHECK(out.report.inverted_before >= at_least_inverted);
    CHECK(out.status == Status::ok);
    CHECK(out.report.left == 0);
    CHECK(out.smallest(tangled) >= UntangleOptions{}.margin);
    bool boundary_stays = true;
    for (std::size_t k = 0; k < tangled.held.size(); ++k) {
        bool const stays = out.mesh.x[k] == tangled.now.x[k] && out.mesh.y[k] == tangled.now.y[k];
        boundary_stays = boundary_stays && (stays || !tangled.is_held(k));
    }
    CHECK(boundary_stays);
}

Tangled twisted_annulus(Cells kind, double angle) {
    Tangled tangled(annulus(16, 64, 0.4, 2, kind, true));
    tangled.turn(body, angle);
    return tangled;
}

}  // namespace

TEST_CASE("squares whose inner points were displaced at random become valid") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Tangled tangled(square(40, kind));
        tangled.scatter(2.0 / 40, 5);
        check_repaired(tangled, Outcome(tangled), 1000);
    }
}

TEST_CASE("rings whose inner circle turns become valid") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid})
        for (double const angle : {0.5, 1.0, -2.0}) {
            Tangled const tangled = twisted_annulus(kind, angle);
            check_repaired(tangled, Outcome(tangled), 64);
        }
}

TEST_CASE("viscous layers under which the airfoil turns become valid") {
    Tangled tangled(o_mesh(naca4({}, 40), stretched(1e-4, 10, 30), Cells::hybrid));
    for (double const angle : {0.05, 0.3}) {
        tangled.turn(body, angle);
        check_repaired(tangled, Outcome(tangled), 40);
    }
}

TEST_CASE("a valid mesh stays unchanged bit by bit, however bad the mesh is") {
    Tangled tangled(square(12, Cells::hybrid));
    perturb(tangled.now, 0.6, 3);
    Outcome const out(tangled);
    CHECK(out.status == Status::ok);
    CHECK(out.report.inverted_before == 0);
    CHECK(out.report.iterations == 0);
    CHECK(out.same_bits(tangled.now));
}

TEST_CASE("points that are far from a few inverted cells do not move") {
    Tangled tangled(square(60, Cells::hybrid));
    std::size_t const inner = 61 * 20 + 20;
    tangled.now.x[inner] += 2.5 / 60;
    UntangleOptions options;
    options.layers = 3;
    Outcome const out(tangled, options);
    check_repaired(tangled, out, 2);
    CHECK(out.report.regions == 1);
    CHECK(out.report.unknowns < 100);
    double farthest = 0;  // in cells
    for (std::size_t k = 0; k < tangled.held.size(); ++k) {
        if (out.mesh.x[k] == tangled.now.x[k] && out.mesh.y[k] == tangled.now.y[k]) continue;
        Point const p = tangled.reference.point(std::int32_t(k));
        farthest = std::fmax(
            farthest, 60 * std::fmax(std::fabs(p.x - 20 / 60.0), std::fabs(p.y - 20 / 60.0)));
    }
    CHECK(farthest > 0.5);
    CHECK(farthest < 7.5);
}

TEST_CASE("a region that is too small is replaced by a larger one") {
    Tangled const tangled = twisted_annulus(Cells::triangles, 1.0);
    UntangleOptions options;
    options.layers = 1;
    options.iterations_in_part = 5;
    Outcome const out(tangled, options);
    check_repaired(tangled, out, 64);
    CHECK(out.report.regions > 1);
    CHECK(out.report.iterations > 5);
}

TEST_CASE("turned, moved and scaled meshes are repaired alike, and a power of two changes no bit") {
    Tangled const tangled = twisted_annulus(Cells::hybrid, 0.6);
    Outcome const expected(tangled);
    for (Similarity const by :
         {Similarity{1, 1.1, 0, 0}, Similarity{1, 0, 3, -2}, Similarity{1e4, 0, 0, 0},
          Similarity{1e-7, 2, 1e-7, 0}, Similarity{0x1p20, 0, 0, 0}}) {
        Tangled moved = tangled;
        moved.reference = by.image(tangled.reference);
        moved.now = by.image(tangled.now);
        Outcome const found(moved);
        CHECK(found.report.iterations == expected.report.iterations);
        CHECK(largest_distance(found.mesh, by.image(expected.mesh)) < 1e-9 * by.scale);
        if (by.scale == 0x1p20) CHECK(found.same_bits(by.image(expected.mesh)));
    }
}

TEST_CASE("other numberings, first corners and mixed orientation are repaired too") {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        Tangled const plain = twisted_annulus(Cells::hybrid, 0.7);
        Mesh both = plain.reference, target = plain.now;
        for (Mesh* const mesh : {&both, &target}) {
            renumber_points(*mesh, seed);
            shuffle_cells(*mesh, seed);
            rotate_starts(*mesh, seed);
        }
        Tangled sorted(both);
        sorted.now = target;
        check_repaired(sorted, Outcome(sorted), 64);

        Tangled mixed = sorted;
        reverse_some(mixed.reference, seed);
        reverse_some(mixed.now, seed);
        Outcome const out(mixed);
        check_repaired(mixed, out, 64);
        Mesh straight = out.mesh;
        straight.cells = sorted.now.cells;
        CHECK(check(straight).min_corner > 0);
    }
}

TEST_CASE("the points of a cut move as one") {
    CMesh const c = c_mesh(naca4({}, 24), 12, 3, stretched(1e-3, 4, 16));
    Tangled tangled(c.mesh);
    std::size_t const ni = std::size_t(c.ni);
    for (std::size_t k = 4; k < 8;
         ++k) {  // both copies of four points in the wake go up by some layers
        for (std::size_t const point : {k, ni - 1 - k}) tangled.now.y[point] += 0.1;
    }
    REQUIRE(tangled.now.y[5] == tangled.now.y[ni - 6]);
    Outcome const out(tangled);
    check_repaired(tangled, out, 4);
    bool moved = false;
    for (std::size_t k = 0; k < 12; ++k) {
        CHECK(out.mesh.x[k] == out.mesh.x[ni - 1 - k]);
        CHECK(out.mesh.y[k] == out.mesh.y[ni - 1 - k]);
        moved = moved || out.mesh.y[k] != tangled.now.y[k];
    }
    CHECK(moved);
}

TEST_CASE("the number of threads changes no bit") {
    Tangled const tangled = twisted_annulus(Cells::hybrid, 0.8);
    Outcome const expected(tangled);
    for (std::int32_t const threads : {2, 3, 8}) {
        Backwards order;
        harmorph::Executor const executor{Backwards::run, &order, threads};
        CHECK(Outcome(tangled, {}, executor).same_bits(expected.mesh));
        CHECK(order.tasks > 100);
    }
}

TEST_CASE("a body across the outer boundary is refused after the given iterations") {
    Tangled tangled(annulus(8, 32, 0.5, 2, Cells::hybrid, true));
    for (std::size_t k = 0; k < 32; ++k) tangled.now.x[k] += 2;
    UntangleOptions options;
    options.iterations_in_part = 4;
    options.iterations_in_whole = 12;
    Outcome const out(tangled, options);
    CHECK(out.status == Status::not_converged);
    CHECK(out.report.inverted_before > 0);
    CHECK(out.report.left > 0);
    CHECK(out.report.iterations <= 4 * (out.report.regions - 1) + 12);
    CHECK(out.report.iterations > 12);
    CHECK(out.same_bits(tangled.now));
}

TEST_CASE("a corner that no movement can change is found at once") {
    Tangled tangled(square(6, Cells::quads));
    tangled.now.x[0] = tangled.now.y[0] =
        0.4;  // the square's own corner, folded over its cell's diagonal
    Outcome const out(tangled);
    CHECK(out.status == Status::not_converged);
    CHECK(out.report.stuck_cell == 0);
    CHECK(out.report.iterations == 0);
    CHECK(out.same_bits(tangled.now));
}

TEST_CASE("an inverted reference is refused; coordinates that are not finite are not repaired") {
    Tangled tangled(square(6, Cells::hybrid));
    std::swap(tangled.reference.x[24], tangled.reference.x[25]);
    tangled.scatter(0.3, 1);
    Outcome const out(tangled);
    CHECK(out.status == Status::bad_mesh);
    CHECK(out.fault.item.number >= 0);
    CHECK(out.same_bits(tangled.now));

    Tangled undefined(square(6, Cells::hybrid));
    Untrapped const untrapped;
    undefined.now.x[24] = std::nan("");
    CHECK(Outcome(undefined).status == Status::not_converged);
}
