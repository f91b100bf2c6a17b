// Where the plane of the faces is, which directions its coordinates have, and for a wedge the axis.
#pragma once

#include "base/span.hpp"
#include "space/space_mesh.hpp"

namespace harmorph {

// A point of space as the plane sees it: its place in the plane, after a movement across the layers
// or a turn about the axis; and where it is on this way, the distance from the plane or cosine and
// sine of the angle.
struct PlacedPoint {
    Vec2 place;
    Real across = 0;
    Vec2 turn{1, 0};
};

struct Frame {
    SpaceKind kind = SpaceKind::planes;
    Vec3 origin, x, y, normal;  // unit vectors, right-handed; x is a wedge's axis
    Real tolerance = 0;         // how far points may be from where they should be

    PlacedPoint placed(Vec3 point) const noexcept;
    // Of a point of the faces: it is in the plane.
    Vec2 in_plane(Vec3 point) const noexcept;
    // The movement in space of a movement in the plane, for a point with this turn.
    Vec3 moved(Vec2 step, Vec2 turn) const noexcept { return step.x * x + step.y * radial(turn); }
    // The transpose.
    Vec2 projected(Vec3 step, Vec2 turn) const noexcept {
        return {dot(step, x), dot(step, radial(turn))};
    }

private:
    Vec3 radial(Vec2 turn) const noexcept {
        return kind == SpaceKind::wedge ? turn.x * y + turn.y * normal : y;
    }
};

// in_faces [n_points]: 1 for the points of the faces. Refuses faces that are not in one plane.
Status find_frame(SpaceMesh const& mesh, Span<const std::uint8_t> in_faces, Frame& frame,
                  Fault& fault) noexcept;

}  // namespace harmorph
