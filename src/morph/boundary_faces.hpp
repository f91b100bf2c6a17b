// The faces of the boundary in the order of their loops. Each face begins at a boundary point and
// ends at the next point of its loop. tests/morph/test_crossing.cpp and tests/morph/test_touch.cpp
// cover this file.
#pragma once

#include "base/span.hpp"

namespace harmorph {

// A range of faces. Faces that follow each other lie close together, so half a range takes about
// half the space.
struct FaceRange {
    Index begin, end;
    Index size() const noexcept { return end - begin; }
    Index middle() const noexcept { return begin + size() / 2; }
};

inline constexpr Index max_leaf_faces =
    8;  // Ranges of at most so many faces are not halved any more.

class BoundaryFaces {
public:
    BoundaryFaces(Span<const Index> boundary_point, Span<const Index> loop_start) noexcept
        : boundary_point_(boundary_point), loop_start_(loop_start) {}

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

    Span<const Index> boundary_point_, loop_start_;
};

}  // namespace harmorph
