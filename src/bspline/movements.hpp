// The movements of a section that hm_move_section applies. This file maps points; parsec and
// camber_change change the outline. tests/bspline/test_movements.cpp covers all three.
#pragma once

#include "bspline/section.hpp"

namespace harmorph {

// The numbers are those of the C header, which explains them.
enum class MovementKind : std::int32_t {
    turn = 0,
    shift = 1,
    scale = 2,
    flap = 3,
    camber_thickness = 4,
    parsec = 5,
    blade = 6
};

struct Movement {
    MovementKind kind = MovementKind::turn;
    Index n_camber = 0, n_thickness = 0;
    Vec2 centre;  // or the hinge
    Real length = 0;
    Vec2 behind;  // flap: the unit vector from the leading to the trailing edge

    Index count() const noexcept;  // the number of values
    bool maps_points() const noexcept { return kind <= MovementKind::flap; }
    bool needs_chord() const noexcept { return kind >= MovementKind::flap; }
    // Returns the first value that is out of its range, or none. NaN is out of range.
    Index find_bad_value(const Real* values) const noexcept;
};

// A point that a map has moved.
struct MappedPoint {
    Vec2 move;         // exactly 0 if the values are 0
    Vec2 by_x, by_y;   // the derivatives of the new place by the coordinates of the old place
    Vec2 by_value[2];  // the derivatives of the new place by the values
};
MappedPoint map_point(Movement const& movement, const Real* values, Vec2 point) noexcept;

}  // namespace harmorph
