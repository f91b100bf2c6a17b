// A morph that reaches the target with cells of good quality, or says how far it came and where
// cells are poor: strategies are tried in the order of their cost, and the best mesh of all is
// kept.
#pragma once

#include "boundary/first_layer.hpp"
#include "boundary/wall_heights.hpp"
#include "morph/quality.hpp"
#include "safe/mesh_improvement.hpp"
#include "safe/mobility.hpp"
#include "safe/moving_mesh.hpp"
#include "safe/untangle.hpp"

namespace harmorph {

enum class Strategy : std::int32_t {
    linear = 0,
    other = 1,
    substeps = 2,
    untangled = 3,
    improved = 4
};

struct SafeOptions {
    Index most_resolves = 10;
    std::uint32_t skipped = 0;  // bit k: strategy k is not tried
    Span<const Basis> others;   // solved with other operators or exponents
    bool solves_others =
        false;  // instead of `others`: solve with other operators at the start, where needed
    UntangleOptions untangle;
    ImproveOptions improve;
    bool improves = false;  // the mesh at the target is made better, however good it is
    // 0..1, of the smallest quality of the start: below it, a mesh at the target that is good
    // enough is still tried to be made better by other operators and by improvement, without steps
    Real fair_quality = 0;
    Real heights = 0;         // 0..1: how much of the heights near walls is brought back at the end
    Real min_quality = 0.05;  // 0..1: of the smallest quality of the start
    Real most_height_change =
        infinity;  // > 1: of heights of the first layer, by which they may grow or shrink

    bool tries(Strategy strategy) const noexcept {
        return (skipped >> static_cast<std::int32_t>(strategy) & 1) == 0;
    }
};

// Where a strategy led.
struct Outcome {
    Strategy strategy = Strategy::linear;  // the last one that moved the mesh
    Index other = none;  // which of `others`; where they are solved for here, the operator
    Index steps = 0;
    Real fraction = 0;       // of the way to the target
    Real min_quality = 0;    // relative to the start
    Real turned_offset = 0;  // largest of what points of walls moved by beside their curve
    Real height_change = 1;  // largest factor, >= 1; not measured where it is not limited
};

struct WorstCell {
    Index cell = none;
    Real quality = 0, before = 0;  // relative to the start; of the start alone
    Vec2 centre;                   // mean of the corners
};

struct SafeReport {
    static constexpr Index most_worst = 5;

    Outcome outcome;       // of the mesh that is given
    Index resolves = 0;    // of all strategies
    AdmissibleStep limit;  // what stood in the way of the step that was tried last
    UntangleReport untangle;
    FirstLayerChange first_layer;
    Real heights = 0;        // how much of them could be brought back
    Crossing crossing;       // of the boundary at the target
    Real start_quality = 0;  // smallest of the start
    // Of the ends of walls that leave the lines beside them, the one that goes farthest from its
    // line, and how far; none: no end does
    Index end = none;
    Real end_leaves = 0;
    Index n_worst = 0;
    WorstCell worst[most_worst];  // the worst first
};

struct SafeMorph {
    MovingMesh mesh;
    Span<Real> best_x, best_y;  // [n_points] the best mesh so far
    Span<Real> reached;         // [2 * functions] the movement that it has
    Span<Vec2> weight;          // [functions]
    Span<unsigned char> block;  // of the basis that is solved on the way
    Mobility mobility;          // of the untangling
    Untangling untangling;      // in the same memory as the improvement: one works after the other
    MeshImprovement improvement;
    FirstLayer first_layer;
    WallHeights wall_heights;
    Span<PointKind> kinds;  // [n_points] what wall_heights must know of them

    // For bases with these counts: those of the plan, or of what was derived from its basis.
    void lay_out(Arena& arena, Plan const& plan, BasisCounts const& counts) noexcept;

    // The plan's mesh is the start; `basis` was solved on it. Points on the wall end where the
    // B-spline, and what is carried of their offsets, put them. Refused at once: a target that is
    // impossible (Status::crossing, see check_target). Status::short_of_target: not all of the way.
    // Status::poor: all of it, but the quality asked for is missed. derivative: a basis like
    // `basis`, or null; see hm_morph_safe. Where functions were solved again, the plan is left
    // without a factor.
    Status run(Plan& plan, Basis const& basis, const Real* move, SafeOptions const& options,
               const Basis* derivative, SafeReport& report, Fault& fault) noexcept;
    Points result() const noexcept { return {best_x.data(), best_y.data(), 1}; }
    void write(MutablePoints to) const noexcept;

private:
    struct Work;  // the arguments of run(), and what is asked for

    Status climb(Work& work) noexcept;
    void begin(Work& work) noexcept;
    AdmissibleStep look_ahead(Work& work, Basis const& by, Real to) noexcept;
    bool is_valid(Work const& work, Points points) const noexcept;
    void take_step(Work& work, Basis const& by) noexcept;
    void turn_sliding(Work const& work) const noexcept;
    void keep_if_better(Work& work) noexcept;
    void keep(Work& work, Outcome const& outcome, Span<const Real> x, Span<const Real> y,
              Span<const Real> movement) noexcept;
    // The best mesh becomes the one ahead, which has the same movement: reached and derivative
    // stay.
    void replace_inner_points(Work& work, Outcome const& outcome) noexcept;
    void measure(Work const& work, Points points, Outcome& outcome) const noexcept;
    void single_step(Work& work, Basis const& by, Strategy strategy, Index other) noexcept;
    void longest_linear_step(Work& work) noexcept;

    // substeps.cpp
    struct OperatorChoice;
    struct Operators;
    Status other_operators(Work& work) noexcept;
    Status substeps(Work& work) noexcept;
    Real find_step(Work& work, Basis const& by) noexcept;
    Basis const& choose_first(Work& work, Real& length) noexcept;
    bool is_stuck(Work const& work, Real length) const noexcept;
    Status change_operator(Work& work, Basis const& here, Operators& operators,
                           Real& length) noexcept;
    Status solve_by(Work& work, Basis const& here, OperatorChoice const& choice) noexcept;
    Status solve_at_present(Work& work, Basis const& basis) noexcept;
    Basis unsolved_copy(Basis const& basis) const noexcept;

    bool leap(Work& work, Basis const& by, bool is_last) noexcept;
    bool improve(Work& work, Points from) noexcept;
    void improve_at_end(Work& work) noexcept;
    void restore_heights(Work& work) noexcept;
    void measure_worst(Work& work) const noexcept;
    void finish_derivative(Work& work) noexcept;
    bool keep_order_of_sliding(Work const& work) noexcept;
    bool untangle_ahead(Work& work) noexcept;
    void find_end_that_leaves(Work& work) const noexcept;
    bool is_beside(Work const& work, Index cell, Index point) const noexcept;
    Status finish(Work& work) noexcept;
};

}  // namespace harmorph
