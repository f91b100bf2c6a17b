#include "harmorph/parts/part.hpp"

#include "harmorph/base/sort.hpp"
#include "harmorph/mesh/cell_shape.hpp"

namespace harmorph {
namespace {

// The cells that the part's own arrays will hold: the counts alone matter to lay_out.
Mesh with_cells(Mesh mesh, Index n_own, const Index* cell_points) noexcept {
    mesh.layout = CellLayout::quads;
    mesh.n_cells = n_own;
    mesh.cell_points = cell_points;
    mesh.cell_start = nullptr;
    return mesh;
}

}  // namespace

Index PartMesh::n_own() const noexcept {
    Index n = 0;
    for (Index cell = 0; cell < mesh.n_cells; ++cell) n += is_ghost(cell) ? 0 : 1;
    return n;
}

void Part::lay_out(Arena& arena, PartMesh const& mesh) noexcept {
    Index const n_own = mesh.n_own(), n_points = mesh.mesh.n_points;
    Mesh const counts = with_cells(mesh.mesh, n_own, nullptr);
    arena.take(cell_points, Offset{4} * n_own);
    arena.take(given_cell, n_own < mesh.mesh.n_cells ? n_own : 0);
    arena.take(topology.reversed, n_own);
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
    HARMORPH_TRY(take_cells(fault));
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
            return fault.refuse(Status::bad_mesh, "the global number of point # is ~, not between 0 and 2^61",
                                Counts::mesh, k, none, static_cast<Real>(number(k)));
        }
        by_number[k] = k;
        in_order = in_order && (k == 0 || number(k - 1) < number(k));
    }
    if (!in_order) sort(by_number, [&](Index a, Index b) { return number(a) < number(b); });
    for (Index k = 1; k < n; ++k) {
        if (number(by_number[k - 1]) != number(by_number[k])) continue;
        return fault.refuse(Status::bad_mesh, "the points # and @ have the same global number ~", Counts::mesh,
                            by_number[k - 1], by_number[k], static_cast<Real>(number(by_number[k])));
    }
    return Status::ok;
}

// Own cells, turned counter-clockwise each by its own area.
Status Part::take_cells(Fault& fault) noexcept {
    Mesh const& mesh = given.mesh;
    fill(in_cell, std::uint8_t{0});
    fill(topology.reversed, std::uint8_t{0});
    Index n = 0;
    Real height = 0;
    bool inverted = false;
    Index const bad = mesh.find_cell([&](Index i, Cell cell) {
        bool const ghost = given.is_ghost(i);
        for (Index k = 0; k < cell.n; ++k) {
            in_cell[cell.point[k]] = larger<std::uint8_t>(in_cell[cell.point[k]], ghost ? 1 : 2);
        }
        if (ghost) return false;
        if (cell_area(cell, mesh.points) < 0) cell.reverse();
        CellShape const shape(cell, mesh.points, false);
        CellCorners const corners(shape);
        inverted = !(corners.smallest() > 0);
        height = inverted ? 0.5 * corners.smallest() : corners.smallest_height(shape.n);
        if (inverted || !(height >= resolved_height(shape))) return true;
        Index* const its = cell_points.data() + 4 * Offset{n};
        for (Index k = 0; k < 4; ++k) its[k] = cell.point[k < cell.n ? k : 2] + mesh.index_base;
        if (!given_cell.empty()) given_cell[n] = i;
        ++n;
        return false;
    });
    topology.mesh = with_cells(mesh, n, cell_points.data());
    if (bad == none) return Status::ok;
    return fault.refuse(Status::bad_mesh,
                        inverted ? "cell # is inverted or empty: its smallest corner area is ~"
                                 : "cell # has a height of ~, too small for the digits of its coordinates",
                        Counts::mesh, bad, none, height);
}

// Cells that are all counter-clockwise run along a common edge in opposite directions, unless they overlap.
Status Part::check_overlap(Fault& fault) const noexcept {
    Edges const& edges = topology.edges;
    if (edges.agree) return Status::ok;
    edges.for_each([&](Index edge, Index low, Index high) {
        Index const second = edges.second[edge];
        if (failed(fault.status) || second < 0 || ((edges.first[edge].code ^ second) & 1) != 0) return;
        fault.refuse(Status::bad_mesh, "the cells on both sides of the edge between points # and @ overlap",
                     Counts::mesh, low, high);
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

Index Part::find(Offset wanted) const noexcept {
    Index low = 0, high = by_number.count();
    while (low < high) {
        Index const middle = low + (high - low) / 2;
        if (number(by_number[middle]) < wanted) low = middle + 1;
        else high = middle;
    }
    return low < by_number.count() && number(by_number[low]) == wanted ? by_number[low] : none;
}

}  // namespace harmorph
