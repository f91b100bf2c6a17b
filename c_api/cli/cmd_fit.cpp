// harmorph fit: from a marker of the mesh to a B-spline in a file.
#include "commands.hpp"
#include "curve_file.hpp"
#include "json.hpp"
#include "mesh_analysis.hpp"
#include "numbers.hpp"
#include "output_file.hpp"

#include <algorithm>
#include <cstdio>

namespace cli {

namespace {

struct Fit {
    Curves curves;
    hm_fit_report report = sized<hm_fit_report>();
};

// The points of a piece of boundary, in order.
struct Outline {
    std::vector<double> x, y;
    bool is_loop;

    Outline(const Mesh& mesh, const BoundaryPiece& piece) : is_loop(piece.is_loop) {
        for (const std::int32_t point : piece.points) {
            x.push_back(mesh.x[static_cast<std::size_t>(point)]);
            y.push_back(mesh.y[static_cast<std::size_t>(point)]);
        }
    }
    std::int32_t points() const { return static_cast<std::int32_t>(x.size()); }
    double chord() const { return std::max(extent(x), extent(y)); }

private:
    static double extent(const std::vector<double>& values) {
        const auto range = std::minmax_element(values.begin(), values.end());
        return *range.second - *range.first;
    }
};

std::int32_t closed_option(const Arguments& arguments) {
    if (!arguments.has("--closed")) return HM_CLOSED_AUTO;
    const std::string closed = arguments.text("--closed");
    if (closed == "auto") return HM_CLOSED_AUTO;
    if (closed == "periodic") return HM_PERIODIC;
    if (closed == "tied") return HM_TIED;
    arguments.refuse("--closed expects auto, periodic or tied, found " + quoted(closed));
}

hm_fit_options fit_options(const Arguments& arguments) {
    auto options = sized<hm_fit_options>();
    options.degree = arguments.whole("--degree", 3, 1, 5);
    options.n_control = arguments.whole("--points", 20, options.degree + 1, INT32_MAX);
    options.closed = closed_option(arguments);
    return options;
}

// Out of the library's block, which goes away.
Curves copy(const hm_curves& from, const hm_fit_report& report) {
    Curves to;
    to.control.assign(from.control, from.control + 2 * from.n_control);
    for (std::int32_t i = 0; i < from.n_curves; ++i) {
        const hm_curve& curve = from.curve[i];
        Curve copied;
        copied.degree = curve.degree;
        copied.closed = i == 0 ? report.closed : std::int32_t{HM_OPEN}; // the second is a blunt base
        copied.indices = default_indices(curve.n_indices, curve.degree, HM_OPEN);
        if (curve.indices) copied.indices.assign(curve.indices, curve.indices + curve.n_indices);
        copied.knots.assign(curve.knots, curve.knots + curve.n_indices + curve.degree + 1);
        to.curves.push_back(copied);
    }
    return to;
}

Fit fit(const Mesh& mesh, const Outline& outline, const hm_fit_options& options) {
    Fit fit;
    std::size_t bytes = 0;
    call(mesh, hm_fit_size, outline.points(), &options, &bytes);
    Block block(bytes);
    const hm_curves* curves = nullptr;
    const hm_points points = {outline.x.data(), outline.y.data(), 1};
    call(mesh, hm_fit, &curves, block.data(), bytes, &points, outline.points(), std::int32_t{outline.is_loop}, &options,
         &fit.report);
    fit.curves = copy(*curves, fit.report);
    return fit;
}

void print_for_people(const Fit& fit, const Outline& outline, const std::string& path) {
    const double chord = outline.chord();
    const auto worst = static_cast<std::size_t>(fit.report.max_error_point);
    std::printf("%s: degree %d, %s, through %s of the mesh%s\n", plural(fit.curves.points(), "control point").c_str(),
                fit.curves.curves[0].degree, closed_name(fit.report.closed), plural(outline.points(), "point").c_str(),
                fit.report.base_points > 0 ? ", with a straight blunt base" : "");
    std::printf("largest error  %s chord, at x = %s, y = %s\n", brief(fit.report.max_error / chord).c_str(),
                brief(outline.x[worst]).c_str(), brief(outline.y[worst]).c_str());
    std::printf("rms error      %s chord (chord: %s)\n", brief(fit.report.rms_error / chord).c_str(),
                brief(chord).c_str());
    std::printf("written        %s\n", path.c_str());
}

void print_json(const Fit& fit) {
    JsonObject object;
    object.add("points", fit.curves.points()).add("degree", fit.curves.curves[0].degree);
    object.add("max_error", fit.report.max_error).add("rms_error", fit.report.rms_error);
    std::printf("%s\n", object.text().c_str());
}

void run(const Arguments& arguments) {
    const hm_fit_options options = fit_options(arguments);
    const std::string path = arguments.text("-o"), tags = arguments.text("--marker");
    const Mesh mesh = read_mesh(arguments, 0);
    const Outline outline(mesh, MeshAnalysis(mesh).boundary(mesh.find_markers(tags)));
    if (options.n_control > outline.points()) {
        arguments.refuse("--points " + std::to_string(options.n_control) + ": the boundary itself has only " +
                         plural(outline.points(), "point"));
    }
    const Fit result = fit(mesh, outline, options);
    OutputFiles files;
    write_curves(files.add(path), result.curves);
    files.commit();
    if (arguments.has("--json")) {
        print_json(result);
    } else {
        print_for_people(result, outline, path);
    }
}

} // namespace

const Command fit_command = {
    "fit",
    {"MESH"},
    "Fits a B-spline to a boundary of the mesh",
    "The points of the markers, which must form one piece of boundary, are approximated by least squares. The curve\n"
    "and its control points go to a small text file that `harmorph solve` reads. Errors are distances of the mesh's\n"
    "points from the curve: in chords (the boundary's largest extent) for people, in the mesh's unit with --json.\n",
    {{"--marker", "A[,B..]", "markers of the boundary (required)"},
     {"--degree", "P", "degree of the curve, 1 to 5 (default 3)"},
     {"--points", "N", "number of control points (default 20)"},
     {"--closed", "HOW", "periodic: smooth all round; tied: both ends are one control point, for a sharp trailing edge;\n"
                         "auto (default): as the boundary's corners ask for"},
     {"-o", "CURVE", "file to write (required)"},
     format_option,
     zone_option,
     {"--json", nullptr, "print one JSON object: points, degree, max_error, rms_error"}},
    "  harmorph fit naca0012.su2 --marker airfoil --points 20 -o airfoil.curve\n",
    run};

} // namespace cli
