// Decides before the mesh moves whether there can be a mesh at the target at all. The decision uses
// only what is prescribed at the target and is exact.
#pragma once

#include "basis/basis.hpp"
#include "boundary/distance.hpp"
#include "mesh/topology.hpp"
#include "morph/crossing.hpp"

namespace harmorph {

struct Target {
    OrientedMesh cells;
    BoundaryFaces faces;
    // [n_points] `prescribed` for points of walls and fixed ones; inner points are `unknown`
    Span<const KnownEnd> ends;
    Points start;
    Points at_target;  // prescribed positions; slipping points may be anywhere on their line
    // The faces that move, and the periods of the mesh; null if these are not known.
    const FaceDistance* walls = nullptr;
};

// Returns Status::crossing, with the place, if
//   - faces of the boundary cross each other that do not cross at the start;
//   - a wall crosses a periodic image of the walls, beyond one period or by one passage;
//   - a body is inside out, inside another one, or outside the domain, without crossing anything;
//   - a cell has a corner whose three points are prescribed, and which has no positive area.
// In the first two cases, `crossing` receives the faces.
Status check_target(Target const& target, Crossing& crossing, Fault& fault) noexcept;

}  // namespace harmorph
