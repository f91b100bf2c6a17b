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
    Points at_target;  // prescribed positions; sliding points may be anywhere on their line
    // The faces that move, and the periods of the mesh; null if these are not known.
    const FaceDistance* walls = nullptr;
};

// Status::crossing, with the place, if
//   - faces of the boundary cross each other that do not at the start;
//   - a wall crosses a periodic image of the walls, beyond one period or by one passage;
//   - a body is inside out, inside another one, or outside the domain, without crossing anything;
//   - a cell has a corner whose three points are prescribed, and which has no positive area.
// crossing: the faces, of the first two kinds.
Status check_target(Target const& target, Crossing& crossing, Fault& fault) noexcept;

}  // namespace harmorph
