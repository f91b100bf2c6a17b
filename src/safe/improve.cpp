#include "safe/improve.hpp"

#include "morph/admissible_step.hpp"

namespace harmorph {
namespace {

// A step takes at most this share of the admissible step.
constexpr Real share_of_admissible = 0.9;
// Armijo's rule: the energy must fall by at least this part of what the slope promises.
constexpr Real min_slope = 1e-4;
constexpr Index max_halvings = 40, max_doublings = 3;
// The natural sharpness makes cells of the smallest quality exp(log_of_weight) times as heavy as
// cells of the mean quality, so that a few of the former are as heavy as all others together in a
// mesh of some hundred cells. It does not depend on the number of cells, so that a passage is
// improved as the annulus of all passages is. It is multiplied by a factor that grows when a step
// lowers J, or gains little beside the gap between the smooth and the exact maximum; it grows fast
// after whole steps.
constexpr Real log_of_weight = 5;
constexpr Real min_sharpness = 4, max_natural_sharpness = 40, max_sharpness = 400;
constexpr Real small_part_of_gap = 0.1, fast_growth = 1.8, slow_growth = 1.4;
constexpr Real blur_per_sharpness = 2, min_blur = 0.01, max_blur = 0.3;
// The least curvature and the damping in parts of the slope of the mean cell.
constexpr Real least_curvature = 0.1, first_damping = 3;
// After a step that is shorter than this part of the possible length, all dampings grow so much
// that the next one should not be. After another step they fall.
constexpr Real short_step = 0.3, min_growth = 4, max_growth = 64, fall_of_damping = 5;
// The damping of a cell grows if the change of the last step deforms the cell by more than this,
// in proportion to the deformation up to a limit.
constexpr Real max_strain = 0.5, max_growth_of_cell = 16, max_damping = 1e12;
// No y of a step is larger than the largest before the step plus this number.
constexpr Real max_rise = 0.3;
// The rest of the curvature of the smooth maximum along its gradient, in parts of the curvature.
constexpr Real min_rest = 1e-3;
// The steps end when the gain of the last step and the gap, which is the most that a sharper
// maximum can bring, are less than small_rest together, or when J gains less than small_gain in
// three steps. After `patience` solutions small_gain grows with the square of their number, up to
// the square of max_growth_of_gain.
constexpr Real small_rest = 0.02, small_gain = 0.012, patience = 13, max_growth_of_gain = 2;
// A step that lowers the energy by less is slow, while anchors pull.
constexpr Real slow_gain = 0.02;

struct Largest {
    Real value = -infinity;
    void merge(Largest const& later) noexcept { value = max(value, later.value); }
};
struct ThreeSums {
    Real exponentials = 0, qualities = 0, gaps = 0;
    void merge(ThreeSums const& later) noexcept {
        exponentials += later.exponentials;
        qualities += later.qualities;
        gaps += later.gaps;
    }
};

}  // namespace

void Improvement::lay_out(Arena& arena, Plan const& of_plan) noexcept {
    RegionCounts const& counts = of_plan.region_counts();
    region.lay_out(arena, counts);
    system.lay_out(arena, counts);
    factor.lay_out(arena, of_plan);
    arena.take(now, counts.points);
    arena.take(change, counts.points);
    arena.take(ahead, counts.points);
    arena.take(best, counts.points);
    arena.take(area, of_plan.mesh().n_given_cells());
    arena.take(y, of_plan.mesh().n_given_cells());
    arena.take(damping, of_plan.mesh().n_given_cells());
}

void Improvement::begin(Plan const& of_plan, Points points) noexcept {
    plan = &of_plan;
    if (PointFactor::exists(of_plan)) factor.init(of_plan);
    for (Index k = 0; k < now.count(); ++k) now[k] = points[k];
    region.link(tangle);
    measure_reference();
    restart();
}

void Improvement::measure_reference() noexcept {
    choose_unit();
    executor.for_ranges(area.count(), 4096, [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) area[k] = measure_in_units(k, tangle.reference).area;
    });
}

void Improvement::choose_unit() noexcept {
    Vec2 lowest{infinity, infinity}, highest{-infinity, -infinity};
    for (Index k = 0; k < tangle.mesh.n_points; ++k) {
        Vec2 const p = tangle.reference[k];
        lowest = {min(lowest.x, p.x), min(lowest.y, p.y)};
        highest = {max(highest.x, p.x), max(highest.y, p.y)};
    }
    unit = power_of_two_at(max(highest.x - lowest.x, highest.y - lowest.y));
    per_unit = 1 / unit;
}

CellShape Improvement::shape_in_units(Index i, Points points) const noexcept {
    CellShape shape = tangle.shape(i, points);
    for (Vec2& at : shape.at) at = per_unit * at;
    return shape;
}

CellMeasure Improvement::measure_in_units(Index number, Points points) const noexcept {
    return {tangle.mesh, number, [&](Index i) { return shape_in_units(i, points); }};
}

bool Improvement::is_slow() const noexcept { return last_length >= 0.5 && last_gain < slow_gain; }

void Improvement::restart() noexcept {
    slipping.rotate_lines(as_points(now));
    fill(change, Vec2{});
    region.grow(tangle, Region::whole);
    blur = max_blur;
    fill(damping, first_damping);
    sharpness = min_sharpness;
    factor_of_sharpness = 1;
    set_sharpness(sums_of(now));
}

void Improvement::set_sharpness(Sums const& sums) noexcept {
    Real const mean = -logarithm(sums.qualities / static_cast<Real>(y.count())),
               spread = max(sums.largest - mean, 1e-3);
    Real const natural = clamp(log_of_weight / spread, min_sharpness, max_natural_sharpness);
    sharpness = min(factor_of_sharpness * natural, max_sharpness);
    blur = clamp(blur_per_sharpness / sharpness, min_blur, max_blur);
}

void Improvement::sharpen(bool raises) noexcept {
    if (last_gain < small_part_of_gap * gap || !raises)
        factor_of_sharpness *= last_length >= 1 ? fast_growth : slow_growth;
    set_sharpness(sums_of(now));
}

bool Improvement::is_at_rest(Real const (&gains)[3], Index solutions) const noexcept {
    Real const spent = clamp(static_cast<Real>(solutions) / patience, 1.0, max_growth_of_gain);
    bool const is_near = last_length >= 0.5 && last_gain + gap < small_rest;
    return is_near || gains[0] + gains[1] + gains[2] < spent * spent * small_gain;
}

void Improvement::keep_if_better(Score const& found, Real lowest, Score& highest) const noexcept {
    if (!found.is_better_than(highest, lowest)) return;
    highest = found;
    copy(best, Span<const Vec2>(now));
}

Improvement::Score Improvement::score(Points points) const noexcept {
    Quality const quality = reduce_cells<Quality>(
        area.count(), executor,
        [&](Index k, Quality& sum) { sum.add(k, measure_in_units(k, points), area[k]); });
    return {quality.min_quality, quality.mean_quality()};
}

Improvement::Sums Improvement::sums_of(Span<const Vec2> points) noexcept {
    Sums sums;
    sums.largest = reduce_cells<Largest>(y.count(), executor, [&](Index k, Largest& largest) {
                       y[k] =
                           minus_log_quality(measure_in_units(k, as_points(points)), area[k], blur);
                       largest.value = max(largest.value, y[k]);
                   }).value;
    if (!(sums.largest < infinity)) return sums;
    ThreeSums const all =
        reduce_cells<ThreeSums>(y.count(), executor, [&](Index k, ThreeSums& sum) {
            Real const below = sums.largest - y[k], weight = exponential(-sharpness * below);
            sum.exponentials += weight;
            sum.qualities += exponential(-y[k]);
            sum.gaps += weight * below;
        });
    sums.exponentials = all.exponentials;
    sums.qualities = all.qualities;
    sums.gap = all.gaps / all.exponentials;
    return sums;
}

Real Improvement::energy_of(Sums const& sums) const noexcept {
    if (!(sums.largest < infinity)) return infinity;
    return sums.largest + logarithm(sums.exponentials) / sharpness -
           logarithm(sums.qualities / static_cast<Real>(y.count()));
}

Real Improvement::energy_of(Span<const Vec2> points, Real max_largest) noexcept {
    Sums const sums = sums_of(points);
    return sums.largest <= max_largest ? energy_of(sums) + energy_of_anchors(points) : infinity;
}

Real Improvement::energy_of_anchors(Span<const Vec2> points) const noexcept {
    Real sum = 0;
    for (Index k = 0; k < anchors.count; ++k)
        sum += anchors.scale[k] * square(points[anchors.point[k]] - anchors.place[k]);
    return 0.5 * anchors.weight * sum;
}

// Adds the derivatives of the energy of the anchors to those of the cells.
void Improvement::pull_anchors() const noexcept {
    for (Index k = 0; k < anchors.count; ++k) {
        Index const point = anchors.point[k];
        Index const u = region.unknown[point];
        if (u == none) continue;
        Real const factor_of_one = anchors.weight * (anchors.scale[k] * unit) * unit;
        Vec2 pull = factor_of_one * (per_unit * (now[point] - anchors.place[k]));
        Block curvature;
        if (tangle.slips(point)) {
            Vec2 const line = tangle.line[point];
            curvature.add(factor_of_one, line, line);
            pull = dot(line, pull) * line;
        } else {
            curvature = {factor_of_one, 0, 0, factor_of_one};
        }
        system.add(region, u, pull, curvature);
    }
}

LogarithmWeights Improvement::weights_of(Sums const& sums, Index number) const noexcept {
    Real const of_mean = 2 / static_cast<Real>(y.count());
    Real const share = exponential(sharpness * (y[number] - sums.largest)) / sums.exponentials,
               part = exponential(-y[number]) / sums.qualities;
    return {share + part, sharpness * share - part, least_curvature * (share + part),
            damping[number] * of_mean, blur};
}

PolygonMeasures Improvement::measure_polygon(Index number) const noexcept {
    PolygonMeasures polygon{0, area[number], 0};
    for (Index const piece : tangle.mesh.pieces_of(number))
        polygon.area += CellCorners(shape_in_units(piece, as_points(now))).cell_area(3);
    for (Index const guard : tangle.mesh.guards_of(number)) {
        if (tangle.mesh.guard_kind[guard - tangle.mesh.n_cells] != CornerKind::convex) continue;
        CellCorners const corner(shape_in_units(guard, as_points(now)));
        polygon.inverse_sines +=
            length(corner.side[0]) * length(corner.side[1]) / corner.twice_area[0];
    }
    return polygon;
}

// `y` belongs to the present points.
template <Index n>
void Improvement::differentiate(Sums const& sums, Index cell, CellForm<n>& form) const noexcept {
    Index const number = tangle.mesh.number(cell);
    LogarithmWeights const weights = weights_of(sums, number);
    CellShape const shape = shape_in_units(cell, as_points(now));
    form.slope = weights.slope;
    form.curvature =
        sharpness * exponential(sharpness * (y[number] - sums.largest)) / sums.exponentials;
    if constexpr (n == 3) {
        if (tangle.mesh.is_piece_or_guard(cell)) {
            PolygonMeasures const polygon = measure_polygon(number);
            bool const is_piece = cell < tangle.mesh.n_cells;
            bool const counts = is_piece || tangle.mesh.guard_kind[cell - tangle.mesh.n_cells] ==
                                                CornerKind::convex;
            if (is_piece) differentiate_piece(shape, polygon, weights, form);
            else if (counts) differentiate_corner(shape, polygon, weights, form);
            return;
        }
    }
    differentiate_cell(shape, area[number], weights, form);
}

// Finds the step from the derivatives; returns false if rounding has made the Hessian singular.
bool Improvement::solve() noexcept {
    Span<Vec2> const step = system.step.first(region.n), border = system.border.first(region.n);
    for (Index u = 0; u < region.n; ++u) step[u] = -1 * system.gradient[u];
    auto const along_border = [&](Span<const Vec2> v, Span<const Vec2> by) {
        return reduce_cells<Sum>(region.n, executor,
                                 [&](Index u, Sum& sum) { sum.value += dot(v[u], by[u]); })
            .value;
    };
    Span<Vec2> const solved = change.first(region.n);  // `change` is set after that
    for (Index u = 0; u < region.n; ++u) solved[u] = border[u];
    if (PointFactor::exists(*plan)) {
        if (failed(factor.factorise(*plan, tangle, region, system))) return false;
        factor.solve(*plan, tangle, region, step, solved);
    } else {
        constexpr Index max_products = 300;
        constexpr Real residual = 1e-3;
        system.solve(region, step, step, max_products, residual, executor);
        system.solve(region, solved, solved, max_products, residual, executor);
    }
    Real const rest = max(sharpness - along_border(border, solved), min_rest * sharpness),
               factor_of_border = along_border(border, step) / rest;
    for (Index u = 0; u < region.n; ++u) step[u] = step[u] + factor_of_border * solved[u];
    if (!(system.slope(region, executor) < 0)) {
        for (Index u = 0; u < region.n; ++u) step[u] = step[u] - factor_of_border * solved[u];
    }
    executor.for_ranges(now.count(), 4096, [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
            Index const u = region.unknown[k];
            change[k] = u != none ? unit * tangle.rotated_alike(k, step[u]) : Vec2{};
        }
    });
    return true;
}

bool Improvement::step() noexcept {
    Sums const sums = sums_of(now);
    Real const before = energy_of(sums) + energy_of_anchors(now);
    if (!(before < infinity)) return false;
    system.assemble_cells(tangle, region, executor,
                          [&](Index i, auto& form) { differentiate(sums, i, form); });
    pull_anchors();
    possible_length = 1;
    Real const length = solve() ? descend(before, sums.largest + max_rise) : 0;
    Sums const found = sums_of(now);
    last_length = length;
    last_gain = length > 0 ? before - energy_of(found) - energy_of_anchors(now) : 1;
    gap = found.gap;
    adapt_damping();
    return length > 0;
}

// The size of dE E^-1, where E = (a, b) are the sides at a corner, which change by dE = (da, db).
Real Improvement::strain_of(Index number) const noexcept {
    Real largest = 0;
    for (Index const piece : tangle.mesh.pieces_of(number)) {
        CellShape const shape = tangle.shape(piece, as_points(now));
        CellCorners const here(shape), changes(tangle.shape(piece, as_points(change)));
        for (Index k = 0; k < (shape.n == 3 ? 1 : 4); ++k) {
            Index const before = k == 0 ? shape.n - 1 : k - 1;
            Vec2 const a = here.side[before], b = here.side[k];
            Vec2 const da = changes.side[before], db = changes.side[k];
            Real const per_area = 1 / here.twice_area[k];
            Real const all = per_area * square(da) * (per_area * square(b)) +
                             per_area * square(db) * (per_area * square(a)) -
                             2 * (per_area * dot(da, db)) * (per_area * dot(a, b));
            largest = max(largest, all);
        }
    }
    return sqrt(largest);
}

void Improvement::adapt_damping() const noexcept {
    Real growth = 1;
    if (!(last_length >= short_step * possible_length)) {
        growth = last_length > 0
                     ? clamp(short_step * possible_length / last_length, min_growth, max_growth)
                     : max_growth;
    }
    Real const fall = growth == 1 ? 1 / (fall_of_damping * max(last_length, 1.0)) : growth;
    executor.for_ranges(damping.count(), 1024, [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
            Real const strain = strain_of(k);
            Real const by =
                strain > max_strain ? growth * min(strain / max_strain, max_growth_of_cell) : fall;
            damping[k] = min(by * damping[k], max_damping);
        }
    });
}

// Returns the length of the step, 0 if no step lowers the energy.
Real Improvement::descend(Real before, Real max_largest) noexcept {
    Real const slope = system.slope(region, executor);
    if (!(slope < 0)) return 0;
    OrientedMesh const cells{tangle.mesh, tangle.reversed};
    Real const max_length =
        share_of_admissible *
        admissible_step(cells, as_points(now), as_points(change), executor).step;
    Real length = min(1.0, max_length), after = infinity;
    possible_length = length;
    auto const falls_enough = [&] {
        look_ahead(length);
        after = energy_of(ahead, max_largest);
        return after < before && after <= before + min_slope * length * slope && is_valid(ahead);
    };
    for (Index halvings = 0; !falls_enough(); length *= 0.5) {
        if (++halvings > max_halvings) return 0;
    }
    for (Index doublings = 0; doublings < max_doublings && 2 * length <= max_length; ++doublings) {
        look_ahead(2 * length);
        Real const farther = energy_of(ahead, max_largest);
        if (!(farther < after) || !is_valid(ahead)) break;
        after = farther;
        length *= 2;
    }
    look_ahead(length);
    copy(now, Span<const Vec2>(ahead));
    slipping.rotate_lines(as_points(now));
    return length;
}

bool Improvement::is_valid(Span<const Vec2> points) const noexcept {
    return count_inverted({tangle.mesh, tangle.reversed}, as_points(points), executor) == 0;
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

}  // namespace harmorph
