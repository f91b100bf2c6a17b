#include "mesh/delaunay.hpp"

#include "base/predicates.hpp"

namespace harmorph {
namespace {

// The number of a side is 3 * triangle + the corner opposite to the side.
constexpr Index triangle_of(Index side) noexcept { return side / 3; }
constexpr Index next_side(Index side) noexcept { return side % 3 == 2 ? side - 2 : side + 1; }

}  // namespace

Size Triangulation::max_triangles(Mesh const& mesh) noexcept {
    return static_cast<Size>(mesh.n_cells) * (mesh.layout == CellLayout::triangles ? 1 : 2);
}

void Triangulation::lay_out(Arena& arena, Mesh const& counts) noexcept {
    Size const n = max_triangles(counts);
    arena.take(corner_, 3 * n);
    arena.take(across_, 3 * n);
    arena.take(waiting_, n);
    arena.take(is_waiting_, n);
    mesh = Mesh{};
    mesh.n_points = counts.n_points;
    mesh.layout = CellLayout::triangles;
    mesh.n_cells = static_cast<Index>(min(n, static_cast<Size>(Mesh::max_cells)));
    edges.lay_out(arena, mesh);
}

Status Triangulation::build(Topology const& given, Fault& fault) noexcept {
    if (max_triangles(given.mesh) > static_cast<Size>(Mesh::max_cells)) {
        return fault.refuse(Status::unsupported,
                            "the bounded scheme can split at most 2^28 cells into triangles, but "
                            "the mesh has # cells",
                            plain(given.mesh.n_cells));
    }
    mesh.points = given.mesh.points;
    representative = given.representative;
    mesh.cell_points = corner_.data();
    mesh.n_cells = 0;
    HARMORPH_TRY(split(given, fault));
    HARMORPH_TRY(edges.build(mesh, representative, fault));
    find_neighbours();
    flip_all();
    return edges.build(mesh, representative, fault);
}

void Triangulation::add(Index a, Index b, Index c) noexcept {
    Index const corner = 3 * mesh.n_cells++;
    corner_[corner] = a;
    corner_[corner + 1] = b;
    corner_[corner + 2] = c;
}

// Splits each quad along its Delaunay diagonal, so that few flips remain.
Status Triangulation::split(Topology const& given, Fault& fault) noexcept {
    for (Index i = 0; i < given.mesh.n_cells; ++i) {
        Cell cell = given.cell(i);
        Vec2 at[4];
        for (Index k = 0; k < cell.n; ++k) {
            cell.point[k] = representative[cell.point[k]];
            at[k] = given.mesh.points[cell.point[k]];
        }
        for (Index k = 0; k < (cell.n == 3 ? 1 : 4); ++k) {
            if (orientation_sign(at[k], at[(k + 1) % cell.n], at[(k + 2) % cell.n]) > 0) continue;
            return fault.refuse(Status::bad_mesh, "cell # is inverted or has no area",
                                cell_item(given.mesh.number(i)));
        }
        Index const* const p = cell.point;
        if (cell.n == 3) {
            add(p[0], p[1], p[2]);
        } else if (in_circle_sign(at[0], at[1], at[2], at[3]) <= 0) {
            add(p[0], p[1], p[2]);
            add(p[0], p[2], p[3]);
        } else {
            add(p[0], p[1], p[3]);
            add(p[1], p[2], p[3]);
        }
    }
    return Status::ok;
}

void Triangulation::find_neighbours() const noexcept {
    fill(across_.first(3 * mesh.n_cells), none);
    edges.for_each([&](Index edge, Index low, Index high) {
        auto const side_of = [&](Index code) {
            Index side = 3 * cell_of_side(code);
            while (corner_[side] == low || corner_[side] == high) ++side;
            return side;
        };
        if (edges.is_boundary(edge)) return;
        Index const one = side_of(edges.first[edge].code), other = side_of(edges.second[edge]);
        across_[one] = other;
        across_[other] = one;
    });
}

bool Triangulation::is_delaunay(Index side) const noexcept {
    Index const other = across_[side], begin = next_side(side), end = next_side(begin);
    auto const at = [&](Index corner) { return mesh.points[corner_[corner]]; };
    return in_circle_sign(at(side), at(begin), at(end), at(other)) <= 0;
}

//       end                 end
//      / | \               /   \        before: (apex, begin, end), (opposite, end, begin)
//  apex  |  opposite   apex --- opposite
//      \ | /               \   /        after: (apex, begin, opposite), (opposite, end, apex)
//      begin               begin
//
// Each triangle changes its third corner and two of its sides.
void Triangulation::flip(Index side) const noexcept {
    auto const join = [&](Index one, Index other) {
        across_[one] = other;
        if (other != none) across_[other] = one;
    };
    Index const other = across_[side];
    Index const begin = next_side(side), end = next_side(begin);
    Index const other_end = next_side(other), other_begin = next_side(other_end);
    Index const begin_opposite = across_[other_end], end_apex = across_[begin];
    corner_[end] = corner_[other];
    corner_[other_begin] = corner_[side];
    join(side, begin_opposite);
    join(other, end_apex);
    join(begin, other_end);
}

void Triangulation::flip_all() noexcept {
    Index n = 0;
    auto const push = [&](Index triangle) {
        if (is_waiting_[triangle] != 0) return;
        is_waiting_[triangle] = 1;
        waiting_[n++] = triangle;
    };
    fill(is_waiting_, std::uint8_t{0});
    for (Index triangle = mesh.n_cells; triangle-- > 0;) push(triangle);
    flips = 0;
    // For every edge that may have to be flipped, at least one of its triangles is on the stack. If
    // both are, the edge is tested when the second one is taken from the stack.
    while (n > 0) {
        Index const triangle = waiting_[--n];
        is_waiting_[triangle] = 0;
        for (Index side = 3 * triangle; side < 3 * triangle + 3; ++side) {
            if (across_[side] == none) continue;
            Index const other = triangle_of(across_[side]);
            if (is_waiting_[other] != 0 || is_delaunay(side)) continue;
            flip(side);
            ++flips;
            push(other);
            push(triangle);
            break;
        }
    }
}

}  // namespace harmorph
