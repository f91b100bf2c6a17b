// Cells as VTK's files of both kinds have them.
#pragma once

#include "mesh/mesh_file.hpp"

namespace cli {

enum VtkCellType {
    vtk_vertex = 1,
    vtk_poly_vertex,
    vtk_line,
    vtk_poly_line,
    vtk_triangle,
    vtk_strip,
    vtk_polygon,
    vtk_pixel,
    vtk_quad,
    vtk_tetrahedron,
    vtk_last_solid = 14
};

// Of a triangle, a quadrilateral or a polygon.
inline int vtk_type(const Mesh& mesh, std::size_t cell) {
    const std::int32_t n = mesh.cell_start[cell + 1] - mesh.cell_start[cell];
    return n == 3 ? vtk_triangle : n == 4 ? vtk_quad : vtk_polygon;
}

struct VtkCells {
    std::vector<std::int64_t> starts;  // cells + 1 places in `points`
    std::vector<std::int64_t> points, types;
    std::vector<std::size_t> offsets;  // in the file, of each of `points`
    std::size_t starts_offset = 0;     // in the file, of the first of `starts`
};

// Adds triangles, quadrilaterals and polygons to a mesh that has its points, passes over vertices
// and lines, and refuses other cells. VTK knows no boundaries: each loop of boundary edges is a
// marker, boundary1, boundary2, ... by the least point in it.
void add_vtk_cells(Mesh& mesh, const VtkCells& cells);

}  // namespace cli
