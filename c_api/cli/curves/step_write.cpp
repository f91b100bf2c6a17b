#include "basics/numbers.hpp"
#include "curves/cad_curves.hpp"

#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

namespace cli {

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

}  // namespace cli
