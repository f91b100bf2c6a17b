#include "harmorph/untangle.hpp"

namespace harmorph {
namespace {

struct Least {
    Real value = infinity;
    // NaN counts as the worst there is, and stays.
    void merge(Least const& later) noexcept {
        if (!(later.value >= value)) value = later.value == later.value ? later.value : -infinity;
    }
};

struct Count {
    Index value = 0;
    void merge(Count const& later) noexcept { value += later.value; }
};

bool is_inverted(Cell const& cell, Points points) noexcept {
    return !(CellCorners(CellShape(cell, points, false)).smallest() > 0);
}

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
    report.inverted_before = report.inverted_after = count_inverted(given);
    if (report.inverted_before == 0) return Status::ok;
    HARMORPH_TRY(check_reference(fault));
    for (Index k = 0; k < now.count(); ++k) now[k] = given[tangle.representative[k]];
    report.stuck_cell = find_stuck_cell();
    if (report.stuck_cell != none) return Status::not_converged;

    // The next region is round what the last one left inverted, and begins where that ended.
    for (Index layers = options.layers;; layers = smaller(2 * layers, Region::whole)) {
        bool const is_whole = layers >= Region::whole;
        region.grow(tangle, as_points(now), layers);
        ++report.regions;
        report.unknowns = region.n;
        Index const most_iterations = is_whole ? options.iterations_in_whole : options.iterations_in_part;
        bool const good = repair_region(options, most_iterations, report);
        report.inverted_after = count_inverted(as_points(now));
        if (good && report.inverted_after == 0) break;
        if (is_whole) return Status::not_converged;
    }
    write(points);
    return Status::ok;
}

Status Untangling::check_reference(Fault& fault) const noexcept {
    for (Index i = 0; i < tangle.mesh.n_cells; ++i) {
        if (!is_inverted(tangle.cell(i), tangle.reference)) continue;
        return fault.refuse(Status::bad_mesh, "cell # of the reference mesh is inverted", Counts::mesh, i);
    }
    return Status::ok;
}

Index Untangling::count_inverted(Points points) const noexcept {
    return reduce_cells<Count>(tangle.mesh.n_cells, executor, [&](Index i, Count& count) {
        count.value += is_inverted(tangle.cell(i), points) ? 1 : 0;
    }).value;
}

Index Untangling::find_stuck_cell() const noexcept {
    for (Index i = 0; i < tangle.mesh.n_cells; ++i) {
        CellTriangles const corners(tangle.cell(i));
        for (Index k = 0; k < corners.n; ++k) {
            bool held = true;
            for (Index const point : corners.point[k]) held = held && tangle.held[point] != 0;
            if (held && !(triangle_of(corners.point[k], as_points(now)).twice_area() > 0)) return i;
        }
    }
    return none;
}

bool Untangling::repair_region(UntangleOptions const& options, Index most_iterations, UntangleReport& report) noexcept {
    constexpr Real least_gain = 0.1;  // however little the energy falls, the softness does
    copy(trial, Span<const Vec2>(now));
    Real smallest = smallest_determinant();
    Real softness = square_root(1e-12 + 0.04 * smallest * smallest);
    for (Index k = 0; k < most_iterations; ++k) {
        Real const before = energy(now, softness);
        if (!is_finite(before)) return false;
        system.assemble(tangle, region, now, softness, executor);
        report.products += system.solve(region, options.most_products, executor);
        ++report.iterations;
        Real const after = descend(softness, before);
        smallest = smallest_determinant();
        report.smallest = smallest;
        if (smallest >= options.goal) return true;
        bool const at_rest = softness == 0 && after > (1 - 1e-4) * before;
        if (smallest >= options.margin && at_rest) return true;
        Real const wanted = (1 - larger(1 - after / before, least_gain)) * regularised(smallest, softness);
        softness = wanted > smallest ? 2 * square_root(wanted * (wanted - smallest)) : 0;
    }
    return smallest >= options.margin;
}

// Halves the step until the energy falls enough (Armijo's rule). Returns the energy; if no step helps, nothing moves.
Real Untangling::descend(Real softness, Real before) noexcept {
    constexpr Index most_halvings = 30;
    Real const slope = system.slope(region, executor);
    auto const for_unknowns = [&](auto const& body) {
        executor.for_ranges(region.n, 4096, [&](Index begin, Index end) {
            for (Index u = begin; u < end; ++u) body(u, region.point[u]);
        });
    };
    Real length = 1;
    for (Index halvings = 0; halvings < most_halvings; ++halvings, length *= 0.5) {
        for_unknowns([&](Index u, Index point) { trial[point] = now[point] + length * system.step[u]; });
        Real const after = energy(trial, softness);
        if (!(after <= before + 1e-4 * length * slope)) continue;
        for_unknowns([&](Index, Index point) { now[point] = trial[point]; });
        return after;
    }
    return before;
}

Real Untangling::energy(Span<const Vec2> at, Real softness) const noexcept {
    Points const points = as_points(at);
    return reduce_cells<Sum>(region.n_cells, executor, [&](Index k, Sum& sum) {
        CellTriangles const corners(tangle.cell(region.cell[k]));
        for (Index corner = 0; corner < corners.n; ++corner) {
            const Index(&its)[3] = corners.point[corner];
            if (!region.can_move(its)) continue;
            sum.value += Distortion(triangle_of(its, tangle.reference)).energy(triangle_of(its, points), softness);
        }
    }).value;
}

Real Untangling::smallest_determinant() const noexcept {
    return reduce_cells<Least>(region.n_cells, executor, [&](Index k, Least& least) {
        CellTriangles const corners(tangle.cell(region.cell[k]));
        for (Index corner = 0; corner < corners.n; ++corner) {
            const Index(&its)[3] = corners.point[corner];
            if (!region.can_move(its)) continue;
            Real const wanted = triangle_of(its, tangle.reference).twice_area();
            least.merge({triangle_of(its, as_points(now)).twice_area() / wanted});
        }
    }).value;
}

void Untangling::write(MutablePoints points) const noexcept {
    for (Index k = 0; k < now.count(); ++k) {
        Index const its = tangle.representative[k];
        if (tangle.held[its] == 0) points.set(k, now[its]);
    }
}

}  // namespace harmorph
