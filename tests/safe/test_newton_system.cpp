// The Newton system: gradient against differences of the sum of energies, symmetry, and the
// conjugate gradients' step.
#include <fixtures/core.hpp>
#include <fixtures/mangle.hpp>
#include <fixtures/mesh.hpp>
#include <fixtures/guarded.hpp>

#include "safe/newton_system.hpp"
#include "safe/untangle.hpp"

using namespace fixtures;
using harmorph::Block;
using harmorph::Index;
using harmorph::Vec2;

namespace {

struct System {
    Mesh mesh;
    harmorph::Mesh view;
    std::vector<std::uint8_t> held;
    std::vector<Vec2> at;
    Analysed analysed;
    std::unique_ptr<Guarded> block;
    harmorph::Tangle tangle;
    harmorph::Region region;
    harmorph::NewtonSystem newton;

    // Inner points are thrown about by up to `reach`; the whole mesh is the region.
    System(Mesh const& given_mesh, double reach)
        : mesh(given_mesh),
          view(core_mesh(mesh)),
          held(mesh.x.size(), 0),
          at(mesh.x.size()),
          analysed(mesh) {
        std::mt19937 random(9);
        for (std::int32_t const point : mesh.faces) held[std::size_t(point)] = 1;
        for (std::size_t k = 0; k < at.size(); ++k) {
            double const dx = 2 * uniform(random) - 1, dy = 2 * uniform(random) - 1,
                         amount = held[k] != 0 ? 0 : reach;
            at[k] = {mesh.x[k] + amount * dx, mesh.y[k] + amount * dy};
        }
        auto const counts = harmorph::RegionCounts::of(analysed->topology());
        auto const lay_out = [&](harmorph::Arena& arena) {
            region.lay_out(arena, counts);
            newton.lay_out(arena, counts);
        };
        block = laid_out(lay_out);
        tangle = {view, view.points, analysed->topology().reversed,
                  analysed->topology().representative, span(held)};
        region.link(tangle);
        region.grow(tangle, harmorph::Region::whole);
    }
    void assemble(double softness) {
        newton.assemble(
            tangle, region, {},
            [&](Index, harmorph::CornerPoints const& point, harmorph::CornerForm& form) {
                harmorph::Distortion const distortion(triangle_of(point, tangle.reference));
                distortion.differentiate(triangle_of(point, harmorph::as_points(span(at))),
                                         softness, 0.1, form);
            });
    }
    double energy(double softness) const {
        double sum = 0;
        for (Index i = 0; i < view.n_cells; ++i) {
            harmorph::CellTriangles const corners(tangle.cell(i));
            for (Index k = 0; k < corners.n; ++k) {
                harmorph::Distortion const distortion(
                    triangle_of(corners.point[k], tangle.reference));
                sum += distortion.energy(
                    triangle_of(corners.point[k], harmorph::as_points(span(at))), softness);
            }
        }
        return sum;
    }
    // In a row are the blocks above the diagonal and those of other ranges.
    Block entry(Index u, Index v) const {
        for (auto k = region.start[u]; k < region.start[u + 1]; ++k)
            if (region.neighbour[k] == v) return newton.hessian[k];
        for (auto k = region.start[v]; k < region.start[v + 1]; ++k)
            if (region.neighbour[k] == u) return transpose(newton.hessian[k]);
        return {};
    }
    std::vector<Vec2> times(harmorph::Span<Vec2> v) const {
        std::vector<Vec2> out(std::size_t(region.n));
        for (Index u = 0; u < region.n; ++u)
            for (Index other = 0; other < region.n; ++other)
                out[std::size_t(u)] = out[std::size_t(u)] + entry(u, other) * v[other];
        return out;
    }
};

Mesh some_mesh() {
    Mesh mesh = square(8, Cells::hybrid);
    perturb(mesh, 0.3, 2);
    reverse_some(mesh, 3);
    return mesh;
}

}  // namespace

TEST_CASE("the gradient is that of the sum over all corners, on tangled meshes too") {
    System system(some_mesh(), 0.2);
    double const softness = 0.5, h = 1e-6;
    system.assemble(softness);
    double largest = 0;
    for (Index u = 0; u < system.region.n; ++u)
        largest = std::fmax(largest, length(system.newton.gradient[u]));
    for (Index u = 0; u < system.region.n; u += 5) {
        Vec2& point = system.at[std::size_t(system.region.point[u])];
        Vec2 const old = point;
        auto const slope = [&](Vec2 by) {
            point = old + h * by;
            double const ahead = system.energy(softness);
            point = old - h * by;
            double const behind = system.energy(softness);
            point = old;
            return (ahead - behind) / (2 * h);
        };
        CHECK(std::fabs(system.newton.gradient[u].x - slope({1, 0})) < 1e-6 * largest);
        CHECK(std::fabs(system.newton.gradient[u].y - slope({0, 1})) < 1e-6 * largest);
    }
}

TEST_CASE("the Hessian is symmetric and positive definite, and its diagonal blocks are inverted") {
    System system(some_mesh(), 0.2);
    system.assemble(0.1);
    for (Index u = 0; u < system.region.n; ++u) {
        Block const own = system.entry(u, u), inverse = system.newton.inverse[u];
        CHECK(own.a * inverse.a + own.b * inverse.c == doctest::Approx(1).epsilon(1e-10));
        CHECK(own.c * inverse.b + own.d * inverse.d == doctest::Approx(1).epsilon(1e-10));
        double const scale = own.a + own.d;
        for (Index const v : system.region.of(u)) {
            Block const there = system.entry(u, v), back = system.entry(v, u);
            CHECK(std::fabs(there.a - back.a) + std::fabs(there.d - back.d) < 1e-12 * scale);
            CHECK(std::fabs(there.b - back.c) + std::fabs(there.c - back.b) < 1e-12 * scale);
        }
    }
    std::mt19937 random(4);
    for (int trial = 0; trial < 20; ++trial) {
        for (Index u = 0; u < system.region.n; ++u)
            system.newton.search[u] = {uniform(random) - 0.5, uniform(random) - 0.5};
        std::vector<Vec2> const image = system.times(system.newton.search);
        double curvature = 0;
        for (Index u = 0; u < system.region.n; ++u)
            curvature += dot(system.newton.search[u], image[std::size_t(u)]);
        CHECK(curvature > 0);
        double product = 0, largest = 0, error = 0;
        for (Index range = 0; range < harmorph::reduced_ranges; ++range) {
            product +=
                system.newton.multiply(system.region, harmorph::range_start(system.region.n, range),
                                       harmorph::range_start(system.region.n, range + 1),
                                       system.newton.search, system.newton.image);
        }
        for (Index u = 0; u < system.region.n; ++u) {
            Vec2 const expected = image[std::size_t(u)];
            largest = std::fmax(largest, length(expected));
            error = std::fmax(error, length(system.newton.image[u] - expected));
        }
        CHECK(product == doctest::Approx(curvature).epsilon(1e-12));
        CHECK(error < 1e-13 * largest);
    }
}

TEST_CASE("the step descends, and more iterations bring the step nearer to Newton's") {
    System system(some_mesh(), 0.2);
    system.assemble(0.3);
    CHECK(system.newton.solve(system.region, 1, {}) == 1);
    CHECK(system.newton.slope(system.region, {}) < 0);
    Index const products = system.newton.solve(system.region, 1000, {});
    CHECK(products > 1);
    CHECK(products < 1000);
    CHECK(system.newton.slope(system.region, {}) < 0);
    // The residual in the norm in which it is measured: of the block diagonal's inverse.
    std::vector<Vec2> const image = system.times(system.newton.step);
    double rest = 0, whole = 0;
    for (Index u = 0; u < system.region.n; ++u) {
        Vec2 const gradient = system.newton.gradient[u], left = gradient + image[std::size_t(u)];
        rest += dot(left, system.newton.inverse[u] * left);
        whole += dot(gradient, system.newton.inverse[u] * gradient);
    }
    double const enough = harmorph::NewtonSystem::enough;
    CHECK(rest <= enough * enough * whole * (1 + 1e-6));
}

TEST_CASE("points whose cells have no energy stay") {
    System system(some_mesh(), 0.2);
    system.newton.assemble(
        system.tangle, system.region, {},
        [](Index, harmorph::CornerPoints const&, harmorph::CornerForm& form) { form = {}; });
    CHECK(system.newton.solve(system.region, 10, {}) == 0);
    for (Index u = 0; u < system.region.n; ++u) CHECK(length(system.newton.step[u]) == 0);
}
