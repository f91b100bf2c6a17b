// harmorph fit: fits a B-spline to the points of a marker, and writes the curve to a file.
#include "basics/json.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "curves/curve_file.hpp"
#include "curves/section.hpp"
#include "files/output_file.hpp"
#include "files/paths.hpp"
#include "mesh/mesh_analysis.hpp"
#include "work/read_mesh.hpp"

#include <harmorph_design.h>

#include <algorithm>
#include <system_error>

namespace cli {

namespace {

// [chord] A curve that is farther from the polygon of the points is reported.
constexpr double largest_departure = .002;

struct Fit {
    Curves curves;
    hm_fit_report report = sized<hm_fit_report>();
    bool is_asked = false;  // whether the closure is that of --closed
};

// The ordered points of a piece of the boundary of a mesh, or of a file with a section.
struct Outline {
    std::vector<std::int32_t> numbers;  // numbers of the points in the mesh, or in the file
    std::vector<double> x, y;
    bool is_loop;
    std::string name;    // of an element of a file with several sections, or empty
    std::string layout;  // of a file with sections, or empty

    Outline(const Mesh& mesh, const BoundaryPiece& piece)
        : numbers(piece.points), is_loop(piece.is_loop) {
        for (const std::int32_t point : piece.points) {
            x.push_back(mesh.x[static_cast<std::size_t>(point)]);
            y.push_back(mesh.y[static_cast<std::size_t>(point)]);
        }
    }
    explicit Outline(const Section& section, const std::string& element = {})
        : x(section.x),
          y(section.y),
          is_loop(section.is_loop),
          name(element),
          layout(section.layout) {
        for (std::size_t k = 0; k < x.size(); ++k) numbers.push_back(static_cast<std::int32_t>(k));
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
    return arguments.choice("--closed", {{"auto", HM_CLOSED_AUTO},
                                         {"periodic", HM_PERIODIC},
                                         {"tied", HM_TIED},
                                         {"open", HM_OPEN}});
}

hm_fit_options fit_options(const Arguments& arguments) {
    auto options = sized<hm_fit_options>();
    options.degree = arguments.whole("--degree", 3, 1, 5);
    options.n_control = arguments.whole("--points", 20, options.degree + 1, INT32_MAX);
    options.closed = closed_option(arguments);
    return options;
}

// Reads lines "point weight" with the numbers that the points have in the mesh, or in the file.
std::vector<double> read_weights(const std::string& path, const Outline& outline) {
    const TextFile file(path);
    LineReader lines(file, '#');
    std::vector<double> weights(outline.x.size(), 1);
    std::vector<bool> named(outline.x.size());
    while (lines.next()) {
        const auto& words = lines.words();
        std::int32_t point = 0;
        double weight = 0;
        if (words.size() != 2 || !parse(words[0], point) || !parse(words[1], weight) ||
            !(weight >= 0 && weight <= 1e30))
            lines.expected("a point and a weight between 0 and 1e30");
        const auto found = std::find(outline.numbers.begin(), outline.numbers.end(), point);
        if (found == outline.numbers.end())
            lines.expected("a point of the boundary that is fitted", words[0]);
        const auto at = static_cast<std::size_t>(found - outline.numbers.begin());
        if (named[at]) lines.fail("point " + std::to_string(point) + " has a weight already");
        named[at] = true;
        weights[at] = weight;
    }
    return weights;
}

void take_direction(const Arguments& arguments, const std::string& option, double& x, double& y) {
    if (!arguments.has(option)) return;
    const std::vector<double> numbers = arguments.number_list(option);
    if (numbers.size() != 2 || (numbers[0] == 0 && numbers[1] == 0))
        arguments.refuse(option + " expects a direction X,Y");
    x = numbers[0];
    y = numbers[1];
}

hm_fit_details fit_details(const Arguments& arguments, const std::vector<double>& weights) {
    auto details = sized<hm_fit_details>();
    if (!weights.empty()) {
        details.weights = weights.data();
        details.n_weights = static_cast<std::int32_t>(weights.size());
    }
    if (arguments.has("--smooth")) details.smoothing = arguments.positive("--smooth", 0);
    if (arguments.has("--tolerance")) details.tolerance = arguments.positive("--tolerance", 0);
    take_direction(arguments, "--begin", details.begin_x, details.begin_y);
    take_direction(arguments, "--end", details.end_x, details.end_y);
    return details;
}

// `path` is the file of the points, which error messages name.
Fit fit(const std::string& path, const Outline& outline, const hm_fit_options& options) {
    Fit fit;
    fit.is_asked = options.closed != HM_CLOSED_AUTO;
    Block block;
    const hm_curves* curves = nullptr;
    const hm_points points = {outline.x.data(), outline.y.data(), 1};
    const std::int32_t is_loop = outline.is_loop;
    const hm_status status = with_memory(block, [&](hm_memory* memory) {
        return call(path, hm_fit, &curves, memory, &points, outline.points(), is_loop, &options,
                    &fit.report);
    });
    if (status == HM_FAR_FROM_POINTS) {
        throw Failure(exit_unusable, path + ": " + plural(options.n_control, "control point") +
                                         " do not reach the tolerance; the largest error is " +
                                         brief(fit.report.max_error));
    }
    fit.curves = copied(*curves);
    return fit;
}

std::string reason_of_closure(const Fit& fit, const Outline& outline) {
    if (!outline.is_loop) return "the boundary is not closed";
    if (fit.is_asked) return "asked for";
    if (fit.report.closed == HM_PERIODIC) return "no corner was found";
    const auto first = static_cast<std::size_t>(fit.report.first_point);
    const std::string at = "x = " + brief(outline.x[first]) + ", y = " + brief(outline.y[first]);
    if (fit.report.base_points == 0)
        return plural(fit.report.corners, "corner") + " and no blunt base; it begins at " + at;
    return "there is a straight blunt base of " + plural(fit.report.base_points, "point") +
           " from " + at;
}

void warn_about(const Fit& fit, const Outline& outline) {
    const std::string element = outline.name.empty() ? "" : outline.name + ": ";
    if (fit.report.backtrack_point >= 0) {
        const auto from = static_cast<std::size_t>(fit.report.backtrack_point),
                   to = (from + 1) % outline.x.size();
        warn(element + "between points " + std::to_string(outline.numbers[from]) + " and " +
             std::to_string(outline.numbers[to]) + " (x = " + brief(outline.x[from]) +
             ", y = " + brief(outline.y[from]) +
             ") the curve runs against the order of the points; look at the curve there, and use "
             "fewer control points or a lower degree");
    }
    const double chord = outline.chord();
    if (fit.report.max_departure > largest_departure * chord) {
        const auto departure = static_cast<std::size_t>(fit.report.departure_point);
        warn(element + "between the points the curve is up to " +
             brief(fit.report.max_departure / chord) +
             " chord off the lines that connect them, behind the point x = " +
             brief(outline.x[departure]) + ", y = " + brief(outline.y[departure]) +
             "; more points there, fewer control points or --smooth help");
    }
}

void print_for_people(const Fit& fit, const Outline& outline, const std::string& from,
                      const std::string& path) {
    const double chord = outline.chord();
    const auto worst = static_cast<std::size_t>(fit.report.max_error_point);
    if (!outline.name.empty()) print("%s\n", outline.name.c_str());
    print("%s: degree %d, through %s of %s\n", plural(fit.curves.points(), "control point").c_str(),
          fit.curves.curves[0].degree, plural(outline.points(), "point").c_str(), from.c_str());
    if (!outline.layout.empty()) print("layout         %s\n", outline.layout.c_str());
    print("closed         %s: %s\n", closed_name(fit.report.closed),
          reason_of_closure(fit, outline).c_str());
    print("largest error  %s chord, at x = %s, y = %s\n",
          brief(fit.report.max_error / chord).c_str(), brief(outline.x[worst]).c_str(),
          brief(outline.y[worst]).c_str());
    print("rms error      %s chord (chord: %s)\n", brief(fit.report.rms_error / chord).c_str(),
          brief(chord).c_str());
    print("between points %s chord off the lines that connect the points, at most\n",
          brief(fit.report.max_departure / chord).c_str());
    print("written        %s\n", path.c_str());
}

// The object describes the element with the largest error.
void print_json(const std::vector<Fit>& fits, const std::vector<Outline>& outlines) {
    std::size_t worst = 0;
    for (std::size_t k = 1; k < fits.size(); ++k)
        if (fits[k].report.max_error > fits[worst].report.max_error) worst = k;
    const Fit& fit = fits[worst];
    JsonObject object;
    object.add("points", fit.curves.points()).add("degree", fit.curves.curves[0].degree);
    object.add("closed", std::string(closed_name(fit.report.closed)));
    object.add("corners", fit.report.corners).add("base_points", fit.report.base_points);
    object.add("backtracks", fit.report.backtrack_point >= 0);
    object.add("max_error", fit.report.max_error).add("rms_error", fit.report.rms_error);
    object.add("max_departure", fit.report.max_departure);
    object.add("elements", static_cast<std::int32_t>(fits.size()));
    object.add("layout", outlines[worst].layout);
    print("%s\n", object.text().c_str());
}

// The ending leaves errors in a curve file to the reader of curves.
bool is_curve(const TextFile& file) {
    return is_curve_file(file) || ends_with(file.path(), ".curve");
}

// Files of sections, grids and curves may have any ending. The options decide, or else the content.
bool is_mesh(const Arguments& arguments, const std::string& path) {
    if (arguments.has("--format") || arguments.has("--zone")) return true;
    if (is_folder(path)) return true;
    const TextFile file(path);
    if (is_mesh_file(file)) return true;
    if (is_curve(file) || is_section_file(file)) return false;
    const bool is_binary = file.text().substr(0, 1024).find('\0') != std::string_view::npos;
    return arguments.has("--marker") || is_binary;  // the readers say what is wrong
}

Outline outline_of_mesh(const Arguments& arguments) {
    const std::string tags = arguments.text("--marker");
    const Mesh mesh = read_mesh(arguments, 0);
    std::vector<std::int32_t> markers;
    const std::vector<MarkerPiece> pieces = mesh.find_pieces(tags);
    for (const MarkerPiece& piece : pieces) markers.push_back(piece.marker);
    if (!pieces[0].is_piece) return Outline(mesh, MeshAnalysis(mesh).boundary(markers));
    if (pieces.size() > 1)
        arguments.refuse("--marker takes one piece MARKER@X:Y, or whole markers");
    const Point near = {pieces[0].x, pieces[0].y};
    return Outline(mesh, MeshAnalysis(mesh).boundary(markers, &near));
}

std::vector<Outline> outlines_of(const Arguments& arguments, const std::string& path) {
    if (is_mesh(arguments, path)) {
        if (arguments.has("--element"))
            arguments.refuse("--element needs a file of sections, but " + path + " is not one");
        return {outline_of_mesh(arguments)};
    }
    if (arguments.has("--marker"))
        arguments.refuse("--marker needs a mesh, but " + path + " is not a mesh");
    if (is_curve(TextFile(path))) return {Outline(sampled(read_curves(path)))};
    std::vector<Section> sections;
    if (arguments.has("--element"))
        sections = {read_section(path, arguments.whole("--element", 1, 1, INT32_MAX))};
    else sections = read_sections(path);
    std::vector<Outline> outlines;
    for (const Section& section : sections) {
        const bool is_one = sections.size() == 1;
        outlines.emplace_back(section,
                              is_one ? "" : "element " + std::to_string(outlines.size() + 1));
        for (const std::string& warning : section.warnings) warn(warning);
    }
    return outlines;
}

Fit fit_of(const Arguments& arguments, const std::string& from, const Outline& outline) {
    hm_fit_options options = fit_options(arguments);
    std::vector<double> weights;
    if (arguments.has("--weights")) weights = read_weights(arguments.text("--weights"), outline);
    const hm_fit_details details = fit_details(arguments, weights);
    options.details = &details;
    if (details.tolerance > 0 && !arguments.has("--points"))
        options.n_control = std::min(outline.points(), 100);
    if (options.n_control > outline.points()) {
        arguments.refuse("--points " + std::to_string(options.n_control) +
                         ": the boundary itself has only " + plural(outline.points(), "point"));
    }
    return fit(from, outline, options);
}

}  // namespace

void run_fit(const Arguments& arguments) {
    const std::string path = arguments.text("-o"), from = arguments.operand(0);
    const std::vector<Outline> outlines = outlines_of(arguments, from);
    if (outlines.size() > 1 && arguments.has("--weights"))
        arguments.refuse("--weights needs --element, because the file has several elements");
    std::vector<Fit> fits;
    Curves curves;
    for (const Outline& outline : outlines) {
        fits.push_back(fit_of(arguments, from, outline));
        if (fits.size() == 1) curves = fits[0].curves;
        else curves.append(fits.back().curves);
    }
    OutputFiles files;
    write_curve_file(files, path, curves);
    files.commit();
    for (std::size_t k = 0; k < fits.size(); ++k) warn_about(fits[k], outlines[k]);
    if (arguments.has("--json")) return print_json(fits, outlines);
    for (std::size_t k = 0; k < fits.size(); ++k)
        print_for_people(fits[k], outlines[k], from, path);
}

}  // namespace cli
