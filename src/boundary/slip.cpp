#include "harmorph/boundary/slip.hpp"

namespace harmorph {
namespace {

constexpr Real straight_below = 1e-6;  // sine of the angle between neighbouring faces: rounding of coordinates in files
constexpr Real corner_above = 0.1;

class SlipLines {
public:
    SlipLines(Points points, Boundary const& boundary, Span<const Condition> conditions, Span<PointKind> kinds,
              Span<Vec2> tangent) noexcept
        : points_(points), boundary_(boundary), conditions_(conditions), kinds_(kinds), tangent_(tangent) {}

    Status run(Fault& fault) noexcept {
        fill(tangent_, Vec2{1, 0});
        for (Index loop = 0; loop < boundary_.n_loops; ++loop) {
            Index const begin = boundary_.loop_start[loop], n = boundary_.loop_start[loop + 1] - begin;
            Index first = 0;  // face of the loop with which a line begins
            while (first < n && continues(loop, begin + first)) ++first;
            if (first == n) {  // no line, or one without end
                HARMORPH_TRY(curved(begin, fault));
                continue;
            }
            for (Index from = 0; from < n;) {
                Index to = from + 1;
                while (to < n && continues(loop, begin + (first + to) % n)) ++to;
                if (slips(begin + (first + from) % n)) HARMORPH_TRY(add_line(loop, (first + from) % n, to - from,
                                                                             fault));
                from = to;
            }
        }
        return Status::ok;
    }

private:
    bool slips(Index face) const noexcept {
        const Condition* const condition = condition_of(conditions_, boundary_, face);
        return condition != nullptr && condition->kind == ConditionKind::slip;
    }
    Index before(Index loop, Index face) const noexcept {
        return face == boundary_.loop_start[loop] ? boundary_.loop_start[loop + 1] - 1 : face - 1;
    }
    Vec2 side(Index loop, Index face) const noexcept {
        return points_[boundary_.point[boundary_.after(face, loop)]] - points_[boundary_.point[face]];
    }
    // Sine of the angle between two directions; 1 if they are opposite.
    static Real bend(Vec2 a, Vec2 b) noexcept {
        Real const scale = square_root(square(a)) * square_root(square(b));
        return dot(a, b) > 0 ? absolute(cross(a, b)) / scale : 1;
    }
    // Does the face lie on one line with the face before it? Bends that are no corners are found by add_line.
    bool continues(Index loop, Index face) const noexcept {
        Index const previous = before(loop, face);
        return previous != face && slips(previous) == slips(face) &&
               (!slips(face) || bend(side(loop, previous), side(loop, face)) < corner_above);
    }

    Status curved(Index face, Fault& fault) const noexcept {
        if (!slips(face)) return Status::ok;
        return fault.refuse(Status::bad_condition, "marker @ slips, but is not straight at point #",
                            Counts::mesh_and_marker, boundary_.point[face], boundary_.marker[face]);
    }

    Status add_line(Index loop, Index first, Index n, Fault& fault) noexcept {
        Index const begin = boundary_.loop_start[loop], n_loop = boundary_.loop_start[loop + 1] - begin;
        auto const face_at = [&](Index k) { return begin + (first + k) % n_loop; };
        Index const last = boundary_.point[boundary_.after(face_at(n - 1), loop)];
        Vec2 const along = points_[last] - points_[boundary_.point[face_at(0)]];
        for (Index k = 0; k < n; ++k) {
            if (!(bend(along, side(loop, face_at(k))) < straight_below)) return curved(face_at(k), fault);
        }
        Vec2 const direction = (1 / length(along)) * along;
        bool const from_corner = slips(before(loop, face_at(0))), to_corner = slips(boundary_.after(face_at(n - 1),
                                                                                                    loop));
        for (Index k = 0; k < n; ++k) put(boundary_.point[face_at(k)], direction, k == 0 && from_corner);
        put(last, direction, to_corner);
        return Status::ok;
    }

    void put(Index point, Vec2 direction, bool corner) noexcept {
        if (kinds_[point] != PointKind::slip) return;
        if (corner) {
            kinds_[point] = PointKind::fixed;
        } else {
            tangent_[point] = direction;
        }
    }

    Points points_;
    Boundary const& boundary_;
    Span<const Condition> conditions_;
    Span<PointKind> kinds_;
    Span<Vec2> tangent_;
};

}  // namespace

Status find_slip_lines(Points points, Boundary const& boundary, Span<const Condition> conditions, Span<PointKind> kinds,
                       Span<Vec2> tangent, Fault& fault) noexcept {
    return SlipLines(points, boundary, conditions, kinds, tangent).run(fault);
}

}  // namespace harmorph
