#include "work/gradient_file.hpp"

#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "files/csv_cells.hpp"

#include <cmath>
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
        // s = scale (cos a, sin a): the derivative of s by the angle is (0, 1) at a = 0.
        rows.push_back({"rigid",
                        mesh.name_of(condition),
                        {g[at], g[at + 1], g[at + 3] * pi / 180, g[at + 2]}});
    });
}

std::vector<Row> rows_of(const Gradient& gradient, const Basis& basis, const Mesh& mesh) {
    const std::vector<double>& g = gradient.by_functions;
    std::vector<Row> rows;
    const std::vector<double>& by = gradient.by_variables;
    if (!by.empty()) {
        for (std::size_t j = 0; j < by.size() / 2; ++j)
            rows.push_back({"variable", std::to_string(j + 1), {by[2 * j], by[2 * j + 1]}});
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
            object.add("dx", row.values[0]).add("dy", row.values[1]);
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

}  // namespace cli
