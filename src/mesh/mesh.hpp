// The caller's mesh as it stands in the caller's arrays: cells in any of seven layouts; boundary as
// faces, point lists, or sides of blocks. Polygons become a mesh of their pieces, see pieces.hpp.
#pragma once

#include "base/executor.hpp"
#include "base/span.hpp"
#include "base/vec2.hpp"

namespace harmorph {

enum class CellLayout : std::int32_t {
    rows = 0,
    triangles = 1,
    quads = 2,
    structured = 3,
    mixed = 4,
    blocks = 5,
    polygons = 6
};

// What the corner of a polygon was before anything moved.
enum class CornerKind : std::uint8_t { convex = 0, flat = 1, reflex = 2 };

// The points of one cell, counted from 0, in order round it; n is 3 or 4.
struct Cell {
    Index n = 0;
    Index point[4] = {};

    Index next(Index corner) const noexcept { return point[corner + 1 == n ? 0 : corner + 1]; }
    Index previous(Index corner) const noexcept { return point[corner == 0 ? n - 1 : corner - 1]; }
    void reverse() noexcept {
        for (Index k = 0; k < n / 2; ++k) {
            Index const its = point[k];
            point[k] = point[n - 1 - k];
            point[n - 1 - k] = its;
        }
    }
};

// The caller's number counted from 0. Whatever the caller gives, this does not overflow: the
// smallest number of all becomes the largest, which does not exist either.
constexpr Index from_zero(Index number, Index index_base) noexcept {
    return static_cast<Index>(static_cast<std::uint32_t>(number) -
                              static_cast<std::uint32_t>(index_base));
}

struct BoundaryFace {
    Index begin = none, end = none;  // points, counted from 0
    Index marker = 0;
};

// One of several structured blocks; its points and cells are numbered row by row.
struct GridBlock {
    Index ni = 0, nj = 0;
    Index first_point = 0, first_cell = 0;

    Index n_points() const noexcept { return ni * nj; }
    Index n_cells() const noexcept { return (ni - 1) * (nj - 1); }
    Cell cell(Index i) const noexcept {  // i counts from the first cell of the block
        Index const corner =
            first_point + i + i / (ni - 1);  // a row of cells has one cell less than points
        return {4, {corner, corner + 1, corner + 1 + ni, corner + ni}};
    }
    // Edges along a side, and their ends. Sides: i = 0, i = ni-1, j = 0, j = nj-1.
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

struct Mesh {
    Index index_base = 0;
    Index n_points = 0;
    Points points;
    CellLayout layout = CellLayout::rows;
    Index n_cells = 0;
    const Index* cell_start = nullptr;
    const Index* cell_points = nullptr;
    Index n_quads = 0;  // mixed: the last cells, after the triangles
    const Index* quad_points = nullptr;
    Index ni = 0, nj = 0;
    Index n_blocks = 0;  // blocks: ni, nj of each, and the markers of its four sides
    const Index* block_sizes = nullptr;
    const Index* block_markers = nullptr;
    Index n_faces = 0;
    const Index* face_points = nullptr;
    const Index* face_markers = nullptr;
    Index n_lists = 0;
    const Index* list_start = nullptr;
    const Index* list_points = nullptr;
    const Index* list_markers = nullptr;
    Index n_given = 0;                   // pieces of polygons: how many polygons
    const Index* piece_start = nullptr;  // where the pieces of each begin
    const Index* guard_start = nullptr;  // where the guards of each begin
    Index n_guards = 0;  // triangles behind the cells whose areas must be positive, too
    const CornerKind* guard_kind = nullptr;  // [n_guards]

    static constexpr Index most_corners = 1024;  // of a polygon
    static constexpr Index max_blocks = Index{1} << 16;
    static constexpr Index no_marker = INT32_MIN;  // in block_markers
    static constexpr Index max_points = Index{1} << 30;
    static constexpr Index max_cells = Index{1}
                                       << 29;  // four corners of each are counted in an Index

    // Whatever the layout but polygons: a quad whose last point is repeated is a triangle. Guards
    // are numbered behind the cells.
    Cell cell(Index i) const noexcept;
    // The first of all cells for which is(i, cell) holds, or none. Faster than asking for cell
    // after cell: in each of its two calls of `is` the compiler knows how many points there are,
    // and keeps them in registers.
    template <class Is>
    Index find_cell(Is is) const noexcept {
        return find_cell(0, n_cells, is);
    }
    template <class Is>
    Index find_cell(Index begin, Index end, Is is) const noexcept;
    // visit(i, cell)
    template <class Visit>
    void for_each_cell(Visit visit) const noexcept {
        for_each_cell(0, n_cells, visit);
    }
    template <class Visit>
    void for_each_cell(Index begin, Index end, Visit visit) const noexcept {
        find_cell(begin, end, [&](Index i, Cell const& its) { return visit(i, its), false; });
    }
    Index n_triangles() const noexcept { return n_cells - n_quads; }  // mixed
    Index n_checked() const noexcept { return n_cells + n_guards; }
    // Polygons are divided into pieces (pieces.hpp), which are the cells of this mesh then. Only
    // what follows distinguishes such a mesh from others.
    bool has_pieces() const noexcept { return piece_start != nullptr; }
    Index n_given_cells() const noexcept { return has_pieces() ? n_given : n_cells; }
    Index n_pieces() const noexcept { return has_pieces() ? n_cells : 0; }
    // The cells that one of the caller's cells consists of, and its guards.
    IndexRange pieces_of(Index given) const noexcept {
        return has_pieces() ? IndexRange{piece_start[given], piece_start[given + 1]}
                            : IndexRange{given, given + 1};
    }
    IndexRange guards_of(Index given) const noexcept {
        return has_pieces() ? IndexRange{guard_start[given], guard_start[given + 1]} : IndexRange{};
    }
    // The caller's cell that a cell or a guard is or belongs to; none of none.
    Index number(Index i) const noexcept;
    // One of several pieces of a cell, or a guard.
    bool is_part(Index i) const noexcept;
    Offset n_corners() const noexcept {
        return Offset{cell_start[n_cells]} - index_base;
    }  // polygons
    Index max_pieces() const noexcept {
        return static_cast<Index>(n_corners() - 2 * Offset{n_cells});
    }
    // Upper bound of the number of cell sides, from the counts alone.
    Size max_sides() const noexcept { return Size{4} * static_cast<Size>(n_cells); }

    // visit(block) until it returns true; which is returned, or a block of no cells.
    template <class Visit>
    GridBlock find_block(Visit visit) const noexcept;

    // Faces, then the segments of the lists, then the sides of blocks. visit(face, list or none,
    // its number among its kind) may stop with false.
    template <class Visit>
    bool for_each_face(Visit visit) const noexcept;
};

// Counter-clockwise area (half the cross product of the diagonals, for a quad).
Real cell_area(Cell const& cell, Points points) noexcept;

// Of coordinates that come with a call: finite, and no larger than the arithmetic carries.
Status check_range(Points points, Index n_points, Fault& fault,
                   Executor const& executor = {}) noexcept;

// Ranges of the counts alone: all that a size query may look at.
Status check_counts(Mesh const& mesh, Fault& fault) noexcept;
// Where the corners of polygons begin: all that a size query looks at besides.
Status check_polygons(Mesh const& mesh, Fault& fault) noexcept;
// Cell lists or block dimensions: where each cell's points are; not yet which.
Status check_layout(Mesh const& mesh, Fault& fault) noexcept;

// Counts, pointers, indices, repeated points in a cell, coordinates: everything that needs no
// neighbourhood.
Status check_mesh(Mesh const& mesh, Fault& fault, Executor const& executor = {}) noexcept;

inline Cell Mesh::cell(Index i) const noexcept {
    if (layout == CellLayout::structured) return GridBlock{ni, nj, 0, 0}.cell(i);
    if (layout == CellLayout::blocks) {
        GridBlock const its = find_block(
            [i](GridBlock const& block) { return i - block.first_cell < block.n_cells(); });
        return its.cell(i - its.first_cell);
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

inline bool Mesh::is_part(Index i) const noexcept {
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

template <class Is>
Index Mesh::find_cell(Index begin, Index end, Is is) const noexcept {
    if (layout == CellLayout::blocks) {
        Index found = none;
        find_block([&](GridBlock const& block) {
            Index const last = min(end, block.first_cell + block.n_cells());
            for (Index i = max(begin, block.first_cell); i < last; ++i) {
                if (!is(i, block.cell(i - block.first_cell))) continue;
                found = i;
                return true;
            }
            return last >= end;
        });
        return found;
    }
    Mesh const mesh = *this;  // what is() writes cannot change a copy
    for (Index i = begin; i < end; ++i) {
        Cell const its = mesh.cell(i);
        const Index(&p)[4] = its.point;
        if (its.n == 3 ? is(i, Cell{3, {p[0], p[1], p[2]}})
                       : is(i, Cell{4, {p[0], p[1], p[2], p[3]}}))
            return i;
    }
    return none;
}

template <class Visit>
bool Mesh::for_each_face(Visit visit) const noexcept {
    for (Index face = 0; face < n_faces; ++face) {
        Index const* const ends = face_points + 2 * Offset{face};
        BoundaryFace const its{from_zero(ends[0], index_base), from_zero(ends[1], index_base),
                               face_markers[face]};
        if (!visit(its, none, face)) return false;
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
    Index number = 0;  // of a side
    GridBlock const stopped = find_block([&](GridBlock const& block) {
        for (Index side = 0; side < 4; ++side, ++number) {
            Index const marker = block_markers[number];
            for (Index k = 0; marker != no_marker && k < block.edges_along(side); ++k) {
                BoundaryFace const its{block.point_along(side, k), block.point_along(side, k + 1),
                                       marker};
                if (!visit(its, none, number)) return true;
            }
        }
        return false;
    });
    return stopped.ni == 0;
}

}  // namespace harmorph
