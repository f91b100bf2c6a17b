#include "formats/point_table.hpp"

#include "basics/failure.hpp"
#include "basics/numbers.hpp"
#include "formats/bytes.hpp"
#include "formats/cgns.hpp"
#include "formats/cgns_fields.hpp"
#include "formats/deflate.hpp"
#include "formats/point_fields.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

constexpr const char* point_name = "PointID";

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

std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        std::string_view word = trimmed(line.substr(begin, end - begin));
        if (word.size() >= 2 && word.front() == '"' && word.back() == '"')
            word = word.substr(1, word.size() - 2);
        words.push_back(trimmed(word));
        begin = end + 1;
    }
    return words;
}

void add_row(PointTable& table, LineReader& lines, const std::vector<std::string_view>& words) {
    for (std::size_t k = 0; k < words.size(); ++k) {
        double value = 0;
        if (!parse(words[k], value))
            lines.expected("a finite number for " + in_quotes(table.names[k]), words[k]);
        table.values.push_back(value);
    }
    table.offsets.push_back(lines.offset());
}

PointTable read_csv(const std::shared_ptr<const TextFile>& file, LineReader& lines) {
    PointTable table;
    table.file = file;
    for (const std::string_view name : split(lines.line())) table.names.emplace_back(name);
    while (lines.next()) {
        const std::vector<std::string_view> words = split(lines.line());
        if (words.size() != table.names.size()) {
            lines.expected(plural(static_cast<std::int64_t>(table.names.size()), "column") +
                           " as in the first line");
        }
        add_row(table, lines, words);
    }
    return table;
}

PointTable read_plain(const std::shared_ptr<const TextFile>& file, LineReader& lines) {
    PointTable table;
    table.file = file;
    table.names = {point_name, "Sensitivity_x", "Sensitivity_y"};
    do {
        if (lines.words().size() != 3) lines.expected("point dJ/dx dJ/dy");
        add_row(table, lines, lines.words());
    } while (lines.next());
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

std::int32_t by_number(const PointTable& table, std::size_t row, const Mesh& mesh) {
    const double number = table.at(row, table.column(point_name));
    if (number != std::floor(number) || number < 0 || number >= mesh.points()) {
        throw Failure(exit_file, table.place(row) + ": the mesh has points 0 to " +
                                     std::to_string(mesh.points() - 1) + ", and no point " +
                                     brief(number));
    }
    return static_cast<std::int32_t>(number);
}

[[noreturn]] void refuse_place(const PointTable& table, std::size_t row, const Mesh& mesh,
                               std::int32_t point, double x, double y) {
    std::string where = "this mesh has no point at ";
    if (point >= 0) {
        const auto k = static_cast<std::size_t>(point);
        where = "point " + std::to_string(point) + " of this mesh is at " +
                place_text(mesh.x[k], mesh.y[k]) + ", not at ";
    }
    throw Failure(exit_file, table.place(row) + ": the values are those of another mesh: " + where +
                                 place_text(x, y));
}

}  // namespace

double reach_of(const Mesh& mesh) {
    const auto x = std::minmax_element(mesh.x.begin(), mesh.x.end());
    const auto y = std::minmax_element(mesh.y.begin(), mesh.y.end());
    return 2e-6 * std::max(*x.second - *x.first, *y.second - *y.first);
}

std::size_t PointTable::find(const std::string& name) const {
    auto found = std::find(names.begin(), names.end(), name);
    const std::size_t end = name.size() - std::min<std::size_t>(name.size(), 2);
    for (const char* component : {"_xX", "_yY", "_zZ"}) {
        if (found == names.end() && name.compare(end, 2, component, 2) == 0)
            found = std::find(names.begin(), names.end(), name.substr(0, end) + component[2]);
    }
    return static_cast<std::size_t>(found - names.begin());
}

std::size_t PointTable::column(const std::string& name) const {
    const std::size_t found = find(name);
    if (found < names.size()) return found;
    std::string known;
    for (const std::string& other : names) known += (known.empty() ? "" : ", ") + in_quotes(other);
    throw Failure(exit_file, file->path() + ": there is no column " + in_quotes(name) +
                                 "; the columns are " + known +
                                 (left_out.empty() ? "" : "; " + left_out));
}

std::string PointTable::place(std::size_t row) const {
    return offsets.empty() ? file->path() + ": point " + std::to_string(row)
                           : file->place(offsets[row]);
}

PointTable read_point_table(const std::string& path) {
    const auto file = std::make_shared<const TextFile>(read_unpacked(path));
    if (is_point_fields(*file)) return read_point_fields(file);
    if (is_cgns(*file)) return read_cgns_fields(*file);
    if (is_restart(file->text())) return read_restart(file);
    LineReader lines(*file, '#');
    if (!lines.next()) file->fail(0, "the file has no numbers");
    const bool has_columns = lines.line().find(',') != std::string_view::npos;
    return has_columns ? read_csv(file, lines) : read_plain(file, lines);
}

std::vector<std::int32_t> points_of(const PointTable& table, const Mesh& mesh) {
    const bool numbered = table.has(point_name), placed = table.has("x") && table.has("y");
    if (!numbered && !placed && table.rows() != mesh.x.size()) {
        throw Failure(exit_file, table.file->path() + ": " +
                                     plural(static_cast<std::int64_t>(table.rows()), "row") +
                                     " without PointID, x and y, but the mesh has " +
                                     plural(mesh.points(), "point"));
    }
    const double reach = reach_of(mesh);
    const PointFinder finder(mesh);
    std::vector<std::int32_t> points;
    std::vector<bool> taken(mesh.x.size());
    for (std::size_t row = 0; row < table.rows(); ++row) {
        std::int32_t point =
            numbered ? by_number(table, row, mesh) : static_cast<std::int32_t>(row);
        if (placed) {
            const double x = table.at(row, table.column("x")), y = table.at(row, table.column("y"));
            const auto is_at = [&](std::int32_t p) {
                const auto k = static_cast<std::size_t>(p);
                return std::hypot(mesh.x[k] - x, mesh.y[k] - y) <= reach;
            };
            if (!numbered && (point >= mesh.points() || !is_at(point)))
                point = finder.nearest(x, y, reach);
            if (point < 0 || !is_at(point)) refuse_place(table, row, mesh, point, x, y);
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
