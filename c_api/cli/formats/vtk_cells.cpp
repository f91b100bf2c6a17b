#include "formats/vtk_cells.hpp"

#include "formats/tidy.hpp"
#include "basics/numbers.hpp"

namespace cli {

void add_vtk_cells(Mesh& mesh, const VtkCells& cells) {
    const auto total = static_cast<std::int64_t>(cells.points.size());
    std::vector<std::int32_t> cell;
    for (std::size_t i = 0; i < cells.types.size(); ++i) {
        const std::int64_t type = cells.types[i], begin = cells.starts[i],
                           end = cells.starts[i + 1];
        if (begin < 0 || end <= begin || end > total) {
            mesh.file.fail(cells.starts_offset,
                           "the offsets of cell " + std::to_string(i) + " are out of range");
        }
        const std::int64_t n = end - begin;
        const std::size_t offset = cells.offsets[static_cast<std::size_t>(begin)];
        if (type >= vtk_vertex && type <= vtk_poly_line) continue;  // no part of the mesh
        const bool is_read = (type == vtk_triangle && n == 3) ||
                             ((type == vtk_quad || type == vtk_pixel) && n == 4) ||
                             (type == vtk_polygon && n >= 3);
        if (!is_read) {
            const bool is_solid = type >= vtk_tetrahedron && type <= vtk_last_solid;
            mesh.file.fail(offset, "cell " + std::to_string(i) + " is of type " +
                                       std::to_string(type) + " with " + plural(n, "point") +
                                       ": triangles, quadrilaterals and polygons are read" +
                                       (is_solid ? "; the mesh has three dimensions" : ""));
        }
        cell.clear();
        for (std::int64_t k = 0; k < n; ++k) {
            const bool is_second_line = type == vtk_pixel && k >= 2;  // a pixel goes line by line
            const std::int64_t at = is_second_line ? begin + 5 - k : begin + k;
            const std::int64_t point = cells.points[static_cast<std::size_t>(at)];
            if (point < 0 || point >= mesh.points()) {
                const std::string last = std::to_string(mesh.points() - 1),
                                  found = std::to_string(point);
                mesh.file.fail(offset,
                               "expected points between 0 and " + last + ", found " + found);
            }
            cell.push_back(static_cast<std::int32_t>(point));
        }
        mesh.add_cell(cell, offset);
    }
    mesh.find_polygons();
    name_open_boundary(mesh, "boundary");
}

}  // namespace cli
