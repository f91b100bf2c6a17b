#include "safe/untangle.hpp"

namespace harmorph {

Real Distortion::energy(Triangle const& now, Real softness) const noexcept {
    Real const d = determinant(now), chi = regularised(d, softness);
    if (chi == 0) return infinity;  // a division by 0 would trap if the caller traps exceptions
    return (2 * (square(map_.z(now)) + square(map_.w(now))) + size_weight * (d * d + 1)) / chi;
}

DensityDerivatives Distortion::derivatives(Triangle const& now, Real softness) const noexcept {
    Real const p = square(map_.z(now)), q = square(map_.w(now)), d = determinant(now);
    Real const root = sqrt(softness * softness + d * d);
    Real const numerator = 2 * (p + q) + size_weight * (d * d + 1);
    Real const scale = 1 / regularised(d, softness);
    // The first and the second derivative of 1 / chi by the determinant.
    Real const slope = -scale / root, bend = 2 / (root * root * root);
    Real const grow = 2 + 2 * size_weight * d;    // the derivative of the numerator by p
    Real const shrink = 2 - 2 * size_weight * d;  // the derivative of the numerator by q
    DensityDerivatives by;
    by.by_p = grow * scale + numerator * slope;
    by.by_q = shrink * scale - numerator * slope;
    by.by_pp = 2 * size_weight * scale + 2 * grow * slope + numerator * bend;
    by.by_qq = 2 * size_weight * scale - 2 * shrink * slope + numerator * bend;
    by.by_pq = -2 * size_weight * scale - 4 * size_weight * d * slope - numerator * bend;
    by.unit = 4 * scale;
    return by;
}
namespace {

// Flat directions get this part of the curvature of |J|^2 / chi, so that steps stay bounded.
constexpr Real min_curvature = 0.1;
// A factorisation of the Hessian of all points takes about as long as so many products with it.
constexpr Real products_of_solution = 100;

struct Smallest {
    Real value = infinity;
    // NaN counts as the worst value, and remains.
    void merge(Smallest const& later) noexcept {
        if (!(later.value >= value)) value = later.value == later.value ? later.value : -infinity;
    }
};

}  // namespace

void Untangling::lay_out(Arena& arena, RegionCounts const& counts) noexcept {
    region.lay_out(arena, counts);
    system.lay_out(arena, counts);
    arena.take(now, counts.points);
    arena.take(trial, counts.points);
}

Status Untangling::run(UntangleOptions const& options, MutablePoints points, UntangleReport& report,
                       Fault& fault) noexcept {
    report = {};
    Points const given{points.x, points.y, points.stride};
    region.choose([&](Index i) { return is_inverted(tangle.shape(i, given)); });
    report.inverted_before = report.left = region.n_cells;
    if (region.n_cells == 0) return Status::ok;
    for (Index k = 0; k < now.count(); ++k) now[k] = given[k];
    slipping.rotate_lines(as_points(now));
    region.link(tangle);
    for (Index const i : region.cell.first(region.n_cells)) {
        if (!is_stuck(i)) continue;
        report.stuck_cell = i;
        return Status::not_converged;
    }
    // Each region surrounds the inverted cells that the previous one left, and begins with the mesh
    // that the previous one ended with.
    for (Index layers = max(options.layers, Index{1}); region.n_cells > 0; layers *= 2) {
        region.grow(tangle, layers);
        // A region that has not grown is all that can move.
        bool const is_whole =
            layers >= Region::whole || (report.regions > 0 && region.n == report.unknowns);
        HARMORPH_TRY(check_reference(fault));
        ++report.regions;
        report.unknowns = region.n;
        repair_region(options, is_whole ? options.iterations_in_whole : options.iterations_in_part,
                      report);
        region.keep([&](Index i) { return !is_good(i, options.margin); });
        if (is_whole && region.n_cells > 0) break;
    }
    region.keep(
        [&](Index i) { return !is_good(i, 0); });  // thin cells of the whole mesh count as valid
    report.left = region.n_cells;
    if (region.n_cells > 0) return Status::not_converged;
    write(points);
    return Status::ok;
}

Status Untangling::check_reference(Fault& fault) const noexcept {
    for (Index const i : region.cell.first(region.n_cells)) {
        if (!is_inverted(tangle.shape(i, tangle.reference))) continue;
        return fault.refuse(Status::bad_mesh, "cell # of the reference mesh is inverted",
                            cell_item(tangle.mesh.number(i)));
    }
    return Status::ok;
}

bool Untangling::is_stuck(Index cell) const noexcept {
    CellTriangles const corners(tangle, cell);
    for (Index k = 0; k < corners.n; ++k) {
        CornerPoints const& triangle = corners.point[k];
        auto const is_held = [&](Index point) {
            return tangle.held[tangle.representative[point]] != 0;
        };
        bool const held = is_held(triangle[0]) && is_held(triangle[1]) && is_held(triangle[2]);
        if (held && !(triangle_of(triangle, as_points(now)).twice_area() > 0)) return true;
    }
    return false;
}

bool Untangling::is_good(Index cell, Real margin) const noexcept {
    CellTriangles const corners(tangle, cell);
    for (Index k = 0; k < corners.n; ++k) {
        CornerPoints const& triangle = corners.point[k];
        Real const area = triangle_of(triangle, as_points(now)).twice_area();
        Real const wanted = triangle_of(triangle, tangle.reference).twice_area();
        Real const min_area = region.can_move(triangle) ? margin * wanted : 0;
        if (!(area > 0 && area >= min_area)) return false;
    }
    return true;
}

void Untangling::repair_region(UntangleOptions const& options, Index max_iterations,
                               UntangleReport& report) noexcept {
    constexpr Real min_gain =
        0.1;  // the softness falls at least by this part, even if the energy does not
    copy(trial, Span<const Vec2>(now));
    Real smallest = smallest_determinant();
    Real softness = sqrt(1e-12 + 0.04 * smallest * smallest);
    for (Index k = 0; k < max_iterations; ++k) {
        Real const before = energy(now, softness);
        if (!is_finite(before) || report.work >= options.max_work) return;
        assemble(softness);
        Index const products = system.solve(region, options.max_products, executor);
        report.products += products;
        report.work += static_cast<Real>(products) * static_cast<Real>(region.n) /
                       (products_of_solution * static_cast<Real>(now.count()));
        ++report.iterations;
        Real const after = descend(softness, before);
        smallest = smallest_determinant();
        report.smallest = smallest;
        if (smallest >= options.goal) return;
        bool const at_rest = softness == 0 && after > (1 - 1e-4) * before;
        if (smallest >= options.margin && at_rest) return;
        Real const wanted =
            (1 - max(1 - after / before, min_gain)) * regularised(smallest, softness);
        softness = wanted > smallest ? 2 * sqrt(wanted * (wanted - smallest)) : 0;
    }
}

void Untangling::assemble(Real softness) const noexcept {
    Points const at = as_points(now);
    system.assemble(
        tangle, region, executor, [&](Index, CornerPoints const& point, CornerForm& form) {
            Distortion const distortion(triangle_of(point, tangle.reference));
            distortion.differentiate(triangle_of(point, at), softness, min_curvature, form);
        });
}

// Halves the step until the energy falls enough (Armijo's rule). Returns the energy; if no step
// lowers it enough, no point moves.
Real Untangling::descend(Real softness, Real before) noexcept {
    constexpr Index max_halvings = 30;
    Real const slope = system.slope(region, executor);
    auto const for_points = [&](auto const& body) {
        executor.for_ranges(now.count(), 4096, [&](Index begin, Index end) {
            for (Index k = begin; k < end; ++k) {
                if (region.unknown[k] != none)
                    body(k, tangle.rotated_alike(k, system.step[region.unknown[k]]));
            }
        });
    };
    Real length = 1;
    for (Index halvings = 0; halvings < max_halvings; ++halvings, length *= 0.5) {
        for_points([&](Index point, Vec2 step) {
            trial[point] = slipping.placed(point, now[point] + length * step);
        });
        Real const after = energy(trial, softness);
        if (!(after <= before + 1e-4 * length * slope)) continue;
        for_points([&](Index point, Vec2) { now[point] = trial[point]; });
        slipping.rotate_lines(as_points(now));
        return after;
    }
    return before;
}

Real Untangling::energy(Span<const Vec2> at, Real softness) const noexcept {
    Points const points = as_points(at);
    return reduce_cells<Sum>(
               region.n_cells, executor,
               [&](Index k, Sum& sum) {
                   CellTriangles const corners(tangle, region.cell[k]);
                   for (Index corner = 0; corner < corners.n; ++corner) {
                       CornerPoints const& triangle = corners.point[corner];
                       if (!region.can_move(triangle)) continue;
                       Distortion const distortion(triangle_of(triangle, tangle.reference));
                       sum.value += distortion.energy(triangle_of(triangle, points), softness);
                   }
               })
        .value;
}

Real Untangling::smallest_determinant() const noexcept {
    return reduce_cells<Smallest>(
               region.n_cells, executor,
               [&](Index k, Smallest& smallest) {
                   CellTriangles const corners(tangle, region.cell[k]);
                   for (Index corner = 0; corner < corners.n; ++corner) {
                       CornerPoints const& triangle = corners.point[corner];
                       if (!region.can_move(triangle)) continue;
                       Real const wanted = triangle_of(triangle, tangle.reference).twice_area();
                       smallest.merge(
                           {triangle_of(triangle, as_points(now)).twice_area() / wanted});
                   }
               })
        .value;
}

void Untangling::write(MutablePoints points) const noexcept {
    for (Index k = 0; k < now.count(); ++k) {
        if (tangle.held[tangle.representative[k]] == 0) points.set(k, now[k]);
    }
}

}  // namespace harmorph
