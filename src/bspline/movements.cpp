#include "bspline/movements.hpp"

#include "base/range.hpp"
#include "bspline/degrees.hpp"

namespace harmorph {
namespace {

constexpr Real largest_turn = 360;  // degrees

MappedPoint turn_about(Vec2 centre, Real degrees, Vec2 point) noexcept {
    Vec2 const turn = turn_by(degrees), arm = point - centre;
    Vec2 const by_degrees = per_degree * left_of(turned(arm, turn));
    return {turned(arm, turn - Vec2{1, 0}), turn, left_of(turn), {by_degrees, {}}};
}

MappedPoint deflect(Movement const& flap, Real degrees, Vec2 point) noexcept {
    Vec2 const arm = point - flap.centre;
    // A quotient that is out of range is not computed: it may overflow.
    Real const behind = dot(arm, flap.behind);
    Real const t = behind >= flap.length ? 1 : behind > 0 ? behind / flap.length : 0;
    Real const share = t * t * t * (10 - t * (15 - 6 * t));
    Real const slope = t > 0 && t < 1 ? 30 * t * t * (1 - t) * (1 - t) / flap.length : 0;
    MappedPoint mapped = turn_about(flap.centre, share * degrees, point);
    Vec2 const by_angle = mapped.by_value[0];
    mapped.by_x = mapped.by_x + (degrees * slope * flap.behind.x) * by_angle;
    mapped.by_y = mapped.by_y + (degrees * slope * flap.behind.y) * by_angle;
    mapped.by_value[0] = share * by_angle;
    return mapped;
}

}  // namespace

Index Movement::count() const noexcept {
    switch (kind) {
        case MovementKind::shift: return 2;
        case MovementKind::camber_thickness: return n_camber + n_thickness;
        case MovementKind::parsec: return 11;
        case MovementKind::blade: return 3;
        default: return 1;
    }
}

Index Movement::find_bad_value(const Real* values) const noexcept {
    bool const is_angle =
        kind == MovementKind::turn || kind == MovementKind::flap || kind == MovementKind::blade;
    for (Index j = 0; j < count(); ++j) {
        if (!is_at_most(values[j], is_angle ? largest_turn : largest_coordinate)) return j;
    }
    return kind == MovementKind::scale && !(values[0] > -1) ? 0 : none;
}

MappedPoint map_point(Movement const& movement, const Real* values, Vec2 point) noexcept {
    Vec2 const x{1, 0}, y{0, 1};
    switch (movement.kind) {
        case MovementKind::shift: return {{values[0], values[1]}, x, y, {x, y}};
        case MovementKind::scale: {
            Vec2 const arm = point - movement.centre;
            Real const scale = 1 + values[0];
            return {values[0] * arm, scale * x, scale * y, {arm, {}}};
        }
        case MovementKind::flap: return deflect(movement, values[0], point);
        default: return turn_about(movement.centre, values[0], point);
    }
}

}  // namespace harmorph
