// Can there be a mesh at the target at all? Decided from what is prescribed there, exactly, before
// the mesh moves.
#pragma once

#include "basis/basis.hpp"
#include "mesh/topology.hpp"
#include "morph/crossing.hpp"

namespace harmorph {

struct Target {
    OrientedMesh cells;
    Span<const Index> boundary_point, loop_start;
    // [n_points] `prescribed` for points of walls and fixed ones; inner points are `unknown`
    Span<const KnownEnd> ends;
    Points start;
    Points at_target;  // where points are prescribed; where they slide, anywhere on their line
};

// Status::crossing, with the place, if
//   - faces of the boundary cross each other;
//   - a body is inside out, inside another one, or outside the domain, without crossing anything;
//   - a cell has a corner whose three points are prescribed, and which has no positive area.
// crossing: the faces, of the first kind.
Status check_target(Target const& target, Crossing& crossing, Fault& fault) noexcept;

}  // namespace harmorph
