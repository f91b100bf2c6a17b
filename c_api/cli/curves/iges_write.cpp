#include "basics/numbers.hpp"
#include "curves/cad_curves.hpp"

#include <algorithm>
#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

namespace cli {

namespace {

std::string padded(std::string text, std::size_t width) {
    text.resize(width, ' ');
    return text;
}

std::string right(std::int64_t number, int width) {
    char text[32];
    std::snprintf(text, sizeof text, "%*lld", width, static_cast<long long>(number));
    return text;
}

// Writes a line of 80 columns, which ends with the letter of the section and the number of the
// line.
void put_line(std::ostream& out, const std::string& text, char section, std::int64_t number) {
    out << padded(text, 72) << section << right(number, 7) << '\n';
}

// Divides parameters with commas between them into lines of at most `width` columns.
std::vector<std::string> lines_of(const std::vector<std::string>& parameters, std::size_t width) {
    std::vector<std::string> lines = {""};
    for (std::size_t k = 0; k < parameters.size(); ++k) {
        const std::string word = parameters[k] + (k + 1 < parameters.size() ? "," : ";");
        if (lines.back().size() + word.size() > width) lines.emplace_back();
        lines.back() += word;
    }
    return lines;
}

bool is_straight(const Curve& curve) { return curve.degree == 1 && curve.indices.size() == 2; }

// Entity 126: K, M, flags (planar, closed, polynomial, periodic), knots, weights, control points,
// range, normal.
std::vector<std::string> parameters_of(const Curves& curves, const Curve& curve) {
    const auto n = curve.indices.size();
    const bool polynomial = curves.weights.empty();
    std::vector<std::string> out = {"126",
                                    std::to_string(n - 1),
                                    std::to_string(curve.degree),
                                    "1",
                                    curve.closed == HM_OPEN ? "0" : "1",
                                    polynomial ? "1" : "0",
                                    curve.closed == HM_PERIODIC ? "1" : "0"};
    for (const double knot : curve.knots) out.push_back(scientific(knot));
    for (const std::int32_t index : curve.indices) {
        out.push_back(
            scientific(polynomial ? 1.0 : curves.weights[static_cast<std::size_t>(index)]));
    }
    for (const std::int32_t index : curve.indices) {
        const auto point = 2 * static_cast<std::size_t>(index);
        for (const double coordinate : {curves.control[point], curves.control[point + 1], 0.0}) {
            out.push_back(scientific(coordinate));
        }
    }
    const auto degree = static_cast<std::size_t>(curve.degree);
    for (const double end : {curve.knots[degree], curve.knots[n]}) out.push_back(scientific(end));
    for (const double component : {0.0, 0.0, 1.0}) out.push_back(scientific(component));
    return out;
}

std::string text_parameter(const std::string& text) {
    return std::to_string(text.size()) + "H" + text;
}

// Writes the description of the file. The date is a constant, so that equal curves make equal
// files.
std::vector<std::string> globals_of(const Curves& curves) {
    double largest = 0;
    for (const double coordinate : curves.control)
        largest = std::max({largest, coordinate, -coordinate});
    const std::string date = text_parameter("20000101.000000"), name = text_parameter("harmorph");
    return {"1H,",
            "1H;",
            name,
            text_parameter("curve.igs"),
            name,
            name,
            "32",
            "38",
            "6",
            "308",
            "15",
            name,
            "1.0",
            "6",
            "1HM",
            "1",
            "0.01",
            date,
            scientific(1e-9 * largest),
            scientific(largest),
            name,
            name,
            "11",
            "0",
            date};
}

}  // namespace

void write_iges(std::ostream& out, const Curves& curves) {
    constexpr std::size_t parameter_columns = 64;
    put_line(out, "B-spline curves written by harmorph; unit of length as in the mesh", 'S', 1);
    const std::vector<std::string> globals = lines_of(globals_of(curves), 72);
    for (std::size_t k = 0; k < globals.size(); ++k)
        put_line(out, globals[k], 'G', static_cast<std::int64_t>(k + 1));
    std::vector<std::vector<std::string>> entities;
    std::int64_t parameter_line = 1, directory_line = 1;
    for (const Curve& curve : curves.curves) {
        entities.push_back(lines_of(parameters_of(curves, curve), parameter_columns));
        const auto n_lines = static_cast<std::int64_t>(entities.back().size());
        const std::string zeros = right(0, 8);
        const std::string type = right(126, 8), four_zeros = zeros + zeros + zeros + zeros;
        const std::int32_t form = is_straight(curve) ? 1 : 0;  // 1: a line; 0: any form
        put_line(out,
                 type + right(parameter_line, 8) + zeros + right(1, 8) + four_zeros + "00000000",
                 'D', directory_line);
        put_line(out,
                 type + zeros + zeros + right(n_lines, 8) + right(form, 8) + padded("", 24) + zeros,
                 'D', directory_line + 1);
        parameter_line += n_lines;
        directory_line += 2;
    }
    std::int64_t number = 1;
    for (std::size_t entity = 0; entity < entities.size(); ++entity) {
        for (const std::string& line : entities[entity]) {
            const std::string directory = right(static_cast<std::int64_t>(2 * entity + 1), 8);
            put_line(out, padded(line, parameter_columns) + directory, 'P', number++);
        }
    }
    put_line(out,
             "S" + right(1, 7) + "G" + right(static_cast<std::int64_t>(globals.size()), 7) + "D" +
                 right(directory_line - 1, 7) + "P" + right(number - 1, 7),
             'T', 1);
}

}  // namespace cli
