// The multifrontal factor of a Hessian in 2 x 2 blocks, in the order of elimination of the plan.
#pragma once

#include "plan/plan.hpp"
#include "safe/newton_system.hpp"

namespace harmorph {

// The tree is that of the plan's direct engine: where a position of the plan's equations is a point
// (with one real or one complex number), it becomes two positions, x and y. Points of the plan that
// are not in the region have an equation of their own, without neighbours.
struct PointFactor {
    Multifrontal engine;
    Matrix matrix;
    Span<Index> node;   // [positions] the node that eliminates the position
    Span<Real> scale;   // [positions] powers of two that make the diagonal about 1
    Span<Real> values;  // [positions x 2] right-hand sides and solutions
    Index per_position = 1;

    // Without a direct engine there is no factor, and no memory for it.
    static bool exists(Plan const& plan) noexcept { return plan.engine().kind == Engine::direct; }
    void lay_out(Arena& arena, Plan const& plan) noexcept;
    // Copies the tree.
    void init(Plan const& plan) noexcept;
    // Factors the system's Hessian. Status::not_positive: rounding has made the Hessian singular.
    Status factorise(Plan const& plan, Tangle const& tangle, Region const& region,
                     NewtonSystem const& system) noexcept;
    // Sets first = hessian^-1 first and second = hessian^-1 second.
    void solve(Plan const& plan, Tangle const& tangle, Region const& region, Span<Vec2> first,
               Span<Vec2> second) noexcept;

private:
    Multifrontal const& of_plan(Plan const& plan) const noexcept {
        return plan.engine().direct.factor;
    }
    // Returns the position of x (component 0) or y (1) of an unknown. The only position of a point
    // that slips is that of the movement along its line.
    Index position(Plan const& plan, Index point, Index component) const noexcept;
    template <class Visit>
    void for_each_entry(Plan const& plan, Tangle const& tangle, Region const& region,
                        NewtonSystem const& system, Visit const& visit) const noexcept;
    void fill_matrix(Plan const& plan, Tangle const& tangle, Region const& region,
                     NewtonSystem const& system) noexcept;
    void drop_entries_beyond_fronts() noexcept;
    void scale_matrix() const noexcept;
};

}  // namespace harmorph
