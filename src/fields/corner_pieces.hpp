// Divides a cell into its shares of the control volumes of its corners.
// tests/fields/test_remap.cpp covers this file.
#pragma once

#include "fields/convex_polygon.hpp"
#include "mesh/box_tree.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

// The share of corner k is the convex quadrilateral of the corner, the middle of the side ahead,
// the mean of all corners, and the middle of the preceding side. All places are relative to an
// origin, which should be near, as differences of coordinates lose no digits then.
struct CornerPieces {
    Cell cell;
    Vec2 corner[4], middle[4], centre;  // middle k: of the side from corner k to the next one
    Box box;

    CornerPieces(Cell const& of_mesh, Points points, Vec2 origin) noexcept : cell(of_mesh) {
        Vec2 sum;
        for (Index k = 0; k < cell.n; ++k) {
            corner[k] = points[cell.point[k]] - origin;
            box.include(corner[k]);
            sum = sum + (corner[k] - corner[0]);
        }
        for (Index k = 0; k < cell.n; ++k)
            middle[k] = 0.5 * (corner[k] + corner[k + 1 == cell.n ? 0 : k + 1]);
        centre = corner[0] + (1.0 / cell.n) * sum;
    }

    Index behind(Index k) const noexcept { return k == 0 ? cell.n - 1 : k - 1; }
    ConvexPolygon piece(Index k) const noexcept {
        ConvexPolygon polygon;
        polygon.add(corner[k]);
        polygon.add(middle[k]);
        polygon.add(centre);
        polygon.add(middle[behind(k)]);
        return polygon;
    }
    // The line of a side is the same for both cells beside the side: the direction goes by the
    // numbers of the points.
    CuttingLine side(Index k) const noexcept {
        Index const next = k + 1 == cell.n ? 0 : k + 1;
        bool const ahead = cell.point[k] < cell.point[next];
        Index const from = ahead ? k : next, to = ahead ? next : k;
        return {corner[from], corner[to] - corner[from], ahead};
    }
    // The line between the pieces of corner k and of the next corner.
    CuttingLine spoke(Index k, bool keeps_left) const noexcept {
        return {middle[k], centre - middle[k], keeps_left};
    }
    // Returns what a polygon has in common with the piece of corner k.
    ConvexPolygon common(ConvexPolygon polygon, Index k) const noexcept {
        CuttingLine const lines[4] = {side(k), spoke(k, true), spoke(behind(k), false),
                                      side(behind(k))};
        for (CuttingLine const& line : lines) {
            polygon = polygon.clipped(line);
            if (polygon.n < 3) break;
        }
        return polygon;
    }
};

}  // namespace harmorph
