// Exact distances to the nearest of chosen boundary faces, and weights of cells that grow towards
// these faces.
#pragma once

#include "mesh/boundary.hpp"
#include "mesh/delaunay.hpp"
#include "base/executor.hpp"
#include "simd/cpu.hpp"
#include "mesh/periodic_rotation.hpp"
#include "mesh/periodic_translations.hpp"

namespace harmorph {

// A tree with eight children for each node, over the faces in the order of their loops, in which
// faces that follow each other lie close together (where they do not, searches are slower, not
// wrong):
//
//   height 0   groups of eight faces
//   height 1   nodes of eight chords: each is a segment along a group, with a radius that contains
//   the group height 2+  nodes of eight boxes: each bounds the groups below a node of the next
//   lower height; up to one root
//
// Boxes and radii include a margin for rounding, so that distances depend on the faces alone, to
// the last bit.
struct FaceDistance {
    static constexpr Index lanes = 8, most_heights = 12;
    static constexpr Real far_away =
        1e100;  // in units: beyond every point, and the square does not overflow
    static constexpr Real slack =
        1e-12;  // relative; more than rounding leaves of any comparison here

    struct Face {
        Index point[2];
    };
    struct Segments {
        Real x[lanes], y[lanes];              // of the first end
        Real along_x[lanes], along_y[lanes];  // from there to the other end
        Real inverse[lanes];                  // 1 / length^2, or 0

        void set(Index lane, Vec2 from, Vec2 to) noexcept;
    };
    struct Chords {
        Segments axis;
        Real radius[lanes];

        void clear(Index lane) noexcept;  // far away from every point
        void copy(Index lane, Chords const& other, Index other_lane) noexcept;
    };
    struct Boxes {
        Real low_x[lanes], low_y[lanes], high_x[lanes], high_y[lanes];

        void clear(Index lane) noexcept;
        void copy(Index lane, Boxes const& other, Index other_lane) noexcept;
    };

    Kernel kernel = Kernel::baseline;  // any gives the same bits
    Index count = 0;
    Span<Face> faces;           // [max_faces], of which `count` are used
    Real extent = 0;            // the larger of the width and height of all faces
    Vec2 middle, half_size;     // of the bounding box, in units; half_size a little larger
    Real unit = 0;              // largest power of two within the extent; 0: no extent
    Real inverse_unit = 1;      // the tree is in units: coordinates times inverse_unit
    Translations translations;  // of a periodic mesh; weights, not distances, take images of the
                                // faces into account
    Rotation rotation;
    struct Image {  // where a point has the same distance as from an image of the faces: turn point
                    // + shift, in units
        Vec2 turn{1, 0}, shift;
    };
    Index n_images = 0;
    Image image[Translations::max_shifts];
    Index root_height = 0;
    Index height_start[most_heights] = {};  // in `boxes`
    Span<Segments> groups;
    Span<Chords> chords;
    Span<Boxes> boxes;

    void lay_out(Arena& arena, Size max_faces) noexcept;

    // Takes the faces for which is_chosen(face) holds.
    template <class IsChosen>
    void choose(Boundary const& boundary, IsChosen is_chosen) noexcept;
    // After choose(), and whenever coordinates have changed. O(count).
    void build(Points points) noexcept;

    // No face: infinity. Rounding leaves a few units in the last place of the distance and of the
    // faces' lengths.
    Real distance(Vec2 from) const noexcept;
    // The nearest point of the faces; none without faces. group: in, the group that is tried first;
    // out, that of the foot: neighbouring points have neighbouring feet.
    struct Foot {
        Index face = none;
        Real t = 0;  // (1 - t) point[0] + t point[1]
    };
    Foot foot(Vec2 from, Index& group) const noexcept;
    // May a face be nearer than `reach`? Cheap: asks the box round all faces, as they were built.
    bool may_reach(Vec2 from, Real reach) const noexcept {
        Vec2 const off = inverse_unit * from - middle;
        Real const most = (1 + slack) * (inverse_unit * reach);
        return !(abs(off.x) > half_size.x + most || abs(off.y) > half_size.y + most);
    }
    Vec2 at(Foot const& foot, Points points) const noexcept;

private:
    void find_unit(Points points) noexcept;
    void find_images(Points points) noexcept;
    void set_chord(Chords& node, Index lane, Points points, Index group) const noexcept;
    void set_box(Boxes& node, Index lane, Points points, Offset first, Offset last) const noexcept;
};

// k [n_cells] = (unit / d)^(quarters / 4), d the distance from the mean of the cell's corners,
// quarters in 0..16. d counts as 1e-30 units at least, far below what coordinates resolve: so k is
// always finite. Without faces, or with all of them in one point: k = 1. In a periodic mesh d is
// the distance from the nearest image, one period, or two passages, away at most: then k does not
// depend on where the mesh is cut. Fastest where cells with neighbouring numbers are neighbours in
// the mesh: blocks of 512 cells are searched together.
void weigh_cells(FaceDistance const& faces, Mesh const& mesh, Points points, Index quarters,
                 Span<Real> k, Executor const& executor) noexcept;

// k [n_edges] likewise, from the midpoints of the edges. Faces are edges as well, where d is 0:
// such k enter no equation.
void weigh_edges(FaceDistance const& faces, Span<const DelaunayEdge> edges, Points points,
                 Index quarters, Span<Real> k, Executor const& executor) noexcept;

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

}  // namespace harmorph
