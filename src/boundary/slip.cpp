#include "boundary/slip.hpp"

namespace harmorph {
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
