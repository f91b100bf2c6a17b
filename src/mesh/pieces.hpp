// Divides cells with any number of corners into triangles and quads, which are called pieces. All
// other rooms work on the pieces.
#pragma once

#include "base/arena.hpp"
#include "mesh/mesh.hpp"

namespace harmorph {

// A cell of three corners, or of four convex corners, is one piece. Any other cell is divided into
// triangles between its corners, so the sides of the cell remain edges of the mesh, and some of its
// diagonals become edges. Positive areas of the pieces do not bound the angles of the cell's
// corners. Therefore each corner has a guard, the triangle of the corner and its two neighbours. No
// equation contains guards, but their areas must stay positive, too; at flat and reflex corners the
// area is computed after a rotation, see cell_shape.hpp. Each piece and each guard has four points,
// as in CellLayout::quads; a triangle repeats its last point. The corner of a guard is its second
// point. Guards are numbered after all pieces.
struct Pieces {
    // A corner is flat if the tangent of its exterior angle has at most this magnitude.
    static constexpr Real flat = 0.125;

    Span<Index> start;        // [cells + 1] the first piece of each cell
    Span<Index> guard_start;  // [cells + 1] the first guard of each cell, numbered after all pieces
    Span<Index> point;        // [4 * (pieces + guards)] in the numbering of the mesh
    Span<CornerKind> kind;    // [guards]

    bool given() const noexcept { return !start.empty(); }
    Index n_pieces() const noexcept { return start[start.size() - 1]; }
    Index n_guards() const noexcept { return guard_start[guard_start.size() - 1] - n_pieces(); }

    void lay_out(Arena& arena, Index n_cells, Index n_pieces, Index n_guards) noexcept;
    // Takes arrays for a copy of the mesh's pieces, if the mesh consists of pieces.
    void lay_out_copy(Arena& arena, Mesh const& mesh) noexcept {
        if (mesh.has_pieces()) lay_out(arena, mesh.n_given, mesh.n_cells, mesh.n_guards);
    }
    void copy_from(Pieces const& other) const noexcept;
    // Copies the pieces and lets the mesh refer to the copy; does nothing if no arrays were taken.
    void copy_from(Pieces const& other, Mesh& mesh) const noexcept;
    // Returns a mesh that consists of the pieces, with the points and faces of the polygons' mesh.
    Mesh mesh(Mesh const& polygons) const noexcept;
    // Gives each guard the orientation of the pieces of its cell.
    void orient_guards(Span<std::uint8_t> reversed) const noexcept;
};

// Divides cells so that the quality of the worst triangle (area / sum of squared sides) is as large
// as possible, by dynamic programming over all diagonals (G. T. Klincsek, Ann. Discrete Math. 9
// (1980) 121). A polygon without crossing sides always has a triangulation without inverted or
// degenerate triangles.
struct PolygonDivision {
    Pieces pieces;
    // [square of the largest number of corners] The quality of the worst triangle in the best
    // division of the corners i .. j.
    Span<Real> worst;
    Span<Index> apex;  // the third corner of the triangle at the side i, j in that division

    // Takes arrays for the largest possible number of pieces; returns a mesh with these counts.
    Mesh lay_out(Arena& arena, Mesh const& polygons) noexcept;
    // Divides polygons whose indices have been checked.
    void run(Mesh const& polygons) noexcept;

private:
    template <class Corners>
    void divide(Corners const& corners) noexcept;
    void add(Index a, Index b, Index c, Index d) noexcept;
    Index n_filled_ = 0;
};

}  // namespace harmorph
