// The C interface: forms the cells of a mesh that is given as edges.
#include <limits>

#include "limits.hpp"

namespace harmorph {
namespace {

constexpr Index max_sides = 1024;

// The edges of the caller, and the cells that are made from them.
struct EdgeCells {
    hm_edge_mesh given;
    Span<Index> start;        // [n_cells + 1] begin of the points of each cell, from index_base
    Span<Index> points;       // [sides of all cells] from index_base
    Span<Index> edge;         // [sides of all cells] edges of each cell, from 0; working memory
    Span<Index> face_points;  // [2 * faces]
    Span<Index> face_marker;  // [faces]
    Index n_sides = 0, n_faces = 0;

    Status read(const hm_edge_mesh* from, CallFault& fault) noexcept;
    void lay_out(Arena& arena) noexcept {
        arena.take(start, Offset{given.n_cells} + 1);
        arena.take(points, n_sides);
        arena.take(edge, n_sides);
        arena.take(face_points, Offset{2} * n_faces);
        arena.take(face_marker, n_faces);
    }
    Status run(Fault& fault) noexcept {
        sort_edges();
        for (Index cell = 0; cell < given.n_cells; ++cell) HARMORPH_TRY(order(cell, fault));
        for (Index cell = 0; cell <= given.n_cells; ++cell) start[cell] += given.index_base;
        list_faces();
        return Status::ok;
    }
    hm_mesh present() const noexcept;

private:
    Index end_of(Index e, Index k) const noexcept {
        return given.edge_points[2 * Offset{e} + k] - given.index_base;
    }
    Index cell_of(Index e, Index k) const noexcept {
        return given.edge_cells[2 * Offset{e} + k] - given.index_base;
    }
    bool is_face(Index e) const noexcept {
        return given.edge_markers != nullptr && given.edge_markers[e] != HM_NO_MARKER &&
               (cell_of(e, 0) == none || cell_of(e, 1) == none);
    }
    Status check_sizes(Fault& fault) const noexcept;
    Status check_edge(Index e, Fault& fault) const noexcept;
    void sort_edges() const noexcept;
    Status order(Index cell, Fault& fault) const noexcept;
    void list_faces() const noexcept;
};

constexpr Index largest_list = Index{1} << 30;
constexpr Limit<hm_edge_mesh> edge_limits[] = {
    {&hm_edge_mesh::index_base, 0, 1, "edges.index_base must be 0 or 1, not #"},
    {&hm_edge_mesh::n_points, 3, largest_list, "edges.n_points must be between 3 and 2^30, not #",
     Status::bad_mesh},
    {&hm_edge_mesh::n_cells, 1, 0.5 * largest_list,
     "edges.n_cells must be between 1 and 2^29, not #", Status::bad_mesh},
    {&hm_edge_mesh::n_edges, 3, largest_list, "edges.n_edges must be between 3 and 2^30, not #",
     Status::bad_mesh},
};

Status EdgeCells::check_sizes(Fault& fault) const noexcept {
    HARMORPH_TRY(check_limits(given, edge_limits, fault));
    return require({{"edges.edge_points", given.edge_points},
                    {"edges.edge_cells", given.edge_cells},
                    {"edges.points.x", given.points.x},
                    {"edges.points.y", given.points.y}},
                   fault);
}

Status EdgeCells::check_edge(Index e, Fault& fault) const noexcept {
    for (Index k = 0; k < 2; ++k) {
        Index const point = end_of(e, k), cell = cell_of(e, k);
        if (point < 0 || point >= given.n_points) {
            return fault.refuse(Status::bad_mesh, "edge # names point @, which does not exist",
                                side_item(e), point_item(point));
        }
        if (cell < none || cell >= given.n_cells) {
            return fault.refuse(Status::bad_mesh, "edge # names cell @, which does not exist",
                                side_item(e), cell_item(cell));
        }
    }
    if (cell_of(e, 0) != cell_of(e, 1)) return Status::ok;
    return fault.refuse(Status::bad_mesh,
                        "edge # has the same cell on both sides, or no cell on either side",
                        side_item(e));
}

Status EdgeCells::read(const hm_edge_mesh* from, CallFault& fault) noexcept {
    HARMORPH_TRY(open_struct(from, given, "edges", "hm_edge_mesh", fault));
    fault.bases.mesh = given.index_base;
    HARMORPH_TRY(check_sizes(fault));
    Offset sides = 0;
    for (Index e = 0; e < given.n_edges; ++e) {
        HARMORPH_TRY(check_edge(e, fault));
        for (Index k = 0; k < 2; ++k) sides += cell_of(e, k) != none ? 1 : 0;
        n_faces += is_face(e) ? 1 : 0;
    }
    if (sides > std::numeric_limits<Index>::max()) {
        return fault.refuse(Status::bad_mesh, "the cells together have more than 2^31 - 1 sides");
    }
    n_sides = static_cast<Index>(sides);
    return Status::ok;
}

// Lists the edges of each cell, in the order of their numbers: counts, sums up and fills.
void EdgeCells::sort_edges() const noexcept {
    for (Index cell = 0; cell <= given.n_cells; ++cell) start[cell] = 0;
    for (Index e = 0; e < given.n_edges; ++e) {
        for (Index k = 0; k < 2; ++k) {
            if (cell_of(e, k) != none) ++start[cell_of(e, k) + 1];
        }
    }
    for (Index cell = 0; cell < given.n_cells; ++cell) start[cell + 1] += start[cell];
    for (Index e = 0; e < given.n_edges; ++e) {
        for (Index k = 0; k < 2; ++k) {
            if (cell_of(e, k) != none) edge[start[cell_of(e, k)]++] = e;
        }
    }
    for (Index cell = given.n_cells; cell > 0; --cell) start[cell] = start[cell - 1];
    start[0] = 0;
}

// Orders the edges of a cell around the cell. Each edge must lead to the next one, and the last one
// to the first.
Status EdgeCells::order(Index cell, Fault& fault) const noexcept {
    Index const begin = start[cell], n = start[cell + 1] - begin;
    if (n < 3 || n > max_sides) {
        return fault.refuse(Status::bad_mesh, "cell # has @ edges, but a cell must have 3 to 1024",
                            cell_item(cell), plain(n));
    }
    Index at = end_of(edge[begin], 0);
    for (Index k = 0; k < n; ++k) {
        Index found = k;
        while (found < n && end_of(edge[begin + found], 0) != at &&
               end_of(edge[begin + found], 1) != at) {
            ++found;
        }
        if (found == n) {
            return fault.refuse(Status::bad_mesh,
                                "the edges of cell # do not form one closed loop; they are not "
                                "connected at point @",
                                cell_item(cell), point_item(at));
        }
        Index const e = edge[begin + found];
        edge[begin + found] = edge[begin + k];
        edge[begin + k] = e;
        points[begin + k] = at + given.index_base;
        at = end_of(e, end_of(e, 0) == at ? 1 : 0);
    }
    if (at + given.index_base == points[begin]) return Status::ok;
    return fault.refuse(
        Status::bad_mesh,
        "the edges of cell # do not form one closed loop; they are not connected at point @",
        cell_item(cell), point_item(at));
}

void EdgeCells::list_faces() const noexcept {
    Index face = 0;
    for (Index e = 0; e < given.n_edges; ++e) {
        if (!is_face(e)) continue;
        for (Index k = 0; k < 2; ++k) face_points[2 * face + k] = end_of(e, k) + given.index_base;
        face_marker[face++] = given.edge_markers[e];
    }
}

hm_mesh EdgeCells::present() const noexcept {
    hm_mesh mesh = {};
    Index longest = 0;
    for (Index cell = 0; cell < given.n_cells; ++cell) {
        longest = max(longest, start[cell + 1] - start[cell]);
    }
    mesh.struct_size = sizeof mesh;
    mesh.index_base = given.index_base;
    mesh.n_points = given.n_points;
    mesh.points = given.points;
    mesh.cell_layout = longest > 4 ? HM_CELLS_POLYGONS : HM_CELLS_ROWS;
    mesh.n_cells = given.n_cells;
    mesh.cell_start = start.data();
    mesh.cell_points = points.data();
    mesh.n_faces = n_faces;
    mesh.face_points = face_points.data();
    mesh.face_markers = face_marker.data();
    return mesh;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_mesh_from_edges(hm_mesh* mesh, hm_memory* memory, const hm_edge_mesh* edges,
                             hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        EdgeCells cells;
        HARMORPH_TRY(cells.read(edges, fault));
        HARMORPH_TRY(place(memory, fault, [&](Arena& arena) { cells.lay_out(arena); }));
        HARMORPH_TRY(check_report(mesh, "mesh", fault));
        HARMORPH_TRY(cells.run(fault));
        write_struct(cells.present(), mesh);
        return Status::ok;
    });
}

}  // extern "C"
