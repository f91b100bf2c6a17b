#include "boundary/slip.hpp"

#include "base/hash.hpp"
#include "base/vec2.hpp"

namespace harmorph {
namespace {

constexpr Index max_steps = 100;  // steps of Newton's method or bisection on a segment

Vec2 mirrored(Vec2 tangent, Vec2 chord) noexcept {
    return (2 * dot(tangent, chord)) * chord - tangent;
}

// Returns the tangent of the circle through three points, at the second point.
Vec2 circle_tangent(Vec2 before, Vec2 here, Vec2 after) noexcept {
    Vec2 const a = here - before, b = after - here;
    Real const length_a = length(a), length_b = length(b);
    Real const share = length_a / (length_a + length_b);
    return direction(((1 - share) / length_a) * a + (share / length_b) * b);
}

// A cubic on 0..1, given by its ends and its derivatives at the ends.
struct Cubic {
    Vec2 begin, end, leaving, arriving;

    Vec2 at(Real u) const noexcept {
        Real const v = 1 - u;
        return begin + (u * u * (3 - 2 * u)) * (end - begin) + (u * v * v) * leaving -
               (u * u * v) * arriving;
    }
    Vec2 slope(Real u) const noexcept {
        Real const v = 1 - u;
        return (6 * u * v) * (end - begin) + (v * (1 - 3 * u)) * leaving +
               (u * (3 * u - 2)) * arriving;
    }
    Vec2 bend(Real u) const noexcept {
        return (6 - 12 * u) * (end - begin) + (6 * u - 4) * leaving + (6 * u - 2) * arriving;
    }
};

// Returns whether p is nearer to the curve than the centre of curvature, with a margin. `fall` is
// minus the derivative of (p - C(u)).C'(u).
bool is_regular(Real fall, Vec2 slope) noexcept { return fall > 1e-3 * square(slope); }

}  // namespace

void SlipCurves::lay_out(Arena& arena, Size max_faces, bool any_given) noexcept {
    Size const n_between = any_given ? 2 * max_faces * (divisions - 1) : 0;
    arena.take(start, max_faces + 1);
    arena.take(point, 2 * max_faces);
    arena.take(own, 2 * max_faces);
    arena.take(at, 2 * max_faces);
    arena.take(tangent, 2 * max_faces);
    arena.take(is_given, max_faces);
    arena.take(between_at, n_between);
    arena.take(between_tangent, n_between);
}

void SlipCurves::lay_out_copy(Arena& arena, SlipCurves const& other) noexcept {
    Index const n = other.n_slots();
    arena.take(start, n == 0 ? 0 : Offset{other.count} + 1);
    arena.take(point, n);
    arena.take(own, n);
    arena.take(at, n);
    arena.take(tangent, n);
    arena.take(is_given, other.count);
    Index const n_between = other.between_at.empty() ? 0 : (divisions - 1) * n;
    arena.take(between_at, n_between);
    arena.take(between_tangent, n_between);
}

void SlipCurves::copy_from(SlipCurves const& other) noexcept {
    count = other.count;
    Index const n = other.n_slots();
    if (n == 0) return;
    copy(start, Span<const Index>(other.start.first(count + 1)));
    copy(point, Span<const Index>(other.point.first(n)));
    copy(own, Span<const Index>(other.own.first(n)));
    copy(at, Span<const Vec2>(other.at.first(n)));
    copy(tangent, Span<const Vec2>(other.tangent.first(n)));
    copy(is_given, Span<const std::uint8_t>(other.is_given.first(count)));
    copy(between_at, Span<const Vec2>(other.between_at.first(between_at.size())));
    copy(between_tangent, Span<const Vec2>(other.between_tangent.first(between_tangent.size())));
}

void SlipCurves::find_tangents(Index curve, bool closed) const noexcept {
    Index const first = start[curve], last = start[curve + 1] - 1;
    for (Index k = first + 1; k < last; ++k)
        tangent[k] = circle_tangent(at[k - 1], at[k], at[k + 1]);
    if (closed) {
        tangent[first] = tangent[last] = circle_tangent(at[last - 1], at[first], at[first + 1]);
    } else {
        tangent[first] = mirrored(tangent[first + 1], direction(at[first + 1] - at[first]));
        tangent[last] = mirrored(tangent[last - 1], direction(at[last] - at[last - 1]));
    }
}

void SlipCurves::keep_slipping(Span<const PointKind> kinds) const noexcept {
    for (Index slot = 0; slot < n_slots(); ++slot) {
        if (kinds[point[slot]] != PointKind::slip) own[slot] = none;
    }
}

std::uint64_t SlipCurves::fingerprint_with(std::uint64_t others) const noexcept {
    Hash hash;
    hash.add(others);
    auto const add = [&](Vec2 v) {
        hash.add(bits_of(v.x));
        hash.add(bits_of(v.y));
    };
    bool any = false;
    for (Index curve = 0; curve < count; ++curve) {
        if (is_given[curve] == 0) continue;
        any = true;
        hash.add(static_cast<std::uint64_t>(curve));
        Index const first = start[curve], last = start[curve + 1] - 1;
        for (Index slot = first; slot <= last; ++slot) add(tangent[slot]);
        for (Index k = (divisions - 1) * first; k < (divisions - 1) * last; ++k) {
            add(between_at[k]);
            add(between_tangent[k]);
        }
    }
    return any ? hash.value() : others;
}

Index SlipCurves::curve_of(Index slot) const noexcept {
    Index first = 0, last = count;  // start[first] <= slot < start[last]
    while (last - first > 1) {
        Index const middle = first + (last - first) / 2;
        (start[middle] <= slot ? first : last) = middle;
    }
    return first;
}

SlipCurves::Place SlipCurves::nearest(Index slot, Vec2 p) const noexcept {
    Index const curve = curve_of(slot), first = start[curve], last = start[curve + 1] - 1;
    auto const same = [](Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; };
    if (same(p, at[slot])) return {at[slot], tangent[slot]};
    bool const closed = same(at[first], at[last]) && same(tangent[first], tangent[last]);
    auto const ahead = [&](Index k) { return dot(p - at[k], tangent[k]); };
    bool const forwards = ahead(slot) >= 0;
    Index here = slot;
    for (Index step = first; step < last; ++step) {
        Index const end = forwards ? last : first;
        if (here == end && !closed) return {at[end] + ahead(end) * tangent[end], tangent[end]};
        if (here == end) here = first + last - end;
        Index const next = forwards ? here + 1 : here - 1;
        if ((ahead(next) >= 0) != forwards) return on_segment(curve, forwards ? here : next, p);
        here = next;
    }
    // If no place of a closed curve is found, p is too far away to have a nearest place.
    if (closed) return {at[slot], tangent[slot]};
    return {at[here] + ahead(here) * tangent[here], tangent[here]};
}

// Searches the first division of the segment whose end lies ahead of p, measured along the tangent
// there.
SlipCurves::Place SlipCurves::on_segment(Index curve, Index slot, Vec2 p) const noexcept {
    Vec2 place[2] = {at[slot], at[slot + 1]}, direction[2] = {tangent[slot], tangent[slot + 1]};
    if (is_given[curve] == 0) return on_cubic(place, direction, p);
    for (Index division = 1; division < divisions; ++division) {
        Index const k = (divisions - 1) * slot + division - 1;
        if (dot(p - between_at[k], between_tangent[k]) < 0) {
            place[1] = between_at[k];
            direction[1] = between_tangent[k];
            break;
        }
        place[0] = between_at[k];
        direction[0] = between_tangent[k];
    }
    return on_cubic(place, direction, p);
}

// Returns whether a cubic between two places is close to the curve: both tangents must point from
// the first place to the second and rotate little.
bool SlipCurves::is_smooth(const Vec2 (&at)[2], const Vec2 (&tangent)[2]) noexcept {
    constexpr Real cosine_of_30_degrees = 0.8660254037844386;
    Vec2 const side = at[1] - at[0];
    Real const min_progress = cosine_of_30_degrees * length(side);
    return dot(tangent[0], side) > min_progress && dot(tangent[1], side) > min_progress &&
           dot(tangent[0], tangent[1]) > cosine_of_30_degrees;
}

// Solves (p - C(u)).C'(u) = 0; the left side is not negative at the beginning of the segment and
// not positive at its end.
SlipCurves::Place SlipCurves::on_cubic(const Vec2 (&at)[2], const Vec2 (&tangent)[2],
                                       Vec2 p) noexcept {
    Vec2 const side = at[1] - at[0];
    Real const chord = length(side);
    Real const along = 0.5 / chord * dot(tangent[0] + tangent[1], side);
    Real const speed = 2 * chord / (1 + along);
    Cubic const curve{at[0], at[1], speed * tangent[0], speed * tangent[1]};
    Real low = 0, high = 1, u = clamp(dot(p - at[0], side) / (chord * chord), 0.0, 1.0);
    for (Index step = 0; step < max_steps && high - low > epsilon; ++step) {
        Vec2 const slope = curve.slope(u), off = p - curve.at(u);
        Real const value = dot(off, slope), fall = square(slope) - dot(off, curve.bend(u));
        (value >= 0 ? low : high) = u;
        Real const newton = is_regular(fall, slope) ? u + value / fall : low;
        Real const next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (abs(next - u) <= epsilon) break;
        u = next;
    }
    Vec2 const slope = curve.slope(u);
    Real const fall = square(slope) - dot(p - curve.at(u), curve.bend(u));
    return {curve.at(u), direction(slope), is_regular(fall, slope) ? square(slope) / fall : 1};
}

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

namespace {

// These bounds are sines of angles between neighbouring faces.
constexpr Real straight_below = 1e-6;  // covers the rounding of coordinates in files
constexpr Real smooth_below = 0.02;    // a smaller angle is never a corner
constexpr Real corner_above = 0.5;     // a larger angle is always a corner
// Between these bounds, an angle is a corner if it is larger than those beside it by this factor.
constexpr Real corner_factor = 2.5;

class SlipLines {
public:
    SlipLines(Points points, Boundary const& boundary, Span<const Condition> conditions,
              SlipAlong const& along, Span<PointKind> kinds, Span<Vec2> tangent, SlipCurves& curves,
              Fault& fault) noexcept
        : points_(points),
          boundary_(boundary),
          conditions_(conditions),
          along_(along),
          kinds_(kinds),
          tangent_(tangent),
          curves_(curves),
          fault_(fault) {}

    Status run() noexcept {
        fill(tangent_, Vec2{1, 0});
        if (!along_.curves.empty()) along_.find_corners(points_, boundary_, conditions_);
        curves_.count = 0;
        for (Index loop = 0; loop < boundary_.n_loops; ++loop) {
            Index const begin = boundary_.loop_start[loop],
                        n = boundary_.loop_start[loop + 1] - begin;
            Index first = 0;  // a face of the loop at which a line begins
            while (first < n && continues(loop, begin + first)) ++first;
            // The whole loop is one closed line, or has no line.
            if (first == n) {
                if (slips(begin)) HARMORPH_TRY(add_line({loop, 0, n, true}));
                continue;
            }
            for (Index from = 0; from < n;) {
                Index to = from + 1;
                while (to < n && continues(loop, begin + (first + to) % n)) ++to;
                if (slips(begin + (first + from) % n)) {
                    HARMORPH_TRY(add_line({loop, (first + from) % n, to - from, false}));
                }
                from = to;
            }
        }
        curves_.keep_slipping(kinds_);
        return Status::ok;
    }

private:
    // A line consists of n faces of a loop.
    struct Line {
        Index loop, first, n;
        bool closed;
    };

    Index face_at(Line const& line, Index k) const noexcept {
        Index const begin = boundary_.loop_start[line.loop];
        return begin + (line.first + k) % (boundary_.loop_start[line.loop + 1] - begin);
    }
    // Returns point k of a line, from 0 to n.
    Index point_at(Line const& line, Index k) const noexcept {
        return k < line.n ? boundary_.point[face_at(line, k)]
                          : boundary_.point[boundary_.after(face_at(line, line.n - 1), line.loop)];
    }

    const Condition* condition(Index face) const noexcept {
        return condition_of(conditions_, boundary_, face);
    }
    bool slips(Index face) const noexcept {
        const Condition* const found = condition(face);
        return found != nullptr && found->kind == ConditionKind::slip;
    }
    Index before(Index loop, Index face) const noexcept {
        return face == boundary_.loop_start[loop] ? boundary_.loop_start[loop + 1] - 1 : face - 1;
    }
    Vec2 side(Index loop, Index face) const noexcept {
        return points_[boundary_.point[boundary_.after(face, loop)]] -
               points_[boundary_.point[face]];
    }
    // Returns the sine of the angle between two directions, positive to the left; returns 1 if the
    // angle is 90 degrees or more.
    static Real bend(Vec2 a, Vec2 b) noexcept {
        Real const scale = sqrt(square(a)) * sqrt(square(b));
        return dot(a, b) > 0 ? cross(a, b) / scale : 1;
    }
    // Returns the bend at the beginning of the face.
    Real bend_at(Index loop, Index face) const noexcept {
        return bend(side(loop, before(loop, face)), side(loop, face));
    }
    bool is_between_slipping_faces(Index loop, Index face) const noexcept {
        Index const previous = before(loop, face);
        return previous != face && slips(previous) && slips(face);
    }

    // Returns whether the face continues the line of the face before it, without a corner.
    bool continues(Index loop, Index face) const noexcept {
        Index const previous = before(loop, face);
        if (previous == face || slips(previous) != slips(face)) return false;
        if (!slips(face)) return true;
        const Condition *const here = condition(face), *const of_previous = condition(previous);
        if (!SlipAlong::is_along(here) && !SlipAlong::is_along(of_previous))
            return is_smooth(loop, face);
        return here->same_curves(*of_previous) && !along_.is_corner(face);
    }
    bool is_smooth(Index loop, Index face) const noexcept {
        Real const here = bend_at(loop, face);
        if (abs(here) < smooth_below) return true;
        if (abs(here) > corner_above) return false;
        bool any = false;
        Index const beside[] = {before(loop, face), boundary_.after(face, loop)};
        for (Index const other : beside) {
            Real const next = is_between_slipping_faces(loop, other) ? bend_at(loop, other) : 1;
            if (abs(next) > corner_above) continue;
            if (here * next <= 0 || abs(here) > corner_factor * abs(next)) return false;
            any = true;
        }
        return any;
    }

    Status add_line(Line const& line) noexcept {
        const Condition* const slip = condition(face_at(line, 0));
        if (SlipAlong::is_along(slip)) {
            for (Index k = 0; k < line.n + (line.closed ? 0 : 1); ++k)
                along_.work.position[k] = points_[point_at(line, k)];
            auto const point = [&](Index k) { return point_at(line, k); };
            HARMORPH_TRY(along_.add(*slip, line.n, line.closed, point, curves_, fault_));
            put_tangents(line);
        } else if (line.closed || !is_straight(line)) {
            curves_.add(
                line.n, line.closed, [&](Index k) { return points_[point_at(line, k)]; },
                [&](Index k) { return point_at(line, k); });
            put_tangents(line);
        } else {
            Vec2 const whole = points_[point_at(line, line.n)] - points_[point_at(line, 0)];
            for (Index k = 0; k <= line.n; ++k) put(line, k, (1 / length(whole)) * whole);
        }
        return Status::ok;
    }

    bool is_straight(Line const& line) const noexcept {
        Vec2 const whole = points_[point_at(line, line.n)] - points_[point_at(line, 0)];
        for (Index k = 0; k < line.n; ++k) {
            if (!(abs(bend(whole, side(line.loop, face_at(line, k)))) < straight_below))
                return false;
        }
        return true;
    }

    // Gives the points of the line the tangents of the curve that was added last.
    void put_tangents(Line const& line) noexcept {
        Index const begin = curves_.start[curves_.count - 1];
        for (Index k = 0; k <= line.n; ++k) put(line, k, curves_.tangent[begin + k]);
    }

    void put(Line const& line, Index k, Vec2 direction) noexcept {
        Index const point = point_at(line, k);
        if (kinds_[point] != PointKind::slip) return;
        bool const from_corner =
            k == 0 && !line.closed && slips(before(line.loop, face_at(line, 0)));
        bool const to_corner = k == line.n && !line.closed &&
                               slips(boundary_.after(face_at(line, line.n - 1), line.loop));
        if (from_corner || to_corner) {
            kinds_[point] = PointKind::fixed;
        } else {
            tangent_[point] = direction;
        }
    }

    Points points_;
    Boundary const& boundary_;
    Span<const Condition> conditions_;
    SlipAlong const& along_;
    Span<PointKind> kinds_;
    Span<Vec2> tangent_;
    SlipCurves& curves_;
    Fault& fault_;
};

}  // namespace

Status find_slip_lines(Points points, Boundary const& boundary, Span<const Condition> conditions,
                       SlipAlong const& along, Span<PointKind> kinds, Span<Vec2> tangent,
                       SlipCurves& curves, Fault& fault) noexcept {
    return SlipLines(points, boundary, conditions, along, kinds, tangent, curves, fault).run();
}

}  // namespace harmorph
