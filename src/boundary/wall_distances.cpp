#include "boundary/wall_distances.hpp"

namespace harmorph {
namespace {

struct WallBox {
    Vec2 low{infinity, infinity}, high{-infinity, -infinity};

    void add(Vec2 p) noexcept {
        low = {min(low.x, p.x), min(low.y, p.y)};
        high = {max(high.x, p.x), max(high.y, p.y)};
    }
    Real extent() const noexcept { return max(high.x - low.x, high.y - low.y); }
};

// A curve lies in the box of its control polygon.
Real extent_of(Curve const& curve) noexcept {
    WallBox box;
    for (Index k = 0; k < curve.n_indices; ++k) box.add(curve.point(k));
    return box.extent();
}

class DistanceCheck {
public:
    DistanceCheck(Points points, Span<const Condition> conditions, Span<const Curve> curves,
                  Wall const& wall) noexcept
        : points_(points), conditions_(conditions), curves_(curves), wall_(wall) {
        WallBox box;
        for (Index slot = 0; slot < wall.count; ++slot) {
            if (wall.curve[slot] < curves.count()) box.add(points[wall.point[slot]]);
        }
        wall_extent_ = box.extent();
    }

    Status run(Fault& fault) noexcept {
        for (Index slot = 0; slot < wall_.count; ++slot) {
            if (wall_.curve[slot] < curves_.count()) HARMORPH_TRY(look_at(slot, fault));
        }
        if (farthest_ != none) return refuse_far(fault);
        if (beyond_ == none) return Status::ok;
        return fault.refuse(Status::far_from_curve,
                            "point # is ~ beyond the end of its curve: points there move as one; "
                            "is a curve missing?",
                            point_item(wall_.point[beyond_]), {}, beyond_distance_);
    }

private:
    Status look_at(Index slot, Fault& fault) noexcept {
        Index const its_curve = wall_.curve[slot];
        Curve const& curve = curves_[its_curve];
        Vec2 const point = points_[wall_.point[slot]];
        Real const distance = length(curve_point(curve, wall_.u[slot]) - point);
        if (distance == 0) return Status::ok;
        if (measured_ != its_curve) {  // slots of a curve follow each other
            measured_ = its_curve;
            curve_extent_ = extent_of(curve);
        }
        Real const extent = min(curve_extent_, wall_extent_);
        Real const part = extent > smallest_height ? distance / extent : infinity;
        if (part > largest_) {
            largest_ = part;
            largest_distance_ = distance;
            farthest_ = slot;
        }
        if (!(distance > share_of_face * face_at(slot))) return Status::ok;
        bool const at_end = wall_.u[slot] == curve.begin() || wall_.u[slot] == curve.end();
        if (at_end && !is_periodic(curve) && distance > beyond_distance_) {
            beyond_ = slot;
            beyond_distance_ = distance;
        }
        for (Index other = 0; other < curves_.count(); ++other) {
            if (named_together(its_curve, other)) continue;
            if (!(project(curves_[other], point).distance < much_nearer * distance)) continue;
            return fault.refuse(Status::bad_condition,
                                "point # is ~ from its curve, but on curve @, which its "
                                "condition does not "
                                "name",
                                point_item(wall_.point[slot]), curve_item(other), distance);
        }
        return Status::ok;
    }

    // The length of the shorter face at the point. Neighbours along the wall have neighbouring
    // slots.
    Real face_at(Index slot) const noexcept {
        Real least = infinity;
        for (Index next = slot - 1; next <= slot + 1; next += 2) {
            if (next < 0 || next >= wall_.count || wall_.curve[next] >= curves_.count()) continue;
            least = min(least, length(points_[wall_.point[next]] - points_[wall_.point[slot]]));
        }
        return least;
    }

    bool named_together(Index a, Index b) const noexcept {
        if (a == b) return true;
        for (Condition const& condition : conditions_) {
            auto const names = [&](Index curve) {
                return curve >= condition.first_curve &&
                       curve < condition.first_curve + condition.n_curves;
            };
            if (condition.kind == ConditionKind::on_curve && names(a) && names(b)) return true;
        }
        return false;
    }

    Status refuse_far(Fault& fault) const noexcept {
        bool const is_another = largest_ > 1;
        return fault.refuse(is_another ? Status::bad_condition : Status::far_from_curve,
                            is_another ? "point # is ~ from its curve, farther than that is large: "
                                         "is its marker another one?"
                                       : "point # is ~ from its curve, above .05 of the extent of "
                                         "curve or wall: is the curve "
                                         "its own?",
                            point_item(wall_.point[farthest_]), {}, largest_distance_);
    }

    static constexpr Real far = 0.05;            // of the extent
    static constexpr Real share_of_face = 0.25;  // a fit that follows the faces is nearer
    static constexpr Real much_nearer = 0.0625;

    Points points_;
    Span<const Condition> conditions_;
    Span<const Curve> curves_;
    Wall const& wall_;
    Real wall_extent_ = 0;   // of all points on curves
    Index measured_ = none;  // the curve with the extent below
    Real curve_extent_ = 0;
    Index farthest_ = none, beyond_ = none;  // slots
    Real largest_ = far, largest_distance_ = 0, beyond_distance_ = 0;
};

}  // namespace

Status check_distances(Points points, Span<const Condition> conditions, Span<const Curve> curves,
                       Wall const& wall, Fault& fault) noexcept {
    return DistanceCheck(points, conditions, curves, wall).run(fault);
}

}  // namespace harmorph
