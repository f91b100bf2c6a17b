#include "morph/touch.hpp"

#include "base/box.hpp"
#include "morph/admissible_step.hpp"
#include "morph/crossing.hpp"

namespace harmorph {
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
