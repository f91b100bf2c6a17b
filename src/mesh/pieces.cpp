#include "mesh/pieces.hpp"

namespace harmorph {

void Pieces::lay_out(Arena& arena, Index n_cells, Index n_pieces, Index n_guards) noexcept {
    if (n_pieces == 0) return;
    arena.take(start, Offset{n_cells} + 1);
    arena.take(guard_start, Offset{n_cells} + 1);
    arena.take(point, 4 * (Offset{n_pieces} + n_guards));
    arena.take(kind, n_guards);
}

void Pieces::copy_from(Pieces const& other) const noexcept {
    copy(start, Span<const Index>(other.start));
    copy(guard_start, Span<const Index>(other.guard_start));
    copy(point, Span<const Index>(other.point));
    copy(kind, Span<const CornerKind>(other.kind));
}

void Pieces::copy_from(Pieces const& other, Mesh& mesh) const noexcept {
    if (!given()) return;
    copy_from(other);
    mesh.cell_points = point.data();
    mesh.piece_start = start.data();
    mesh.guard_start = guard_start.data();
    mesh.guard_kind = kind.data();
}

Mesh Pieces::mesh(Mesh const& polygons) const noexcept {
    Mesh mesh = polygons;
    mesh.layout = CellLayout::quads;
    mesh.n_given = polygons.n_cells;
    mesh.piece_start = start.data();
    mesh.guard_start = guard_start.data();
    mesh.cell_start = nullptr;
    mesh.cell_points = point.data();
    mesh.n_cells = n_pieces();
    mesh.n_guards = n_guards();
    mesh.guard_kind = kind.data();
    return mesh;
}

void Pieces::orient_guards(Span<std::uint8_t> reversed) const noexcept {
    for (Index i = 0; i + 1 < start.count(); ++i) {
        for (Index guard = guard_start[i]; guard < guard_start[i + 1]; ++guard)
            reversed[guard] = reversed[start[i]];
    }
}

}  // namespace harmorph
