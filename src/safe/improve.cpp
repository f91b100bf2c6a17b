#include "safe/improve.hpp"

#include "morph/admissible_step.hpp"
#include "morph/quality.hpp"
#include "safe/quality_energy.hpp"

namespace harmorph {
namespace {

// A step takes at most this share of the admissible step.
constexpr Real share_of_admissible = 0.9;
// Armijo's rule: the energy must fall by at least this part of what the slope promises.
constexpr Real least_slope = 1e-4;
constexpr Index most_halvings = 30;
// If a step promises a smaller relative decrease of the energy, the decrease is rounding.
constexpr Real at_rest = 1e-12;
// Where the power is large, Newton's step improves one of the worst cells only by a small factor;
// then a longer step is better.
constexpr Index most_doublings = 8;
// If the minimum of a power leaves less than this part of the smallest quality, this power has
// sacrificed a few cells for many others, and the next power would begin at such a mesh.
constexpr Real part_kept = 0.9;

struct Valid {
    bool all = true;
    void merge(Valid const& later) noexcept { all = all && later.all; }
};

}  // namespace

struct Improvement::Score {
    Real smallest = 1;  // the smallest ratio of quality and `least`, at most 1
    Real sum = 0;       // the sum of qualities

    void merge(Score const& later) noexcept {
        smallest = min(smallest, later.smallest);
        sum += later.sum;
    }
    bool is_better_than(Score const& other) const noexcept {
        return smallest > other.smallest || (smallest == other.smallest && sum > other.sum);
    }
};

void Improvement::lay_out(Arena& arena, RegionCounts const& counts) noexcept {
    region.lay_out(arena, counts);
    system.lay_out(arena, counts);
    targets.lay_out(arena, counts.cells);
    arena.take(now, counts.points);
    arena.take(change, counts.points);
    arena.take(ahead, counts.points);
    arena.take(best, counts.points);
}

void Improvement::run(ImproveOptions const& options, Points from, MutablePoints to,
                      ImproveReport& report) noexcept {
    report = {};
    begin(from);
    report.unknowns = region.n;
    copy(best, Span<const Vec2>(now));
    Score highest = score();
    for (Index const power : powers) {
        Index const left = options.most_iterations - report.iterations;
        Real const smallest = power > 0 ? score().smallest : 0;
        if (region.n == 0 || smallest >= 1) break;
        climb(options, power, min(left, most_for_power), highest, report);
        if (power > 0 && score().smallest < part_kept * smallest) break;
    }
    for (Index layers = least_layers;
         layers <= most_layers && begin_near_poor(options.enough, layers); layers *= 2) {
        highest = score();
        for (Index const power : powers_near_poor)
            climb(options, power, most_near_poor, highest, report);
    }
    for (Index k = 0; k < now.count(); ++k) to.set(k, best[k]);
}

// Begins at `now`. The best mesh on the way replaces `best`, the score of which is `highest`.
void Improvement::climb(ImproveOptions const& options, Index power, Index most_steps,
                        Score& highest, ImproveReport& report) noexcept {
    Real before = energy(power);
    for (Index k = 0; k < most_steps && before < infinity; ++k) {
        Real const after = step(options, power, before, report);
        Score const found = score();
        if (found.is_better_than(highest)) {
            highest = found;
            copy(best, Span<const Vec2>(now));
        }
        bool const gains = before - after > options.least_gain * before;
        before = after;
        if (!gains) break;
    }
}

// Begins at the best points so far. Returns false if no cell is below `enough`.
bool Improvement::begin_near_poor(Real enough, Index layers) noexcept {
    copy(now, Span<const Vec2>(best));
    sliding.turn_lines(as_points(now));
    fill(change, Vec2{});
    region.choose(
        [&](Index i) { return targets.quality(i, tangle.shape(i, as_points(now))) < enough; });
    if (region.n_cells == 0) return false;
    region.grow(tangle, layers);
    return region.n > 0;
}

void Improvement::begin(Points points) noexcept {
    for (Index k = 0; k < now.count(); ++k) now[k] = points[k];
    sliding.turn_lines(as_points(now));
    fill(change, Vec2{});
    region.link(tangle);
    region.grow(tangle, Region::whole);
}

Real Improvement::step(ImproveOptions const& options, Index power, Real before,
                       ImproveReport& report) noexcept {
    assemble(power);
    report.products += system.solve(region, options.most_products, executor);
    ++report.iterations;
    for_points([&](Index k, Vec2 step) { change[k] = step; });
    return descend(power, before);
}

Improvement::Score Improvement::score() const noexcept {
    return reduce_cells<Score>(region.n_cells, executor, [&](Index k, Score& result) {
        Index const cell = region.cell[k];
        Real const quality = targets.quality(cell, tangle.shape(cell, as_points(now)));
        result.merge({min(quality / targets.cell[cell].least, 1.0), quality});
    });
}

void Improvement::assemble(Index power) const noexcept {
    constexpr Real floor = QualityEnergy::least_curvature;
    system.assemble(
        tangle, region, executor, [&](Index cell, CornerPoints const& point, CornerForm& form) {
            Triangle const triangle = triangle_of(point, as_points(now));
            Real const share = targets.share(cell), least = targets.cell[cell].least;
            QualityEnergy const relative(targets.of(cell, point, triangle));
            relative.differentiate(triangle, share, floor, form);
            if (power == 0) return;
            QualityEnergy const measure(targets.ideal(cell, point, triangle), power, least * least);
            measure.differentiate(triangle, share, floor, form);
        });
}

Real Improvement::energy_of(Span<const Vec2> points, Index power) const noexcept {
    return reduce_cells<Sum>(
               region.n_cells, executor,
               [&](Index k, Sum& sum) {
                   Index const cell = region.cell[k];
                   CellTriangles const corners(tangle, cell);
                   Real const share = targets.share(cell), least = targets.cell[cell].least;
                   for (Index corner = 0; corner < corners.n; ++corner) {
                       CornerPoints const& point = corners.point[corner];
                       if (!region.can_move(point)) continue;
                       Triangle const triangle = triangle_of(point, as_points(points));
                       sum.value += share * QualityEnergy::energy(
                                                targets.sizes(cell, point, triangle), 1, 1);
                       if (power == 0) continue;
                       sum.value +=
                           share * QualityEnergy::energy(targets.ideal_sizes(cell, point, triangle),
                                                         power, least * least);
                   }
               })
        .value;
}

bool Improvement::is_valid(Span<const Vec2> points) const noexcept {
    if (region.n_cells >
        tangle.mesh.n_checked() / 2) {  // the kernels are faster if they measure most cells anyway
        return count_inverted({tangle.mesh, tangle.reversed}, as_points(points), executor) == 0;
    }
    return reduce_cells<Valid>(
               region.n_cells, executor,
               [&](Index k, Valid& valid) {
                   CellShape const shape = tangle.shape(region.cell[k], as_points(points));
                   valid.all = valid.all && !is_inverted(shape) && !is_inverted_exactly(shape);
               })
        .all;
}

Real Improvement::descend(Index power, Real before) noexcept {
    Real const slope = system.slope(region, executor);
    if (!(-slope > at_rest * before)) return before;
    OrientedMesh const cells{tangle.mesh, tangle.reversed};
    Real const most = share_of_admissible *
                      admissible_step(cells, as_points(now), as_points(change), executor).step;
    Real length = min(1.0, most), after = infinity;
    auto const falls_enough = [&] {
        look_ahead(length);
        after = energy_of(ahead, power);
        return after < before && after <= before + least_slope * length * slope && is_valid(ahead);
    };
    for (Index halvings = 0; !falls_enough(); length *= 0.5) {
        if (++halvings > most_halvings) return before;
    }
    for (Index doublings = 0; doublings < most_doublings && 2 * length <= most; ++doublings) {
        look_ahead(2 * length);
        Real const farther = energy_of(ahead, power);
        if (!(farther < after) || !is_valid(ahead)) break;
        after = farther;
        length *= 2;
    }
    look_ahead(length);
    copy(now, Span<const Vec2>(ahead));
    sliding.turn_lines(as_points(now));
    return after;
}

// Sets the points ahead to now + length * change, with sliding points on their curves.
void Improvement::look_ahead(Real length) const noexcept {
    executor.for_ranges(now.count(), 4096, [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
            bool const moves = region.unknown[k] != none;
            ahead[k] = moves ? sliding.placed(k, now[k] + length * change[k]) : now[k];
        }
    });
}

// Calls visit(point, step), where the step is that of the unknown that moves the point.
template <class Visit>
void Improvement::for_points(Visit const& visit) const noexcept {
    executor.for_ranges(now.count(), 4096, [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
            if (region.unknown[k] != none)
                visit(k, tangle.turned_alike(k, system.step[region.unknown[k]]));
        }
    });
}

}  // namespace harmorph
