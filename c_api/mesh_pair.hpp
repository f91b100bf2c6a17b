// Opens a basis and a mesh for the calls that judge meshes.
#pragma once

#include "handles.hpp"

namespace harmorph {

// Opens a basis and a mesh. They must belong together, as far as counts, layout and a sample of the
// cells tell.
inline Status open_pair(const hm_basis* handle, const hm_mesh* given, Basis& basis, Mesh& mesh,
                        OrientedMesh& cells, CallFault& fault) noexcept {
    HARMORPH_TRY(open_basis(handle, basis, fault));
    HARMORPH_TRY(view_mesh(given, mesh, fault));
    HARMORPH_TRY(check_layout(mesh, fault));
    if (basis.header->counts.cells == 0) {
        return fault.refuse(Status::bad_basis,
                            "the basis was made for a list of points, so it has no cells and "
                            "cannot be used with a mesh");
    }
    if (mesh.layout == CellLayout::polygons && !basis.pieces.given()) {
        return fault.refuse(Status::bad_basis,
                            "the basis belongs to another mesh, because it has no polygons");
    }
    cells = basis.cells(mesh);
    if (mesh.n_points != basis.n_points() || mesh.n_cells != basis.header->counts.cells) {
        return fault.refuse(Status::bad_basis,
                            "the basis belongs to another mesh, which has # points and @ cells",
                            plain(basis.n_points()), plain(basis.header->counts.cells));
    }
    if (sample_of(mesh) == basis.header->topology.sample) return Status::ok;
    return fault.refuse(Status::bad_basis,
                        "the basis belongs to another mesh, because the cells differ");
}

// Views the given coordinates of the mesh points, or the mesh's own if given is NULL.
inline Status view_coordinates(const hm_points* given, const char* name, Mesh const& mesh,
                               Points& points, Fault& fault) noexcept {
    hm_points const own = {mesh.points.x, mesh.points.y, mesh.points.stride};
    return given != nullptr ? view_points(given, name, points, fault)
                            : view_points(&own, "mesh.points", points, fault);
}

}  // namespace harmorph
