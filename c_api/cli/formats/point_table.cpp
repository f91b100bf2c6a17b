#include "formats/point_table.hpp"

#include "basics/failure.hpp"
#include "basics/numbers.hpp"
#include "files/csv_cells.hpp"
#include "formats/bytes.hpp"
#include "formats/cgns.hpp"
#include "formats/cgns_fields.hpp"
#include "formats/deflate.hpp"
#include "formats/point_fields.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

// ---- SU2's restart files: five integers, names of 33 characters, numbers point by point

constexpr std::int32_t restart_magic = 535532;
constexpr std::size_t restart_header = 5 * sizeof(std::int32_t), restart_name = 33;

bool is_restart(std::string_view text) {
    return text.size() >= restart_header &&
           load<std::int32_t>(text.data(), !little_endian_machine()) == restart_magic;
}

PointTable read_restart(const std::shared_ptr<const TextFile>& file) {
    const std::string_view text = file->text();
    const auto number = [&](std::size_t at) {
        return load<std::int32_t>(text.data() + at * sizeof(std::int32_t),
                                  !little_endian_machine());
    };
    PointTable table;
    table.file = file;
    const std::int64_t columns = number(1), rows = number(2);
    const auto size = static_cast<std::int64_t>(text.size());
    const std::int64_t names = columns * static_cast<std::int64_t>(restart_name);
    const std::int64_t left = size - static_cast<std::int64_t>(restart_header) - names;
    if (columns < 1 || rows < 1 || rows > left / 8 / columns) {
        throw Failure(exit_file, file->path() + ": this SU2 restart file announces " +
                                     std::to_string(rows) + " points with " +
                                     std::to_string(columns) + " numbers each, but is shorter");
    }
    for (std::int64_t k = 0; k < columns; ++k) {
        const char* const name =
            text.data() + restart_header + static_cast<std::size_t>(k) * restart_name;
        table.names.emplace_back(name, std::find(name, name + restart_name, '\0'));
    }
    const char* at = text.data() + restart_header + static_cast<std::size_t>(names);
    table.values.reserve(static_cast<std::size_t>(rows * columns));
    for (std::int64_t i = 0; i < rows * columns; ++i, at += 8)
        table.values.push_back(load<double>(at, !little_endian_machine()));
    return table;
}

// ---- Text

PointTable read_csv(const std::shared_ptr<const TextFile>& file) {
    PointTable table;
    table.file = file;
    CsvReader records(*file);
    if (records.next()) table.names = records.cells();
    while (records.next()) {
        const std::vector<std::string>& cells = records.cells();
        if (cells.size() != table.names.size()) {
            records.fail("the file needs " +
                         plural(static_cast<std::int64_t>(table.names.size()), "column") +
                         " as in the first line here, but " +
                         plural(static_cast<std::int64_t>(cells.size()), "column") + " follow");
        }
        for (std::size_t k = 0; k < cells.size(); ++k) {
            double value = 0;
            if (!parse(trimmed(cells[k]), value)) {
                records.fail("the file needs a finite number for " + in_quotes(table.names[k]) +
                             " here, but " + in_quotes(cells[k]) + " follows");
            }
            table.values.push_back(value);
        }
        table.offsets.push_back(records.offset());
    }
    return table;
}

PointTable read_plain(const std::shared_ptr<const TextFile>& file) {
    PointTable table;
    table.file = file;
    table.names = {"point", "Sensitivity_x", "Sensitivity_y"};
    LineReader lines(*file, '#');
    while (lines.next()) {
        if (lines.words().size() != 3) lines.expected("point dJ/dx dJ/dy");
        for (std::size_t k = 0; k < 3; ++k) {
            const std::string_view word = lines.words()[k];
            double value = 0;
            if (!parse(word, value))
                lines.expected("a finite number for " + in_quotes(table.names[k]), word);
            table.values.push_back(value);
        }
        table.offsets.push_back(lines.offset());
    }
    return table;
}

// ---- Rows and mesh points

// Points in the order of x, to find the nearest one.
class PointFinder {
public:
    explicit PointFinder(const Mesh& mesh) : mesh_(mesh) {
        for (std::int32_t point = 0; point < mesh.points(); ++point) order_.push_back(point);
        std::sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) {
            return x(a) != x(b) ? x(a) < x(b) : a < b;
        });
    }
    // Returns the point nearest to a place, or -1 if no point is within `reach`.
    std::int32_t nearest(double at_x, double at_y, double reach) const {
        auto next = std::lower_bound(order_.begin(), order_.end(), at_x - reach,
                                     [&](std::int32_t p, double value) { return x(p) < value; });
        std::int32_t best = -1;
        double min_distance = reach;
        for (; next != order_.end() && x(*next) <= at_x + reach; ++next) {
            const double distance = std::hypot(x(*next) - at_x, y(*next) - at_y);
            if (distance > min_distance) continue;
            min_distance = distance;
            best = *next;
        }
        return best;
    }

private:
    double x(std::int32_t p) const { return mesh_.x[static_cast<std::size_t>(p)]; }
    double y(std::int32_t p) const { return mesh_.y[static_cast<std::size_t>(p)]; }

    const Mesh& mesh_;
    std::vector<std::int32_t> order_;
};

std::string place_text(double x, double y) { return "(" + brief(x) + ", " + brief(y) + ")"; }

std::int32_t by_number(const PointTable& table, std::size_t row, std::size_t column,
                       const Mesh& mesh) {
    const double number = table.at(row, column);
    if (number != std::floor(number) || number < 0 || number >= mesh.points()) {
        throw Failure(exit_file, table.place(row) + ": the mesh has points 0 to " +
                                     std::to_string(mesh.points() - 1) + ", and no point " +
                                     brief(number));
    }
    return static_cast<std::int32_t>(number);
}

[[noreturn]] void refuse_place(const PointTable& table, std::size_t row, const Mesh& mesh,
                               const PointColumns& columns, std::int32_t point) {
    std::string where = "this mesh has no point at ";
    std::string remedy;
    if (point >= 0) {
        const auto k = static_cast<std::size_t>(point);
        where = "point " + std::to_string(point) + " of this mesh is at " +
                place_text(mesh.x[k], mesh.y[k]) + ", not at ";
        if (columns.has_numbers()) {
            remedy = "; if the numbers " + in_quotes(table.names[columns.number]) +
                     " are not those of this mesh, take the column away: rows are then found by "
                     "their coordinates";
        }
    }
    throw Failure(exit_file,
                  table.place(row) + ": the values are those of another mesh: " + where +
                      place_text(table.at(row, columns.place[0]), table.at(row, columns.place[1])) +
                      remedy);
}

// Refuses rows that nothing assigns to points, unless their order does.
void check_order(const PointTable& table, const Mesh& mesh, bool in_order) {
    if (!in_order && !table.has_file_points) {
        throw Failure(exit_file,
                      table.file->path() +
                          ": no columns have the numbers of points (such as PointID) or their "
                          "coordinates (such as x and y); the columns are " +
                          table.name_list() +
                          ". Name such columns so, or give --in-order if the rows are all points "
                          "of the mesh in the order of its file");
    }
    if (table.rows() != mesh.x.size()) {
        throw Failure(exit_file,
                      table.file->path() + ": " +
                          plural(static_cast<std::int64_t>(table.rows()), "row") +
                          " without numbers and coordinates of points, but the mesh has " +
                          plural(mesh.points(), "point"));
    }
}

}  // namespace

double reach_of(const Mesh& mesh) {
    if (mesh.x.empty()) return 0;
    const auto x = std::minmax_element(mesh.x.begin(), mesh.x.end());
    const auto y = std::minmax_element(mesh.y.begin(), mesh.y.end());
    return 2e-6 * std::max(*x.second - *x.first, *y.second - *y.first);
}

std::size_t PointTable::find(const std::string& name) const {
    auto found = std::find(names.begin(), names.end(), name);
    const std::size_t end = name.size() - std::min<std::size_t>(name.size(), 2);
    for (const char* component : {"_xX0", "_yY1", "_zZ2"}) {
        if (name.compare(end, 2, component, 2) != 0) continue;
        const std::string stem = name.substr(0, end);
        for (const std::string& other :
             {stem + component[2], stem + ':' + component[3], stem + '_' + component[3]})
            if (found == names.end()) found = std::find(names.begin(), names.end(), other);
    }
    return static_cast<std::size_t>(found - names.begin());
}

std::size_t PointTable::column(const std::string& name) const {
    const std::size_t found = find(name);
    if (found < names.size()) return found;
    throw Failure(exit_file, file->path() + ": there is no column " + in_quotes(name) +
                                 "; the columns are " + name_list() +
                                 (left_out.empty() ? "" : "; " + left_out));
}

std::string PointTable::name_list() const {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + in_quotes(name);
    return list;
}

PointColumns PointTable::point_columns() const {
    PointColumns columns = find_point_columns(names);
    if (has_file_points) columns.number = PointColumns::none;
    return columns;
}

std::string PointTable::place(std::size_t row) const {
    return offsets.empty() ? file->path() + ": point " + std::to_string(row)
                           : file->place(offsets[row]);
}

bool is_plain_table(const TextFile& file) {
    if (is_point_fields(file) || is_cgns(file) || is_restart(file.text())) return false;
    CsvReader records(file);
    return !records.next() || records.cells().size() == 1;
}

PointTable read_point_table(const std::shared_ptr<const TextFile>& file) {
    if (is_point_fields(*file)) return read_point_fields(file);
    if (is_cgns(*file)) return read_cgns_fields(*file);
    if (is_restart(file->text())) return read_restart(file);
    const PointTable table = is_plain_table(*file) ? read_plain(file) : read_csv(file);
    if (table.rows() == 0) file->fail(0, "the file has no numbers");
    return table;
}

PointTable read_point_table(const std::string& path) {
    return read_point_table(std::make_shared<const TextFile>(read_unpacked(path)));
}

std::vector<std::int32_t> points_of(const PointTable& table, const Mesh& mesh, bool in_order) {
    const PointColumns columns = table.point_columns();
    const bool is_numbered = columns.has_numbers(), is_placed = columns.has_places();
    if (!is_numbered && !is_placed) check_order(table, mesh, in_order);
    const double reach = reach_of(mesh);
    const PointFinder finder(mesh);
    std::vector<std::int32_t> points;
    std::vector<bool> taken(mesh.x.size());
    for (std::size_t row = 0; row < table.rows(); ++row) {
        std::int32_t point = is_numbered ? by_number(table, row, columns.number, mesh)
                                         : static_cast<std::int32_t>(row);
        if (is_placed) {
            const double x = table.at(row, columns.place[0]), y = table.at(row, columns.place[1]);
            const auto is_at = [&](std::int32_t p) {
                const auto k = static_cast<std::size_t>(p);
                return std::hypot(mesh.x[k] - x, mesh.y[k] - y) <= reach;
            };
            if (!is_numbered && (point >= mesh.points() || !is_at(point)))
                point = finder.nearest(x, y, reach);
            if (point < 0 || !is_at(point)) refuse_place(table, row, mesh, columns, point);
        }
        const auto k = static_cast<std::size_t>(point);
        if (taken[k])
            throw Failure(exit_file, table.place(row) + ": point " + std::to_string(point) +
                                         " has values already");
        taken[k] = true;
        points.push_back(point);
    }
    return points;
}

}  // namespace cli
