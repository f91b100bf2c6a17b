// Moves inner points until no cell is inverted. The boundary stays, and points that slip stay on
// their lines and curves. Newton's method minimises the energy of Distortion, the softness of which
// goes to 0 by the rule of Garanzha et al. (2021), with one step for each softness. At first only
// points near inverted cells move.
#pragma once

#include "safe/newton_system.hpp"
#include "safe/corner_map.hpp"
#include "safe/mobility.hpp"

namespace harmorph {

// Measures the deviation of a triangle from the shape and the size of a reference by an energy that
// stays finite when the triangle is folded. V. Garanzha, I. Kaporin, L. Kudryavtseva, F. Protais,
// N. Ray, D. Sokolov: Foldover-free maps in 50 lines of code, ACM Trans. Graph. 40 (2021), eqs.
// 2-4.

// Returns a number that is positive for every determinant, increases with the determinant, and is
// close to a large one. With softness 0 it is the positive part.
inline Real regularised(Real determinant, Real softness) noexcept {
    Real const root = sqrt(softness * softness + determinant * determinant);
    if (determinant <= 0 && softness == 0) return 0;
    return determinant > 0 ? 0.5 * (determinant + root)
                           : 0.5 * softness * softness / (root - determinant);
}

// The energy of the map J from the reference, with the regularised determinant chi: (|J|^2 +
// size_weight (det^2 + 1)) / chi.
struct Distortion {
    static constexpr Real size_weight = 0.1;

    explicit Distortion(Triangle const& reference) noexcept : map_(reference) {}

    Real determinant(Triangle const& now) const noexcept { return map_.determinant(now); }
    Real energy(Triangle const& now, Real softness) const noexcept;
    // Returns the derivatives of the energy, in units of the curvature of |J|^2 / chi, so that with
    // least >= 0 no curvature is negative; see CornerMap.
    DensityDerivatives derivatives(Triangle const& now, Real softness) const noexcept;
    // Adds the derivatives by the sides to `form`; see CornerMap.
    void differentiate(Triangle const& now, Real softness, Real min_curvature,
                       CornerForm& form) const noexcept {
        map_.differentiate(now, derivatives(now, softness), min_curvature, form);
    }
    CornerMap const& map() const noexcept { return map_; }

private:
    CornerMap map_;
};

struct UntangleOptions {
    // The number of layers of cells round inverted ones that move at first. If this region fails,
    // the number is doubled, and so on.
    Index layers = 6;
    Index iterations_in_part = 30;    // the largest number in a part of the mesh
    Index iterations_in_whole = 100;  // the largest number in the whole mesh
    Real max_work = infinity;         // in solutions
    Index max_products = 200;  // the largest number of products with the Hessian in each iteration
    // Areas of corners in units of those of the reference. A region is finished when its smallest
    // area is at least `goal`, or is at least `margin` and no longer grows; if it stays below
    // `margin`, a larger region is tried. In the whole mesh, and at corners that cannot move, any
    // positive area suffices.
    Real goal = 0.05, margin = 1e-3;
};

struct UntangleReport {
    Index inverted_before = 0;  // the number of cells
    // The number of cells that are inverted or below the margin, among the inverted cells and those
    // that moved with them.
    Index left = 0;
    // A cell with an inverted corner the three points of which are held; then no iteration was
    // made. Or none.
    Index stuck_cell = none;
    Index iterations = 0;  // the number in all regions
    Offset products = 0;   // the number of products with the Hessian
    Real work = 0;         // the time of the products, in solutions
    Index regions = 0;     // the number of regions that were tried
    Index unknowns = 0;    // the number of points that could move in the last region
    // The smallest area of a corner that could move in that region, in units of the reference's.
    Real smallest = 0;
};

// Every corner has the same weight. An integral over the reference mesh would weigh corners with
// their areas; then viscous layers, the areas of which are ten orders of magnitude smaller, would
// be sacrificed for the cells outside them.
struct Untangling {
    Tangle tangle;  // set by the caller
    // Set by the caller: the points that slip along curves; their lines are those of the tangle.
    SlippingPoints slipping;
    Executor executor;  // set by the caller
    Region region;
    NewtonSystem system;
    Span<Vec2> now, trial;  // [n_points]

    void lay_out(Arena& arena, RegionCounts const& counts) noexcept;

    // Status::ok means that no cell is inverted. No bit has changed if no cell was inverted before,
    // and held points keep their bits. Status::not_converged leaves `points` unchanged. Inverted
    // cells of the reference are refused.
    Status run(UntangleOptions const& options, MutablePoints points, UntangleReport& report,
               Fault& fault) noexcept;

private:
    Status check_reference(Fault& fault) const noexcept;
    bool is_stuck(Index cell) const noexcept;
    bool is_good(Index cell, Real margin) const noexcept;
    void repair_region(UntangleOptions const& options, Index max_iterations,
                       UntangleReport& report) noexcept;
    void assemble(Real softness) const noexcept;
    Real descend(Real softness, Real before) noexcept;
    Real energy(Span<const Vec2> at, Real softness) const noexcept;
    Real smallest_determinant() const noexcept;
    void write(MutablePoints points) const noexcept;
};

}  // namespace harmorph
