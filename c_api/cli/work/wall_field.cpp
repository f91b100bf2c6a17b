#include "work/wall_field.hpp"

#include "basics/elementary.hpp"
#include "basics/failure.hpp"
#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "files/text_file.hpp"
#include "formats/deflate.hpp"
#include "formats/table_points.hpp"
#include "mesh/point_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace cli {

namespace {

// A point that two markers share may have two lines.
WallField read_lines(const TextFile& file, const Mesh& mesh) {
    LineReader lines(file, '#');
    const PointNumbers numbers(mesh);
    WallField field;
    while (lines.next()) {
        const auto& words = lines.words();
        std::int64_t number = 0;
        double d[2] = {0, 0};
        if (words.size() != 3) lines.expected("point dx dy");
        if (!parse(words[0], number)) lines.expected("the number of a point", words[0]);
        const std::int32_t point = numbers.point(number);
        if (point < 0) lines.fail(numbers.why_no_point(number));
        for (std::size_t i = 0; i < 2; ++i) {
            if (!parse(words[i + 1], d[i])) lines.expected("a finite number", words[i + 1]);
        }
        field.points.push_back(point);
        field.x.push_back(d[0]);
        field.y.push_back(d[1]);
    }
    return field;
}

std::vector<bool> given_points(const Mesh& mesh, const std::vector<hm_condition>& conditions) {
    std::vector<bool> is_given(mesh.x.size());
    for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
        const auto is_of = [&](const hm_condition& one) {
            return one.kind == HM_GIVEN && one.marker == mesh.face_markers[face];
        };
        if (std::none_of(conditions.begin(), conditions.end(), is_of)) continue;
        for (const std::size_t end : {2 * face, 2 * face + 1})
            is_given[place(mesh.face_points[end])] = true;
    }
    return is_given;
}

WallField take_rows(const PointTable& table, const Mesh& mesh,
                    const std::vector<hm_condition>& conditions, bool in_order) {
    const std::string x = table.has("dx") ? "dx" : "displacement_x",
                      y = table.has("dx") ? "dy" : "displacement_y";
    const std::size_t columns[2] = {table.column(x), table.column(y)};
    const std::vector<std::int32_t> points = points_of(table, mesh, in_order, JoinedRows::taken);
    std::vector<bool> is_given(mesh.x.size(), true);
    if (std::set<std::int32_t>(points.begin(), points.end()).size() == mesh.x.size())
        is_given = given_points(mesh, conditions);
    WallField field;
    for (std::size_t row = 0; row < points.size(); ++row) {
        if (!is_given[place(points[row])]) continue;
        for (const std::size_t column : columns) {
            if (std::isfinite(table.at(row, column))) continue;
            throw Failure(exit_file, table.place(row) + ": the file needs a finite number for " +
                                         in_quotes(table.names[column]));
        }
        field.points.push_back(points[row]);
        field.x.push_back(table.at(row, columns[0]));
        field.y.push_back(table.at(row, columns[1]));
    }
    return field;
}

// Points of the file at one place, which are one point of the mesh, move alike: the displacement of
// the first one stands for those that differ by rounding. The library refuses larger differences.
void join(WallField& field, const Mesh& mesh) {
    const double rounding = smallest_reach * extent_of(mesh);
    std::map<std::int32_t, std::size_t> first_of;
    for (std::size_t row = 0; row < field.points.size(); ++row) {
        const std::size_t first = first_of.emplace(field.points[row], row).first->second;
        if (length_of(field.x[row] - field.x[first], field.y[row] - field.y[first]) > rounding)
            continue;
        field.x[row] = field.x[first];
        field.y[row] = field.y[first];
    }
}

}  // namespace

WallField read_wall_field(const std::string& path, const Mesh& mesh,
                          const std::vector<hm_condition>& conditions, bool in_order) {
    const auto file = std::make_shared<const TextFile>(read_unpacked(path));
    WallField field = is_plain_table(*file)
                          ? read_lines(*file, mesh)
                          : take_rows(read_point_table(file), mesh, conditions, in_order);
    join(field, mesh);
    return field;
}

void FluxList::give_to(hm_problem& problem) const {
    problem.n_fluxes = static_cast<std::int32_t>(points.size() / 2);
    problem.flux_points = points.data();
    problem.fluxes = values.data();
}

FluxList read_fluxes(const std::string& path, const Mesh& mesh, std::int32_t n_control) {
    const TextFile file(path);
    LineReader lines(file, '#');
    FluxList list;
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> face_of;
    std::set<std::pair<std::size_t, std::int32_t>> named;
    const PointNumbers numbers(mesh);
    while (lines.next()) {
        const auto& words = lines.words();
        if (words.size() != 4) lines.expected("point point control-point value");
        std::int32_t ends[2] = {0, 0}, control = 0;
        for (const std::size_t i : {0, 1}) {
            std::int64_t number = 0;
            ends[i] = parse(words[i], number) ? numbers.point(number) : -1;
            if (ends[i] < 0)
                lines.expected("a point between 0 and " + std::to_string(numbers.count() - 1),
                               words[i]);
        }
        if (!parse(words[2], control) || control < 1 || control > n_control) {
            lines.expected("a control point between 1 and " + std::to_string(n_control), words[2]);
        }
        double value = 0;
        if (!parse(words[3], value)) lines.expected("a finite number", words[3]);
        const auto [found, is_new] =
            face_of.emplace(std::minmax(ends[0], ends[1]), list.points.size() / 2);
        if (is_new) {
            list.points.insert(list.points.end(), {ends[0], ends[1]});
            list.values.resize(list.values.size() + place(n_control));
        }
        if (!named.emplace(found->second, control).second)
            lines.fail("the flux of this control point through this face is given twice");
        list.values[found->second * place(n_control) + place(control - 1)] = value;
    }
    return list;
}

}  // namespace cli
