// Cells with any number of corners as triangles and quads: the rest of the library works on these
// pieces.
#pragma once

#include "base/arena.hpp"
#include "mesh/mesh.hpp"

namespace harmorph {

// A cell of three corners, or of four convex ones, is one piece. Any other cell is divided into
// triangles between its corners, so its sides remain edges of the mesh and its diagonals become
// edges. That the pieces have positive areas does not bound the angles of the corners. So each
// corner has a guard, the triangle with its two neighbours: no equation contains guards, but their
// areas have to stay positive, too, for flat and reflex corners after a turn, see guard_shape.hpp.
// Points as in CellLayout::quads, four for each, a triangle repeats its last point; the corner of a
// guard is its second point. Guards stand behind all pieces.
struct Pieces {
    // Exterior angles whose tangent is not above this, nor below its negative, are flat.
    static constexpr Real flat = 0.125;

    Span<Index> start;  // [cells + 1] first piece of each cell
    Span<Index>
        guard_start;        // [cells + 1] first guard of each cell, counted on from the last piece
    Span<Index> point;      // [4 * (pieces + guards)] in the numbering of the mesh
    Span<CornerKind> kind;  // [guards]

    bool given() const noexcept { return !start.empty(); }
    Index n_pieces() const noexcept { return start[start.size() - 1]; }
    Index n_guards() const noexcept { return guard_start[guard_start.size() - 1] - n_pieces(); }

    void lay_out(Arena& arena, Index n_cells, Index n_pieces, Index n_guards) noexcept;
    // Room for the pieces of a mesh: none where the mesh does not consist of pieces.
    void lay_out_copy(Arena& arena, Mesh const& mesh) noexcept {
        if (mesh.has_pieces()) lay_out(arena, mesh.n_given, mesh.n_cells, mesh.n_guards);
    }
    void copy_from(Pieces const& other) const noexcept;
    // The copy is made, and the mesh refers to it from now on; nothing where there is no room.
    void copy_from(Pieces const& other, Mesh& mesh) const noexcept;
    // The mesh that consists of the pieces, with the points and faces of the polygons' mesh.
    Mesh mesh(Mesh const& polygons) const noexcept;
    // Guards have the orientation of the pieces of their cell.
    void orient_guards(Span<std::uint8_t> reversed) const noexcept;
};

// Divides cells, such that the shape of the worst triangle (area / sum of squared sides) is the
// best that there is: by dynamic programming over all diagonals (G. T. Klincsek, Ann. Discrete
// Math. 9 (1980) 121). For a polygon without crossing sides, there are triangulations without any
// inverted or degenerate triangle.
struct PolygonDivision {
    Pieces pieces;
    Span<Real>
        worst;  // [most corners squared] shape of the worst triangle between the corners i .. j
    Span<Index> apex;  // the corner that its triangle at the side i, j has

    // As many pieces as there could be; returns the mesh of so many.
    Mesh lay_out(Arena& arena, Mesh const& polygons) noexcept;
    // Polygons whose indices have been checked.
    void run(Mesh const& polygons) noexcept;

private:
    template <class Corners>
    void divide(Corners const& corners) noexcept;
    void add(Index a, Index b, Index c, Index d) noexcept;
    Index n_filled_ = 0;
};

}  // namespace harmorph
