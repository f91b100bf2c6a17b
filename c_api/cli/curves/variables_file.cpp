#include "curves/variables_file.hpp"

#include "basics/numbers.hpp"
#include "basics/text_file.hpp"

#include <ostream>

namespace cli {

namespace {

std::int32_t count(LineReader& lines, const char* keyword) {
    std::int32_t n = 0;
    const bool found = lines.next();
    if (!found || lines.words().size() != 2 || lines.words()[0] != keyword ||
        !parse(lines.words()[1], n) || n < 1 || n > (1 << 20)) {
        lines.expected(std::string(keyword) + " and how many");
    }
    return n;
}

std::int32_t index(LineReader& lines, std::size_t word, std::int32_t most, const char* what) {
    std::int32_t number = 0;
    if (!parse(lines.words()[word], number) || number < 1 || number > most) {
        lines.expected(std::string(what) + " between 1 and " + std::to_string(most),
                       lines.words()[word]);
    }
    return number - 1;
}

double value(LineReader& lines, std::size_t word) {
    double number = 0;
    if (!parse(lines.words()[word], number)) lines.expected("a finite number", lines.words()[word]);
    return number;
}

}  // namespace

std::vector<double> VariableMap::control_moves(const std::vector<double>& values) const {
    std::vector<double> moves(2 * static_cast<std::size_t>(points));
    const auto n = static_cast<std::size_t>(variables);
    for (std::size_t i = 0; i < static_cast<std::size_t>(points); ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            const double a = matrix[2 * (i * n + j)], b = matrix[2 * (i * n + j) + 1],
                         x = values[2 * j], y = values[2 * j + 1];
            moves[2 * i] += a * x - b * y;
            moves[2 * i + 1] += a * y + b * x;
        }
    }
    return moves;
}

std::vector<double> VariableMap::variable_gradient(const std::vector<double>& gradient) const {
    const auto n = static_cast<std::size_t>(variables);
    std::vector<double> by(2 * n);
    for (std::size_t i = 0; i < static_cast<std::size_t>(points); ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            const double a = matrix[2 * (i * n + j)], b = matrix[2 * (i * n + j) + 1],
                         x = gradient[2 * i], y = gradient[2 * i + 1];
            by[2 * j] += a * x + b * y;
            by[2 * j + 1] += a * y - b * x;
        }
    }
    return by;
}

VariableMap read_variables(const std::string& path) {
    const TextFile file(path);
    LineReader lines(file, '#');
    VariableMap map;
    map.variables = count(lines, "variables");
    map.points = count(lines, "points");
    map.matrix.resize(2 * static_cast<std::size_t>(map.variables) *
                      static_cast<std::size_t>(map.points));
    while (lines.next()) {
        if (lines.words().size() != 4) lines.expected("control point, variable, dx, dy");
        const std::int32_t point = index(lines, 0, map.points, "a control point");
        const std::int32_t variable = index(lines, 1, map.variables, "a variable");
        const std::size_t at =
            2 * (static_cast<std::size_t>(point) * static_cast<std::size_t>(map.variables) +
                 static_cast<std::size_t>(variable));
        map.matrix[at] = value(lines, 2);
        map.matrix[at + 1] = value(lines, 3);
    }
    return map;
}

void write_variables(std::ostream& out, const VariableMap& map) {
    out << "variables " << map.variables << "\npoints " << map.points
        << "\n# control point, variable, dx, dy\n";
    std::size_t at = 0;
    for (std::int32_t i = 1; i <= map.points; ++i) {
        for (std::int32_t j = 1; j <= map.variables; ++j, at += 2) {
            if (map.matrix[at] == 0 && map.matrix[at + 1] == 0) continue;
            out << i << ' ' << j << ' ' << exact(map.matrix[at]) << ' ' << exact(map.matrix[at + 1])
                << '\n';
        }
    }
}

std::vector<double> read_values(const std::string& path, const VariableMap& map) {
    const TextFile file(path);
    LineReader lines(file, '#');
    std::vector<double> values(2 * static_cast<std::size_t>(map.variables));
    std::vector<bool> named(static_cast<std::size_t>(map.variables));
    while (lines.next()) {
        const std::size_t n = lines.words().size();
        if (n != 2 && n != 3) lines.expected("variable value, or variable x y");
        const auto variable =
            static_cast<std::size_t>(index(lines, 0, map.variables, "a variable"));
        if (named[variable])
            lines.fail("variable " + std::to_string(variable + 1) + " has a value already");
        named[variable] = true;
        values[2 * variable] = value(lines, 1);
        if (n == 3) values[2 * variable + 1] = value(lines, 2);
    }
    return values;
}

}  // namespace cli
