#include "mesh/orientation.hpp"

#include "mesh/cell_shape.hpp"

namespace harmorph {
namespace {

// A union-find structure with parity: every cell refers to another cell whose orientation is known
// to be equal or opposite.
class Agreement {
public:
    explicit Agreement(Span<Index> parent) noexcept : parent_(parent) {
        for (Index cell = 0; cell < parent.count(); ++cell) parent_[cell] = 2 * cell;
    }

    // Returns 2 * root, + 1 if the cell has the opposite orientation to its root.
    Index root(Index cell) const noexcept {
        Index code = 2 * cell;
        while (parent_[code >> 1] >> 1 != code >> 1) {
            Index& step = parent_[code >> 1];
            step = parent_[step >> 1] ^ (step & 1);  // path halving
            code = step ^ (code & 1);
        }
        return code;
    }

    // Notes that cells a and b have equal (opposite = 0) or opposite (1) orientations. Returns
    // false if this contradicts what is known.
    bool unite(Index a, Index b, Index opposite) const noexcept {
        Index const root_a = root(a), root_b = root(b);
        Index const parity = (root_a ^ root_b ^ opposite) & 1;
        if (root_a >> 1 == root_b >> 1) return parity == 0;
        Index const low = min(root_a, root_b) >> 1, high = max(root_a, root_b) >> 1;
        parent_[high] = 2 * low + parity;
        return true;
    }

private:
    Span<Index> parent_;
};

}  // namespace

void OrientationWork::lay_out(Arena& arena, Mesh const& mesh) noexcept {
    arena.take(parent, mesh.n_cells);
    arena.take(balance, mesh.n_cells);
}

Sense common_orientation(Mesh const& mesh, Real& min_height) noexcept {
    constexpr Real rounding = 1e-9;  // a generous bound of the rounding errors below
    bool const clockwise = cell_area(mesh.cell(0), mesh.points) < 0;
    Real min_square = infinity;  // a lower bound of the squared heights of all corners
    Index const inverted = mesh.find_cell([&](Index, Cell const& cell) {
        CellCorners const corners({cell, mesh.points, clockwise});
        Real const area = corners.smallest();
        if (!(area > 0)) return true;
        min_square = min(min_square, area / corners.longest_square(cell.n) * area);
        return false;
    });
    min_height = inverted == none ? (1 - rounding) * sqrt(min_square) : 0;
    return inverted != none ? Sense::mixed
           : clockwise      ? Sense::clockwise
                            : Sense::counter_clockwise;
}

Status orient(Topology& topology, Sense sense, OrientationWork const& work, Index& inverted,
              Fault& fault) noexcept {
    Mesh const& mesh = topology.mesh;
    Edges const& edges = topology.edges;
    Span<std::uint8_t> const reversed = topology.reversed;
    inverted = none;
    // Nearly all meshes have cells of one orientation.
    if (edges.agree && sense != Sense::mixed) {
        fill(reversed, static_cast<std::uint8_t>(sense == Sense::clockwise ? 1 : 0));
        return Status::ok;
    }
    Agreement const agreement(work.parent);
    for (Index edge = 0; edge < edges.count(); ++edge) {
        Index const code = edges.first[edge].code, other = edges.second[edge];
        if (other < 0) continue;
        Index const same_direction = ((code ^ other) & 1) ^ 1;
        if (!agreement.unite(cell_of_side(code), cell_of_side(other), same_direction)) {
            return fault.refuse(
                Status::bad_mesh,
                "cells # and @ cannot have the same orientation: the mesh contains a one-sided "
                "(Moebius) strip of cells",
                cell_item(mesh.number(cell_of_side(code))),
                cell_item(mesh.number(cell_of_side(other))));
        }
    }
    fill(work.balance, 0.0);
    for (Index cell = 0; cell < mesh.n_cells; ++cell) {
        Index const root = agreement.root(cell);
        Real const area = cell_area(mesh.cell(cell), mesh.points);
        work.balance[root >> 1] += (root & 1) != 0 ? -area : area;
    }
    for (Index cell = 0; cell < mesh.n_cells; ++cell) {
        Index const root = agreement.root(cell);
        bool const against_root = (root & 1) != 0;
        reversed[cell] = (work.balance[root >> 1] < 0) != against_root ? 1 : 0;
    }
    inverted = mesh.find_cell([&](Index i, Cell const& cell) {
        return is_inverted({cell, mesh.points, reversed[i] != 0});
    });
    return Status::ok;
}

}  // namespace harmorph
