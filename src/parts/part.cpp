#include "parts/part.hpp"

#include "base/sort.hpp"
#include "mesh/cell_shape.hpp"

namespace harmorph {
namespace {

// Returns the mesh with the cells that the part's own arrays hold.
Mesh with_cells(Mesh mesh, Index n_own, const Index* cell_start,
                const Index* cell_points) noexcept {
    if (mesh.layout != CellLayout::polygons) mesh.layout = CellLayout::quads;
    mesh.n_cells = n_own;
    mesh.cell_points = cell_points;
    mesh.cell_start = cell_start;
    return mesh;
}

// Reverses the order of the points of a piece or guard.
void reverse(Index* points) noexcept {
    bool const is_triangle = points[2] == points[3];
    Index const a = points[0], b = points[1], c = points[2], d = points[3];
    points[0] = is_triangle ? c : d;
    points[1] = is_triangle ? b : c;
    points[2] = is_triangle ? a : b;
    points[3] = a;
}

}  // namespace

Index PartMesh::n_own() const noexcept {
    Index n = 0;
    for (Index cell = 0; cell < mesh.n_cells; ++cell) n += is_ghost(cell) ? 0 : 1;
    return n;
}

Offset PartMesh::n_own_corners() const noexcept {
    Offset n = 0;
    for (Index cell = 0; cell < mesh.n_cells; ++cell) {
        n += is_ghost(cell) ? 0 : mesh.cell_start[cell + 1] - mesh.cell_start[cell];
    }
    return n;
}

void Part::lay_out(Arena& arena, PartMesh const& mesh) noexcept {
    Index const n_own = mesh.n_own(), n_points = mesh.mesh.n_points;
    bool const polygons = mesh.mesh.layout == CellLayout::polygons;
    arena.take(cell_start, polygons ? n_own + Offset{1} : 0);
    arena.take(cell_points, polygons ? mesh.n_own_corners() : Offset{4} * n_own);
    arena.take(given_cell, n_own < mesh.mesh.n_cells ? n_own : 0);
    // For polygons the ghost cells are counted, too, so that the sizes are upper bounds.
    Mesh const counts = polygons ? division.lay_out(arena, mesh.mesh)
                                 : with_cells(mesh.mesh, n_own, nullptr, nullptr);
    arena.take(topology.reversed, counts.n_checked());
    topology.edges.lay_out(arena, counts);
    arena.take(topology.representative, n_points);
    boundary.lay_out(arena, counts);
    arena.take(in_cell, n_points);
    arena.take(on_border, n_points);
    arena.take(by_number, n_points);
}

Status Part::init(PartMesh const& mesh, Fault& fault) noexcept {
    given = mesh;
    HARMORPH_TRY(check_mesh(mesh.mesh, fault));
    HARMORPH_TRY(sort_numbers(fault));
    fill(in_cell, std::uint8_t{0});
    fill(topology.reversed, std::uint8_t{0});
    HARMORPH_TRY(mesh.mesh.layout == CellLayout::polygons ? take_polygons(fault)
                                                          : take_cells(fault));
    for (Index k = 0; k < own().n_points; ++k) topology.representative[k] = k;
    HARMORPH_TRY(topology.edges.build(own(), {}, fault));
    HARMORPH_TRY(check_overlap(fault));
    HARMORPH_TRY(boundary.mark(topology, fault));
    count_pairs();
    return Status::ok;
}

Status Part::sort_numbers(Fault& fault) noexcept {
    Index const n = given.mesh.n_points;
    bool in_order = true;
    for (Index k = 0; k < n; ++k) {
        if (number(k) < 0 || number(k) > largest_number) {
            return fault.refuse(Status::bad_mesh,
                                "the global number of point # is ~, but it must be from 0 to 2^61",
                                point_item(k), {}, static_cast<Real>(number(k)));
        }
        by_number[k] = k;
        in_order = in_order && (k == 0 || number(k - 1) < number(k));
    }
    if (!in_order) sort(by_number, [&](Index a, Index b) { return number(a) < number(b); });
    for (Index k = 1; k < n; ++k) {
        if (number(by_number[k - 1]) != number(by_number[k])) continue;
        return fault.refuse(Status::bad_mesh, "points # and @ have the same global number, ~",
                            point_item(by_number[k - 1]), point_item(by_number[k]),
                            static_cast<Real>(number(by_number[k])));
    }
    return Status::ok;
}

void Part::note_points(const Index* points, Index n, bool ghost) noexcept {
    for (Index k = 0; k < n; ++k) {
        std::uint8_t& mark = in_cell[points[k]];
        mark = max<std::uint8_t>(mark, ghost ? 1 : 2);
    }
}

// Takes the own cells; each is made counter-clockwise by its own area.
Status Part::take_cells(Fault& fault) noexcept {
    Mesh const& mesh = given.mesh;
    Index n = 0;
    Index const bad = mesh.find_cell([&](Index i, Cell cell) {
        bool const ghost = given.is_ghost(i);
        note_points(cell.point, cell.n, ghost);
        if (ghost) return false;
        if (cell_area(cell, mesh.points) < 0) cell.reverse();
        CellShape const shape(cell, mesh.points, false);
        if (!is_whole(shape, resolved_height(shape))) return true;
        Index* const corner = cell_points.data() + 4 * Offset{n};
        for (Index k = 0; k < 4; ++k) corner[k] = cell.point[k < cell.n ? k : 2] + mesh.index_base;
        if (!given_cell.empty()) given_cell[n] = i;
        ++n;
        return false;
    });
    topology.mesh = cells = with_cells(mesh, n, nullptr, cell_points.data());
    return bad == none ? Status::ok : refuse_shape(bad, fault);
}

// Takes the own polygons. They are divided in the orientation in which they are given, so that all
// parts have the triangles of the whole mesh, and are made counter-clockwise after that.
Status Part::take_polygons(Fault& fault) noexcept {
    Mesh const& mesh = given.mesh;
    Index n = 0, filled = 0;
    for (Index i = 0; i < mesh.n_cells; ++i) {
        const Index* const corner =
            mesh.cell_points + (Offset{mesh.cell_start[i]} - mesh.index_base);
        Index const corners = mesh.cell_start[i + 1] - mesh.cell_start[i];
        bool const ghost = given.is_ghost(i);
        for (Index k = 0; k < corners; ++k) {
            Index const point = from_zero(corner[k], mesh.index_base);
            note_points(&point, 1, ghost);
            if (!ghost) cell_points[filled + k] = corner[k];
        }
        if (ghost) continue;
        if (!given_cell.empty()) given_cell[n] = i;
        cell_start[n++] = filled + mesh.index_base;
        filled += corners;
    }
    cell_start[n] = filled + mesh.index_base;
    cells = with_cells(mesh, n, cell_start.data(), cell_points.data());
    Pieces& pieces = division.pieces;
    pieces.start = pieces.start.first(n + Offset{1});
    pieces.guard_start = pieces.guard_start.first(n + Offset{1});
    division.run(cells);
    topology.mesh = pieces.mesh(cells);
    topology.reversed = topology.reversed.first(topology.mesh.n_checked());
    for (Index i = 0; i < n; ++i) orient_polygon(i);
    for (Index k = 0; k < topology.mesh.n_checked(); ++k) {
        Real const resolved = resolved_height(CellShape(topology.cell(k), mesh.points, false));
        if (is_whole(shape_of(topology, k, mesh.points), resolved)) continue;
        Index const cell = topology.mesh.number(k);
        return refuse_shape(given_cell.empty() ? cell : given_cell[cell], fault);
    }
    return Status::ok;
}

// Makes polygon i, with its pieces and guards, counter-clockwise.
void Part::orient_polygon(Index i) noexcept {
    Mesh const& mesh = given.mesh;
    Pieces& pieces = division.pieces;
    Index* const corner = cell_points.data() + (cell_start[i] - mesh.index_base);
    Index const corners = cell_start[i + 1] - cell_start[i];
    Real area = 0;
    for (Index piece = pieces.start[i]; piece < pieces.start[i + 1]; ++piece) {
        area += cell_area(topology.mesh.cell(piece), mesh.points);
    }
    if (!(area < 0)) return;
    for (Index k = 0; 2 * k + 1 < corners; ++k) {
        Index const other = corner[corners - 1 - k];
        corner[corners - 1 - k] = corner[k];
        corner[k] = other;
    }
    for (Index k = pieces.start[i]; k < pieces.start[i + 1]; ++k)
        reverse(pieces.point.data() + 4 * Offset{k});
    for (Index k = pieces.guard_start[i]; k < pieces.guard_start[i + 1]; ++k)
        reverse(pieces.point.data() + 4 * Offset{k});
}

// Tells whether the cell is neither inverted nor too thin for the digits of its coordinates.
bool Part::is_whole(CellShape const& shape, Real resolved) noexcept {
    CellCorners const corners(shape);
    inverted_ = !(corners.smallest() > 0);
    height_ = inverted_ ? 0.5 * corners.smallest() : corners.smallest_height(shape.n);
    return !inverted_ && height_ >= resolved;
}

Status Part::refuse_shape(Index cell, Fault& fault) const noexcept {
    return fault.refuse(
        Status::bad_mesh,
        inverted_ ? "cell # is inverted or has no area: the smallest area at its corners is ~"
                  : "cell # is too thin: its height is ~, which its coordinates do not resolve",
        cell_item(cell), {}, height_);
}

// Checks that cells do not overlap: cells that are all counter-clockwise run along a common edge in
// opposite directions, unless they overlap.
Status Part::check_overlap(Fault& fault) const noexcept {
    Edges const& edges = topology.edges;
    if (edges.agree) return Status::ok;
    edges.for_each([&](Index edge, Index low, Index high) {
        Index const second = edges.second[edge];
        if (failed(fault.status) || second < 0 || ((edges.first[edge].code ^ second) & 1) != 0)
            return;
        fault.refuse(Status::bad_mesh,
                     "the cells on both sides of the edge between points # and @ overlap",
                     point_item(low), point_item(high));
    });
    return fault.status;
}

void Part::count_pairs() noexcept {
    fill(on_border, std::uint8_t{0});
    n_open = 0;
    topology.edges.for_each([&](Index edge, Index low, Index high) {
        if (!topology.edges.is_boundary(edge)) return;
        ++n_open;
        on_border[low] = on_border[high] = 1;
    });
    pairs = border_pairs = 0;
    auto const count = [&](Index a, Index b) {
        ++pairs;
        border_pairs += on_border[a] | on_border[b];
    };
    topology.edges.for_each([&](Index, Index low, Index high) { count(low, high); });
    own().for_each_cell([&](Index, Cell const& cell) {
        if (cell.n != 4) return;
        count(cell.point[0], cell.point[2]);
        count(cell.point[1], cell.point[3]);
    });
}

}  // namespace harmorph
