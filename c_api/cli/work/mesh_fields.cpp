#include "work/mesh_fields.hpp"

#include "basics/library.hpp"
#include "basics/numbers.hpp"
#include "files/text_file.hpp"
#include "formats/table_points.hpp"
#include "formats/vtu.hpp"
#include "mesh/mesh_analysis.hpp"
#include "mesh/point_numbers.hpp"

#include <cmath>
#include <utility>

namespace cli {

std::vector<Column> read_fields(const std::string& path, const std::vector<std::string>& names,
                                const Mesh& mesh, bool in_order) {
    const PointTable table = read_point_table(path);
    const std::vector<std::int32_t> points = points_of(table, mesh, in_order);
    if (points.size() != mesh.x.size()) {
        throw Failure(exit_file,
                      path + " has " + plural(static_cast<std::int64_t>(points.size()), "row") +
                          ", but " + mesh.file.path() + " has " + plural(mesh.points(), "point"));
    }
    std::vector<Column> fields;
    std::vector<std::pair<std::string, std::size_t>> columns;
    for (const std::string& name : names) columns.emplace_back(name, table.column(name));
    for (std::size_t k = 0; names.empty() && k < table.names.size(); ++k)
        if (!says_where(table.names, k)) columns.emplace_back(table.names[k], k);
    for (const auto& [name, column] : columns) {
        Column field = {name, std::vector<double>(points.size())};
        for (std::size_t row = 0; row < points.size(); ++row) {
            const double value = table.at(row, column);
            if (!std::isfinite(value)) {
                throw Failure(
                    exit_file,
                    table.place(row) + ": the file needs a finite number for " + in_quotes(name));
            }
            field.values[static_cast<std::size_t>(points[row])] = value;
        }
        fields.push_back(std::move(field));
    }
    if (fields.empty()) {
        throw Failure(exit_file, path + " has no fields, only numbers and coordinates of points");
    }
    return fields;
}

void write_csv(std::ostream& out, const Mesh& mesh, const std::vector<Column>& columns) {
    out << "point,x,y";
    for (const Column& column : columns) out << ',' << csv_cell(column.name);
    out << '\n';
    const PointNumbers numbers(mesh);
    for (std::size_t point = 0; point < mesh.x.size(); ++point) {
        out << numbers.number(static_cast<std::int32_t>(point)) << ',' << exact(mesh.x[point])
            << ',' << exact(mesh.y[point]);
        for (const Column& column : columns) out << ',' << exact(column.values[point]);
        out << '\n';
    }
}

void write_fields(OutputFiles& files, const std::string& path, const Mesh& mesh,
                  const std::vector<Column>& fields) {
    std::ostream& out = files.add(path);
    if (!ends_with(path, ".vtu")) {
        write_csv(out, mesh, fields);
        return;
    }
    std::vector<PointData> data;
    for (const Column& field : fields) data.push_back({field.name, 1, field.values});
    write_vtu(out, mesh, mesh.x, mesh.y, data);
}

Interpolated interpolated(const Mesh& from, const Field& at, const std::vector<Column>& fields,
                          const Mesh& to, const Threads& threads) {
    const MeshAnalysis analysis(from);
    const hm_points places = {to.x.data(), to.y.data(), 1}, moved = at.read();
    Interpolated found = {{}, sized<hm_interpolation_report>()};
    Block block;
    hm_interpolation* interpolation = nullptr;
    with_memory(block, [&](hm_memory* memory) {
        return call(from, hm_interpolation_init, &interpolation, memory, analysis.get(), &moved,
                    to.points(), &places, nullptr, threads.executor(), &found.report);
    });
    for (const Column& field : fields) {
        found.fields.push_back({field.name, std::vector<double>(to.x.size())});
        call(from, hm_interpolate, interpolation, 1, field.values.data(),
             found.fields.back().values.data(), threads.executor());
    }
    return found;
}

void judge_outside(const Arguments& arguments, const Interpolated& found, const std::string& from,
                   const std::string& to) {
    const hm_interpolation_report& report = found.report;
    if (report.outside == 0) return;
    const std::string text = to + ": " + plural(report.outside, "point") + " outside " + from +
                             ", by " + brief(report.max_distance) + " at most (point " +
                             std::to_string(report.max_distance_point) + ")";
    if (arguments.has("--max-outside") &&
        report.max_distance > arguments.positive("--max-outside", 0))
        throw Failure(exit_unusable, text);
    warn(text);
}

}  // namespace cli
