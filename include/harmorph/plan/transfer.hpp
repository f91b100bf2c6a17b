// From a coarse mesh to a denser one of the same domain: solved functions are interpolated, and what is known on the fine
// boundary is restored.
#pragma once

#include "harmorph/boundary/distance.hpp"
#include "harmorph/mesh/locate.hpp"
#include "harmorph/plan/analysis.hpp"

namespace harmorph {

struct TransferReport {
    Index points = 0;                  // interpolated: neither on the wall nor fixed
    Index outside = 0;                 // of them and of the wall's: outside the coarse mesh
    Real max_distance = 0;
    Index max_distance_point = none;
    Real wall_correction = 0;          // largest difference between interpolated and boundary functions on the wall
};

// Points of the fine mesh get the values of the coarse cell they are in. Those outside (beyond a curved boundary, whose
// coarse faces are chords of the fine one) get those of the nearest cell, extrapolated linearly; half its longest side
// is the farthest: no circular arc rises higher above its chord.
//
// Wall points get their boundary functions instead. The difference D, of second order in the coarse spacing h, is large
// against the thin first layers of a viscous mesh, which would invert. So the points near the wall move along: each gets
// (1 - d/h) D, d its distance from the wall and h and D those at the foot. The strain that this adds is of first order in h,
// like the interpolation's own.
struct Transfer {
    Locator locator;
    FaceDistance wall;       // faces that move, of the fine mesh
    Span<Real> correction;   // [wall x row_length] D of each slot
    Span<Real> reach;        // [wall] h

    void lay_out(Arena& arena, Analysis const& fine, Mesh const& coarse) noexcept;

    // `fine` must have been made of the analysis, `coarse` been solved on coarse_mesh. Seals `fine`; a refused call leaves
    // it unsolved.
    Status run(Analysis const& analysis, Mesh const& coarse_mesh, Basis const& coarse, Basis const& fine,
               TransferReport& report, Fault& fault) noexcept;
};

// Same curves, bodies and way of solving? Then function i is the same function on both meshes.
Status check_alike(Basis const& coarse, Basis const& fine, Fault& fault) noexcept;

}  // namespace harmorph
