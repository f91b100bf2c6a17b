// The caller's mesh as it stands in the caller's arrays: cells in any of five layouts, boundary as faces or point lists.
#pragma once

#include "harmorph/base/span.hpp"
#include "harmorph/base/vec2.hpp"

namespace harmorph {

enum class CellLayout : std::int32_t { rows = 0, triangles = 1, quads = 2, structured = 3, mixed = 4 };

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

// The caller's number counted from 0. Whatever the caller gives, this does not overflow: the smallest number of all becomes
// the largest, which does not exist either.
constexpr Index from_zero(Index number, Index index_base) noexcept {
    return static_cast<Index>(static_cast<std::uint32_t>(number) - static_cast<std::uint32_t>(index_base));
}

struct BoundaryFace {
    Index begin = none, end = none;  // points, counted from 0
    Index marker = 0;
};

struct Mesh {
    Index index_base = 0;
    Index n_points = 0;
    Points points;
    CellLayout layout = CellLayout::rows;
    Index n_cells = 0;
    const Index* cell_start = nullptr;
    const Index* cell_points = nullptr;
    Index n_quads = 0;                   // mixed: the last cells, after the triangles
    const Index* quad_points = nullptr;
    Index ni = 0, nj = 0;
    Index n_faces = 0;
    const Index* face_points = nullptr;
    const Index* face_markers = nullptr;
    Index n_lists = 0;
    const Index* list_start = nullptr;
    const Index* list_points = nullptr;
    const Index* list_markers = nullptr;

    static constexpr Index max_points = Index{1} << 30;
    static constexpr Index max_cells = Index{1} << 29;  // four corners of each are counted in an Index

    // Whatever the layout: a quad whose last point is repeated is a triangle.
    Cell cell(Index i) const noexcept;
    // The first of all cells for which is(i, cell) holds, or none. Faster than asking for cell after cell: in each of its two
    // calls of `is` the compiler knows how many points there are, and keeps them in registers.
    template <class Is>
    Index find_cell(Is is) const noexcept { return find_cell(0, n_cells, is); }
    template <class Is>
    Index find_cell(Index begin, Index end, Is is) const noexcept;
    // visit(i, cell)
    template <class Visit>
    void for_each_cell(Visit visit) const noexcept { for_each_cell(0, n_cells, visit); }
    template <class Visit>
    void for_each_cell(Index begin, Index end, Visit visit) const noexcept {
        find_cell(begin, end, [&](Index i, Cell const& its) { return visit(i, its), false; });
    }
    Index n_triangles() const noexcept { return n_cells - n_quads; }  // mixed
    // Upper bound of the number of cell sides, from the counts alone.
    Size max_sides() const noexcept { return Size{4} * static_cast<Size>(n_cells); }

    // Faces, then the segments of the lists. visit(face, list or none, its number among its kind) may stop with false.
    template <class Visit>
    bool for_each_face(Visit visit) const noexcept;
};

// Counter-clockwise area (half the cross product of the diagonals, for a quad).
Real cell_area(Cell const& cell, Points points) noexcept;

// Ranges of the counts alone: all that a size query may look at.
Status check_counts(Mesh const& mesh, Fault& fault) noexcept;
// Cell lists or block dimensions: where each cell's points are; not yet which.
Status check_layout(Mesh const& mesh, Fault& fault) noexcept;

// Counts, pointers, indices, repeated points in a cell, coordinates: everything that needs no neighbourhood.
Status check_mesh(Mesh const& mesh, Fault& fault) noexcept;

inline Cell Mesh::cell(Index i) const noexcept {
    if (layout == CellLayout::structured) {
        Index const row = i / (ni - 1);
        Index const corner = i + row;  // a row of cells has one cell less than points
        return {4, {corner, corner + 1, corner + 1 + ni, corner + ni}};
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
    return {last == c ? 3 : 4, {from_zero(first[0], index_base), from_zero(first[1], index_base), c, last}};
}

template <class Is>
Index Mesh::find_cell(Index begin, Index end, Is is) const noexcept {
    Mesh const mesh = *this;  // what is() writes cannot change a copy
    for (Index i = begin; i < end; ++i) {
        Cell const its = mesh.cell(i);
        const Index(&p)[4] = its.point;
        if (its.n == 3 ? is(i, Cell{3, {p[0], p[1], p[2]}}) : is(i, Cell{4, {p[0], p[1], p[2], p[3]}})) return i;
    }
    return none;
}

template <class Visit>
bool Mesh::for_each_face(Visit visit) const noexcept {
    for (Index face = 0; face < n_faces; ++face) {
        Index const* const ends = face_points + 2 * Offset{face};
        BoundaryFace const its{from_zero(ends[0], index_base), from_zero(ends[1], index_base), face_markers[face]};
        if (!visit(its, none, face)) return false;
    }
    for (Index list = 0; list < n_lists; ++list) {
        for (Index k = list_start[list] - index_base; k + 1 < list_start[list + 1] - index_base; ++k) {
            Index const begin = from_zero(list_points[k], index_base), end = from_zero(list_points[k + 1], index_base);
            if (!visit(BoundaryFace{begin, end, list_markers[list]}, list, k)) return false;
        }
    }
    return true;
}

}  // namespace harmorph
