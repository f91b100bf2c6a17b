// A morph that reaches the target without an inverted cell, or says how far it came: strategies are tried in the order
// of their cost.
#pragma once

#include "harmorph/morph/admissible_step.hpp"
#include "harmorph/morph/crossing.hpp"
#include "harmorph/boundary/first_layer.hpp"
#include "harmorph/plan/plan.hpp"
#include "harmorph/safe/motion_path.hpp"
#include "harmorph/safe/untangle.hpp"
#include "harmorph/boundary/wall_heights.hpp"

namespace harmorph {

enum class Strategy : std::int32_t { linear = 0, other = 1, substeps = 2, untangled = 3 };

struct SafeOptions {
    Index most_resolves = 10;
    std::uint32_t skipped = 0;     // bit k: strategy k is not tried
    Span<const Basis> others;      // solved with other operators or exponents
    UntangleOptions untangle;
    Real heights = 0;              // 0..1: how much of the heights near walls is brought back at the end

    bool tries(Strategy strategy) const noexcept { return (skipped >> static_cast<std::int32_t>(strategy) & 1) == 0; }
};

struct SafeReport {
    Strategy strategy = Strategy::linear;  // the last one that moved the mesh
    Index other = none;           // which of `others`
    Index steps = 0, resolves = 0;
    Real fraction = 0;            // of the way to the target
    AdmissibleStep limit;         // what stood in the way of the first strategy
    UntangleReport untangle;
    FirstLayerChange first_layer;
    Real heights = 0;             // how much of them could be brought back
    Crossing crossing;            // of the boundary at the target
};

struct SafeMorph {
    MovementPath path;
    Span<Real> x, y;                             // [n_points] the mesh as far as it got
    Span<Real> next_x, next_y;                   // [n_points] where a step leads, displacements at first
    Span<Real> reached, aimed, difference;       // [2 * functions] movements since the start
    Span<Vec2> weight;                           // [functions]
    Span<unsigned char> block;                   // of the basis that is solved on the way
    Span<Index> representative;                  // [n_points] for untangling
    Span<std::uint8_t> held;
    Untangling untangling;
    FirstLayer first_layer;
    WallHeights wall_heights;
    Span<PointKind> kinds;                       // [n_points] what wall_heights must know of them

    void lay_out(Arena& arena, Plan const& plan) noexcept;

    // The plan's mesh is the start; `basis` was solved on it. Points on the wall end where the B-spline is. Refused at once:
    // a boundary that crosses itself at the target (Status::crossing). Status::short_of_target: not all of the way.
    // derivative: a basis like `basis`, or null; see hm_morph_safe. The plan is left with the factor of the last step.
    Status run(Plan& plan, Basis const& basis, const Real* move, SafeOptions const& options, const Basis* derivative,
               SafeReport& report, Fault& fault) noexcept;
    // The last valid mesh.
    Points result() const noexcept { return {x.data(), y.data(), 1}; }
    void write(MutablePoints to) const noexcept;

private:
    struct Work;  // the arguments of run()

    Points now() const noexcept { return result(); }
    MutablePoints next() const noexcept { return {next_x.data(), next_y.data(), 1}; }
    void aim(Real time) noexcept;
    bool is_admissible(Work& work, Basis const& by) noexcept;
    bool is_valid(Work const& work) const noexcept;
    Index count_inverted(Work const& work) const noexcept;
    Status substeps(Work& work) noexcept;
    Real find_step(Work& work, Basis const& by, Real from) noexcept;
    void take_step(Work& work, Basis const& by, Real from, Real to_time) noexcept;
    Basis unsolved_copy(Basis const& basis) const noexcept;
    Status solve_at_present(Work& work, Basis const& basis, Fault& why) noexcept;
    void mark_held(Work const& work) const noexcept;
    void restore_heights(Work& work) noexcept;
    void measure_first_layer(Work& work) noexcept;
    Status untangle(Work& work, Basis const& by) noexcept;
    void put_wall(Work const& work) const noexcept;
    void finish_derivative(Work const& work) const noexcept;
};

}  // namespace harmorph
