#include "formats/table_points.hpp"

#include "basics/elementary.hpp"
#include "basics/failure.hpp"
#include "basics/numbers.hpp"
#include "mesh/point_numbers.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

double extent_of(const Mesh& mesh) {
    if (mesh.x.empty()) return 0;
    const auto x = std::minmax_element(mesh.x.begin(), mesh.x.end());
    const auto y = std::minmax_element(mesh.y.begin(), mesh.y.end());
    return std::max(*x.second - *x.first, *y.second - *y.first);
}

namespace {

// Points in the order of x, to find the nearest one.
class PointFinder {
public:
    explicit PointFinder(const Mesh& mesh) : mesh_(mesh) {
        for (std::int32_t point = 0; point < mesh.points(); ++point) order_.push_back(point);
        std::sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) {
            return x(a) != x(b) ? x(a) < x(b) : y(a) != y(b) ? y(a) < y(b) : a < b;
        });
    }
    // Returns a point with exactly these coordinates, or -1; of several one that is_free(point)
    // names, if there is one.
    template <class IsFree>
    std::int32_t at(double at_x, double at_y, const IsFree& is_free) const {
        auto next = std::lower_bound(order_.begin(), order_.end(), 0, [&](std::int32_t p, int) {
            return x(p) != at_x ? x(p) < at_x : y(p) < at_y;
        });
        std::int32_t found = -1;
        for (; next != order_.end() && x(*next) == at_x && y(*next) == at_y; ++next) {
            if (found < 0 || is_free(*next)) found = *next;
            if (is_free(found)) break;
        }
        return found;
    }
    // Returns the point nearest to a place, or -1 if no point is within `reach`; of points at one
    // place one that is_free(point) names, if there is one.
    template <class IsFree>
    std::int32_t nearest(double at_x, double at_y, double reach, const IsFree& is_free) const {
        auto next = std::lower_bound(order_.begin(), order_.end(), at_x - reach,
                                     [&](std::int32_t p, double value) { return x(p) < value; });
        std::int32_t best = -1;
        double min_distance = reach;
        for (; next != order_.end() && x(*next) <= at_x + reach; ++next) {
            const double distance = length_of(x(*next) - at_x, y(*next) - at_y);
            if (distance > min_distance) continue;
            if (best >= 0 && distance == min_distance && (is_free(best) || !is_free(*next)))
                continue;
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

// How far the coordinates of a table may be from those of the mesh, by the digits of the table.
class Rounding {
public:
    Rounding(const PointTable& table, const PointColumns& columns, double extent)
        : extent_(extent) {
        for (std::size_t row = 0; row < table.rows() && columns.has_places(); ++row) {
            for (const std::size_t axis : {0u, 1u}) add(table.at(row, columns.place[axis]));
        }
    }
    // Returns whether a place of the mesh, written with these digits, may be that of a row.
    bool may_be(double of_mesh_x, double of_mesh_y, double x, double y) const {
        return std::fabs(of_mesh_x - x) <= half_unit(x) && std::fabs(of_mesh_y - y) <= half_unit(y);
    }
    // Returns within what distance a point of the mesh is that of a row: other programs may have
    // computed in single precision.
    double reach(double x, double y) const {
        return length_of(half_unit(x), half_unit(y)) + 1e-6 * length_of(x, y) +
               smallest_reach * extent_;
    }

private:
    static double power_of_ten(int exponent) {
        double value = 0;
        parse("1e" + std::to_string(exponent), value);
        return value;
    }
    // Returns whether the number, printed with these digits, is read back as the same number.
    static bool has_digits(char style, int digits, double value) {
        std::string text;
        append_number(text, style, digits, value);
        double read = 0;
        return parse(text, read) && read == value;
    }
    void add(double value) {
        while (significant_ < 17 && !has_digits('e', significant_ - 1, value)) ++significant_;
        while (decimals_ < 17 && !has_digits('f', decimals_, value)) ++decimals_;
        is_single_ = is_single_ && static_cast<double>(static_cast<float>(value)) == value;
    }
    // Half a unit of the last digit, but not more than in a table of 6 digits.
    double half_unit(double value) const {
        const double size = std::fabs(value);
        double unit = decimals_ < 17 ? power_of_ten(-decimals_) : 0;
        if (size > 0)
            unit = std::max(unit, power_of_ten(decimal_exponent(size) + 1 - significant_));
        if (is_single_) unit = std::max(unit, 1.2e-7 * size);
        return std::min(.501 * unit, 2e-6 * extent_) + 1e-15 * size;
    }

    double extent_;
    int significant_ = 6, decimals_ = 0;  // the most of a number
    bool is_single_ = true;               // all numbers are those of single precision
};

// The point of the mesh to which a row with coordinates belongs. `number`: the point that the row
// names, or of which the row has the place in the table; -1: none. Returns -1 if no point of the
// mesh has these coordinates.
class PointOfRow {
public:
    PointOfRow(const PointTable& table, const PointColumns& columns, const Mesh& mesh)
        : mesh_(mesh), rounding_(table, columns, extent_of(mesh)), finder_(mesh) {}

    template <class IsFree>
    std::int32_t find(double x, double y, std::int32_t number, bool is_named,
                      const IsFree& is_free) const {
        if (number >= 0 && distance(number, x, y) == 0) return number;
        const std::int32_t exact = finder_.at(x, y, is_free);
        const bool is_other = exact >= 0 && is_free(exact) && !is_named;
        if (number >= 0 && !is_other && may_be(number, x, y)) return number;
        if (exact >= 0) return is_named ? -1 : exact;
        const std::int32_t nearest = finder_.nearest(x, y, rounding_.reach(x, y), is_free);
        if (nearest < 0 || number < 0) return nearest;
        const bool is_nearest = distance(number, x, y) == distance(nearest, x, y);
        return is_nearest ? number : is_named ? -1 : nearest;
    }

private:
    bool may_be(std::int32_t point, double x, double y) const {
        const auto k = static_cast<std::size_t>(point);
        return rounding_.may_be(mesh_.x[k], mesh_.y[k], x, y);
    }
    double distance(std::int32_t point, double x, double y) const {
        const auto k = static_cast<std::size_t>(point);
        return length_of(mesh_.x[k] - x, mesh_.y[k] - y);
    }

    const Mesh& mesh_;
    const Rounding rounding_;
    const PointFinder finder_;
};

std::string place_text(double x, double y) { return "(" + brief(x) + ", " + brief(y) + ")"; }

std::int32_t by_number(const PointTable& table, std::size_t row, std::size_t column,
                       const PointNumbers& numbers) {
    const double given = table.at(row, column);
    if (given != std::floor(given) || std::fabs(given) >= 1e15)
        throw Failure(exit_file,
                      table.place(row) + ": " + brief(given) + " is no number of a point");
    const auto number = static_cast<std::int64_t>(given);
    const std::int32_t point = numbers.point(number);
    if (point < 0) throw Failure(exit_file, table.place(row) + ": " + numbers.why_no_point(number));
    return point;
}

[[noreturn]] void refuse_place(const PointTable& table, std::size_t row, const Mesh& mesh,
                               const PointColumns& columns, const PointNumbers& numbers,
                               std::int32_t point) {
    std::string where = "this mesh has no point at ";
    std::string remedy;
    if (point >= 0) {
        const auto k = static_cast<std::size_t>(point);
        where = "point " + std::to_string(numbers.number(point)) + " of this mesh is at " +
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
void check_order(const PointTable& table, const Mesh& mesh, const PointNumbers& numbers,
                 bool in_order) {
    if (!in_order && !table.has_file_points) {
        throw Failure(exit_file,
                      table.file->path() +
                          ": no columns have the numbers of points (such as PointID) or their "
                          "coordinates (such as x and y); the columns are " +
                          table.name_list() +
                          ". Name such columns so, or give --in-order if the rows are all points "
                          "of the mesh in the order of its file");
    }
    if (!numbers.are_those_of_mesh()) {
        throw Failure(exit_file,
                      table.file->path() +
                          ": the points of the mesh are not the first points of its file, which "
                          "has a second plane or several points at one place, so that rows need "
                          "the numbers of points in the file, or their coordinates");
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

bool has_points_of_file(const PointTable& table, const Mesh& mesh) {
    return table.has_file_points && mesh.in_file.n_points > 0 &&
           mesh.in_file.n_points == static_cast<std::int64_t>(table.rows());
}

std::vector<std::int32_t> points_of(const PointTable& table, const Mesh& mesh, bool in_order,
                                    JoinedRows joined) {
    if (has_points_of_file(table, mesh) && table.rows() != mesh.x.size()) {
        throw Failure(exit_file, table.file->path() +
                                     ": the file has values at all points of the mesh file, "
                                     "of which several are one point of the mesh; give one value "
                                     "for each, such as in a CSV table with the columns x and y");
    }
    const PointColumns columns = table.point_columns();
    const bool is_numbered = columns.has_numbers(), is_placed = columns.has_places();
    const PointNumbers numbers(mesh);
    if (!is_numbered && !is_placed) check_order(table, mesh, numbers, in_order);
    const PointOfRow point_of_row(table, columns, mesh);
    std::vector<std::int32_t> points;
    std::vector<std::int32_t> rows_of(mesh.x.size());
    std::vector<bool> is_named(static_cast<std::size_t>(numbers.count()));
    for (std::size_t row = 0; row < table.rows(); ++row) {
        std::int32_t point = is_numbered ? by_number(table, row, columns.number, numbers)
                                         : static_cast<std::int32_t>(row);
        if (is_placed) {
            const auto is_free = [&](std::int32_t p) { return rows_of[place(p)] == 0; };
            const std::int32_t given = point < mesh.points() ? point : -1;
            point = point_of_row.find(table.at(row, columns.place[0]),
                                      table.at(row, columns.place[1]), given, is_numbered, is_free);
            if (point < 0)
                refuse_place(table, row, mesh, columns, numbers, is_numbered ? given : -1);
        }
        bool is_named_again = false;
        if (is_numbered) {
            const auto number = static_cast<std::size_t>(table.at(row, columns.number));
            is_named_again = is_named[number];
            is_named[number] = true;
        }
        const std::int32_t most = joined == JoinedRows::refused ? 1 : numbers.points_in_file(point);
        if (is_named_again || ++rows_of[place(point)] > most)
            throw Failure(exit_file, table.place(row) + ": point " +
                                         std::to_string(numbers.number(point)) +
                                         " has values already");
        points.push_back(point);
    }
    return points;
}

}  // namespace cli
