// Computes exact distances to the nearest of chosen boundary faces, and weights of cells that grow
// towards these faces.
#pragma once

#include "base/executor.hpp"
#include "mesh/boundary.hpp"
#include "mesh/delaunay.hpp"
#include "mesh/periodic_motion.hpp"
#include "simd/cpu.hpp"

namespace harmorph {

// The faces are in a tree with eight children for each node, in the order of their loops, so that
// consecutive faces are close together. If they are not, searches are slower, but not wrong.
//
//   height 0   groups of eight faces
//   height 1   nodes of eight chords: a chord is a segment along a group, with a radius such that
//              the group lies within this distance of the segment
//   height 2+  nodes of eight boxes: a box contains all groups below one node of the next lower
//              height; the highest node is the root
//
// Boxes and radii include a margin for rounding, so that distances depend on the faces alone, to
// the last bit.
struct FaceDistance {
    static constexpr Index lanes = 8, max_heights = 12;
    // Points are at most `farthest` units away in the searches; farther ones are moved to this
    // distance, from where all faces are equally near. The empty lanes of nodes are `far_away`,
    // farther than every point, and the square of this distance does not overflow.
    static constexpr Real farthest = 1e120, far_away = 1e150;
    // A relative margin that is larger than the rounding error of any comparison in this file.
    static constexpr Real slack = 1e-12;

    struct Face {
        Index point[2];
    };
    struct Segments {
        Real x[lanes], y[lanes];              // the first end
        Real along_x[lanes], along_y[lanes];  // the vector to the other end
        Real inverse[lanes];                  // 1 / length^2, or 0

        void set(Index lane, Vec2 from, Vec2 to) noexcept;
    };
    struct Chords {
        Segments axis;
        Real radius[lanes];

        // Moves the chord far away from every point.
        void clear(Index lane) noexcept;
        void copy(Index lane, Chords const& other, Index other_lane) noexcept;
    };
    struct Boxes {
        Real low_x[lanes], low_y[lanes], high_x[lanes], high_y[lanes];

        void clear(Index lane) noexcept;
        void copy(Index lane, Boxes const& other, Index other_lane) noexcept;
    };

    Kernel kernel = Kernel::baseline;  // all kernels give the same bits
    Index count = 0;
    Span<Face> faces;        // [max_faces], of which `count` are used
    Real extent = 0;         // the larger of the width and height of all faces
    Vec2 middle, half_size;  // of the bounding box, in units; half_size is a little larger
    Real unit = 0;           // the largest power of two within the extent; 0 without extent
    Real inverse_unit = 1;   // coordinates in the tree are multiplied by inverse_unit
    Real range = infinity;   // `farthest`, as a length
    // In a periodic mesh, weights take images of the faces into account; distances do not.
    Translations translations;
    Rotation rotation;
    // The distance of a point from an image of the faces is the distance of rotation * point +
    // shift from the faces, in units.
    struct Image {
        Vec2 rotation{1, 0}, shift;
    };
    Index n_images = 0;
    Image image[Translations::max_shifts];
    Index root_height = 0;
    Index height_start[max_heights] = {};  // the first node of each height in `boxes`
    Span<Segments> groups;
    Span<Chords> chords;
    Span<Boxes> boxes;

    void lay_out(Arena& arena, Size max_faces) noexcept;

    Span<const Face> chosen() const noexcept { return faces.first(count); }
    // Chooses the faces for which is_chosen(face) holds.
    template <class IsChosen>
    void choose(Boundary const& boundary, IsChosen is_chosen) noexcept;
    // Builds the tree; must be called after choose(), and after coordinates have changed. The time
    // is proportional to the number of faces.
    void build(Points points) noexcept;

    // Returns the distance to the nearest face, or infinity without faces. The rounding error is a
    // few units in the last place of the distance and of the lengths of faces.
    Real distance(Vec2 from) const noexcept;
    // Returns the place in units from which a point is searched.
    Vec2 in_units(Vec2 point) const noexcept {
        Real const size = largest_of(point);
        return inverse_unit * (size > range ? range / size * point : point);
    }
    // A foot is the nearest point of the faces: (1 - t) point[0] + t point[1] of a face. Without
    // faces, `face` is none.
    struct Foot {
        Index face = none;
        Real t = 0;
    };
    // Finds the foot of a point. The search begins at `group`, which then becomes the group of the
    // foot: neighbouring points have neighbouring feet.
    Foot foot(Vec2 from, Index& group) const noexcept;
    // Finds the nearest face of each of the points begin .. end-1; of faces at equal distances, the
    // one with the smallest number. hint(k) is a face that is probably nearest to point k, or none.
    // Calls found(k, face). There must be faces. The search is fast if points with neighbouring
    // numbers are neighbours.
    template <class Hint, class Found>
    void find_nearest(Points points, Index begin, Index end, Hint hint, Found found) const noexcept;
    // Returns false if no face can be nearer than `reach`. The test is fast, because only the
    // bounding box of all faces is tested, as it was when the tree was built.
    bool may_reach(Vec2 from, Real reach) const noexcept {
        Vec2 const off = inverse_unit * from - middle;
        Real const limit = (1 + slack) * (inverse_unit * reach);
        return !(abs(off.x) > half_size.x + limit || abs(off.y) > half_size.y + limit);
    }
    Vec2 at(Foot const& foot, Points points) const noexcept;

private:
    static constexpr Index block = 512;
    // Does the same for at most `block` points; hint [n] becomes the nearest faces.
    void find_nearest(const Vec2* point, Index n, Index* hint) const noexcept;
    void find_unit(Points points) noexcept;
    void find_images(Points points) noexcept;
    void set_chord(Chords& node, Index lane, Points points, Index group) const noexcept;
    void set_box(Boxes& node, Index lane, Points points, Offset first, Offset last) const noexcept;
};

// Computes k [n_cells] = (unit / d)^(exponent_quarters / 4), where exponent_quarters is 0 to 16 and
// d is the distance of the faces from the mean of the cell's corners. A distance below 1e-30 units
// counts as 1e-30 units, far below the resolution of coordinates, so k is always finite. If there
// are no faces, or all faces are in one point, k is 1. In a periodic mesh, d is the distance from
// the nearest image of the faces, at most one period or two passages away, so that k does not
// depend on where the mesh is cut. Blocks of 512 cells are searched together; this is fastest if
// cells with neighbouring numbers are neighbours in the mesh.
void weigh_cells(FaceDistance const& faces, Mesh const& mesh, Points points,
                 Index exponent_quarters, Span<Real> k, Executor const& executor) noexcept;

// Computes k [n_edges] in the same way for the midpoints of edges. At edges that are faces, d is 0;
// no equation contains their k.
void weigh_edges(FaceDistance const& faces, Span<const DelaunayEdge> edges, Points points,
                 Index exponent_quarters, Span<Real> k, Executor const& executor) noexcept;

template <class IsChosen>
void FaceDistance::choose(Boundary const& boundary, IsChosen is_chosen) noexcept {
    count = 0;
    for (Index loop = 0; loop < boundary.n_loops; ++loop) {
        for (Index face = boundary.loop_start[loop]; face < boundary.loop_start[loop + 1]; ++face) {
            if (!is_chosen(face)) continue;
            faces[count++] = {{boundary.point[face], boundary.point[boundary.after(face, loop)]}};
        }
    }
}

template <class Hint, class Found>
void FaceDistance::find_nearest(Points points, Index begin, Index end, Hint hint,
                                Found found) const noexcept {
    for (Index first = begin; first < end; first += block) {
        Index const n = min(block, end - first);
        Vec2 point[block];
        Index face[block];
        for (Index k = 0; k < n; ++k) {
            point[k] = in_units(points[first + k]);
            face[k] = hint(first + k);
        }
        find_nearest(point, n, face);
        for (Index k = 0; k < n; ++k) found(first + k, face[k]);
    }
}

}  // namespace harmorph
