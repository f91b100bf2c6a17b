#include "boundary/slip_along.hpp"

namespace harmorph {
namespace {

constexpr Real max_offset = 0.05;  // as a fraction of the length of the line

// A path along a curve in one direction, through the parameters of points in order.
class Path {
public:
    Path(Curve const& curve, Span<const Real> u, Index n, bool closed) noexcept
        : curve_(curve), u_(u), n_(n), closed_(closed), has_seam_(is_closed(curve)) {
        Index forwards = 0;
        for (Index k = 0; k < n; ++k) forwards += u[next(k)] > u[k] ? 1 : -1;
        ascends_ = forwards >= 0;
    }

    Index next(Index k) const noexcept { return closed_ && k + 1 == n_ ? 0 : k + 1; }
    // Returns the parameter at the fraction t, from 0 to 1, of the path from point k to the next.
    Real at(Index k, Real t) const noexcept {
        Real const period = curve_.end() - curve_.begin();
        Real const begin = leaving(u_[k]), end = arriving(u_[next(k)]);
        if (t >= 1) return end;
        Real length = end - begin;
        if (has_seam_ && length != 0 && (length > 0) != ascends_)
            length += ascends_ ? period : -period;
        Real const u = begin + t * length;
        return u > curve_.end() ? u - period : u < curve_.begin() ? u + period : u;
    }
    Vec2 tangent(Real u) const noexcept {
        Vec2 point[2];
        curve_point(curve_, u, 1, point);
        Real const size = harmorph::length(point[1]);
        return size > 0 ? ((ascends_ ? 1 : -1) / size) * point[1] : Vec2{};
    }

private:
    // The seam of a closed curve has two parameters. A path that leaves the seam uses the one from
    // which the parameters continue; a path that arrives there uses the other one.
    Real leaving(Real u) const noexcept {
        if (has_seam_ && u == (ascends_ ? curve_.end() : curve_.begin()))
            return ascends_ ? curve_.begin() : curve_.end();
        return u;
    }
    Real arriving(Real u) const noexcept {
        if (has_seam_ && u == (ascends_ ? curve_.begin() : curve_.end()))
            return ascends_ ? curve_.end() : curve_.begin();
        return u;
    }

    Curve const& curve_;
    Span<const Real> u_;
    Index n_;
    bool closed_, has_seam_, ascends_;
};

}  // namespace

void SlipAlong::find_corners(Points points, Boundary const& boundary,
                             Span<const Condition> conditions) const noexcept {
    fill(work.is_break.first(boundary.count), std::uint8_t{0});
    auto const mark_nearest = [&](Condition const& condition, Vec2 end) {
        Index nearest = none;
        Real smallest = infinity;
        auto const try_face = [&](Index face) {
            Real const distance = square(points[boundary.point[face]] - end);
            if (!(distance < smallest)) return;
            smallest = distance;
            nearest = face;
        };
        for (Index loop = 0; loop < boundary.n_loops; ++loop) {
            for (Index face = boundary.loop_start[loop]; face < boundary.loop_start[loop + 1];
                 ++face) {
                const Condition* const here = condition_of(conditions, boundary, face);
                if (!is_along(here) || !here->same_curves(condition)) continue;
                try_face(face);
                try_face(boundary.after(face, loop));
            }
        }
        if (nearest != none) work.is_break[nearest] = 1;
    };
    for (Condition const& condition : conditions) {
        if (!is_along(&condition)) continue;
        for (Curve const& curve : curves.from(condition.first_curve, condition.n_curves)) {
            if (is_periodic(curve)) continue;
            mark_nearest(condition, curve_point(curve, curve.begin()));
            mark_nearest(condition, curve_point(curve, curve.end()));
        }
    }
}

Status SlipAlong::give(Condition const& condition, Index n, bool closed, SlipCurves& to,
                       Fault& fault) const noexcept {
    Index const n_points = closed ? n : n + 1, first = to.start[to.count - 1];
    Span<const Vec2> const position = work.position.first(n_points);
    Span<Real> const u = work.u.first(n_points), best_u = work.best_u.first(n_points);
    Real smallest = infinity;
    Index best = condition.first_curve;
    for (Index number = condition.first_curve; number < condition.first_curve + condition.n_curves;
         ++number) {
        Real const misfit = project_chain(curves[number], position, closed, work.projection, u);
        if (!(misfit < smallest)) continue;
        smallest = misfit;
        best = number;
        copy(best_u, Span<const Real>(u));
    }
    Curve const& curve = curves[best];
    Path const path(curve, best_u, n, closed);
    auto const offset = [&](Index k) { return position[k] - curve_point(curve, best_u[k]); };
    Real size = 0, farthest = 0;
    Index where = 0;
    for (Index k = 0; k < n; ++k) size += length(position[path.next(k)] - position[k]);
    for (Index k = 0; k < n_points; ++k) {
        Real const distance = length(offset(k));
        if (distance > farthest) where = k;
        farthest = max(farthest, distance);
    }
    if (farthest > max_offset * size) {
        return fault.refuse(
            Status::bad_condition,
            "point # is ~ away from the curve along which it slips; check the marker of the "
            "condition",
            point_item(to.point[first + where]), {}, farthest);
    }
    bool const smooth = to.give([&](Index j, Vec2& tangent) {
        // The end of a closed line has the same bits as its beginning.
        if (closed && j == n * SlipCurves::divisions) j = 0;
        Index const k = min(j / SlipCurves::divisions, n - 1);
        Real const t = static_cast<Real>(j - k * SlipCurves::divisions) / SlipCurves::divisions,
                   at = path.at(k, t);
        tangent = path.tangent(at);
        return curve_point(curve, at) + (1 - t) * offset(k) + t * offset(path.next(k));
    });
    if (smooth) return Status::ok;
    return fault.refuse(
        Status::bad_condition,
        "the curve along which point # and the following points slip has a corner between them",
        point_item(to.point[first]));
}

}  // namespace harmorph
