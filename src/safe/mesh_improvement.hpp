// Improves a mesh of a plan: the targets are the cells before a movement, and the first layers on
// walls get their heights back.
#pragma once

#include "boundary/first_layer.hpp"
#include "safe/improve.hpp"
#include "safe/mobility.hpp"

namespace harmorph {

struct MeshImprovement {
    Mobility mobility;
    FirstLayer first_layer;
    Improvement improvement;
    Span<Vec2> result;       // [n_points]
    Real given_quality = 0;  // the smallest quality before the improvement

    void lay_out(Arena& arena, Plan const& plan) noexcept;

    // Refuses coordinates out of range and inverted cells.
    static Status check(Plan const& plan, Points reference, Points from, Fault& fault) noexcept;
    // The arrays `reference` and `from` are coordinates of the plan's mesh before and after a
    // movement, which check() has accepted; the improved coordinates are left in `result`. A mesh
    // that is its own reference is not changed. The tops of the first layer are the ends of those
    // edges that leave walls most nearly along the normal. Where the mesh has a layer (see
    // has_layer()), they are put where the wall carries them, with their former height and angle,
    // and are held there. If that would make cells poor, the first steps, at most a third of them,
    // pull the tops to these places with all points free; then each top goes as far as no cell is
    // inverted. If the smallest quality falls meanwhile, is then far below that of `from`, or ends
    // below it, the rest of the steps begins again with the tops where they are in `from`, as far
    // as their cells are not poor there. The plan's distances are left at the reference.
    void run(Plan& plan, ImproveOptions const& options, Points reference, Points from,
             ImproveReport& report) noexcept;
    void write(MutablePoints to) const noexcept {
        for (Index k = 0; k < result.count(); ++k) to.set(k, result[k]);
    }

private:
    // A wall point has a layer if the wall faces beside it are longer than this number of heights.
    static constexpr Real layer_anisotropy = 4;
    // Anchors pull tops that are farther from their places than this, in parts of the height.
    static constexpr Real near_place = 0.02;

    bool has_layer(Index slot, Points reference) const noexcept;
    void find_layer(Points reference, Points from) noexcept;
    void begin(Plan& plan, Points reference, Points from) noexcept;
    bool improve_with_layer(Plan const& plan, ImproveOptions const& options, Points from,
                            ImproveReport& report) noexcept;
    void improve_without_layer(Plan const& plan, ImproveOptions const& options, Points from,
                               ImproveReport& report) noexcept;
    Prepared pull_layer(ImproveOptions const& options, Index solutions, Points from) noexcept;
    bool is_at_least(Points points, Real smallest) const noexcept;
    MutablePoints found() const noexcept { return {&result.data()->x, &result.data()->y, 2}; }
    void place_first_layer(Real lowest, Points from) noexcept;
    Real farthest_top() const noexcept;
    void drop_poor_tops() noexcept;
    void hold_first_layer(bool holds) noexcept;
    bool try_top(Index top, Vec2 at, Points from) noexcept;
    Vec2 position(Index point, Points from) const noexcept;
};

}  // namespace harmorph
