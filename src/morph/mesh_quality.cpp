#include "morph/mesh_quality.hpp"

namespace harmorph {

void MeshQuality::lay_out(Arena& arena, Basis const& basis, Mesh const& mesh) noexcept {
    Size const n_faces = static_cast<Size>(basis.faces().count());
    arena.take(xy, 2 * static_cast<Size>(mesh.n_points));
    arena.take(edge, WallPoints::max_count(mesh.n_points, n_faces));
    auto const mark = arena.mark();
    layer_.lay_out(arena, mesh, n_faces);
    arena.take(wall_face_, n_faces);
    arena.take(representative_, mesh.n_points);
    arena.take(is_wall_, mesh.n_points);
    arena.release(mark);
}

void MeshQuality::find(Basis const& basis, OrientedMesh const& mesh, Points at) noexcept {
    cells = mesh;
    Index const n_points = cells.mesh.n_points;
    for (Index k = 0; k < n_points; ++k) {
        xy[k] = at[k].x;
        xy[n_points + k] = at[k].y;
        representative_[k] = k;
    }
    fill(is_wall_, std::uint8_t{0});
    for (Index const point : basis.wall_point) is_wall_[point] = 1;
    for (Index k = 0; k < basis.joined_point.count(); ++k) {
        is_wall_[basis.joined_point[k]] = 1;
        representative_[basis.joined_point[k]] = basis.wall_point[basis.joined_slot[k]];
    }
    Index n_walls = 0;
    BoundaryFaces const faces = basis.faces();
    for (Index face = 0; face < faces.count(); ++face) {
        Index const from = faces.begin_of(face), to = faces.end_of(face);
        if (is_wall_[from] != 0 && is_wall_[to] != 0)
            wall_face_[n_walls++] = {{representative_[from], representative_[to]}};
    }
    layer_.find(cells.mesh, start(), representative_, wall_face_.first(n_walls));
    n_edges = 0;
    WallPoints const& wall = layer_.wall;
    for (Index slot = 0; slot < wall.count; ++slot) {
        if (layer_.above[slot] == none) continue;
        edge[n_edges++] = {wall.point[slot], layer_.above[slot], wall.previous[slot],
                           wall.next[slot]};
    }
}

}  // namespace harmorph
