#include "curves/variables_file.hpp"

#include "basics/library.hpp"
#include "basics/numbers.hpp"
#include "curves/section_movement.hpp"
#include "files/text_file.hpp"

#include <cstring>
#include <ostream>

namespace cli {

namespace {

// Returns the number on the line "keyword number".
std::int32_t count(LineReader& lines, const char* keyword) {
    std::int32_t n = 0;
    if (lines.words().size() != 2 || lines.words()[0] != keyword || !parse(lines.words()[1], n) ||
        n < 1 || n > (1 << 20)) {
        lines.expected(std::string(keyword) + " and how many");
    }
    return n;
}

std::int32_t index(LineReader& lines, std::size_t word, std::int32_t count, const char* what) {
    std::int32_t number = 0;
    if (!parse(lines.words()[word], number) || number < 1 || number > count) {
        lines.expected(std::string(what) + " between 1 and " + std::to_string(count),
                       lines.words()[word]);
    }
    return number - 1;
}

double value(LineReader& lines, std::size_t word) {
    double number = 0;
    if (!parse(lines.words()[word], number)) lines.expected("a finite number", lines.words()[word]);
    return number;
}

// The name of a movement in files, and the count of the numbers that follow the name.
struct MovementName {
    const char* name;
    std::int32_t kind;
    std::size_t numbers;
};
constexpr MovementName movement_names[] = {{"turn", HM_ROTATE, 2},
                                           {"shift", HM_SHIFT, 0},
                                           {"scale", HM_SCALE, 2},
                                           {"flap", HM_FLAP, 3},
                                           {"camber-thickness", HM_CAMBER_THICKNESS, 2},
                                           {"parsec", HM_PARSEC, 0},
                                           {"blade", HM_BLADE, 2}};

hm_movement movement_on(LineReader& lines) {
    const auto& words = lines.words();
    auto movement = sized<hm_movement>();
    for (const MovementName& known : movement_names) {
        if (words[0] != known.name) continue;
        if (words.size() != known.numbers + 1) {
            lines.expected(plural(static_cast<std::int64_t>(known.numbers), "number") + " after " +
                           known.name);
        }
        movement.kind = known.kind;
        if (known.kind == HM_CAMBER_THICKNESS) {
            if (!parse(words[1], movement.n_camber) || !parse(words[2], movement.n_thickness))
                lines.expected("two whole numbers after camber-thickness");
            return movement;
        }
        if (known.numbers > 0) {
            movement.x = value(lines, 1);
            movement.y = value(lines, 2);
        }
        if (known.numbers > 2) movement.length = value(lines, 3);
        return movement;
    }
    lines.expected("a movement such as turn, flap or parsec", words[0]);
}

void read_movements(LineReader& lines, std::int32_t n, VariableMap& map) {
    while (lines.next()) {
        if (lines.words()[0] != "chord") {
            map.movements.push_back(movement_on(lines));
            map.variables += static_cast<std::int32_t>(value_names(map.movements.back()).size());
            continue;
        }
        if (lines.words().size() != 5) lines.expected("chord X Y X Y");
        map.section.leading_x = value(lines, 1);
        map.section.leading_y = value(lines, 2);
        map.section.trailing_x = value(lines, 3);
        map.section.trailing_y = value(lines, 4);
    }
    if (static_cast<std::int32_t>(map.movements.size()) != n)
        lines.fail("the file announces " + plural(n, "movement") + ", but has " +
                   std::to_string(map.movements.size()));
}

void write_movements(std::ostream& out, const VariableMap& map) {
    out << "movements " << map.movements.size() << "\npoints " << map.points << '\n';
    const hm_section& s = map.section;
    if (!(s.leading_x == 0 && s.leading_y == 0 && s.trailing_x == 0 && s.trailing_y == 0)) {
        out << "chord " << exact(s.leading_x) << ' ' << exact(s.leading_y) << ' '
            << exact(s.trailing_x) << ' ' << exact(s.trailing_y) << '\n';
    }
    for (const hm_movement& movement : map.movements) {
        const MovementName& name = movement_names[movement.kind];
        out << name.name;
        if (movement.kind == HM_CAMBER_THICKNESS) {
            out << ' ' << movement.n_camber << ' ' << movement.n_thickness;
        } else if (name.numbers > 0) {
            out << ' ' << exact(movement.x) << ' ' << exact(movement.y);
        }
        if (name.numbers > 2) out << ' ' << exact(movement.length);
        out << '\n';
    }
}

// values: pairs, of which only the first numbers are used.
MovedSection moved_by(const VariableMap& map, const hm_curves& curves,
                      const std::vector<double>& values, const std::string& path) {
    std::vector<double> own;
    for (std::size_t j = 0; j < values.size(); j += 2) own.push_back(values[j]);
    MovedSection moved;
    hm_error error = {};
    if (!move_section(curves, map.section, map.movements, own, moved, error)) refuse(error, path);
    return moved;
}

}  // namespace

std::vector<double> VariableMap::control_moves(const hm_curves& curves,
                                               const std::vector<double>& values,
                                               const std::string& path,
                                               std::vector<MovementError>* errors) const {
    if (!movements.empty()) {
        const MovedSection moved = moved_by(*this, curves, values, path);
        if (errors != nullptr) errors->push_back(movement_error("the variables", curves, moved));
        return moved.move;
    }
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

std::vector<double> VariableMap::variable_gradient(const hm_curves& curves,
                                                   const std::vector<double>& values,
                                                   const std::vector<double>& gradient,
                                                   const std::string& path) const {
    const auto n = static_cast<std::size_t>(variables), n_points = static_cast<std::size_t>(points);
    std::vector<double> by(2 * n);
    if (!movements.empty()) {
        const std::vector<double> derivatives = moved_by(*this, curves, values, path).derivatives;
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t k = 0; k < 2 * n_points; ++k)
                by[2 * j] += derivatives[j * 2 * n_points + k] * gradient[k];
        return by;
    }
    for (std::size_t i = 0; i < n_points; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            const double a = matrix[2 * (i * n + j)], b = matrix[2 * (i * n + j) + 1],
                         x = gradient[2 * i], y = gradient[2 * i + 1];
            by[2 * j] += a * x + b * y;
            by[2 * j + 1] += a * y - b * x;
        }
    }
    return by;
}

// FNV-1a of degrees, control points and knots, without the sign.
std::int64_t checksum_of_knots(const hm_curves& curves) {
    std::uint64_t sum = 0xcbf29ce484222325;
    const auto add = [&](std::uint64_t word) {
        for (int byte = 0; byte < 8; ++byte)
            sum = (sum ^ (word >> 8 * byte & 0xff)) * 0x100000001b3;
    };
    for (std::int32_t number = 0; number < curves.n_curves; ++number) {
        const hm_curve& curve = curves.curve[number];
        add(static_cast<std::uint64_t>(curve.degree));
        for (std::int32_t k = 0; k < curve.n_indices; ++k)
            add(static_cast<std::uint64_t>(
                curve.indices == nullptr ? k : curve.indices[k] - curves.index_base));
        for (std::int32_t k = 0; k <= curve.n_indices + curve.degree; ++k) {
            std::uint64_t bits = 0;
            std::memcpy(&bits, &curve.knots[k], sizeof bits);
            add(bits);
        }
    }
    return static_cast<std::int64_t>(sum >> 1);
}

void check_curves(const VariableMap& map, const hm_curves& curves, const std::string& path) {
    if (map.points != curves.n_control) {
        throw Failure(exit_file,
                      path + ": the variables move " + plural(map.points, "control point") +
                          ", but the curves of the basis have " + std::to_string(curves.n_control));
    }
    if (map.knots != 0 && map.knots != checksum_of_knots(curves)) {
        throw Failure(exit_file, path +
                                     ": the variables were made for a curve with other knots than "
                                     "those of the basis; make them for the curve of the basis");
    }
}

VariableMap read_variables(const std::string& path) {
    const TextFile file(path);
    LineReader lines(file, '#');
    VariableMap map;
    map.section = sized<hm_section>();
    if (!lines.next() || (lines.words()[0] != "variables" && lines.words()[0] != "movements"))
        lines.expected("variables or movements, and how many");
    const bool is_linear = lines.words()[0] == "variables";
    const std::int32_t n = count(lines, is_linear ? "variables" : "movements");
    if (!lines.next()) lines.expected("points and how many");
    map.points = count(lines, "points");
    if (!is_linear) {
        read_movements(lines, n, map);
        return map;
    }
    map.variables = n;
    map.matrix.resize(2 * static_cast<std::size_t>(map.variables) *
                      static_cast<std::size_t>(map.points));
    while (lines.next()) {
        if (map.knots == 0 && lines.words()[0] == "knots") {
            if (lines.words().size() != 2 || !parse(lines.words()[1], map.knots))
                lines.expected("knots and their checksum");
            continue;
        }
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
    if (!map.movements.empty()) return write_movements(out, map);
    out << "variables " << map.variables << "\npoints " << map.points << "\nknots " << map.knots
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
        if (n == 3 && !map.movements.empty())
            lines.expected("one value, as the variables are movements");
        if (n == 3) values[2 * variable + 1] = value(lines, 2);
    }
    return values;
}

}  // namespace cli
