#include "boundary/wall_distances.hpp"

#include "base/box.hpp"

namespace harmorph {
namespace {

// Returns the extent of the control polygon, whose bounding box contains the curve.
Real extent_of(Curve const& curve) noexcept {
    Box box;
    for (Index k = 0; k < curve.n_indices; ++k) box.include(curve.point(k));
    return box.extent();
}

// Returns the diagonal of the box around the curve.
Real diagonal_of(Curve const& curve) noexcept {
    constexpr Index pieces = 8;  // of a span of the knots
    Box box;
    box.include(curve_point(curve, curve.end()));
    for (Index k = curve.degree; k < curve.n_indices; ++k) {
        Real const begin = curve.knots[k], length = curve.knots[k + 1] - begin;
        for (Index piece = 0; piece < pieces && length > 0; ++piece)
            box.include(curve_point(curve, begin + piece * (length / pieces)));
    }
    return length(box.size());
}

class DistanceCheck {
public:
    DistanceCheck(Points points, Span<const Condition> conditions, Span<const Curve> curves,
                  Real max_distance, Wall const& wall) noexcept
        : points_(points),
          conditions_(conditions),
          curves_(curves),
          max_distance_(max_distance),
          wall_(wall) {
        Box box;
        for (Index slot = 0; slot < wall.count; ++slot) {
            if (wall.curve[slot] < curves.count()) box.include(points[wall.point[slot]]);
        }
        wall_extent_ = box.extent();
    }

    Status run(Fault& fault) noexcept {
        for (Index slot = 0; slot < wall_.count; ++slot) {
            if (wall_.curve[slot] < curves_.count()) HARMORPH_TRY(look_at(slot, fault));
        }
        bool const is_refused = farthest_ != none && (outside_ || largest_ >= max_distance_);
        if (farthest_ != none && (is_refused || beyond_ == none)) return refuse_far(fault);
        if (beyond_ == none) return Status::ok;
        return fault.refuse(
            Status::far_from_curve,
            "point # is ~ beyond the end of its curve, where all points move alike; "
            "check whether a curve is missing",
            point_item(wall_.point[beyond_]), {}, beyond_distance_);
    }

private:
    Status look_at(Index slot, Fault& fault) noexcept {
        Index const number = wall_.curve[slot];
        Curve const& curve = curves_[number];
        Vec2 const point = points_[wall_.point[slot]];
        Real const distance = length(curve_point(curve, wall_.u[slot]) - point);
        if (distance == 0) return Status::ok;
        // The slots of a curve are consecutive, so the extent is computed once.
        if (measured_ != number) {
            measured_ = number;
            curve_extent_ = extent_of(curve);
            diagonal_ = diagonal_of(curve);
        }
        Real const extent = min(curve_extent_, wall_extent_);
        outside_ = outside_ || !(extent > smallest_height) || distance > extent;
        Real const relative = diagonal_ > smallest_height ? distance / diagonal_ : infinity;
        if (relative > largest_ || (farthest_ == none && relative == largest_)) {
            largest_ = relative;
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
            if (named_together(number, other)) continue;
            if (!(project(curves_[other], point).distance < much_nearer * distance)) continue;
            return fault.refuse(Status::bad_condition,
                                "point # is ~ away from its curve, but lies on curve @, which its "
                                "condition does not name",
                                point_item(wall_.point[slot]), curve_item(other), distance);
        }
        return Status::ok;
    }

    // Returns the length of the shorter face at the point. Neighbours along the wall have
    // neighbouring slots.
    Real face_at(Index slot) const noexcept {
        Real shortest = infinity;
        for (Index next = slot - 1; next <= slot + 1; next += 2) {
            if (next < 0 || next >= wall_.count || wall_.curve[next] >= curves_.count()) continue;
            shortest =
                min(shortest, length(points_[wall_.point[next]] - points_[wall_.point[slot]]));
        }
        return shortest;
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
        Status status = Status::bad_condition;
        const char* text =
            "point # is ~ away from its curve, more than the extent of the curve or wall; check "
            "the marker of the condition";
        if (!outside_) {
            text =
                "point # is ~ away from its curve, which is too far for a curve of this wall; fit "
                "a curve to the wall, or accept the distance "
                "(hm_problem.max_curve_distance)";
            if (largest_ < max_distance_) {
                status = Status::far_from_curve;
                text =
                    "point # is ~ away from its curve, at least 0.001 of the diagonal of the box "
                    "around the curve; check the curve";
            }
        }
        return fault.refuse(status, text, point_item(wall_.point[farthest_]), {},
                            largest_distance_);
    }

    static constexpr Real far = 0.001;           // as a fraction of the diagonal
    static constexpr Real share_of_face = 0.25;  // points of a good fit are nearer to the curve
    static constexpr Real much_nearer = 0.0625;  // as a fraction of the distance

    Points points_;
    Span<const Condition> conditions_;
    Span<const Curve> curves_;
    Real max_distance_;
    Wall const& wall_;
    Real wall_extent_ = 0;   // the extent of all points on curves
    Index measured_ = none;  // the curve whose measures the next two are
    Real curve_extent_ = 0, diagonal_ = 0;
    bool outside_ = false;                   // a point is farther away than the extent
    Index farthest_ = none, beyond_ = none;  // slots
    Real largest_ = far, largest_distance_ = 0, beyond_distance_ = 0;
};

}  // namespace

Status check_distances(Points points, Span<const Condition> conditions, Span<const Curve> curves,
                       Real max_distance, Wall const& wall, Fault& fault) noexcept {
    return DistanceCheck(points, conditions, curves, max_distance, wall).run(fault);
}

}  // namespace harmorph
