// Merges the control volumes of all points of a mesh into coarser ones, for multigrid flow solvers,
// and computes the areas of the merged volumes in any position of the mesh.
#pragma once

#include "multigrid/agglomeration.hpp"
#include "plan/analysis.hpp"

namespace harmorph {

// Points that are joined (the two sides of a cut, periodic pairs) have one control volume. The
// coupling of two volumes is the length of their common face in the median dual, divided by the
// length of the mesh edge between the points. Volumes are merged in the order of a front that
// advances from the boundary, through quadrilaterals first (agglomeration.hpp).
struct CoarseLevels {
    const Analysis* analysis = nullptr;  // must exist as long as the levels
    Agglomeration agglomeration;
    Span<Index> volume;  // [n_points] the volume of each point on the finest level, or none

    void lay_out(Arena& arena, Analysis const& of_analysis) noexcept;
    void build(Analysis const& of_analysis, Points at, MergingRules const& rules) noexcept;

    Index count() const noexcept { return agglomeration.count; }
    Index n_volumes(Index level) const noexcept { return agglomeration.level[level].n; }
    // Computes the volume of a level in which each point is, or none.
    void cells(Index level, Span<Index> cell) const noexcept;
    // Computes the areas of the volumes of a level at the mesh points `to`; if `from` is given,
    // minus the areas at `from`. Each corner of a cell contributes a number that is computed with
    // twice the precision of doubles.
    void areas(Index level, Points from, Points to, Span<Real> area) const noexcept;

private:
    SymmetricRows finest_;
    struct Work {
        Span<Index> first;      // [n_points + 1] the first neighbour of each point
        Span<Index> neighbour;  // [2 * edges]
        Span<Index> order;      // [n_points] the points in the order of the front
        Span<std::uint8_t> in_quad;
    };
    Work work_;

    void order_points() noexcept;
    void fill_rows(Points at) noexcept;
    Index volume_of(Index level, Index point) const noexcept;
};

}  // namespace harmorph
