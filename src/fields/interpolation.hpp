// Interpolates fields from the points of one mesh to any points, and the transpose.
#pragma once

#include "base/arena.hpp"
#include "base/vec2.hpp"
#include "boundary/distance.hpp"
#include "mesh/locate.hpp"
#include "plan/analysis.hpp"

namespace harmorph {

// Sorts points so that points that follow each other are neighbours in the plane.

// The order is that of Morton's curve on a grid of 2^32 squares in each direction over the bounding
// box of the points; points in one square keep their order.
struct SortedOrder {
    struct Entry {
        std::uint64_t key;
        Index point;
    };
    Span<Entry> entry, spare;  // [n]

    void lay_out(Arena& arena, Index n) noexcept {
        arena.take(entry, n);
        arena.take(spare, n);
    }
    void sort(Points points) noexcept;
    Index operator[](Index k) const noexcept { return entry[k].point; }
};

// The value at each point is a sum of weights times values at up to four points of the mesh: linear
// inside a triangle, the mean of both splits in a quadrilateral. A point outside the mesh has the
// value at the nearest place of the boundary, linear by arc length between the ends of its face.
struct Interpolation {
    struct Report {
        Index outside = 0;
        Real max_distance = 0;
        Index max_distance_point = none;
    };
    // A point on the boundary to this part of the length of its face counts as inside.
    static constexpr Real on_boundary = 1e-12;
    static constexpr Index corners = 4;

    Index n_mesh_points = 0, index_base = 0;
    Span<Index> point;  // [4 * n] the points of the mesh; unused ones have the weight 0
    Span<Real> weight;  // [4 * n]

    Index count() const noexcept { return static_cast<Index>(weight.size() / corners); }
    void lay_out(Arena& arena, Analysis const& from, Index n) noexcept;
    // Finds the cells of all points; the mesh of the analysis at the points `at` must have no
    // inverted cell. distance [n], or empty, receives the distances from the mesh.
    Report find(Analysis const& from, Points at, Points to, Span<Real> distance,
                Executor const& executor) noexcept;
    void apply(const Real* from, Real* to, Executor const& executor) const noexcept;
    // Adds the transpose of apply().
    void add_transpose(const Real* to, Real* from) const noexcept;

private:
    FaceDistance boundary_;
    Span<Index> neighbour_;  // [4 * cells] the cell beyond each side, or none
    SortedOrder order_;
};

}  // namespace harmorph
