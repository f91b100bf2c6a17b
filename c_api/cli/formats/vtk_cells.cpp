#include "formats/vtk_cells.hpp"

#include "basics/geometry.hpp"
#include "basics/numbers.hpp"

#include <algorithm>
#include <utility>

namespace cli {

namespace {

struct VtkShape {
    int type;
    ElementShape shape;
};
constexpr VtkShape vtk_shapes[] = {
    {vtk_line, {1, 2}},
    {vtk_triangle, {2, 3}},
    {vtk_pixel, {2, 4}},
    {vtk_quad, {2, 4}},
    {vtk_tetrahedron, {3, 4}},
    {vtk_voxel, {3, 8}},
    {vtk_hexahedron, {3, 8}},
    {vtk_wedge, {3, 6}},
    {vtk_pyramid, {3, 5}},
    {21, {1, 2, "01"}},                                   // QUADRATIC_EDGE
    {22, {2, 3, "01 12 20"}},                             // QUADRATIC_TRIANGLE
    {34, {2, 3, "01 12 20 012"}},                         // BIQUADRATIC_TRIANGLE
    {23, {2, 4, "01 12 23 30"}},                          // QUADRATIC_QUAD
    {28, {2, 4, "01 12 23 30 0123"}},                     // BIQUADRATIC_QUAD
    {30, {2, 4, "01 23"}},                                // QUADRATIC_LINEAR_QUAD
    {24, {3, 4, "01 12 20 03 13 23"}},                    // QUADRATIC_TETRA
    {25, {3, 8, "01 12 23 30 45 56 67 74 04 15 26 37"}},  // _HEXAHEDRON
    {33, {3, 8, "01 12 23 30 45 56 67 74 04 15 26 37 0473 1265 0154 2376"}},  // BIQUADRATIC_...
    {29,
     {3, 8,
      "01 12 23 30 45 56 67 74 04 15 26 37 0473 1265 0154 2376 0321 4567 "
      "01234567"}},                                             // TRIQUADRATIC_HEXAHEDRON
    {31, {3, 6, "01 12 20 34 45 53"}},                          // QUADRATIC_LINEAR_WEDGE
    {26, {3, 6, "01 12 20 34 45 53 03 14 25"}},                 // QUADRATIC_WEDGE
    {32, {3, 6, "01 12 20 34 45 53 03 14 25 0143 1254 2035"}},  // BIQUADRATIC_..._WEDGE
    // LAGRANGE_CURVE, _TRIANGLE and _QUADRILATERAL of first and second order, as dolfinx and
    // Firedrake write them. Their nodes have the places of the quadratic cells above.
    {68, {1, 2}},
    {68, {1, 2, "01"}},
    {69, {2, 3}},
    {69, {2, 3, "01 12 20"}},
    {69, {2, 3, "01 12 20 012"}},
    {70, {2, 4}},
    {70, {2, 4, "01 12 23 30"}},
    {70, {2, 4, "01 12 23 30 0123"}},
    {27, {3, 5, "01 12 23 30 04 14 24 34"}},                            // QUADRATIC_PYRAMID
    {37, {3, 5, "01 12 23 30 04 14 24 34 0321 014 124 234 304 01234"}}  // TRIQUADRATIC_PYRAMID
};
constexpr std::int64_t vertex = 1, several_vertices = 2,
                       several_lines = 4;  // these are no part of the mesh

bool is_passed_over(std::int64_t type) {
    return type == vertex || type == several_vertices || type == several_lines;
}

// Returns the shape of a cell; the dimension is 0 if the cell is no element of a mesh.
ElementShape shape_of(std::int64_t type, std::int64_t n) {
    if (type == vtk_polygon && n >= 3) return {2, static_cast<int>(n)};
    for (const VtkShape& known : vtk_shapes) {
        if (known.type == type && known.shape.nodes == n) return known.shape;
    }
    return {0, 0};
}

// Pixels and voxels list their corners line by line, and not round their faces.
std::int64_t place_in_cell(std::int64_t type, std::int64_t k) {
    const bool by_lines = type == vtk_pixel || type == vtk_voxel;
    return by_lines && k % 4 >= 2 ? k / 4 * 4 + 5 - k % 4 : k;
}

}  // namespace

void add_vtk_cells(const TextFile& file, const VtkCells& cells, std::int32_t first_point,
                   Elements& elements) {
    const auto total = static_cast<std::int64_t>(cells.points.size());
    const std::int64_t n_points = elements.points.points() - first_point;
    for (std::size_t i = 0; i < cells.types.size(); ++i) {
        const std::int64_t type = cells.types[i], begin = cells.starts[i],
                           end = cells.starts[i + 1];
        if (begin < 0 || end <= begin || end > total || end - begin > INT32_MAX) {
            file.fail(cells.starts_offset,
                      "the offsets of cell " + std::to_string(i) + " are out of range");
        }
        const std::int64_t n = end - begin;
        const std::size_t offset = cells.offsets[static_cast<std::size_t>(begin)];
        if (is_passed_over(type)) continue;
        const ElementShape shape = shape_of(type, n);
        if (shape.dimension == 0) {
            file.fail(offset,
                      "cell " + std::to_string(i) + " is of type " + std::to_string(type) +
                          " with " + plural(n, "point") +
                          ", which is not read: save polygons, or triangles, quadrilaterals, "
                          "wedges and hexahedra of first or second order (Lagrange triangles and "
                          "quadrilaterals, too)");
        }
        elements.add(shape, -1, offset);
        for (std::int64_t k = 0; k < n; ++k) {
            const std::int64_t point =
                cells.points[static_cast<std::size_t>(begin + place_in_cell(type, k))];
            if (point < 0 || point >= n_points) {
                const std::string last = std::to_string(n_points - 1),
                                  found = std::to_string(point);
                file.fail(offset, "the file needs points between 0 and " + last + " here, but " +
                                      found + " follows");
            }
            elements.nodes.push_back(first_point + static_cast<std::int32_t>(point));
        }
    }
}

bool has_vtk_size(const std::int64_t (&size)[3], std::int64_t n_points) {
    for (const std::int64_t n : size) {
        if (n < 1 || n > n_points) return false;
    }
    const std::int64_t plane = size[0] * size[1];
    return plane <= n_points / size[2] && plane * size[2] == n_points;
}

bool add_vtk_blocks(const std::int64_t (&size)[3], std::int32_t first_point, Elements& elements) {
    const std::int64_t step[3] = {1, size[0], size[0] * size[1]};
    std::int64_t along[3] = {0, 0, 0};  // the steps of the directions with several points
    std::size_t n = 0;
    for (std::size_t d = 0; d < 3; ++d) {
        if (size[d] > 1) along[n++] = step[d];
    }
    if (n < 2) return false;
    const std::int64_t face[4] = {0, along[0], along[0] + along[1], along[1]};
    const auto cells = [&](std::size_t d) { return std::max<std::int64_t>(size[d] - 1, 1); };
    for (std::int64_t k = 0; k < cells(2); ++k) {
        for (std::int64_t j = 0; j < cells(1); ++j) {
            for (std::int64_t i = 0; i < cells(0); ++i) {
                const std::int64_t first = first_point + i + j * step[1] + k * step[2];
                elements.add(n == 3 ? ElementShape{3, 8} : ElementShape{2, 4}, -1,
                             elements.points.offset[0][static_cast<std::size_t>(first)]);
                for (std::size_t corner = 0; corner < (n == 3 ? 8 : 4); ++corner) {
                    elements.nodes.push_back(static_cast<std::int32_t>(
                        first + face[corner % 4] + (corner < 4 ? 0 : along[2])));
                }
            }
        }
    }
    return true;
}

}  // namespace cli
