// Improves a valid mesh: inner points move to where cells are most like their targets. P. Knupp,
// Introducing the target-matrix paradigm for mesh optimization via node-movement, Eng. Comput. 28
// (2012) 419.
#pragma once

#include "safe/newton_system.hpp"
#include "safe/corner_energies.hpp"
#include "safe/slipping_points.hpp"
#include "safe/targets.hpp"

namespace harmorph {

struct ImproveOptions {
    // The largest number of Newton steps.
    Index max_iterations = 60;
    // The largest number of steps that move points of the whole mesh.
    Index max_in_whole = 8;
    // The largest number of products with the Hessian in each step.
    Index max_products = 50;
    // The work of all steps, in products of a block of the Hessian and a vector, is at most this
    // number for each point that can move and each of max_iterations. A product with the whole
    // Hessian is 4 of them for each point of triangles, 5 for each point of quadrilaterals.
    Real max_work = 48;
    // If a step decreases the energy by a smaller part, the next power begins.
    Real min_gain = 5e-4;
    // If cells have a quality Q (see below) less than this at the end, further steps, beyond
    // max_iterations and max_work, move the points near these cells.
    Real enough = 0;
    // The smallest Q should not fall below this value.
    Real lowest = 0;
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
// rest. The first steps lower this term in the whole mesh. If a cell was then or before clearly
// below `least`, the second term is added with increasing powers, and only points near the worst
// cells move, a few steps for each power: the term is negligible for cells well above `least`, and
// among cells below `least` the worst one counts most.
//
// The minimiser is Newton's method. No step is longer than a part of the exact admissible step, so
// that no cell is inverted on the way, and every step lowers the energy. Walls do not move; points
// that slip stay on their lines and curves.
struct Improvement {
    static constexpr Index powers_of_worst[] = {2, 4, 8, 16, 32}, max_for_power = 2,
                           layers_of_worst = 3;
    static constexpr Index powers_near_poor[] = {2, 4, 8, 16, 32}, max_near_poor = 60,
                           min_layers = 6, max_layers = 24;

    Tangle tangle;    // set by the caller, with the reference of the targets
    Targets targets;  // found by the caller
    // Set by the caller: the points that slip along curves; their lines are those of the tangle.
    SlippingPoints slipping;
    Executor executor;  // set by the caller
    Region region;
    NewtonSystem system;
    Span<Vec2> now, change, ahead, best;  // [n_points]
    // [cells and guards] Q at `now`; negative if no point of the cell can move.
    Span<Real> quality;

    void lay_out(Arena& arena, RegionCounts const& counts) noexcept;

    // The mesh `from` is valid. The mesh `to` becomes the best of all meshes on the way, see Score.
    // It is never worse than `from`. Held points keep their bits.
    void run(ImproveOptions const& options, Points from, MutablePoints to,
             ImproveReport& report) noexcept;

    // These are the parts of run(). begin() sets `now` to `points`. step() makes a Newton step that
    // lowers the energy of the given power from `before` to the returned value, which is `before`
    // if no step lowers the energy.
    void begin(Points points) noexcept;
    Real energy(Index power) const noexcept { return energy_of(now, power); }
    Real step(ImproveOptions const& options, Index power, Real before,
              ImproveReport& report) noexcept;

private:
    // If the smallest Q of one of two meshes is below options.lowest, the mesh with the larger
    // smallest Q is better. Otherwise the mesh is better whose product of the mean quality and the
    // smallest Q / least is larger; values of Q / least above 1 have a small weight in this
    // product, and are at most Targets::aim.
    struct Score {
        Real lowest = 1;  // the smallest Q / options.lowest, at most 1
        Real smallest = infinity;
        Real sum = 0;  // the sum of qualities

        void merge(Score const& later) noexcept {
            lowest = min(lowest, later.lowest);
            smallest = min(smallest, later.smallest);
            sum += later.sum;
        }
        Real value() const noexcept {
            constexpr Real weight_above = 0.02;
            return sum * (smallest < 1 ? smallest : 1 + weight_above * (smallest - 1));
        }
        bool is_better_than(Score const& other) const noexcept {
            return lowest > other.lowest || (lowest == other.lowest && value() > other.value());
        }
    };

    Score outside;    // the score of the cells that are not in the region
    Real lowest = 0;  // options.lowest
    Real work = 0;    // in products with a block of the Hessian
    // The numbers of blocks on and above the diagonal of the Hessian, for the whole mesh and for
    // the region. They do not depend on the numbering of the points.
    Real n_blocks = 0, n_region_blocks = 0;

    Score score_of(Index cell) const noexcept;
    Score score() const noexcept;
    void climb(ImproveOptions const& options, Index power, Index max_steps, Real max_work,
               Score& found, Score& highest, ImproveReport& report) noexcept;
    void raise_worst(ImproveOptions const& options, Real max_work, Score found, Score& highest,
                     ImproveReport& report) noexcept;
    void count_blocks() noexcept;
    bool begin_near(Real enough, Real part_of_aim, Index layers) noexcept;
    void assemble(Index power) noexcept;
    Real energy_of(Span<const Vec2> points, Index power) const noexcept;
    Real energy_ahead(Index power) noexcept;
    bool is_valid(Span<const Vec2> points) const noexcept;
    void look_ahead(Real length) const noexcept;
    Real descend(Index power, Real before) noexcept;
    template <class Visit>
    void for_points(Visit const& visit) const noexcept;
};

}  // namespace harmorph
