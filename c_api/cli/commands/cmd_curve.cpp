// harmorph curve: measures a section, and gives its curve more control points.
#include "basics/json.hpp"
#include "basics/library.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "curves/curve_file.hpp"
#include "files/output_file.hpp"
#include "options/place_options.hpp"

#include <harmorph_design.h>

#include <algorithm>

namespace cli {

namespace {

// Returns curves of the same shape with more control points, by inserted knots or a higher degree.
Curves refined(const std::string& path, const Curves& curves, std::int32_t curve,
               std::int32_t degree, const std::vector<double>& knots) {
    const CurvesView view(curves);
    const auto n = static_cast<std::int32_t>(knots.size());
    Block block;
    const hm_curves* finer = nullptr;
    with_memory(block, [&](hm_memory* memory) {
        return call(path, hm_refine, &finer, nullptr, memory, view.get(), curve, degree, n,
                    knots.data());
    });
    return copied(*finer);
}

// Returns the middles of all knot spans.
std::vector<double> middles(const Curve& curve) {
    std::vector<double> found;
    const auto degree = static_cast<std::size_t>(curve.degree);
    for (std::size_t k = degree; k + 1 < curve.knots.size() - degree; ++k) {
        const double begin = curve.knots[k], end = curve.knots[k + 1];
        if (begin < end) found.push_back(begin + 0.5 * (end - begin));
    }
    return found;
}

Curves changed(const Arguments& arguments, Curves curves) {
    const std::string path = arguments.operand(0);
    const std::int32_t number =
        arguments.whole("--curve", 1, 1, static_cast<std::int32_t>(curves.curves.size())) - 1;
    if (arguments.has("--elevate")) {
        const Curve& curve = curves.curves[static_cast<std::size_t>(number)];
        curves = refined(path, curves, number, curve.degree + 1, {});
    }
    if (arguments.has("--halve"))
        curves = refined(path, curves, number, 0,
                         middles(curves.curves[static_cast<std::size_t>(number)]));
    if (arguments.has("--insert"))
        curves = refined(path, curves, number, 0, arguments.number_list("--insert"));
    return curves;
}

struct Wanted {
    std::string key, text;
    hm_quantity quantity;
};

hm_quantity quantity_of(std::int32_t kind, double station = 0) {
    auto quantity = sized<hm_quantity>();
    quantity.kind = kind;
    quantity.station = station;
    return quantity;
}

std::vector<Wanted> wanted_of(const Arguments& arguments, const std::vector<double>& box) {
    std::vector<Wanted> all = {
        {"area", "area", quantity_of(HM_AREA)},
        {"centroid_x", "centroid, x", quantity_of(HM_CENTROID_X)},
        {"centroid_y", "centroid, y", quantity_of(HM_CENTROID_Y)},
        {"moment_xx", "second moment xx", quantity_of(HM_MOMENT_XX)},
        {"moment_yy", "second moment yy", quantity_of(HM_MOMENT_YY)},
        {"moment_xy", "second moment xy", quantity_of(HM_MOMENT_XY)},
        {"chord", "chord", quantity_of(HM_CHORD)},
        {"chord_angle", "angle of the chord", quantity_of(HM_TWIST)},
        {"max_thickness", "largest thickness", quantity_of(HM_MAX_THICKNESS)},
        {"max_camber", "largest camber", quantity_of(HM_MAX_CAMBER)},
        {"leading_edge_radius", "leading-edge radius", quantity_of(HM_LEADING_EDGE_RADIUS)},
        {"trailing_edge_angle", "trailing-edge angle", quantity_of(HM_TRAILING_EDGE_ANGLE)},
        {"trailing_edge_gap", "trailing-edge gap", quantity_of(HM_TRAILING_EDGE_GAP)},
        {"min_radius", "smallest radius", quantity_of(HM_MIN_RADIUS)},
        {"curvature_variation", "curvature variation", quantity_of(HM_CURVATURE_VARIATION)}};
    if (arguments.has("--stations")) {
        for (const double station : stations_of(arguments)) {
            all.push_back({"thickness_" + brief(station), "thickness at " + brief(station),
                           quantity_of(HM_THICKNESS, station)});
            all.push_back({"camber_" + brief(station), "camber at " + brief(station),
                           quantity_of(HM_CAMBER, station)});
        }
    }
    if (!box.empty()) {
        all.push_back({"clearance", "clearance of the box", quantity_of(HM_CLEARANCE)});
        all.back().quantity.polygon = box.data();
        all.back().quantity.n_polygon = static_cast<std::int32_t>(box.size() / 2);
    }
    return all;
}

void print_measures(const Arguments& arguments, const Curves& curves) {
    const hm_section section = section_of(arguments);
    const CurvesView view(curves);
    std::vector<double> box;
    if (arguments.has("--box")) box = arguments.number_list("--box");
    if (box.size() % 2 != 0) arguments.refuse("--box expects pairs x,y of numbers");
    JsonObject object;
    object.add("points", curves.points())
        .add("curves", static_cast<std::int32_t>(curves.curves.size()));
    for (const Wanted& wanted : wanted_of(arguments, box)) {
        double value = 0, at[2] = {};
        hm_error error = {};
        const hm_status status =
            hm_measure(view.get(), &section, 1, &wanted.quantity, &value, at, nullptr, &error);
        if (status == HM_BAD_ARGUMENT) refuse(error, arguments.operand(0));
        if (arguments.has("--json")) {
            if (status >= 0) object.add(wanted.key, value);
        } else if (status < 0) {
            print("%-22s none: %s\n", wanted.text.c_str(), error.text);
        } else {
            print("%-22s %-12s at x = %s, y = %s\n", wanted.text.c_str(), brief(value).c_str(),
                  brief(at[0]).c_str(), brief(at[1]).c_str());
        }
    }
    if (arguments.has("--json")) print("%s\n", object.text().c_str());
}

}  // namespace

void run_curve(const Arguments& arguments) {
    const Curves curves = changed(arguments, read_curves(arguments.operand(0)));
    OutputFiles files;
    if (arguments.has("-o")) write_curve_file(files, arguments.text("-o"), curves);
    print_measures(arguments, curves);
    files.commit();
}

}  // namespace cli
