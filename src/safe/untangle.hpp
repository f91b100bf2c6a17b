// Moves inner points until no cell is inverted; the boundary stays, and points that slide stay on
// their lines and curves. Newton's method on the energy
// of Distortion, whose softness goes to 0 by the rule of Garanzha et al. (2021), with one step for
// each softness. Only the surroundings of inverted cells move at first.
#pragma once

#include "safe/newton_system.hpp"
#include "safe/sliding_points.hpp"
#include "safe/untangling_energy.hpp"

namespace harmorph {

struct UntangleOptions {
    Index layers =
        6;  // of cells round inverted ones move at first; if in vain, twice as many, and so on
    Index iterations_in_part = 30;    // at most, in a region that is part of the mesh
    Index iterations_in_whole = 200;  // at most, in the whole mesh
    Index most_products = 200;        // with the Hessian, in each iteration
    // Of corner areas in units of the reference's. A region is done when its smallest is at least
    // `goal`, or at least `margin` and no longer grows; below `margin` a larger one is tried. Of
    // the whole mesh, and of corners that cannot move, positive is enough.
    Real goal = 0.05, margin = 1e-3;
};

struct UntangleReport {
    Index inverted_before = 0;  // cells
    Index left =
        0;  // of them and those moved with them: cells that are inverted or below the margin
    Index stuck_cell =
        none;  // has an inverted corner whose three points are held: no iteration was made
    Index iterations = 0;  // in all regions
    Offset products = 0;   // with the Hessian
    Index regions = 0;     // tried
    Index unknowns = 0;    // points that could move in the last of them
    Real smallest = 0;     // area, in units of the reference's, of a corner that could move there
};

// Every corner counts alike. The integral over the reference mesh would weigh with areas; then
// viscous layers, whose areas are ten orders smaller, would be as nothing beside the cells outside
// them, and would pay for them.
struct Untangling {
    Tangle tangle;          // set by the caller
    SlidingPoints sliding;  // set by the caller: along curves, with the lines of the tangle
    Executor executor;      // set by the caller
    Region region;
    NewtonSystem system;
    Span<Vec2> now, trial;  // [n_points]

    void lay_out(Arena& arena, RegionCounts const& counts) noexcept;

    // Status::ok: no cell is inverted. Not a bit has changed if none was before, nor of points that
    // are held. Status::not_converged: `points` is as it was. Refused: inverted cells of the
    // reference.
    Status run(UntangleOptions const& options, MutablePoints points, UntangleReport& report,
               Fault& fault) noexcept;

private:
    Status check_reference(Fault& fault) const noexcept;
    bool is_stuck(Index cell) const noexcept;
    bool is_good(Index cell, Real margin) const noexcept;
    void repair_region(UntangleOptions const& options, Index most_iterations,
                       UntangleReport& report) noexcept;
    void assemble(Real softness) const noexcept;
    Real descend(Real softness, Real before) noexcept;
    Real energy(Span<const Vec2> at, Real softness) const noexcept;
    Real smallest_determinant() const noexcept;
    void write(MutablePoints points) const noexcept;
};

}  // namespace harmorph
