#include "mesh/sensitivity.hpp"

#include "basics/failure.hpp"

#include <cmath>
#include <map>

namespace cli {

namespace {

double finite(const PointTable& table, std::size_t row, std::size_t column) {
    const double value = table.at(row, column);
    if (!std::isfinite(value)) {
        throw Failure(exit_file, table.place(row) + ": the file needs a finite number for " +
                                     in_quotes(table.names[column]));
    }
    return value;
}

// At each boundary point: the sum of the normals of the faces beside it, half the length of the
// face each, into the fluid.
Field boundary_normals(const Mesh& mesh) {
    Field normals(mesh.x.size());
    std::map<std::pair<std::int32_t, std::int32_t>, bool> runs_as_cell;  // faces; found below
    for (std::int32_t face = 0; face < mesh.faces(); ++face) {
        const std::int32_t* ends = &mesh.face_points[2 * static_cast<std::size_t>(face)];
        runs_as_cell[{ends[0], ends[1]}] = false;
    }
    const auto x = [&](std::int32_t p) { return mesh.x[static_cast<std::size_t>(p)]; };
    const auto y = [&](std::int32_t p) { return mesh.y[static_cast<std::size_t>(p)]; };
    for (std::int32_t cell = 0; cell < mesh.cells(); ++cell) {
        const auto begin =
            static_cast<std::size_t>(mesh.cell_start[static_cast<std::size_t>(cell)]);
        const auto end =
            static_cast<std::size_t>(mesh.cell_start[static_cast<std::size_t>(cell) + 1]);
        double area = 0;
        for (std::size_t k = begin; k < end; ++k) {
            const std::int32_t a = mesh.cell_points[k],
                               b = mesh.cell_points[k + 1 < end ? k + 1 : begin],
                               o = mesh.cell_points[begin];
            area += (x(a) - x(o)) * (y(b) - y(o)) - (x(b) - x(o)) * (y(a) - y(o));
        }
        for (std::size_t k = begin; k < end; ++k) {
            std::int32_t a = mesh.cell_points[k], b = mesh.cell_points[k + 1 < end ? k + 1 : begin];
            if (area < 0) std::swap(a, b);
            const auto found = runs_as_cell.find({a, b});
            if (found != runs_as_cell.end()) found->second = true;
        }
    }
    for (const auto& [ends, is_left] : runs_as_cell) {
        const double sign = is_left ? 0.5 : -0.5;  // the fluid is on the left of the face
        const double nx = -sign * (y(ends.second) - y(ends.first)),
                     ny = sign * (x(ends.second) - x(ends.first));
        for (const std::int32_t point : {ends.first, ends.second}) {
            normals.x[static_cast<std::size_t>(point)] += nx;
            normals.y[static_cast<std::size_t>(point)] += ny;
        }
    }
    return normals;
}

}  // namespace

Sensitivity read_sensitivity(const std::string& path, const SensitivityColumns& columns,
                             const Mesh& mesh) {
    const PointTable table = read_point_table(path);
    const std::vector<std::int32_t> points = points_of(table, mesh);
    Sensitivity found{Field(mesh.x.size()), points.size()};
    if (columns.normal.empty()) {
        const std::size_t x = table.column(columns.x), y = table.column(columns.y);
        for (std::size_t row = 0; row < points.size(); ++row) {
            const auto point = static_cast<std::size_t>(points[row]);
            found.by.x[point] = finite(table, row, x);
            found.by.y[point] = finite(table, row, y);
        }
        return found;
    }
    const std::size_t normal = table.column(columns.normal);
    const Field normals = boundary_normals(mesh);
    for (std::size_t row = 0; row < points.size(); ++row) {
        const auto point = static_cast<std::size_t>(points[row]);
        const double nx = normals.x[point], ny = normals.y[point], length = std::hypot(nx, ny);
        double value = finite(table, row, normal);
        if (value == 0) continue;
        if (!(length > 0)) {
            throw Failure(exit_file, table.place(row) + ": point " + std::to_string(points[row]) +
                                         " is not on the boundary and has no normal");
        }
        if (!columns.into_fluid) value = -value;
        const double factor = columns.per_length ? value : value / length;
        found.by.x[point] = factor * nx;
        found.by.y[point] = factor * ny;
    }
    return found;
}

}  // namespace cli
