#include "harmorph/crossing.hpp"

namespace harmorph {
namespace {

constexpr Index few_faces = 8;

struct Box {
    Vec2 low{infinity, infinity}, high{-infinity, -infinity};

    void include(Vec2 p) noexcept {
        low = {smaller(low.x, p.x), smaller(low.y, p.y)};
        high = {larger(high.x, p.x), larger(high.y, p.y)};
    }
    bool overlaps(Box const& other) const noexcept {
        return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y;
    }
};

struct Range {
    Index begin, end;
    Index size() const noexcept { return end - begin; }
    Index middle() const noexcept { return begin + size() / 2; }
};

class Search {
public:
    Search(Span<const Index> boundary_point, Span<const Index> loop_start, Points points, Points displacement) noexcept
        : boundary_point_(boundary_point), loop_start_(loop_start), points_(points), displacement_(displacement) {}

    // Pairs of faces within the range.
    bool within(Range range) noexcept {
        if (range.size() <= few_faces) {
            for (Index face = range.begin; face < range.end; ++face) {
                if (face_against(face, {face + 1, range.end})) return true;
            }
            return false;
        }
        Range const left{range.begin, range.middle()}, right{range.middle(), range.end};
        return within(left) || within(right) || between(left, right);
    }

    Crossing const& result() const noexcept { return result_; }

private:
    bool between(Range a, Range b) noexcept {
        if (!box_of(a).overlaps(box_of(b))) return false;
        if (a.size() <= few_faces && b.size() <= few_faces) {
            for (Index face = a.begin; face < a.end; ++face) {
                if (face_against(face, b)) return true;
            }
            return false;
        }
        if (a.size() < b.size()) return between(a, {b.begin, b.middle()}) || between(a, {b.middle(), b.end});
        return between({a.begin, a.middle()}, b) || between({a.middle(), a.end}, b);
    }

    bool face_against(Index face, Range others) noexcept {
        for (Index other = others.begin; other < others.end; ++other) {
            if (!cross_properly(face, other) && !cross_at_a_point(face, other) && !cross_at_a_point(other, face)) continue;
            result_ = {true, {boundary_point_[face], end_of(face)}, {boundary_point_[other], end_of(other)}};
            return true;
        }
        return false;
    }

    // The ends of each lie strictly on both sides of the other.
    bool cross_properly(Index face, Index other) const noexcept {
        Vec2 const a = at(boundary_point_[face]), b = at(end_of(face));
        Vec2 const c = at(boundary_point_[other]), d = at(end_of(other));
        auto const opposite = [](Real s, Real t) { return (s < 0 && t > 0) || (s > 0 && t < 0); };
        return opposite(triangle_area(a, b, c), triangle_area(a, b, d)) &&
               opposite(triangle_area(c, d, a), triangle_area(c, d, b));
    }

    // Do the faces before and after the point where `face` begins leave the other one, or the corner where that begins, to
    // different sides? Only then has the boundary passed through it, and not just touched it.
    bool cross_at_a_point(Index face, Index other) const noexcept {
        Index const point = boundary_point_[face];
        if (point == boundary_point_[other] || point == end_of(other)) return false;
        Vec2 const here = at(point), a = at(boundary_point_[other]), b = at(end_of(other));
        bool const at_corner = here.x == a.x && here.y == a.y;
        if (!at_corner && (triangle_area(a, b, here) != 0 || !(dot(a - here, b - here) < 0))) return false;
        Vec2 const behind = at(boundary_point_[before(face)]) - here, ahead = at(end_of(face)) - here;
        Vec2 const coming = (at_corner ? at(boundary_point_[before(other)]) : a) - here, going = b - here;
        return (lies_between(coming, behind, going) && lies_between(going, ahead, coming)) ||
               (lies_between(coming, ahead, going) && lies_between(going, behind, coming));
    }

    // Does the direction lie strictly between two others, counter-clockwise from the first to the second?
    static bool lies_between(Vec2 first, Vec2 direction, Vec2 second) noexcept {
        Real const turn = cross(first, second);
        if (turn > 0) return cross(first, direction) > 0 && cross(direction, second) > 0;
        if (turn == 0 && dot(first, second) > 0) return false;
        if (turn == 0) return cross(first, direction) > 0;
        return !(cross(second, direction) >= 0 && cross(direction, first) >= 0);
    }

    Vec2 at(Index point) const noexcept {
        return displacement_.given() ? points_[point] + displacement_[point] : points_[point];
    }

    Index before(Index face) const noexcept {
        Index loop = 0;
        while (loop_start_[loop + 1] <= face) ++loop;
        return face > loop_start_[loop] ? face - 1 : loop_start_[loop + 1] - 1;
    }

    Index end_of(Index face) const noexcept {
        Index loop = 0;
        while (loop_start_[loop + 1] <= face) ++loop;
        return boundary_point_[face + 1 < loop_start_[loop + 1] ? face + 1 : loop_start_[loop]];
    }

    Box box_of(Range range) const noexcept {
        Box box;
        for (Index face = range.begin; face < range.end; ++face) box.include(at(boundary_point_[face]));
        box.include(at(end_of(range.end - 1)));
        // A range may hold the end of one loop and the beginning of the next: faces that close a loop end at its start.
        for (Index loop = 0; loop + 1 < loop_start_.count(); ++loop) {
            Index const last = loop_start_[loop + 1] - 1;
            if (last >= range.begin && last < range.end) box.include(at(boundary_point_[loop_start_[loop]]));
        }
        return box;
    }

    Span<const Index> boundary_point_, loop_start_;
    Points points_, displacement_;
    Crossing result_;
};

}  // namespace

Crossing find_crossing(Span<const Index> boundary_point, Span<const Index> loop_start, Points points,
                       Points displacement) noexcept {
    Search search(boundary_point, loop_start, points, displacement);
    search.within({0, boundary_point.count()});
    return search.result();
}

}  // namespace harmorph
