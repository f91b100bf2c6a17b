// Improves a valid mesh: inner points move to where the smallest and the mean quality of the cells
// are as large as possible.
#pragma once

#include "safe/cell_logarithm.hpp"
#include "safe/point_factor.hpp"
#include "safe/mobility.hpp"

namespace harmorph {

struct ImproveOptions {
    // The largest number of solutions: of factorisations, each with its substitution.
    Index max_solutions = 20;
    // The solutions that the caller has spent on this mesh before. The more there are, the more
    // further ones have to bring; see Improvement::is_at_rest().
    Index spent = 0;
};

struct ImproveReport {
    Index solutions = 0;     // each made one step of Newton's method
    Index unknowns = 0;      // the number of points that could move
    bool converged = false;  // further solutions would bring little
};

// What prepare() of Improvement::run() has done: nothing; it may have changed the mesh or the
// anchors, so that the search for the best mesh begins again; or the run is to end.
enum class Prepared { nothing, mesh, end };

// Points that are pulled to places, with the energy weight / 2 sum of scale |point - place|^2.
struct Anchors {
    Span<Index> point;
    Span<Vec2> place;
    Span<Real> scale;
    Index count = 0;
    Real weight = 0;

    void lay_out(Arena& arena, Offset max_count) noexcept {
        arena.take(point, max_count);
        arena.take(place, max_count);
        arena.take(scale, max_count);
    }
    void add(Index anchor, Vec2 at, Real of_one) noexcept {
        point[count] = anchor;
        place[count] = at;
        scale[count++] = of_one;
    }
};

// Maximises J = ln(smallest quality) + ln(mean quality), where quality is what measure_quality()
// reports, relative to the reference. With y = -ln(quality) of a cell, the steps minimise
//   ln(sum exp(sharpness y)) / sharpness - ln(mean exp(-y)),
// in which a smooth maximum of y takes the place of the largest y. The smooth maximum becomes
// sharper from step to step, and is a mean in the beginning.
//
// Each step is one of Newton's method with the Hessians of LogarithmWeights. The smooth maximum
// also contributes minus the square of its gradient, a negative term of rank one, which two
// substitutions take into account (Sherman and Morrison). Relative deformations of cells are damped
// (Levenberg and Marquardt). Each cell has its own damping, which grows where a step deforms the
// cell much, so that a few poor cells do not shorten the steps of all others; all dampings grow if
// the energy does not fall along the step, and fall after a whole step. No step is longer than a
// part of the exact admissible step, so that no cell is inverted on the way, and every step lowers
// the energy. Walls do not move; points that slip stay on their lines and curves.
struct Improvement {
    Tangle tangle;  // set by the caller, with the reference
    // Set by the caller: the points that slip along curves; their lines are those of the tangle.
    SlippingPoints slipping;
    Executor executor;  // set by the caller
    const Plan* plan = nullptr;
    Region region;
    NewtonSystem system;
    PointFactor factor;
    Span<Vec2> now, change, ahead, best;  // [n_points]
    Span<Real> area;                      // [given cells] at the reference, in square units
    Span<Real> y;                         // [given cells]
    Span<Real> damping;                   // [given cells] in parts of the slope of the mean cell
    Anchors anchors;                      // laid out by the caller
    // Cells are measured, and the system is solved, in units of a power of two of the extent of the
    // mesh, so that no bit depends on the unit of length.
    Real unit = 1, per_unit = 1;

    void lay_out(Arena& arena, Plan const& of_plan) noexcept;

    // The mesh `from` is valid. The mesh `to` becomes the best of all meshes on the way: the one
    // with the largest J, among those whose smallest quality is not below `lowest`, or with the
    // largest smallest quality if there is none. Held points keep their bits. The function
    // prepare() is called before each step; see Prepared. The mesh must remain valid.
    template <class Prepare>
    void run(Plan const& of_plan, ImproveOptions const& options, Real lowest, Points from,
             MutablePoints to, ImproveReport& report, Prepare const& prepare) noexcept;

    // These are the parts of run(). begin() sets `now` to `points`. restart() takes changes of held
    // points into account. step() makes a step of Newton's method and returns whether the mesh has
    // changed.
    void begin(Plan const& of_plan, Points points) noexcept;
    void restart() noexcept;
    bool step() noexcept;
    bool is_slow() const noexcept;  // the last step hardly lowered the energy
    Real energy() noexcept { return energy_of(now, infinity); }
    // Measures the cells of the reference; begin() does that, too.
    void measure_reference() noexcept;
    Real smallest_of(Points points) const noexcept { return score(points).smallest; }
    Real smallest() const noexcept { return smallest_of(as_points(now)); }
    // Makes the smooth maximum sharper. `raises`: the last step has raised J.
    void sharpen(bool raises) noexcept;

private:
    struct Score {
        Real smallest = 0, mean = 0;

        Real value() const noexcept {
            return smallest > 0 ? logarithm(smallest) + logarithm(mean) : -infinity;
        }
        bool is_better_than(Score const& other, Real lowest) const noexcept {
            Real const own = min(smallest, lowest), others = min(other.smallest, lowest);
            return own > others || (own == others && value() > other.value());
        }
    };
    // What the terms of the energy have in common.
    struct Sums {
        // The mean of how far y is below the largest, with the weights of the smooth maximum.
        Real gap = 0;
        Real largest = 0;       // y
        Real exponentials = 0;  // the sum of exp(sharpness (y - largest))
        Real qualities = 0;     // the sum of exp(-y)
    };

    Real factor_of_sharpness = 1;
    // Of the last step: its length, the length up to which no cell is inverted (at most 1), the
    // gain of energy, and the gap that remains (see Sums).
    Real last_length = 0, possible_length = 0, last_gain = 0, gap = 0;
    Real sharpness = 0, blur = 0;

    // Returns whether further solutions would bring little, after `solutions` of them. The gains
    // are those of J in the last three steps.
    bool is_at_rest(Real const (&gains)[3], Index solutions) const noexcept;
    Score score(Points points) const noexcept;
    void choose_unit() noexcept;
    CellShape shape_in_units(Index i, Points points) const noexcept;
    CellMeasure measure_in_units(Index number, Points points) const noexcept;
    void set_sharpness(Sums const& sums) noexcept;
    Sums sums_of(Span<const Vec2> points) noexcept;
    // Returns infinity if a y is larger than `max_largest`.
    Real energy_of(Span<const Vec2> points, Real max_largest) noexcept;
    Real energy_of_anchors(Span<const Vec2> points) const noexcept;
    void pull_anchors() const noexcept;
    Real energy_of(Sums const& sums) const noexcept;
    LogarithmWeights weights_of(Sums const& sums, Index number) const noexcept;
    template <Index n>
    void differentiate(Sums const& sums, Index cell, CellForm<n>& form) const noexcept;
    PolygonMeasures measure_polygon(Index number) const noexcept;
    bool solve() noexcept;
    Real descend(Real before, Real max_largest) noexcept;
    bool is_valid(Span<const Vec2> points) const noexcept;
    void look_ahead(Real length) const noexcept;
    void adapt_damping() const noexcept;
    // Returns the size of the relative deformation of a cell by the last change.
    Real strain_of(Index number) const noexcept;
    void keep_if_better(Score const& found, Real lowest, Score& highest) const noexcept;
};

template <class Prepare>
void Improvement::run(Plan const& of_plan, ImproveOptions const& options, Real lowest, Points from,
                      MutablePoints to, ImproveReport& report, Prepare const& prepare) noexcept {
    report = {};
    begin(of_plan, from);
    report.unknowns = region.n;
    Score found = score(as_points(now)), highest = found;
    copy(best, Span<const Vec2>(now));
    Real gains[3] = {infinity, infinity, infinity}, first = highest.value();
    while (region.n > 0 && report.solutions < options.max_solutions && !report.converged) {
        Prepared const prepared = prepare();
        if (prepared == Prepared::end) break;
        bool const is_new = prepared == Prepared::mesh;
        if (is_new) {
            highest = found = score(as_points(now));
            first = highest.value();
            copy(best, Span<const Vec2>(now));
        }
        Real const before = highest.value(), last = found.value();
        ++report.solutions;
        step();
        found = score(as_points(now));
        if (anchors.count == 0) sharpen(found.value() > last);
        keep_if_better(found, lowest, highest);
        // Before the first mesh that is better, the way there counts: sharpness begins low.
        bool const is_ahead = highest.value() > first;
        Real const gain = is_ahead ? highest.value() - before : max(found.value() - last, 0.0);
        gains[report.solutions % 3] = is_new ? infinity : gain;
        report.converged = is_at_rest(gains, options.spent + report.solutions);
    }
    for (Index k = 0; k < now.count(); ++k) to.set(k, best[k]);
}

}  // namespace harmorph
