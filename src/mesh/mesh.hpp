// A Mesh is a view of the caller's arrays: cells in one of seven layouts, and the boundary as
// faces, point lists, or sides of blocks. Polygons are replaced by their pieces, see pieces.hpp.
#pragma once

#include "base/executor.hpp"
#include "base/span.hpp"
#include "base/vec2.hpp"

namespace harmorph {

// Defines the cells, boundary faces and structured blocks of a mesh.

// The kind of a polygon's corner before any movement.
enum class CornerKind : std::uint8_t { convex = 0, flat = 1, reflex = 2 };

// The n points of one cell in order round the cell, counted from 0; n is 3 or 4.
struct Cell {
    Index n = 0;
    Index point[4] = {};

    Index next(Index corner) const noexcept { return point[corner + 1 == n ? 0 : corner + 1]; }
    Index previous(Index corner) const noexcept { return point[corner == 0 ? n - 1 : corner - 1]; }
    void reverse() noexcept {
        for (Index k = 0; k < n / 2; ++k) {
            Index const first = point[k];
            point[k] = point[n - 1 - k];
            point[n - 1 - k] = first;
        }
    }
};

// Returns the caller's number counted from 0. Unsigned arithmetic cannot overflow: the smallest
// Index becomes the largest, which is not a valid number either.
constexpr Index from_zero(Index number, Index index_base) noexcept {
    return static_cast<Index>(static_cast<std::uint32_t>(number) -
                              static_cast<std::uint32_t>(index_base));
}

struct BoundaryFace {
    Index begin = none, end = none;  // points, counted from 0
    Index marker = 0;
};

// One structured block, whose points and cells are numbered row by row.
struct GridBlock {
    Index ni = 0, nj = 0;
    Index first_point = 0, first_cell = 0;

    Index n_points() const noexcept { return ni * nj; }
    Index n_cells() const noexcept { return (ni - 1) * (nj - 1); }
    // Returns cell i, counted from the first cell of the block. A row has one cell less than
    // points.
    Cell cell(Index i) const noexcept {
        Index const corner = first_point + i + i / (ni - 1);
        return {4, {corner, corner + 1, corner + 1 + ni, corner + ni}};
    }
    // The sides 0 to 3 are i = 0, i = ni-1, j = 0 and j = nj-1.
    Index edges_along(Index side) const noexcept { return (side < 2 ? nj : ni) - 1; }
    Index point_along(Index side, Index k) const noexcept {
        Index const i = side == 0   ? 0
                        : side == 1 ? ni - 1
                                    : k,
                    j = side == 2   ? 0
                        : side == 3 ? nj - 1
                                    : k;
        return first_point + i + ni * j;
    }
};

enum class CellLayout : std::int32_t {
    rows = 0,
    triangles = 1,
    quads = 2,
    structured = 3,
    mixed = 4,
    blocks = 5,
    polygons = 6
};

struct Mesh {
    Index index_base = 0;
    Index n_points = 0;
    Points points;
    CellLayout layout = CellLayout::rows;
    Index n_cells = 0;
    const Index* cell_start = nullptr;
    const Index* cell_points = nullptr;
    Index n_quads = 0;  // layout mixed: the last cells, after the triangles
    const Index* quad_points = nullptr;
    Index ni = 0, nj = 0;
    Index n_blocks = 0;
    const Index* block_sizes = nullptr;    // [2 * n_blocks] ni and nj
    const Index* block_markers = nullptr;  // [4 * n_blocks] the markers of the sides
    Index n_faces = 0;
    const Index* face_points = nullptr;
    const Index* face_markers = nullptr;
    Index n_lists = 0;
    const Index* list_start = nullptr;
    const Index* list_points = nullptr;
    const Index* list_markers = nullptr;
    // If the cells are pieces of polygons, n_given is the number of polygons.
    Index n_given = 0;
    const Index* piece_start = nullptr;      // [n_given + 1] the first piece of each polygon
    const Index* guard_start = nullptr;      // [n_given + 1] the first guard of each polygon
    Index n_guards = 0;                      // guards are numbered after the cells
    const CornerKind* guard_kind = nullptr;  // [n_guards]

    static constexpr Index max_corners = 1024;  // of a polygon
    static constexpr Index max_blocks = Index{1} << 16;
    static constexpr Index no_marker = INT32_MIN;  // in block_markers
    static constexpr Index max_points = Index{1} << 30;
    // An Index can count the four corners of all cells.
    static constexpr Index max_cells = Index{1} << 29;

    // Returns a cell of any layout except polygons, or a guard, if i is not less than n_cells. A
    // quad whose last point is repeated is a triangle.
    Cell cell(Index i) const noexcept;
    // Returns the first cell for which matches(i, cell) holds, or none, faster than a loop
    // over cell(i): matches() is called separately for triangles and quads, so that the compiler
    // knows the number of points and keeps them in registers.
    template <class Matches>
    Index find_cell(Matches matches) const noexcept {
        return find_cell(0, n_cells, matches);
    }
    template <class Matches>
    Index find_cell(Index begin, Index end, Matches matches) const noexcept;
    // Calls visit(i, cell) for all cells, or for the cells begin .. end - 1.
    template <class Visit>
    void for_each_cell(Visit visit) const noexcept {
        for_each_cell(0, n_cells, visit);
    }
    template <class Visit>
    void for_each_cell(Index begin, Index end, Visit visit) const noexcept {
        find_cell(begin, end, [&](Index i, Cell const& cell) { return visit(i, cell), false; });
    }
    Index n_triangles() const noexcept { return n_cells - n_quads; }  // for the layout mixed
    Index n_checked() const noexcept { return n_cells + n_guards; }
    // If the caller's cells are polygons, the cells of this mesh are their pieces (pieces.hpp).
    // Only the following functions distinguish such a mesh from others.
    bool has_pieces() const noexcept { return piece_start != nullptr; }
    Index n_given_cells() const noexcept { return has_pieces() ? n_given : n_cells; }
    Index n_pieces() const noexcept { return has_pieces() ? n_cells : 0; }
    // Return the pieces and the guards of one of the caller's cells.
    IndexRange pieces_of(Index given) const noexcept {
        return has_pieces() ? IndexRange{piece_start[given], piece_start[given + 1]}
                            : IndexRange{given, given + 1};
    }
    IndexRange guards_of(Index given) const noexcept {
        return has_pieces() ? IndexRange{guard_start[given], guard_start[given + 1]} : IndexRange{};
    }
    // Returns the number of the caller's cell to which a cell or guard belongs; none stays none.
    Index number(Index i) const noexcept;
    // Returns whether i is one of several pieces of a polygon, or a guard.
    bool is_piece_or_guard(Index i) const noexcept;
    // Returns the number of all corners, for the layout polygons.
    Offset n_corners() const noexcept { return Offset{cell_start[n_cells]} - index_base; }
    Index max_pieces() const noexcept {
        return static_cast<Index>(n_corners() - 2 * Offset{n_cells});
    }
    // Returns an upper bound of the number of cell sides, which depends on the counts alone.
    Size max_sides() const noexcept { return Size{4} * static_cast<Size>(n_cells); }

    // Returns the first block for which visit(block) returns true, or a block without cells.
    template <class Visit>
    GridBlock find_block(Visit visit) const noexcept;

    // Calls visit(face, list, number) for the faces, then for the segments of the point lists, then
    // for the edges along sides of blocks. `list` is none unless the face is a segment of a list;
    // `number` is the face, the entry of list_points, or the side of a block. A visit that returns
    // false ends the loop, and the function returns false.
    template <class Visit>
    bool for_each_face(Visit visit) const noexcept;
};

// Returns the area of a cell, positive if the cell is counter-clockwise. The area of a quad is half
// the cross product of the diagonals.
Real cell_area(Cell const& cell, Points points) noexcept;

// Refuses coordinates that are not finite or exceed the largest coordinate.
Status check_range(Points points, Index n_points, Fault& fault,
                   Executor const& executor = {}) noexcept;

// Checks the ranges of the counts. A size query reads only these counts and, for polygons,
// cell_start, which check_polygons() checks.
Status check_counts(Mesh const& mesh, Fault& fault) noexcept;
Status check_polygons(Mesh const& mesh, Fault& fault) noexcept;
// Checks where the points of each cell are stored: the starts of cell lists, or block dimensions.
Status check_layout(Mesh const& mesh, Fault& fault) noexcept;

// Checks everything that needs no neighbours: counts, pointers, indices, repeated points in a cell,
// and coordinates.
Status check_mesh(Mesh const& mesh, Fault& fault, Executor const& executor = {}) noexcept;

inline Cell Mesh::cell(Index i) const noexcept {
    if (layout == CellLayout::structured) return GridBlock{ni, nj, 0, 0}.cell(i);
    if (layout == CellLayout::blocks) {
        GridBlock const found = find_block(
            [i](GridBlock const& block) { return i - block.first_cell < block.n_cells(); });
        return found.cell(i - found.first_cell);
    }
    const Index* first = cell_points;
    Index width = 4;
    if (layout == CellLayout::rows) {
        width = cell_start[i + 1] - cell_start[i];
        first += Offset{cell_start[i]} - index_base;
    } else if (layout == CellLayout::mixed && i >= n_triangles()) {
        first = quad_points + Offset{4} * (i - n_triangles());
    } else {
        width = layout == CellLayout::quads ? 4 : 3;
        first += Offset{width} * i;
    }
    Index const c = from_zero(first[2], index_base), last = from_zero(first[width - 1], index_base);
    return {last == c ? 3 : 4,
            {from_zero(first[0], index_base), from_zero(first[1], index_base), c, last}};
}

inline Index Mesh::number(Index i) const noexcept {
    if (!has_pieces() || i == none) return i;
    const Index* const start = i < n_cells ? piece_start : guard_start;
    Index low = 0, high = n_given;  // start[low] <= i < start[high]
    while (high - low > 1) {
        Index const middle = low + (high - low) / 2;
        (start[middle] <= i ? low : high) = middle;
    }
    return low;
}

inline bool Mesh::is_piece_or_guard(Index i) const noexcept {
    if (!has_pieces()) return false;
    Index const cell = number(i);
    return i >= n_cells || pieces_of(cell).count() > 1;
}

template <class Visit>
GridBlock Mesh::find_block(Visit visit) const noexcept {
    GridBlock block;
    for (Index b = 0; b < n_blocks; ++b) {
        block.first_point += block.n_points();
        block.first_cell += b == 0 ? 0 : block.n_cells();
        block.ni = block_sizes[2 * b];
        block.nj = block_sizes[2 * b + 1];
        if (visit(block)) return block;
    }
    return {};
}

template <class Matches>
Index Mesh::find_cell(Index begin, Index end, Matches matches) const noexcept {
    if (layout == CellLayout::blocks) {
        Index found = none;
        find_block([&](GridBlock const& block) {
            Index const last = min(end, block.first_cell + block.n_cells());
            for (Index i = max(begin, block.first_cell); i < last; ++i) {
                if (!matches(i, block.cell(i - block.first_cell))) continue;
                found = i;
                return true;
            }
            return last >= end;
        });
        return found;
    }
    // matches() cannot change a copy, so the compiler need not read the fields of the mesh again.
    Mesh const mesh = *this;
    for (Index i = begin; i < end; ++i) {
        Cell const cell = mesh.cell(i);
        const Index(&p)[4] = cell.point;
        if (cell.n == 3 ? matches(i, Cell{3, {p[0], p[1], p[2]}})
                        : matches(i, Cell{4, {p[0], p[1], p[2], p[3]}}))
            return i;
    }
    return none;
}

template <class Visit>
bool Mesh::for_each_face(Visit visit) const noexcept {
    for (Index face = 0; face < n_faces; ++face) {
        Index const* const ends = face_points + 2 * Offset{face};
        BoundaryFace const given{from_zero(ends[0], index_base), from_zero(ends[1], index_base),
                                 face_markers[face]};
        if (!visit(given, none, face)) return false;
    }
    for (Index list = 0; list < n_lists; ++list) {
        for (Index k = list_start[list] - index_base; k + 1 < list_start[list + 1] - index_base;
             ++k) {
            Index const begin = from_zero(list_points[k], index_base),
                        end = from_zero(list_points[k + 1], index_base);
            if (!visit(BoundaryFace{begin, end, list_markers[list]}, list, k)) return false;
        }
    }
    if (block_markers == nullptr) return true;
    Index number = 0;  // counts the sides of all blocks
    GridBlock const stopped = find_block([&](GridBlock const& block) {
        for (Index side = 0; side < 4; ++side, ++number) {
            Index const marker = block_markers[number];
            for (Index k = 0; marker != no_marker && k < block.edges_along(side); ++k) {
                BoundaryFace const edge{block.point_along(side, k), block.point_along(side, k + 1),
                                        marker};
                if (!visit(edge, none, number)) return true;
            }
        }
        return false;
    });
    return stopped.ni == 0;
}

}  // namespace harmorph
