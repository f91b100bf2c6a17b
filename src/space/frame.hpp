// Finds the coordinate frame of the plane in which the faces lie: the origin, the directions of the
// coordinates, and for a wedge the axis. In this library, a frame is a set of coordinate
// directions.
#pragma once

#include "base/span.hpp"
#include "space/space_mesh.hpp"

namespace harmorph {

// A point of space is projected into the plane by a movement across the layers, or in a wedge by a
// rotation about the axis.
struct PlacedPoint {
    Vec2 place;       // the projection in plane coordinates
    Real across = 0;  // the distance from the plane; in a wedge, a number that grows with the angle
    Vec2 rotation{1, 0};  // in a wedge, cosine and sine of the angle
};

struct Frame {
    SpaceKind kind = SpaceKind::planes;
    Vec3 origin, x, y, normal;  // right-handed unit vectors; x is the axis of a wedge
    Real tolerance = 0;         // the largest permitted distance of points from the plane

    PlacedPoint placed(Vec3 point) const noexcept;
    // Returns the plane coordinates of a point of the faces, which lies in the plane.
    Vec2 in_plane(Vec3 point) const noexcept;
    // Returns the movement in space for a movement in the plane, at a point with this rotation.
    Vec3 moved(Vec2 step, Vec2 rotation) const noexcept {
        return step.x * x + step.y * radial(rotation);
    }
    // Is the transpose of moved().
    Vec2 projected(Vec3 step, Vec2 rotation) const noexcept {
        return {dot(step, x), dot(step, radial(rotation))};
    }

private:
    Vec3 radial(Vec2 rotation) const noexcept {
        return kind == SpaceKind::wedge ? rotation.x * y + rotation.y * normal : y;
    }
};

// in_faces [n_points] is 1 for the points of the faces. Refuses faces that are not in one plane.
Status find_frame(SpaceMesh const& mesh, Span<const std::uint8_t> in_faces, Frame& frame,
                  Fault& fault) noexcept;

}  // namespace harmorph
