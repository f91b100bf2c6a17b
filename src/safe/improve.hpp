// Makes a valid mesh better: inner points go where cells are most like their targets. P. Knupp,
// Introducing the target-matrix paradigm for mesh optimization via node-movement, Eng. Comput. 28
// (2012) 419.
#pragma once

#include "safe/newton_system.hpp"
#include "safe/sliding_points.hpp"
#include "safe/targets.hpp"

namespace harmorph {

struct ImproveOptions {
    Index most_iterations = 60;  // Newton steps, at most `most_for_power` of them for each power
    Index most_products = 60;    // with the Hessian, in each step
    Real least_gain = 5e-4;      // of the energy; if a step gains less, the next power begins
    Real enough = 0;  // Q, see below: near cells that are below it at the end, more steps are made
};

struct ImproveReport {
    Index iterations = 0;  // Newton steps
    Offset products = 0;   // with the Hessian
    Index unknowns = 0;    // points that could move
};

// The energy is a sum over cells, with the mean over the corners of a quadrilateral:
//     1 / q^2 + (least / Q)^(2 power)
// q is the size-skew quality relative to the target, Q the size-skew quality that the library
// reports, `least` what Q should not fall below (see Targets). The first term alone (power 0) makes
// cells like their targets; a mesh that is its own target is at rest. If a cell is below its least
// quality then, the second term joins, with powers that grow: cells well above `least` do not feel
// it, and of cells below it the worst counts most. The last power is one that leaves the smallest Q
// / least clearly lower than it was.
//
// Newton's method. No step goes farther than a part of the exact admissible step, so that no cell
// inverts on the way, and the energy falls in each. Walls do not move; points that slide stay on
// their lines and curves.
struct Improvement {
    static constexpr Index powers[] = {0, 2, 4, 8}, most_for_power = 20;
    static constexpr Index powers_near_poor[] = {2, 4, 8, 16, 32}, most_near_poor = 60,
                           least_layers = 6, most_layers = 24;

    Tangle tangle;    // set by the caller; its reference is that of the targets
    Targets targets;  // found by the caller
    SlidingPoints
        sliding;        // set by the caller; along curves, their lines being those of the tangle
    Executor executor;  // set by the caller
    Region region;
    NewtonSystem system;
    Span<Vec2> now, change, ahead, best;  // [n_points]

    void lay_out(Arena& arena, RegionCounts const& counts) noexcept;

    // from: a valid mesh. to: of all meshes on the way the one in which the smallest Q / least is
    // largest, where more than 1 counts as 1, and then the mean quality; never a worse one than
    // `from`. Points that are held keep their bits.
    void run(ImproveOptions const& options, Points from, MutablePoints to,
             ImproveReport& report) noexcept;

    // The parts of run(): `now` becomes `points`; then a Newton step that lowers the energy of this
    // power from `before` to what is returned, which is `before` if none does.
    void begin(Points points) noexcept;
    Real energy(Index power) const noexcept { return energy_of(now, power); }
    Real step(ImproveOptions const& options, Index power, Real before,
              ImproveReport& report) noexcept;

private:
    struct Score;

    Score score() const noexcept;
    void climb(ImproveOptions const& options, Index power, Index most_steps, Score& highest,
               ImproveReport& report) noexcept;
    bool begin_near_poor(Real enough, Index layers) noexcept;
    void assemble(Index power) const noexcept;
    Real energy_of(Span<const Vec2> points, Index power) const noexcept;
    bool is_valid(Span<const Vec2> points) const noexcept;
    void look_ahead(Real length) const noexcept;
    Real descend(Index power, Real before) noexcept;
    template <class Visit>
    void for_points(Visit const& visit) const noexcept;
};

}  // namespace harmorph
