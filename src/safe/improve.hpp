// Improves a valid mesh: inner points move to where cells are most like their targets. P. Knupp,
// Introducing the target-matrix paradigm for mesh optimization via node-movement, Eng. Comput. 28
// (2012) 419.
#pragma once

#include "safe/newton_system.hpp"
#include "safe/sliding_points.hpp"
#include "safe/targets.hpp"

namespace harmorph {

struct ImproveOptions {
    // The largest number of Newton steps, of which at most `most_for_power` have the same power.
    Index most_iterations = 60;
    // The largest number of products with the Hessian in each step.
    Index most_products = 60;
    // If a step decreases the energy by a smaller part, the next power begins.
    Real least_gain = 5e-4;
    // If cells have a quality Q (see below) less than this at the end, further steps move the
    // points near these cells.
    Real enough = 0;
};

struct ImproveReport {
    Index iterations = 0;  // the number of Newton steps
    Offset products = 0;   // the number of products with the Hessian
    Index unknowns = 0;    // the number of points that could move
};

// The energy is a sum over cells, with the mean over the corners of a quadrilateral:
//   1 / q^2 + (least / Q)^(2 power)
// Here q is the size-skew quality relative to the target, Q is the size-skew quality that the
// library reports, and `least` is the value that Q should not fall below (see Targets). The first
// term alone (power 0) makes cells similar to their targets; a mesh that is its own target is at
// rest. If a cell is then below its least quality, the second term is added with increasing powers:
// it is negligible for cells well above `least`, and among cells below `least` the worst one counts
// most. The last power is the first one that leaves the smallest Q / least clearly lower than
// before.
//
// The minimiser is Newton's method. No step is longer than a part of the exact admissible step, so
// that no cell is inverted on the way, and every step lowers the energy. Walls do not move; points
// that slide stay on their lines and curves.
struct Improvement {
    static constexpr Index powers[] = {0, 2, 4, 8}, most_for_power = 20;
    static constexpr Index powers_near_poor[] = {2, 4, 8, 16, 32}, most_near_poor = 60,
                           least_layers = 6, most_layers = 24;

    Tangle tangle;          // set by the caller, with the reference of the targets
    Targets targets;        // found by the caller
    SlidingPoints sliding;  // set by the caller: sliding along curves, the lines of which are those
                            // of the tangle
    Executor executor;      // set by the caller
    Region region;
    NewtonSystem system;
    Span<Vec2> now, change, ahead, best;  // [n_points]

    void lay_out(Arena& arena, RegionCounts const& counts) noexcept;

    // The mesh `from` is valid. The mesh `to` becomes the best of all meshes on the way: that with
    // the largest smallest Q / least, where values above 1 count as 1, and among these that with
    // the largest mean quality. It is never worse than `from`. Held points keep their bits.
    void run(ImproveOptions const& options, Points from, MutablePoints to,
             ImproveReport& report) noexcept;

    // These are the parts of run(). The first sets `now` to `points`. The second makes a Newton
    // step that lowers the energy of the given power from `before` to the returned value, which is
    // `before` if no step lowers the energy.
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
