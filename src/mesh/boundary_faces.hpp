// The faces of the boundary in the order of their loops. Each face begins at a boundary point and
// ends at the next point of its loop. Faces on a sliding interface have the number of their side.
// tests/morph/test_crossing.cpp and tests/morph/test_touch.cpp cover this file.
#pragma once

#include "base/span.hpp"

namespace harmorph {

// A range of faces. Consecutive faces lie close together, so each half of a range occupies about
// half of the area.
struct FaceRange {
    Index begin, end;
    Index size() const noexcept { return end - begin; }
    Index middle() const noexcept { return begin + size() / 2; }
};

// Ranges of at most so many faces are not divided.
inline constexpr Index max_leaf_faces = 8;

class BoundaryFaces {
public:
    // side [faces], or empty if there are no interfaces: 2 i and 2 i + 1 on both sides of interface
    // i, none elsewhere.
    BoundaryFaces(Span<const Index> boundary_point, Span<const Index> loop_start,
                  Span<const Index> side = {}) noexcept
        : boundary_point_(boundary_point), loop_start_(loop_start), side_(side) {}

    Index count() const noexcept { return boundary_point_.count(); }
    Index n_loops() const noexcept { return loop_start_.count() - 1; }
    FaceRange loop(Index number) const noexcept {
        return {loop_start_[number], loop_start_[number + 1]};
    }
    Span<const Index> points_of_loop(Index number) const noexcept {
        return boundary_point_.from(loop_start_[number], loop(number).size());
    }

    Index begin_of(Index face) const noexcept { return boundary_point_[face]; }
    Index end_of(Index face) const noexcept { return boundary_point_[after(face)]; }

    Index before(Index face) const noexcept {
        Index const loop = loop_of(face);
        return face > loop_start_[loop] ? face - 1 : loop_start_[loop + 1] - 1;
    }
    Index after(Index face) const noexcept {
        Index const loop = loop_of(face);
        return face + 1 < loop_start_[loop + 1] ? face + 1 : loop_start_[loop];
    }

    // Tells whether two faces may touch and cross each other: they are on both sides of one
    // interface, or are next to the end of such a side.
    bool may_slide(Index face, Index other) const noexcept {
        if (side_.empty()) return false;
        Index const near[3] = {face, before(face), after(face)};
        for (Index const k : near) {
            if (side_[k] != none && touches_side(other, side_[k] ^ 1)) return true;
        }
        return false;
    }
    // Tells whether two loops have the two sides of one interface.
    bool share_interface(Index number, Index other) const noexcept {
        if (side_.empty()) return false;
        FaceRange const faces = loop(number), others = loop(other);
        Index last = none;  // faces of one side follow each other
        for (Index face = faces.begin; face < faces.end; ++face) {
            if (side_[face] == none || side_[face] == last) continue;
            last = side_[face];
            for (Index k = others.begin; k < others.end; ++k) {
                if (side_[k] == (last ^ 1)) return true;
            }
        }
        return false;
    }

    // Calls visit(point) for all points of the faces of a range that is not empty; some points are
    // visited twice.
    template <class Visit>
    void for_each_end(FaceRange range, Visit const& visit) const noexcept {
        for (Index face = range.begin; face < range.end; ++face) visit(begin_of(face));
        visit(end_of(range.end - 1));
        // A range may contain the end of one loop and the beginning of the next; the face that
        // closes a loop ends where the loop begins.
        for (Index loop = loop_of(range.begin);
             loop + 1 < loop_start_.count() && loop_start_[loop + 1] <= range.end; ++loop) {
            visit(boundary_point_[loop_start_[loop]]);
        }
    }

private:
    bool touches_side(Index face, Index side) const noexcept {
        return side_[face] == side || side_[before(face)] == side || side_[after(face)] == side;
    }
    // Searches by bisection, as a mesh may have thousands of bodies.
    Index loop_of(Index face) const noexcept {
        // Invariant: loop_start_[first] <= face < loop_start_[last].
        Index first = 0, last = loop_start_.count() - 1;
        while (last - first > 1) {
            Index const middle = first + (last - first) / 2;
            (loop_start_[middle] <= face ? first : last) = middle;
        }
        return first;
    }

    Span<const Index> boundary_point_, loop_start_, side_;
};

}  // namespace harmorph
