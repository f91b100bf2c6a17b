// A safe morph reaches the target with cells of good quality, or reports how far the mesh came and
// where cells are poor. Strategies are tried in the order of their cost, and the best mesh is kept.
#pragma once

#include "boundary/first_layer.hpp"
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
    Index max_resolves = 10;  // for each part of the movement that is tried
    // The largest number of solutions, of functions and of improvements together; and of those that
    // search for the largest part of a movement that cannot be completed.
    static constexpr Index max_solutions = 200, max_in_search = 60;
    // An improvement that multiplies smallest and mean quality together by less is not worth a
    // change.
    static constexpr Real clear_gain = 1.02;
    std::uint32_t skipped = 0;  // bit k: strategy k is skipped
    Span<const Basis> others;   // solved with other operators or exponents
    // If true, the morph solves functions of other operators at the start where they are needed;
    // then `others` is empty.
    bool solves_others = false;
    UntangleOptions untangle;
    ImproveOptions improve;
    bool improves = false;  // the mesh at the target is always improved
    // The largest part of a movement that cannot be completed is searched for.
    bool searches = true;
    // Fractions, 0 to 1, of the smallest quality of the start. If the quality of an acceptable mesh
    // at the target is below fair_quality, other operators are tried, but no substeps; below
    // fine_quality, an improvement is tried.
    Real fair_quality = 0.8, fine_quality = 0.98;
    Real heights = 0;  // 0 to 1: the part of the heights near walls that is restored at the end
    Real min_quality = 0.05;  // 0 to 1: in parts of the smallest quality of the start
    // A factor > 1, by which heights of the first layer may grow or shrink.
    Real max_height_change = infinity;

    bool tries(Strategy strategy) const noexcept {
        return (skipped >> static_cast<std::int32_t>(strategy) & 1) == 0;
    }
};

// The mesh that a strategy ended with.
struct Outcome {
    Strategy strategy = Strategy::linear;  // the last strategy that moved the mesh
    // The index in SafeOptions::others, or the operator if SafeOptions::solves_others is true; none
    // if the functions were those of the given basis.
    Index other = none;
    Index steps = 0;
    Real fraction = 0;                       // of the whole movement
    Real min_quality = 0, mean_quality = 0;  // relative to the start
    // The largest displacement of points of walls that their carried offsets cause.
    Real rotated_offset = 0;
    // The largest factor, >= 1, by which heights changed; it is not measured unless the change is
    // limited.
    Real height_change = 1;
};

struct WorstCell {
    Index cell = none;
    Real quality = 0, before = 0;  // relative to the start; absolute at the start
    Vec2 centre;                   // the mean of the corners
};

struct SafeReport {
    static constexpr Index max_worst = 5;

    Outcome outcome;           // of the returned mesh
    Index resolves = 0;        // by all strategies together
    Real untangling = 0;       // the work of all untangling, in solutions
    Index improvements = 0;    // the solutions of all improvements
    bool may_improve = false;  // the last improvement ended at the limit of solutions
    AdmissibleStep limit;      // the limit of the last step that was tried
    UntangleReport untangle;
    FirstLayerChange first_layer;
    Real heights = 0;                        // the part of the heights that could be restored
    Crossing crossing;                       // of boundary faces at the target
    Real start_quality = 0, start_mean = 0;  // the smallest and the mean quality at the start
    // Among the ends of walls that leave the lines beside them, the end that goes farthest from its
    // line, and the distance from the line; none if no end leaves its line.
    Index end = none;
    Real end_distance = 0;
    Index n_worst = 0;
    WorstCell worst[max_worst];  // the worst cell first

    Index solutions() const noexcept {
        return resolves + improvements + static_cast<Index>(untangling);
    }
};

struct SafeMorph {
    MovingMesh mesh;
    Span<Real> best_x, best_y;  // [n_points] the best mesh so far
    Span<Real> reached;         // [2 * functions] the movement of the best mesh
    Span<Vec2> weight;          // [functions]
    Span<unsigned char> block;  // the block of the basis that is solved on the way
    Mobility mobility;          // for untangling
    // The untangling uses the same memory as the improvement, because they work one after the
    // other.
    Untangling untangling;
    MeshImprovement improvement;
    FirstLayer first_layer;
    WallHeights wall_heights;
    Span<PointKind> kinds;  // [n_points] the kinds that wall_heights needs

    // Takes memory for bases with these counts, which are those of the plan, or of a basis derived
    // from the plan's basis.
    void lay_out(Arena& arena, Plan const& plan, BasisCounts const& counts) noexcept;

    // The plan's mesh, on which `basis` was solved, is the start. Points on the wall end where the
    // B-spline and their carried offsets put them. An impossible target is refused at once
    // (Status::crossing, see check_target). Status::short_of_target means that the movement is not
    // complete. Status::poor means that the movement is complete but the quality asked for is not
    // reached. The derivative is a basis like `basis`, or null; see hm_move_safe. If functions
    // were solved again, the plan is left without a factor.
    Status run(Plan& plan, Basis const& basis, const Real* move, SafeOptions const& options,
               const Basis* derivative, SafeReport& report, Fault& fault) noexcept;
    Points result() const noexcept { return {best_x.data(), best_y.data(), 1}; }
    void write(MutablePoints to) const noexcept;

private:
    struct Work;  // the arguments of run() and the values derived from them

    Status climb(Work& work) noexcept;
    void improve_result(Work& work) noexcept;
    Status several_steps(Work& work) noexcept;
    Status search_farthest(Work& work) noexcept;
    void begin(Work& work) noexcept;
    void resume(Work& work) noexcept;
    AdmissibleStep look_ahead(Work& work, Basis const& by, Real to) noexcept;
    bool is_valid(Work const& work, Points points) const noexcept;
    void take_step(Work& work, Basis const& by) noexcept;
    void rotate_slipping(Work const& work) const noexcept;
    void keep_if_better(Work& work) noexcept;
    void keep(Work& work, Outcome const& outcome, Span<const Real> x, Span<const Real> y,
              Span<const Real> movement) noexcept;
    // Puts the best mesh ahead, which has the same movement; `reached` and the derivative stay.
    void replace_inner_points(Work& work, Outcome const& outcome) noexcept;
    void measure(Work const& work, Points points, Outcome& outcome) const noexcept;
    void single_step(Work& work, Basis const& by, Strategy strategy, Index other) noexcept;
    void longest_linear_step(Work& work) noexcept;

    // These functions are in substeps.cpp.
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
    Basis copy_to_solve(Work const& work) const noexcept;

    bool leap(Work& work, Basis const& by, bool is_last) noexcept;
    bool run_improvement(Work& work, Index max_solutions, Points from) noexcept;
    bool improve(Work& work, Points from) noexcept;
    void improve_on_the_way(Work& work) noexcept;
    void improve_at_end(Work& work) noexcept;
    void restore_heights(Work& work) noexcept;
    void measure_worst(Work& work) const noexcept;
    void finish_derivative(Work& work) noexcept;
    bool keep_order_of_slipping(Work const& work) noexcept;
    bool untangle_ahead(Work& work, Real max_work) noexcept;
    void find_end_that_leaves(Work& work) const noexcept;
    bool is_beside(Work const& work, Index cell, Index point) const noexcept;
    Status finish(Work& work) noexcept;
};

}  // namespace harmorph
