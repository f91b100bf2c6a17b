#include "morph/crossing.hpp"

#include "base/predicates.hpp"
#include "base/vec2.hpp"
#include "mesh/cell_shape.hpp"
#include "morph/admissible_step.hpp"

namespace harmorph {
namespace {

struct FaceBox : Box {
    void widen(Real by) noexcept {
        low = {low.x - by, low.y - by};
        high = {high.x + by, high.y + by};
    }
    bool is_point() const noexcept { return low.x == high.x && low.y == high.y; }
};

// The places of the boundary points for which crossings are searched.
struct Places {
    Points points, displacement;  // without a displacement, the places are the points

    Vec2 operator[](Index point) const noexcept {
        return displacement.given() ? points[point] + displacement[point] : points[point];
    }
};

class Search {
public:
    // Two faces that cross each other at `start`, if given, are ignored.
    Search(BoundaryFaces const& faces, Places places, Points start, Overlaps overlaps,
           Span<const KnownEnd> ends = {}) noexcept
        : faces_(faces), places_(places), start_(start), overlaps_(overlaps), ends_(ends) {}

    Crossing run() noexcept {
        if (start_.given()) {
            Real size = 0;
            for (Index face = 0; face < faces_.count(); ++face) {
                Index const point = begin_of(face);
                size = max(size, max(largest_of(places_[point]), largest_of(start_[point])));
            }
            resolved_ = resolved_height(size);
        }
        within({0, faces_.count()});
        return result_;
    }

private:
    struct Joined {
        Index point, stays_at;
    };

    // Pairs of faces within the range.
    bool within(FaceRange range) noexcept {
        if (range.size() <= max_leaf_faces) {
            for (Index face = range.begin; face < range.end; ++face) {
                if (face_against(face, {face + 1, range.end})) return true;
            }
            return false;
        }
        FaceRange const left{range.begin, range.middle()}, right{range.middle(), range.end};
        return within(left) || within(right) || between(left, right);
    }

    bool between(FaceRange a, FaceRange b) noexcept {
        FaceBox const box_a = box_of(a), box_b = box_of(b);
        if (!box_a.meets(box_b) || (box_a.is_point() && box_b.is_point())) return false;
        if (a.size() <= max_leaf_faces && b.size() <= max_leaf_faces) {
            for (Index face = a.begin; face < a.end; ++face) {
                if (face_against(face, b)) return true;
            }
            return false;
        }
        if (a.size() < b.size())
            return between(a, {b.begin, b.middle()}) || between(a, {b.middle(), b.end});
        return between({a.begin, a.middle()}, b) || between({a.middle(), a.end}, b);
    }

    bool face_against(Index face, FaceRange others) noexcept {
        FaceBox const box = box_of({face, face + 1});
        for (Index other = others.begin; other < others.end; ++other) {
            FaceBox const other_box = box_of({other, other + 1});
            if (!other_box.meets(box) || (other_box.is_point() && box.is_point())) continue;
            join_sides(face, other);
            if (!cross(face, other) || !is_known(face, other) || faces_.may_slide(face, other) ||
                crossed_before(face, other))
                continue;
            result_ = {true, {begin_of(face), end_of(face)}, {begin_of(other), end_of(other)}};
            return true;
        }
        return false;
    }

    bool cross(Index face, Index other) const noexcept {
        return cross_properly(face, other) || cross_at_a_point(face, other) ||
               cross_at_a_point(other, face) ||
               (overlaps_ == Overlaps::cross && lie_on_each_other(face, other));
    }
    bool crossed_before(Index face, Index other) const noexcept {
        if (!start_.given()) return false;
        Search before(*this);
        before.places_ = {start_, {}};
        before.overlaps_ = Overlaps::cross;
        before.join_sides(face, other);
        return before.cross(face, other);
    }

    // Finds the points of the two faces and of their neighbours that stay at one place. at()
    // returns the place of the first of them for all.
    void join_sides(Index face, Index other) noexcept {
        n_joined_ = 0;
        if (!start_.given()) return;
        Index const points[] = {begin_of(before(face)), begin_of(face),          end_of(face),
                                end_of(after(face)),    begin_of(before(other)), begin_of(other),
                                end_of(other),          end_of(after(other))};
        Vec2 now[8];
        for (Index k = 0; k < 8; ++k) now[k] = places_[points[k]];
        for (Index k = 1; k < 8; ++k) {
            for (Index i = 0; i < k && points[i] != points[k]; ++i) {
                if (!(abs(now[i].x - now[k].x) < resolved_)) continue;
                Vec2 const start = start_[points[i]], other_start = start_[points[k]];
                if (!stay_at_one_place(start, other_start, now[i], now[k])) continue;
                joined_[n_joined_++] = {points[k], points[i]};
                break;
            }
        }
    }

    bool has(Index face, KnownEnd what) const noexcept {
        return ends_[begin_of(face)] == what || ends_[end_of(face)] == what;
    }
    // Tells whether a face of a wall ends on a line along which points slip.
    bool ends_on_line(Index face) const noexcept {
        return !has(face, KnownEnd::on_line) &&
               (has(before(face), KnownEnd::on_line) || has(after(face), KnownEnd::on_line));
    }
    bool is_known(Index face, Index other) const noexcept {
        if (ends_.empty()) return true;
        if (has(face, KnownEnd::unknown) || has(other, KnownEnd::unknown)) return false;
        bool const line = has(face, KnownEnd::on_line), other_line = has(other, KnownEnd::on_line);
        if (line && other_line) return false;
        return !(line && ends_on_line(other)) && !(other_line && ends_on_line(face));
    }

    // Tells whether the ends of each face lie strictly on both sides of the other.
    bool cross_properly(Index face, Index other) const noexcept {
        Vec2 const a = at(begin_of(face)), b = at(end_of(face));
        Vec2 const c = at(begin_of(other)), d = at(end_of(other));
        return orientation_sign(a, b, c) * orientation_sign(a, b, d) < 0 &&
               orientation_sign(c, d, a) * orientation_sign(c, d, b) < 0;
    }

    // Tells whether both faces are on one line and have a common section.
    bool lie_on_each_other(Index face, Index other) const noexcept {
        Vec2 const a = at(begin_of(face)), b = at(end_of(face));
        Vec2 const c = at(begin_of(other)), d = at(end_of(other));
        if (same(a, b) || same(c, d)) return false;
        if (same(a, d) && same(b, c))
            return separated_by_mesh(face, other) || separated_by_mesh(other, face);
        if (orientation_sign(a, b, c) != 0 || orientation_sign(a, b, d) != 0) return false;
        auto const share = [](Real p, Real q, Real r, Real s) {
            return max(min(p, q), min(r, s)) < min(max(p, q), max(r, s));
        };
        return a.x != b.x ? share(a.x, b.x, c.x, d.x) : share(a.y, b.y, c.y, d.y);
    }

    // Tells for faces with the same ends, in opposite directions, whether mesh lies between the
    // face after the one and the face before the other. Then two walls have come together.
    // Otherwise the solid is between them, where the two sides of a wall without thickness
    // separate; at the tip of the wall they need not separate. If both walls continue together, the
    // faces that follow decide.
    bool separated_by_mesh(Index face, Index other) const noexcept {
        Index const next = after(face), last = before(other);
        Vec2 const here = at(end_of(face)), ahead = at(end_of(next)), behind = at(begin_of(last));
        return next != other && !same(ahead, behind) &&
               is_between(here, ahead, behind, at(begin_of(face)));
    }

    // Tells whether the faces before and after the point where `face` begins leave the other face,
    // or the corner where that face begins, to different sides. Only then has the boundary passed
    // through the other face; otherwise it just touches that face.
    bool cross_at_a_point(Index face, Index other) const noexcept {
        Index const point = begin_of(face);
        if (point == begin_of(other) || point == end_of(other)) return false;
        Vec2 const here = at(point), a = at(begin_of(other)), b = at(end_of(other));
        bool const at_corner = same(here, a);
        if (!at_corner && (orientation_sign(a, b, here) != 0 || !on_opposite_sides(here, a, b)))
            return false;
        Vec2 const behind = at(begin_of(before(face))), ahead = at(end_of(face));
        Vec2 const coming = at_corner ? at(begin_of(before(other))) : a, going = b;
        auto const lies_between = [&](Vec2 first, Vec2 point_between, Vec2 second) {
            return is_between(here, first, point_between, second);
        };
        return (lies_between(coming, behind, going) && lies_between(going, ahead, coming)) ||
               (lies_between(coming, ahead, going) && lies_between(going, behind, coming));
    }

    static bool same(Vec2 a, Vec2 b) noexcept { return a.x == b.x && a.y == b.y; }

    // Tells for points on one line whether the first one is between the others.
    static bool on_opposite_sides(Vec2 here, Vec2 a, Vec2 b) noexcept {
        auto const between = [](Real p, Real middle, Real q) {
            return (p < middle && middle < q) || (q < middle && middle < p);
        };
        return between(a.x, here.x, b.x) || between(a.y, here.y, b.y);
    }

    // Tells whether the point lies strictly between two others, seen from `here` and
    // counter-clockwise from the first to the second.
    static bool is_between(Vec2 here, Vec2 first, Vec2 point, Vec2 second) noexcept {
        int const sign = orientation_sign(here, first, second);
        int const from_first = orientation_sign(here, first, point),
                  to_second = orientation_sign(here, point, second);
        if (sign > 0) return from_first > 0 && to_second > 0;
        if (sign < 0) return !(to_second <= 0 && from_first <= 0);
        return on_opposite_sides(here, first, second) && from_first > 0;
    }

    Vec2 at(Index point) const noexcept {
        for (Index k = 0; k < n_joined_; ++k) {
            if (joined_[k].point == point) return places_[joined_[k].stays_at];
        }
        return places_[point];
    }

    Index begin_of(Index face) const noexcept { return faces_.begin_of(face); }
    Index end_of(Index face) const noexcept { return faces_.end_of(face); }
    Index before(Index face) const noexcept { return faces_.before(face); }
    Index after(Index face) const noexcept { return faces_.after(face); }

    FaceBox box_of(FaceRange range) const noexcept {
        FaceBox box;
        faces_.for_each_end(range, [&](Index point) { box.include(places_[point]); });
        if (!box.is_point()) box.widen(resolved_);
        return box;
    }

    BoundaryFaces faces_;
    Places places_;
    Points start_;
    Overlaps overlaps_;
    Span<const KnownEnd> ends_;
    Real resolved_ = 0;  // the distance below which two places cannot be distinguished from one
    Joined joined_[8];
    Index n_joined_ = 0;
    Crossing result_;
};

}  // namespace

bool stay_at_one_place(Vec2 a, Vec2 b, Vec2 a_moved, Vec2 b_moved) noexcept {
    // Both places count, because a movement from a place with large coordinates has larger rounding
    // errors than the new place.
    Real const size =
        max(max(largest_of(a), largest_of(b)), max(largest_of(a_moved), largest_of(b_moved)));
    Real const far = max(largest_of(a - b), largest_of(a_moved - b_moved));
    return far < resolved_height(size);
}

Crossing find_crossing(BoundaryFaces const& faces, Points points) noexcept {
    return Search(faces, {points, {}}, {}, Overlaps::cross).run();
}

Crossing find_crossing(BoundaryFaces const& faces, Points points, Points displacement,
                       Overlaps overlaps) noexcept {
    Points const start = displacement.given() ? points : Points{};
    return Search(faces, {points, displacement}, start, overlaps).run();
}

Crossing find_new_crossing(BoundaryFaces const& faces, Points start, Points now) noexcept {
    return Search(faces, {now, {}}, start, Overlaps::cross).run();
}

Crossing find_known_crossing(BoundaryFaces const& faces, Points start, Points points,
                             Span<const KnownEnd> ends) noexcept {
    return Search(faces, {points, {}}, start, Overlaps::ignored, ends).run();
}

namespace {

// Larger steps are not considered: the squares of places there would overflow.
constexpr Real largest_step = 0x1p100;
// A point that is beyond an end of a face by this fraction of the face's length still touches the
// end.
constexpr Real beyond_end = 1e-12;

// Returns n / d if this is at most largest_step in magnitude, and 0 otherwise.
Real ratio_in_range(Real n, Real d) noexcept {
    return d != 0 && abs(n) <= largest_step * abs(d) ? n / d : 0;
}

// The values of s at which a range of numbers and of their changes may include 0.
struct Window {
    Real begin = 0, end = infinity;

    // Keeps the values of s with value + s change <= 0.
    void require_negative(Real value, Real change) noexcept {
        if (value > 0 && change >= 0) {
            end = -1;
        } else if (change > 0 && -value <= largest_step * change) {
            end = min(end, -value / change);
        } else if (change < 0 && value <= largest_step * -change) {
            begin = max(begin, -value / change);
        }
    }
    // The test allows for rounding.
    bool is_empty() const noexcept { return end < 0 || begin * (1 - 1e-9) > end; }
};

// Points that are somewhere in a box and move by some displacement in another box.
struct MovingBox {
    Box place, change;

    void include(Vec2 p, Vec2 by) noexcept {
        place.include(p);
        change.include(by);
    }
    // Tells whether the two boxes can have a point in common for any s < limit.
    bool may_meet(MovingBox const& other, Real limit) const noexcept {
        Window window;
        window.end = limit;
        auto const require = [&](MovingBox const& a, MovingBox const& b) {
            Vec2 const gap = a.place.low - b.place.high, by = a.change.low - b.change.high;
            window.require_negative(gap.x, by.x);
            window.require_negative(gap.y, by.y);
        };
        require(*this, other);
        require(other, *this);
        return !window.is_empty();
    }
};

class TouchSearch {
public:
    TouchSearch(BoundaryFaces const& faces, Points points, Points displacement, Real limit) noexcept
        : faces_(faces), points_(points), displacement_(displacement) {
        touch_.step = limit;
    }

    // Searches pairs of faces within the range.
    void within(FaceRange range) noexcept {
        if (range.size() <= max_leaf_faces) {
            for (Index face = range.begin; face < range.end; ++face) {
                face_against(face, {face + 1, range.end});
            }
            return;
        }
        FaceRange const left{range.begin, range.middle()}, right{range.middle(), range.end};
        within(left);
        within(right);
        between(left, right);
    }

    Touch const& result() const noexcept { return touch_; }

private:
    void between(FaceRange a, FaceRange b) noexcept {
        if (!box_of(a).may_meet(box_of(b), touch_.step)) return;
        if (a.size() <= max_leaf_faces && b.size() <= max_leaf_faces) {
            for (Index face = a.begin; face < a.end; ++face) face_against(face, b);
        } else if (a.size() < b.size()) {
            between(a, {b.begin, b.middle()});
            between(a, {b.middle(), b.end});
        } else {
            between({a.begin, a.middle()}, b);
            between({a.middle(), a.end}, b);
        }
    }

    void face_against(Index face, FaceRange others) noexcept {
        MovingBox const box = box_of({face, face + 1});
        for (Index other = others.begin; other < others.end; ++other) {
            if (!box_of({other, other + 1}).may_meet(box, touch_.step)) continue;
            point_against(face, other);
            point_against(other, face);
        }
    }

    // Examines the point where `from` begins against another face.
    void point_against(Index from, Index face) noexcept {
        Index const point = faces_.begin_of(from);
        Index const ends[2] = {faces_.begin_of(face), faces_.end_of(face)};
        if (point == ends[0] || point == ends[1]) return;
        Pair const pair{
            points_[ends[1]] - points_[ends[0]], displacement_[ends[1]] - displacement_[ends[0]],
            points_[point] - points_[ends[0]], displacement_[point] - displacement_[ends[0]]};
        Real const step = pair.first_touch(begins_at(point, ends[0]) || begins_at(point, ends[1]));
        if (step < touch_.step && !faces_.may_slide(from, face) && !stays_at(point, ends[0]) &&
            !stays_at(point, ends[1]))
            touch_ = {step, point, {ends[0], ends[1]}};
    }

    bool begins_at(Index point, Index other) const noexcept {
        Vec2 const a = points_[point], b = points_[other];
        return stay_at_one_place(a, b, a, b);
    }
    bool stays_at(Index point, Index other) const noexcept {
        Vec2 const a = points_[point], b = points_[other];
        return stay_at_one_place(a, b, a + displacement_[point], b + displacement_[other]);
    }

    // A face and a point, both relative to the point where the face begins.
    struct Pair {
        Vec2 side, side_moves, point, point_moves;

        bool touches_at(Real s) const noexcept {
            Vec2 const along = side + s * side_moves;
            Real const squared = square(along), projection = dot(along, point + s * point_moves);
            return squared > 0 && projection >= -beyond_end * squared &&
                   projection <= (1 + beyond_end) * squared;
        }
        Real if_touches(Real s) const noexcept {
            return s > 0 && s < largest_step && touches_at(s) ? s : infinity;
        }
        // is_at_end: the point is at an end of the face at s = 0, but for rounding.
        Real first_touch(bool is_at_end) const noexcept {
            Real const area = is_at_end ? 0 : cross(side, point);
            Real const slope = cross(side, point_moves) + cross(side_moves, point);
            Real const curvature = cross(side_moves, point_moves);
            if (area == 0) return touch_from_line(slope, curvature);
            Real const sign = area > 0 ? 1 : -1;
            Real const first = smallest_positive_root(sign * curvature, sign * slope, sign * area);
            if (!(first > 0 && first < largest_step)) return infinity;
            Real const touch = if_touches(first);
            // The product of both roots is area / curvature.
            return touch < infinity ? touch : if_touches(ratio_in_range(area / first, curvature));
        }
        // Finds the step if the point is on the line of the face at s = 0.
        Real touch_from_line(Real slope, Real curvature) const noexcept {
            if (slope == 0 && curvature == 0) return touch_along_line();
            Real const s = ratio_in_range(-slope, curvature);
            bool const has_left = abs(curvature) * s * s > 4 * beyond_end * square(side);
            return has_left ? if_touches(s) : infinity;
        }
        // Finds the step if the point stays on the line of the face, so that it meets one of the
        // ends first.
        Real touch_along_line() const noexcept {
            if (touches_at(0)) return infinity;
            Real const first = if_touches(meeting(point, point_moves));
            return min(first, if_touches(meeting(point - side, point_moves - side_moves)));
        }
        // Returns the s with distance + s change = 0 in the coordinate that changes most.
        static Real meeting(Vec2 distance, Vec2 change) noexcept {
            return abs(change.x) > abs(change.y) ? ratio_in_range(-distance.x, change.x)
                                                 : ratio_in_range(-distance.y, change.y);
        }
    };

    MovingBox box_of(FaceRange range) const noexcept {
        MovingBox box;
        faces_.for_each_end(range, [&](Index k) { box.include(points_[k], displacement_[k]); });
        return box;
    }

    BoundaryFaces faces_;
    Points points_, displacement_;
    Touch touch_;
};

}  // namespace

Touch first_touch(BoundaryFaces const& faces, Points points, Points displacement,
                  Real limit) noexcept {
    if (!(limit > 0)) return {};
    TouchSearch search(faces, points, displacement, limit);
    search.within({0, faces.count()});
    Touch touch = search.result();
    if (touch.point == none) touch.step = infinity;
    if (!(limit > 1 && touch.step > 1)) return touch;
    Crossing const crossing = find_crossing(faces, points, displacement);
    if (!crossing.found) return touch;
    if (touch.step < 1 + 1e-9) {
        touch.step = 1;
        return touch;
    }
    return {0, crossing.first[0], {crossing.second[0], crossing.second[1]}};
}

}  // namespace harmorph
