// Cells as legacy and XML files of VTK list them.
#pragma once

#include "formats/element_mesh.hpp"

namespace cli {

enum VtkCellType {
    vtk_line = 3,
    vtk_triangle = 5,
    vtk_polygon = 7,
    vtk_pixel,
    vtk_quad,
    vtk_tetrahedron,
    vtk_voxel,
    vtk_hexahedron,
    vtk_wedge,
    vtk_pyramid
};

// Returns the type of a triangle, a quadrilateral or a polygon.
inline int vtk_type(const Mesh& mesh, std::size_t cell) {
    const std::int32_t n = mesh.cell_start[cell + 1] - mesh.cell_start[cell];
    return n == 3 ? vtk_triangle : n == 4 ? vtk_quad : vtk_polygon;
}

struct VtkCells {
    std::vector<std::int64_t> starts;  // [cells + 1] places in `points`
    std::vector<std::int64_t> points, types;
    std::vector<std::size_t> offsets;  // the place in the file of each of `points`
    std::size_t starts_offset = 0;     // the place in the file of the first of `starts`
};

// Adds cells of points first_point, first_point + 1, ... of `elements`. Vertices and lines of
// several segments are ignored, and other types of cells are refused. VTK has no names for
// boundaries.
void add_vtk_cells(const TextFile& file, const VtkCells& cells, std::int32_t first_point,
                   Elements& elements);

// Tells whether a structured grid with so many points along i, j and k has n_points points.
bool has_vtk_size(const std::int64_t (&size)[3], std::int64_t n_points);

// Adds the cells of a structured grid of points first_point, first_point + 1, ... of `elements`:
// quadrilaterals, or hexahedra if every direction has several points. Returns false if the grid has
// no cells, as two directions have one point.
bool add_vtk_blocks(const std::int64_t (&size)[3], std::int32_t first_point, Elements& elements);

}  // namespace cli
