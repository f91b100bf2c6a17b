// parts: meshes that no process has as a whole. Input: the cells of one process with the global
// numbers of its points. Output: the edges where the part ends; the boundary of the whole mesh,
// which follows from the edges of all parts (shared_boundary.hpp); the equations of the part, whose
// sum over all parts is the matrix of the mesh (part_equations.hpp). No code here sends messages.
//
// Here: one part, with the checks that need no other part. tests/parts/test_parts.cpp and
// tests/parts/test_refused_parts.cpp cover this file.
#pragma once

#include "mesh/boundary.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/pieces.hpp"

namespace harmorph {

// An edge with one cell in a part; the cell is on the left of the edge. The layout is that of
// hm_private_edge.
struct OpenEdge {
    Offset begin = 0, end = 0;  // The ends are global numbers.
    Vec2 at_begin, at_end;
    Index marker = 0;
    Index marked = 0;  // The value is 1 if the edge is a boundary face.

    Offset low() const noexcept { return min(begin, end); }
    Offset high() const noexcept { return max(begin, end); }
};

struct PartMesh {
    Mesh mesh;
    const Offset* number = nullptr;        // [n_points]
    const std::uint8_t* ghosts = nullptr;  // [n_cells] or null

    bool is_ghost(Index cell) const noexcept { return ghosts != nullptr && ghosts[cell] != 0; }
    Index n_own() const noexcept;
    Offset n_own_corners() const noexcept;  // The function counts the corners of polygons.
};

struct Part {
    static constexpr Offset largest_number = Offset{1} << 61;

    PartMesh given;
    Mesh cells;  // The own cells, counter-clockwise: quads, or polygons.
    // The topology of the own cells, or of their pieces: quads, none reversed. Points are not
    // joined.
    Topology topology;
    Boundary boundary;       // The boundary contains only the marked faces, which are not in order.
    Span<Index> cell_start;  // [own cells + 1] This array exists for polygons only.
    Span<Index> cell_points;   // The corners of `cells`; both arrays count from index_base.
    PolygonDivision division;  // The division exists for polygons only.
    // [own cells] The numbers in the given mesh; empty if there are no ghosts.
    Span<Index> given_cell;
    // [n_points] The value is 1 for points of ghost cells alone, and 2 for points of an own cell.
    Span<std::uint8_t> in_cell;
    // [n_points] The value is 1 for the ends of edges with one own cell.
    Span<std::uint8_t> on_border;
    Span<Index> by_number;  // [n_points] The points in the order of global numbers.
    Index n_open = 0;       // The number of edges with one own cell.
    Offset pairs = 0;       // The number of edges, and of diagonals of quads.
    // The pairs with an end on the border, which alone may touch a known value.
    Offset border_pairs = 0;

    void lay_out(Arena& arena, PartMesh const& mesh) noexcept;
    Status init(PartMesh const& mesh, Fault& fault) noexcept;

    Mesh const& own() const noexcept { return topology.mesh; }
    Offset number(Index point) const noexcept { return given.number[point]; }
    // Calls visit(open edge) for the edges with one own cell.
    template <class Visit>
    void for_each_open(Visit visit) const noexcept;

private:
    Status take_cells(Fault& fault) noexcept;
    Status take_polygons(Fault& fault) noexcept;
    void orient_polygon(Index i) noexcept;
    bool is_whole(CellShape const& shape, Real resolved) noexcept;
    Status refuse_shape(Index cell, Fault& fault) const noexcept;
    void note_points(const Index* points, Index n, bool ghost) noexcept;
    Status sort_numbers(Fault& fault) noexcept;
    Status check_overlap(Fault& fault) const noexcept;
    void count_pairs() noexcept;
    Real height_ = 0;  // The height of the last cell that was refused.
    bool inverted_ = false;
};

template <class Visit>
void Part::for_each_open(Visit visit) const noexcept {
    Points const points = own().points;
    topology.edges.for_each([&](Index edge, Index low, Index high) {
        if (!topology.edges.is_boundary(edge)) return;
        bool const backwards = runs_backwards(topology.edges.first[edge].code);
        Index const begin = backwards ? high : low, end = backwards ? low : high;
        Index const second = topology.edges.second[edge];
        bool const marked = second != Edges::unmarked;
        Index const marker = marked ? boundary.given_marker[-2 - second] : 0;
        visit(OpenEdge{number(begin), number(end), points[begin], points[end], marker,
                       marked ? 1 : 0});
    });
}

}  // namespace harmorph
