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
            if (!cross_properly(face, other)) continue;
            result_ = {true, {boundary_point_[face], end_of(face)}, {boundary_point_[other], end_of(other)}};
            return true;
        }
        return false;
    }

    // The ends of each lie strictly on both sides of the other; faces that only touch, or share a point, do not cross.
    bool cross_properly(Index face, Index other) const noexcept {
        Vec2 const a = at(boundary_point_[face]), b = at(end_of(face));
        Vec2 const c = at(boundary_point_[other]), d = at(end_of(other));
        auto const opposite = [](Real s, Real t) { return (s < 0 && t > 0) || (s > 0 && t < 0); };
        return opposite(triangle_area(a, b, c), triangle_area(a, b, d)) &&
               opposite(triangle_area(c, d, a), triangle_area(c, d, b));
    }

    Vec2 at(Index point) const noexcept {
        return displacement_.given() ? points_[point] + displacement_[point] : points_[point];
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
