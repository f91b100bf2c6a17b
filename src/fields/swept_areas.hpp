// Computes the areas that the sides of cells and the faces of the median dual sweep while all
// points move on straight lines at constant velocities from one mesh to another.
#pragma once

#include "base/executor.hpp"
#include "mesh/mesh.hpp"

namespace harmorph {

// Each cell has one entry for each entry of its list of points: 3 for a triangle, 4 for a
// quadrilateral, as many as corners for a polygon. Entry k belongs to the directed side from point
// k of the cell to the next one, and to the line from the middle of that side to the mean of the
// corners of the cell. An area is positive if the line moves to its right. Arrays that are empty
// are not computed. The from and to of every point must be in range.
struct SweptAreas {
    Span<Real> sides;   // [entries]
    Span<Real> duals;   // [entries] the lines from the middles of sides to the means of the corners
    Span<Real> halves;  // [2 * entries] the two halves of each side

    // Returns the number of entries of all cells; the layout of the mesh must have been checked.
    static Offset count_entries(Mesh const& mesh) noexcept;
    void compute(Mesh const& mesh, Points from, Points to, Executor const& executor) const noexcept;
};

}  // namespace harmorph
