#include "safe/improve.hpp"

#include "morph/admissible_step.hpp"
#include "morph/quality.hpp"

namespace harmorph {
namespace {

// A step takes at most this share of the admissible step.
constexpr Real share_of_admissible = 0.9;
// Armijo's rule: the energy must fall by at least this part of what the slope promises.
constexpr Real min_slope = 1e-4;
constexpr Index max_halvings = 30;
// If a step promises a smaller relative decrease of the energy, the decrease is rounding.
constexpr Real at_rest = 1e-12;
// Where the power is large, Newton's step improves one of the worst cells only by a small factor;
// then a longer step is better.
constexpr Index max_doublings = 8;
// Steps that move points of the whole mesh may use this part of the work.
constexpr Real share_of_whole = 0.65;
// The worst cells are improved only if the quality of one of them, divided by Targets::Cell::least
// or by the smallest quality of the given mesh, was less than this number. A small movement
// therefore changes the mesh little.
constexpr Real clearly_below = 0.999;
// Measured times for each block of the Hessian, in units of one product of the block and a vector:
// computing the block for the first and for the second term of the energy, and computing the
// energy. The last two are times of a region and of a step that do not depend on the size of the
// region; they count for each block of the whole mesh.
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
        Real const max_work = options.max_work * static_cast<Real>(options.max_iterations) *
                              static_cast<Real>(region.n);
        Real const given = highest.smallest;
        Score found = highest;
        climb(options, 0, min(options.max_in_whole, options.max_iterations),
              share_of_whole * max_work, found, highest, report);
        if (min(given, min(found.smallest, found.lowest)) < clearly_below)
            raise_worst(options, max_work, found, highest, report);
    }
    for (Index layers = min_layers; options.enough > 0 && layers <= max_layers; layers *= 2) {
        begin(as_points(best));
        Score found = score();
        if (!begin_near(options.enough, 0, layers)) break;
        for (Index const power : powers_near_poor)
            climb(options, power, max_near_poor, infinity, found, highest, report);
    }
    for (Index k = 0; k < now.count(); ++k) to.set(k, best[k]);
}

// Begins at `now`. The best mesh on the way replaces `best`, the score of which is `highest`.
// `found` is the score of the last mesh.
void Improvement::climb(ImproveOptions const& options, Index power, Index max_steps, Real max_work,
                        Score& found, Score& highest, ImproveReport& report) noexcept {
    Real before = energy(power);
    for (Index k = 0; k < max_steps && before < infinity && work < max_work; ++k) {
        Real const after = step(options, power, before, report);
        found = score();
        if (found.is_better_than(highest)) {
            highest = found;
            copy(best, Span<const Vec2>(now));
        }
        bool const gains = before - after > options.min_gain * before;
        before = after;
        if (!gains) break;
    }
}

// Moves points near the cells that are not much better than the worst one. The last power is
// repeated as long as the quality of the worst cell increases.
void Improvement::raise_worst(ImproveOptions const& options, Real max_work, Score found,
                              Score& highest, ImproveReport& report) noexcept {
    constexpr Real width = 1.5, min_part = 0.6, max_part = 0.999, min_rise = 1.005;
    constexpr Index n_powers = sizeof powers_of_worst / sizeof *powers_of_worst;
    for (Index k = 0; work < max_work && report.iterations < options.max_iterations; ++k) {
        Real const smallest = found.smallest;
        if (!begin_near(0, min(max_part, max(min_part, width * smallest)), layers_of_worst)) return;
        work += work_of_region * n_blocks;
        climb(options, powers_of_worst[min(k, n_powers - 1)],
              min(max_for_power, options.max_iterations - report.iterations), max_work, found,
              highest, report);
        if (k + 1 >= n_powers && found.smallest < min_rise * smallest) return;
    }
}

// The block of two unknowns in different ranges is stored in both rows.
void Improvement::count_blocks() noexcept {
    Offset twice = 0;
    for (Index u = 0; u < region.n; ++u)
        twice += region.outer_start[u] - region.start[u] + region.start[u + 1] - region.start[u];
    n_region_blocks = 0.5 * static_cast<Real>(twice);
}

// Begins at `now`, near cells whose quality is below `enough` or below this part of their aim.
// Returns false if there is none.
bool Improvement::begin_near(Real enough, Real part_of_aim, Index layers) noexcept {
    slipping.turn_lines(as_points(now));
    fill(change, Vec2{});
    region.choose([&](Index i) {
        return quality[i] >= 0 &&
               quality[i] < max(enough, part_of_aim * targets.aim * targets.cell[i].wanted);
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
    slipping.turn_lines(as_points(now));
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
    Index const products = system.solve(region, options.max_products, executor);
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
    return {is_reported ? min(found / lowest, 1.0) : 1, min(found / target.wanted, targets.aim),
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
                       for (Index const part = min(end, k + CornerEnergies::max_cells); k < part;
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
    Real const max_length =
        share_of_admissible *
        admissible_step(cells, as_points(now), as_points(change), executor).step;
    Real length = min(1.0, max_length), after = infinity;
    auto const falls_enough = [&] {
        look_ahead(length);
        after = energy_ahead(power);
        return after < before && after <= before + min_slope * length * slope && is_valid(ahead);
    };
    for (Index halvings = 0; !falls_enough(); length *= 0.5) {
        if (++halvings > max_halvings) return before;
    }
    for (Index doublings = 0; doublings < max_doublings && 2 * length <= max_length; ++doublings) {
        look_ahead(2 * length);
        Real const farther = energy_ahead(power);
        if (!(farther < after) || !is_valid(ahead)) break;
        after = farther;
        length *= 2;
    }
    look_ahead(length);
    copy(now, Span<const Vec2>(ahead));
    slipping.turn_lines(as_points(now));
    return after;
}

// Sets the points ahead to now + length * change, with slipping points on their curves.
void Improvement::look_ahead(Real length) const noexcept {
    executor.for_ranges(now.count(), 4096, [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
            bool const moves = region.unknown[k] != none;
            ahead[k] = moves ? slipping.placed(k, now[k] + length * change[k]) : now[k];
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
