#include "curves/cad_curves.hpp"

#include "basics/numbers.hpp"

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

namespace cli {

namespace {

std::string filled(std::string text, std::size_t width) {
    text.resize(width, ' ');
    return text;
}

// Writes a line of 80 columns, which ends with the letter of the section and the number of the
// line.
void put_line(std::ostream& out, const std::string& text, char section, std::int64_t number) {
    out << filled(text, 72) << section << padded(number, 7) << '\n';
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
        const std::string zeros = padded(0, 8);
        const std::string type = padded(126, 8), four_zeros = zeros + zeros + zeros + zeros;
        const std::int32_t form = is_straight(curve) ? 1 : 0;  // 1: a line; 0: any form
        put_line(out,
                 type + padded(parameter_line, 8) + zeros + padded(1, 8) + four_zeros + "00000000",
                 'D', directory_line);
        put_line(
            out,
            type + zeros + zeros + padded(n_lines, 8) + padded(form, 8) + filled("", 24) + zeros,
            'D', directory_line + 1);
        parameter_line += n_lines;
        directory_line += 2;
    }
    std::int64_t number = 1;
    for (std::size_t entity = 0; entity < entities.size(); ++entity) {
        for (const std::string& line : entities[entity]) {
            const std::string directory = padded(static_cast<std::int64_t>(2 * entity + 1), 8);
            put_line(out, filled(line, parameter_columns) + directory, 'P', number++);
        }
    }
    put_line(out,
             "S" + padded(1, 7) + "G" + padded(static_cast<std::int64_t>(globals.size()), 7) + "D" +
                 padded(directory_line - 1, 7) + "P" + padded(number - 1, 7),
             'T', 1);
}

namespace {

template <class Values, class Word>
std::string list_of(const Values& values, Word word) {
    std::string text = "(";
    for (const auto& value : values) text += (text.size() > 1 ? "," : "") + word(value);
    return text + ")";
}

struct Knots {
    std::vector<double> value;  // the distinct knots
    std::vector<int> multiplicity;

    explicit Knots(const std::vector<double>& all) {
        for (const double knot : all) {
            if (value.empty() || value.back() != knot) {
                value.push_back(knot);
                multiplicity.push_back(0);
            }
            ++multiplicity.back();
        }
    }
};

// Writes records, numbered from 1, and returns the name of each.
class StepWriter {
public:
    explicit StepWriter(std::ostream& out) : out_(out) {}
    std::string put(const std::string& record) {
        out_ << '#' << ++last_ << '=' << record << ";\n";
        return "#" + std::to_string(last_);
    }

private:
    std::ostream& out_;
    long last_ = 0;
};

std::string put_curve(StepWriter& step, const Curves& curves, const Curve& curve,
                      const std::vector<std::string>& points) {
    const Knots knots(curve.knots);
    const auto logical = [](bool value) { return std::string(value ? ".T." : ".F."); };
    const std::string control = list_of(
        curve.indices, [&](std::int32_t index) { return points[static_cast<std::size_t>(index)]; });
    const std::string shape = std::to_string(curve.degree) + "," + control + ",.UNSPECIFIED.," +
                              logical(curve.closed != HM_OPEN) + ",.F.";
    const std::string spans = list_of(knots.multiplicity, [](int n) { return std::to_string(n); }) +
                              "," + list_of(knots.value, scientific) + ",.UNSPECIFIED.";
    if (curves.weights.empty())
        return step.put("B_SPLINE_CURVE_WITH_KNOTS(''," + shape + "," + spans + ")");
    const std::string weights = list_of(curve.indices, [&](std::int32_t index) {
        return scientific(curves.weights[static_cast<std::size_t>(index)]);
    });
    return step.put("(BOUNDED_CURVE()B_SPLINE_CURVE(" + shape + ")B_SPLINE_CURVE_WITH_KNOTS(" +
                    spans + ")CURVE()GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE(" +
                    weights + ")REPRESENTATION_ITEM(''))");
}

// The product whose shape the curves are, as programs expect one.
void put_product(StepWriter& step, const std::string& set) {
    const std::string metre = step.put("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.))");
    const std::string radian = step.put("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
    const std::string steradian =
        step.put("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
    const std::string accuracy = step.put("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-9)," +
                                          metre + ",'distance_accuracy_value','')");
    const std::string units = metre + "," + radian + "," + steradian;
    const std::string context = step.put(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((" + accuracy +
        "))GLOBAL_UNIT_ASSIGNED_CONTEXT((" + units + "))REPRESENTATION_CONTEXT('',''))");
    const std::string shape = step.put("GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(" +
                                       set + ")," + context + ")");
    const std::string application = step.put(
        "APPLICATION_CONTEXT('configuration controlled 3d designs of mechanical parts and "
        "assemblies')");
    step.put(
        "APPLICATION_PROTOCOL_DEFINITION('international standard','config_control_design',1994," +
        application + ")");
    const std::string mechanical =
        step.put("MECHANICAL_CONTEXT(''," + application + ",'mechanical')");
    const std::string product = step.put("PRODUCT('harmorph','harmorph','',(" + mechanical + "))");
    step.put("PRODUCT_RELATED_PRODUCT_CATEGORY('part','',(" + product + "))");
    const std::string formation = step.put(
        "PRODUCT_DEFINITION_FORMATION_WITH_SPECIFIED_SOURCE('',''," + product + ",.NOT_KNOWN.)");
    const std::string stage = step.put("DESIGN_CONTEXT(''," + application + ",'design')");
    const std::string definition =
        step.put("PRODUCT_DEFINITION('',''," + formation + "," + stage + ")");
    const std::string product_shape =
        step.put("PRODUCT_DEFINITION_SHAPE('',''," + definition + ")");
    step.put("SHAPE_DEFINITION_REPRESENTATION(" + product_shape + "," + shape + ")");
}

}  // namespace

void write_step(std::ostream& out, const Curves& curves) {
    // The date is a constant, so that equal curves make equal files.
    out << "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('B-spline curves'),'2;1');\n"
           "FILE_NAME('','2000-01-01T00:00:00',(''),(''),'harmorph','harmorph','');\n"
           "FILE_SCHEMA(('CONFIG_CONTROL_DESIGN'));\nENDSEC;\nDATA;\n";
    StepWriter step(out);
    std::vector<std::string> points;
    for (std::size_t k = 0; k < curves.control.size(); k += 2) {
        const std::string coordinates =
            scientific(curves.control[k]) + "," + scientific(curves.control[k + 1]) + ",0.";
        points.push_back(step.put("CARTESIAN_POINT('',(" + coordinates + "))"));
    }
    std::vector<std::string> written;
    for (const Curve& curve : curves.curves)
        written.push_back(put_curve(step, curves, curve, points));
    const std::string members = list_of(written, [](const std::string& name) { return name; });
    put_product(step, step.put("GEOMETRIC_CURVE_SET(''," + members + ")"));
    out << "ENDSEC;\nEND-ISO-10303-21;\n";
}

namespace {

// Writes name = values, with at most `per_line` values in each line.
template <class Values, class Text>
void put(std::ostream& out, const char* name, const Values& values, std::size_t per_line,
         Text text) {
    out << "  " << name << " =";
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i % per_line == 0) out << "\n   ";
        out << ' ' << text(values[i]) << (i + 1 < values.size() ? "," : "");
    }
    out << '\n';
}

}  // namespace

void write_namelist(std::ostream& out, const Curves& curves) {
    const auto number = [](std::int32_t value) { return std::to_string(value); };
    const auto from_1 = [](std::int32_t index) { return std::to_string(index + 1); };
    out << "&control_points\n  n = " << curves.points() << '\n';
    put(out, "xy", curves.control, 2, exact);
    if (!curves.weights.empty()) put(out, "weights", curves.weights, 1, exact);
    out << "/\n";
    for (const Curve& curve : curves.curves) {
        out << "&curve\n  degree = " << number(curve.degree) << "\n  closed = '"
            << closed_name(curve.closed) << "'\n"
            << "  n_indices = " << curve.indices.size() << '\n';
        put(out, "indices", curve.indices, 10, from_1);
        put(out, "knots", curve.knots, 1, exact);
        out << "/\n";
    }
}

}  // namespace cli
