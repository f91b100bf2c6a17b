#include "mesh/topology.hpp"

#include "base/sort.hpp"

namespace harmorph {
namespace {

bool comes_before(Edges::Side a, Edges::Side b) noexcept {
    return a.end != b.end ? a.end < b.end : a.code < b.code;
}

// Sorts a few sides without branches: the sides of a point come in no particular order, so branches
// would often be mispredicted.
template <Size n>
void sort_few(Span<Edges::Side> sides) noexcept {
    std::uint64_t key[n];
    for (Size i = 0; i < n; ++i) {
        key[i] = static_cast<std::uint64_t>(sides[i].end) << 32 |
                 static_cast<std::uint32_t>(sides[i].code);
    }
    for (Size last = n - 1; last > 0; --last) {
        for (Size i = 0; i < last; ++i) {
            std::uint64_t const low = min(key[i], key[i + 1]), high = max(key[i], key[i + 1]);
            key[i] = low;
            key[i + 1] = high;
        }
    }
    for (Size i = 0; i < n; ++i) {
        sides[i] = {static_cast<Index>(key[i] >> 32), static_cast<Index>(key[i] & 0xFFFFFFFFu)};
    }
}

// At most points, up to four edges begin, and each has two sides.
void sort_sides(Span<Edges::Side> sides) noexcept {
    switch (sides.size()) {
        case 0:
        case 1: return;
        case 2: return sort_few<2>(sides);
        case 3: return sort_few<3>(sides);
        case 4: return sort_few<4>(sides);
        case 5: return sort_few<5>(sides);
        case 6: return sort_few<6>(sides);
        case 7: return sort_few<7>(sides);
        case 8: return sort_few<8>(sides);
        default: return sort(sides, comes_before);
    }
}

// Calls visit(smaller point, side) for every side of every cell. Returns the first cell that has a
// side from a point to the same point, or none.
template <class PointOf, class Visit>
Index visit_sides(Mesh const& mesh, PointOf point_of, Visit visit) noexcept {
    return mesh.find_cell([&](Index i, Cell const& cell) {
        for (Index k = 0; k < cell.n; ++k) {
            Index const a = point_of(cell.point[k]), b = point_of(cell.next(k));
            if (a == b) return true;
            visit(min(a, b), Edges::Side{max(a, b), 2 * i + (a < b ? 0 : 1)});
        }
        return false;
    });
}

template <class Visit>
Index for_each_side(Mesh const& mesh, Span<const Index> representative, Visit visit) noexcept {
    if (representative.empty())
        return visit_sides(
            mesh, [](Index point) { return point; }, visit);
    return visit_sides(
        mesh, [&](Index point) { return representative[point]; }, visit);
}

}  // namespace

void Edges::lay_out(Arena& arena, Mesh const& mesh) noexcept {
    arena.take(start, Size{1} + static_cast<Size>(mesh.n_points));
    arena.take(first, mesh.max_sides());
    arena.take(second, mesh.max_sides());
}

Status Edges::build(Mesh const& mesh, Span<const Index> representative, Fault& fault) noexcept {
    fill(start, Index{0});
    Index const bad_cell =
        for_each_side(mesh, representative, [&](Index point, Side) { ++start[point]; });
    if (bad_cell != none) {
        return fault.refuse(Status::bad_mesh,
                            "cell # has two corners that a cut joins into one point",
                            cell_item(mesh.number(bad_cell)));
    }
    counts_to_starts(start);
    for_each_side(mesh, representative,
                  [&](Index point, Side side) { first[start[point]++] = side; });

    n_boundary = 0;
    Index against = 0;  // 1 if two cells run along a common edge in the same direction
    Index n_edges = 0;
    Index sides_begin = 0;
    for (Index point = 0; point < mesh.n_points; ++point) {
        Index const sides_end = start[point];  // filling has advanced the start to the end
        Span<Side> const sides = first.from(sides_begin, sides_end - sides_begin);
        sort_sides(sides);
        start[point] = n_edges;
        // Edges overwrite sides that have been read.
        for (Size k = 0; k < sides.size();) {
            Side const side = sides[k++];
            Index other = unmarked;
            if (k < sides.size() && sides[k].end == side.end) {
                other = sides[k++].code;
                against |= ~(other ^ side.code) & 1;
            } else {
                ++n_boundary;
            }
            if (k < sides.size() && sides[k].end == side.end) {
                return fault.refuse(
                    Status::bad_mesh,
                    "the edge between points # and @ belongs to more than two cells",
                    point_item(point), point_item(side.end));
            }
            first[n_edges] = side;
            second[n_edges++] = other;
        }
        sides_begin = sides_end;
    }
    start[mesh.n_points] = n_edges;
    agree = against == 0;
    return Status::ok;
}

Index Edges::find(Index a, Index b) const noexcept {
    Index const begin = min(a, b), end = max(a, b);
    Index low = start[begin], high = start[begin + 1];
    while (low < high) {
        Index const middle = low + (high - low) / 2;
        if (first[middle].end < end) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < start[begin + 1] && first[low].end == end ? low : none;
}

RegionCounts RegionCounts::of(Topology const& topology) noexcept {
    Mesh const& mesh = topology.mesh;
    RegionCounts counts;
    counts.points = mesh.n_points;
    counts.cells = mesh.n_checked();
    counts.pairs = topology.edges.count();
    for (Index i = 0; i < mesh.n_cells; ++i) {
        Index const n = mesh.cell(i).n;
        counts.cell_corners += n;
        if (n == 4) counts.pairs += 2;  // the diagonals
    }
    counts.cell_corners += 3 * Offset{mesh.n_guards};
    counts.pairs += mesh.n_guards;  // the neighbours of a corner
    return counts;
}

}  // namespace harmorph
