// Transfer from a coarse mesh to a finer one of the same domain: solved functions are interpolated,
// and the known values on the fine boundary are restored.
#pragma once

#include "boundary/distance.hpp"
#include "mesh/locate.hpp"
#include "plan/analysis.hpp"

namespace harmorph {

struct TransferReport {
    // The number of interpolated points, which are neither on the wall nor fixed.
    Index points = 0;
    // The number of points outside the coarse mesh, including points on the wall.
    Index outside = 0;
    Real max_distance = 0;
    Index max_distance_point = none;
    // The largest difference between interpolated functions and boundary functions on the wall.
    Real wall_correction = 0;
};

// Points of the fine mesh get the values interpolated in the coarse cell in which they lie. Points
// outside the coarse mesh (beyond a curved boundary, whose coarse faces are chords of the fine
// boundary) get values extrapolated linearly from the nearest cell, over at most half the longest
// side of that cell: a circular arc up to a semicircle rises no higher above the chord.
//
// Wall points get the boundary functions instead. The difference D to the interpolated values, of
// second order in the coarse spacing h, is large relative to the thin first layers of a viscous
// mesh, which would invert. Therefore points near the wall get the correction (1 - d/h) D, where d
// is the distance of the point from the wall, and h and D are those at the foot. The strain that
// this adds is of first order in h, like that of the interpolation.
struct Transfer {
    Locator locator;
    FaceDistance wall;      // The faces of the fine mesh that move.
    Span<Real> correction;  // [wall x row_length] D of each slot.
    Span<Real> reach;       // [wall] h of each slot.

    void lay_out(Arena& arena, Analysis const& fine, Mesh const& coarse) noexcept;

    // `fine` must have been made from the analysis; `coarse` must have been solved on coarse_mesh.
    // Seals `fine`; after a refused call `fine` is unsolved.
    Status run(Analysis const& analysis, Mesh const& coarse_mesh, Basis const& coarse,
               Basis const& fine, TransferReport& report, Fault& fault) noexcept;
};

// Refuses bases with different curves, bodies or methods; without these differences function i is
// the same function on both meshes.
Status check_alike(Basis const& coarse, Basis const& fine, Fault& fault) noexcept;

}  // namespace harmorph
