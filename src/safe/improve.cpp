#include "safe/improve.hpp"

#include "morph/admissible_step.hpp"
#include "morph/quality.hpp"

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
// Part of the work that steps of the whole mesh may use.
constexpr Real share_of_whole = 0.65;
// Cells are raised only if the quality of one of them, divided by `least` or by the smallest of the
// given mesh, was less than this number, so that a small movement changes the mesh little.
constexpr Real clearly_below = 0.999;
// Measured times for one block of the Hessian, in products with the block: computing the block for
// each of the two terms of the energy, and the energy. Those of a region or a step that do not
// depend on the size of the region are for each block of the whole mesh.
constexpr Real work_of_first = 20, work_of_second = 7, work_of_energy = 6.5, work_of_region = 10,
               work_of_step = 5;

struct Valid {
    bool all = true;
    void merge(Valid const& later) noexcept { all = all && later.all; }
};

}  // namespace

void Improvement::lay_out(Arena& arena, RegionCounts const& counts) noexcept {
    region.lay_out(arena, counts);
    system.lay_out(arena, counts);
    targets.lay_out(arena, counts.cells);
    arena.take(now, counts.points);
    arena.take(change, counts.points);
    arena.take(ahead, counts.points);
    arena.take(best, counts.points);
    arena.take(quality, counts.cells);
}

void Improvement::run(ImproveOptions const& options, Points from, MutablePoints to,
                      ImproveReport& report) noexcept {
    report = {};
    lowest = options.lowest;
    begin(from);
    report.unknowns = region.n;
    copy(best, Span<const Vec2>(now));
    Score highest = score();
    if (region.n > 0) {
        Real const most_work = options.most_work * static_cast<Real>(options.most_iterations) *
                               static_cast<Real>(region.n);
        Real const given = highest.smallest;
        Score found = highest;
        climb(options, 0, min(options.most_in_whole, options.most_iterations),
              share_of_whole * most_work, found, highest, report);
        if (min(given, min(found.smallest, found.lowest)) < clearly_below)
            raise_worst(options, most_work, found, highest, report);
    }
    for (Index layers = least_layers; options.enough > 0 && layers <= most_layers; layers *= 2) {
        begin(as_points(best));
        Score found = score();
        if (!begin_near(options.enough, 0, layers)) break;
        for (Index const power : powers_near_poor)
            climb(options, power, most_near_poor, infinity, found, highest, report);
    }
    for (Index k = 0; k < now.count(); ++k) to.set(k, best[k]);
}

// Begins at `now`. The best mesh on the way replaces `best`, the score of which is `highest`.
// `found` is the score of the last mesh.
void Improvement::climb(ImproveOptions const& options, Index power, Index most_steps,
                        Real most_work, Score& found, Score& highest,
                        ImproveReport& report) noexcept {
    Real before = energy(power);
    for (Index k = 0; k < most_steps && before < infinity && work < most_work; ++k) {
        Real const after = step(options, power, before, report);
        found = score();
        if (found.is_better_than(highest)) {
            highest = found;
            copy(best, Span<const Vec2>(now));
        }
        bool const gains = before - after > options.least_gain * before;
        before = after;
        if (!gains) break;
    }
}

// Moves points near the cells that are not much better than the worst one. The last power is
// repeated as long as the worst cell rises.
void Improvement::raise_worst(ImproveOptions const& options, Real most_work, Score found,
                              Score& highest, ImproveReport& report) noexcept {
    constexpr Real width = 1.5, least_part = 0.6, most_part = 0.999, least_rise = 1.005;
    constexpr Index n_powers = sizeof powers_of_worst / sizeof *powers_of_worst;
    for (Index k = 0; work < most_work && report.iterations < options.most_iterations; ++k) {
        Real const smallest = found.smallest;
        if (!begin_near(0, min(most_part, max(least_part, width * smallest)), layers_of_worst))
            return;
        work += work_of_region * n_blocks;
        climb(options, powers_of_worst[min(k, n_powers - 1)],
              min(most_for_power, options.most_iterations - report.iterations), most_work, found,
              highest, report);
        if (k + 1 >= n_powers && found.smallest < least_rise * smallest) return;
    }
}

// A block between two ranges is stored in both rows.
void Improvement::count_blocks() noexcept {
    Offset twice = 0;
    for (Index u = 0; u < region.n; ++u)
        twice += region.outer_start[u] - region.start[u] + region.start[u + 1] - region.start[u];
    n_region_blocks = 0.5 * static_cast<Real>(twice);
}

// Begins at `now`, near cells whose quality is below `enough` or below this part of their aim.
// Returns false if there is none.
bool Improvement::begin_near(Real enough, Real part_of_aim, Index layers) noexcept {
    sliding.turn_lines(as_points(now));
    fill(change, Vec2{});
    region.choose([&](Index i) {
        return quality[i] >= 0 &&
               quality[i] < max(enough, part_of_aim * targets.aim * targets.cell[i].least);
    });
    if (region.n_cells == 0) return false;
    region.grow(tangle, layers);
    count_blocks();
    outside = reduce_cells<Score>(region.cell.count(), executor, [&](Index i, Score& result) {
        Cell const cell = tangle.cell(i);
        bool is_in_region = quality[i] < 0;
        for (Index k = 0; k < cell.n; ++k)
            is_in_region = is_in_region || region.unknown[cell.point[k]] != none;
        if (!is_in_region) result.merge(score_of(i));
    });
    return region.n > 0;
}

void Improvement::begin(Points points) noexcept {
    for (Index k = 0; k < now.count(); ++k) now[k] = points[k];
    sliding.turn_lines(as_points(now));
    fill(change, Vec2{});
    fill(quality, Real{-1});
    region.link(tangle);
    region.grow(tangle, Region::whole);
    count_blocks();
    n_blocks = n_region_blocks;
    work = 0;
    outside = {};
}

Real Improvement::step(ImproveOptions const& options, Index power, Real before,
                       ImproveReport& report) noexcept {
    assemble(power);
    Index const products = system.solve(region, options.most_products, executor);
    report.products += products;
    ++report.iterations;
    work += static_cast<Real>(products) * n_region_blocks + work_of_step * n_blocks;
    for_points([&](Index k, Vec2 step) { change[k] = step; });
    return descend(power, before);
}

Improvement::Score Improvement::score_of(Index cell) const noexcept {
    Targets::Cell const& target = targets.cell[cell];
    Real const found = quality[cell];
    bool const is_reported = lowest > 0 && !target.is_part;
    return {is_reported ? min(found / lowest, 1.0) : 1, min(found / target.least, targets.aim),
            found};
}

// Finds the qualities of the cells in the region.
Improvement::Score Improvement::score() const noexcept {
    Score all = outside;
    all.merge(reduce_cells<Score>(region.n_cells, executor, [&](Index k, Score& result) {
        Index const cell = region.cell[k];
        quality[cell] = targets.quality(cell, tangle.shape(cell, as_points(now)));
        result.merge(score_of(cell));
    }));
    return all;
}

void Improvement::assemble(Index power) noexcept {
    work += (work_of_first + (power > 0 ? work_of_second : 0)) * n_region_blocks;
    system.assemble_lists(tangle, region, executor, [&] {
        return CornerEnergies(targets, executor.kernel, as_points(now), power);
    });
}

Real Improvement::energy_of(Span<const Vec2> points, Index power) const noexcept {
    return reduce_ranges<Sum>(
               region.n_cells, executor,
               [&](Index begin, Index end, Sum& sum) {
                   CornerEnergies list(targets, executor.kernel, as_points(points), power);
                   for (Index k = begin; k < end;) {
                       list.clear();
                       for (Index const part = min(end, k + CornerEnergies::most_cells); k < part;
                            ++k) {
                           Index const cell = region.cell[k];
                           CellTriangles const corners(tangle, cell);
                           for (Index corner = 0; corner < corners.n; ++corner) {
                               CornerPoints const& point = corners.point[corner];
                               if (region.can_move(point)) list.add(cell, point);
                           }
                       }
                       sum.value += list.energy();
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

Real Improvement::energy_ahead(Index power) noexcept {
    work += work_of_energy * n_region_blocks;
    return energy_of(ahead, power);
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
        after = energy_ahead(power);
        return after < before && after <= before + least_slope * length * slope && is_valid(ahead);
    };
    for (Index halvings = 0; !falls_enough(); length *= 0.5) {
        if (++halvings > most_halvings) return before;
    }
    for (Index doublings = 0; doublings < most_doublings && 2 * length <= most; ++doublings) {
        look_ahead(2 * length);
        Real const farther = energy_ahead(power);
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
