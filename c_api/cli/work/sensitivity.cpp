#include "work/sensitivity.hpp"

#include "basics/elementary.hpp"
#include "basics/failure.hpp"
#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "files/text_file.hpp"

#include <cmath>
#include <complex>
#include <map>
#include <ostream>

namespace cli {

namespace {

// One line of the output: a movable object and the derivatives with respect to its movement.
struct Row {
    std::string kind, name;  // kind: "point", "rigid", "mode", "variable"
    std::vector<double> values;
};

void add_bodies(std::vector<Row>& rows, const std::vector<double>& g, const Basis& basis,
                const Mesh& mesh) {
    for_each_body(basis.conditions(), basis.info().bodies, [&](const hm_condition& condition) {
        const auto at = static_cast<std::size_t>(2 * basis.n_control() + 4 * condition.body);
        // A body that has turned by s0 is moved by (s - 1) s0 with s = scale (cos a, sin a): the
        // derivatives by the angle and by the scale are i s0 and s0.
        const std::complex<double> s0 = basis.body_rotation(condition.body),
                                   by = std::complex<double>(g[at + 2], g[at + 3]) * std::conj(s0);
        rows.push_back({"rigid",
                        mesh.name_of(condition),
                        {g[at], g[at + 1], by.imag() * pi / 180, by.real()}});
    });
}

std::vector<Row> rows_of(const Gradient& gradient, const Basis& basis, const Mesh& mesh) {
    const std::vector<double>& g = gradient.by_functions;
    std::vector<Row> rows;
    const std::vector<double>& by = gradient.by_variables;
    if (!by.empty()) {
        for (std::size_t j = 0; j < by.size() / 2; ++j) {
            rows.push_back({"variable", std::to_string(j + 1), {by[2 * j]}});
            if (!gradient.variables_are_movements) rows.back().values.push_back(by[2 * j + 1]);
        }
    } else {
        for (std::size_t i = 0; i < static_cast<std::size_t>(basis.n_control()); ++i)
            rows.push_back({"point", std::to_string(i + 1), {g[2 * i], g[2 * i + 1]}});
    }
    add_bodies(rows, g, basis, mesh);
    const auto first = static_cast<std::size_t>(basis.functions() - basis.info().modes);
    for (std::size_t k = 0; k < static_cast<std::size_t>(basis.info().modes); ++k)
        rows.push_back(
            {"mode", std::to_string(k + 1), {g[2 * (first + k)], g[2 * (first + k) + 1]}});
    return rows;
}

void write_text(std::ostream& out, const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        if (row.kind == "rigid" || row.kind == "mode") out << row.kind << ' ';
        out << row.name;
        for (const double value : row.values) out << ' ' << exact(value);
        out << '\n';
    }
}

void write_csv(std::ostream& out, std::size_t objective, const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        out << objective << ',' << row.kind << ',' << csv_cell(row.name);
        for (std::size_t k = 0; k < 4; ++k)
            out << ',' << (k < row.values.size() ? exact(row.values[k]) : "");
        out << '\n';
    }
}

}  // namespace

JsonObject gradients_json(const std::vector<Gradient>& gradients, const Basis& basis,
                          const Mesh& mesh) {
    std::vector<JsonObject> objectives;
    for (const Gradient& gradient : gradients) {
        std::vector<JsonObject> rows;
        for (const Row& row : rows_of(gradient, basis, mesh)) {
            JsonObject object;
            object.add("kind", row.kind).add("name", row.name);
            object.add("dx", row.values[0]);
            if (row.values.size() > 1) object.add("dy", row.values[1]);
            if (row.values.size() == 4)
                object.add("ddegrees", row.values[2]).add("dscale", row.values[3]);
            rows.push_back(object);
        }
        objectives.push_back(JsonObject()
                                 .add("objective", gradient.objective)
                                 .add("points", static_cast<std::int64_t>(gradient.points))
                                 .add("admissible_descent", gradient.admissible_descent)
                                 .add("gradient", rows));
    }
    return JsonObject().add("objectives", objectives);
}

void write_gradients(std::ostream& out, const std::string& path,
                     const std::vector<Gradient>& gradients, const Basis& basis, const Mesh& mesh) {
    if (ends_with(path, ".json")) {
        out << gradients_json(gradients, basis, mesh).text() << '\n';
        return;
    }
    const bool is_csv = ends_with(path, ".csv");
    if (is_csv) out << "objective,kind,name,dx,dy,ddegrees,dscale\n";
    std::size_t number = 0;
    for (const Gradient& gradient : gradients) {
        const std::vector<Row> rows = rows_of(gradient, basis, mesh);
        ++number;
        if (is_csv) {
            write_csv(out, number, rows);
        } else {
            out << "# objective " << number << ": " << in_quotes(gradient.objective) << '\n';
            write_text(out, rows);
        }
    }
}

namespace {

double finite(const PointTable& table, std::size_t row, std::size_t column) {
    const double value = table.at(row, column);
    if (!std::isfinite(value)) {
        throw Failure(exit_file, table.place(row) + ": the file needs a finite number for " +
                                     in_quotes(table.names[column]));
    }
    return value;
}

// Returns for each boundary point the sum of the normals of both faces at the point. A normal
// points into the fluid and is half as long as the face.
Field boundary_normals(const Mesh& mesh) {
    Field normals(mesh.x.size());
    // For each face: whether the cell beside it is on the left.
    std::map<std::pair<std::int32_t, std::int32_t>, bool> runs_as_cell;
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

// Adds to the derivatives by each point of the mesh those by all coordinates of the file that move
// with this point, in both planes of a mesh that is one cell thick.
Sensitivity by_points_of_file(const PointTable& table, const SensitivityColumns& columns,
                              const Mesh& mesh) {
    if (!mesh.in_file.between.empty()) {
        throw Failure(exit_file, table.file->path() +
                                     ": sensitivities by the points of elements of "
                                     "second order are not read");
    }
    const bool has_ending = ends_with(columns.x, "x") || ends_with(columns.x, "X");
    std::string z = columns.x + (has_ending ? "" : "_z");
    if (has_ending) z.back() = static_cast<char>(z.back() + 2);
    std::size_t component[] = {table.column(columns.x), table.column(columns.y),
                               table.names.size()};
    const PointColumns at = table.point_columns();
    const bool has_places = at.has_places() && at.place[2] != PointColumns::none;
    constexpr double six_digits = 6e-6;  // of a coordinate: text has 6 digits or more
    const double noise = smallest_reach * extent_of(mesh);
    Sensitivity found{Field(mesh.x.size()), table.rows()};
    for (const CoordinateSlot& slot : mesh.in_file.slots) {
        if (slot.number < 0) continue;
        const auto row = static_cast<std::size_t>(slot.number / 3),
                   point = static_cast<std::size_t>(slot.point);
        const auto d = static_cast<std::size_t>(slot.number % 3);
        Direction along = {{slot.rule == takes_x ? 1.0 : 0.0, slot.rule == takes_y ? 1.0 : 0.0}};
        if (slot.rule >= 0) along = mesh.in_file.directions[static_cast<std::size_t>(slot.rule)];
        const double place = slot.rule == takes_x ? mesh.x[point] : mesh.y[point];
        if (has_places && slot.rule < 0 &&
            std::fabs(table.at(row, at.place[d]) - place) > six_digits * std::fabs(place) + noise) {
            throw Failure(exit_file, table.place(row) +
                                         ": the values are those of another mesh: coordinate " +
                                         std::string(1, "xyz"[d]) + " is " +
                                         brief(table.at(row, at.place[d])) +
                                         ", that of this mesh is " + brief(place));
        }
        if (component[d] == table.names.size()) component[d] = table.column(z);
        const double value = finite(table, row, component[d]);
        found.by.x[point] += along.along[0] * value;
        found.by.y[point] += along.along[1] * value;
    }
    return found;
}

}  // namespace

Sensitivity read_sensitivity(const std::string& path, const SensitivityColumns& columns,
                             const Mesh& mesh, bool in_order) {
    const PointTable table = read_point_table(path);
    if (columns.normal.empty() && has_points_of_file(table, mesh))
        return by_points_of_file(table, columns, mesh);
    const std::vector<std::int32_t> points = points_of(table, mesh, in_order, JoinedRows::taken);
    Sensitivity found{Field(mesh.x.size()), points.size()};
    if (columns.normal.empty()) {
        const std::size_t x = table.column(columns.x), y = table.column(columns.y);
        for (std::size_t row = 0; row < points.size(); ++row) {
            const auto point = static_cast<std::size_t>(points[row]);
            found.by.x[point] += finite(table, row, x);
            found.by.y[point] += finite(table, row, y);
        }
        return found;
    }
    const std::size_t normal = table.column(columns.normal);
    const Field normals = boundary_normals(mesh);
    for (std::size_t row = 0; row < points.size(); ++row) {
        const auto point = static_cast<std::size_t>(points[row]);
        const double nx = normals.x[point], ny = normals.y[point], length = length_of(nx, ny);
        double value = finite(table, row, normal);
        if (value == 0) continue;
        if (!(length > 0)) {
            throw Failure(exit_file, table.place(row) + ": point " + std::to_string(points[row]) +
                                         " is not on the boundary and has no normal");
        }
        if (!columns.into_fluid) value = -value;
        const double factor = columns.per_length ? value : value / length;
        found.by.x[point] += factor * nx;
        found.by.y[point] += factor * ny;
    }
    return found;
}

}  // namespace cli
