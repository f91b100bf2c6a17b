#include "basics/numbers.hpp"
#include "options/operators.hpp"
#include "pictures/contour_lines.hpp"
#include "pictures/draw_curves.hpp"
#include "pictures/function_bands.hpp"
#include "pictures/mesh_lines.hpp"
#include "pictures/pictures.hpp"
#include "pictures/plot.hpp"
#include "pictures/triangles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cli {

namespace {

// Draws contour lines, with values written on some of them.

// Returns the line in pixels, without points that are not visibly apart from the preceding one.
std::vector<Point> in_pixels(const Plot& plot, const ContourLine& line) {
    constexpr double visible = .4;
    std::vector<Point> pixels;
    for (const Point& point : line.points) {
        const Point pixel = plot.pixel(point);
        if (pixels.empty() || distance(pixels.back(), pixel) >= visible) pixels.push_back(pixel);
    }
    if (pixels.size() > 1) pixels.back() = plot.pixel(line.points.back());
    return pixels;
}

// Writes values on lines, inside the frame, at the points farthest from the values already written.
class Labels {
public:
    Labels(Plot& plot, const std::vector<Point>& taken) : plot_(plot), taken_(taken) {}

    void add(const std::vector<Point>& line, const std::string& text) {
        constexpr double min_length = 90, min_room = 46;
        double length = 0;
        for (std::size_t i = 1; i < line.size(); ++i) length += distance(line[i - 1], line[i]);
        if (length < min_length) return;
        double best_room = min_room;
        std::size_t best = 0;
        for (std::size_t i = 2; i + 2 < line.size(); ++i) {
            const double room = room_at(line[i]);
            if (room > best_room) {
                best_room = room;
                best = i;
            }
        }
        if (best == 0) return;
        write(text, line[best], line[best - 2], line[best + 2]);
        places_.push_back(line[best]);
    }

private:
    double room_at(Point at) const {
        constexpr double border = 22, far = 400;
        const Box& frame = plot_.frame();
        if (at.x < frame.low.x + border || at.x > frame.high.x - border) return 0;
        if (at.y < frame.low.y + border || at.y > frame.high.y - border) return 0;
        double room = far;
        for (const Point& place : places_) room = std::min(room, distance(at, place));
        for (const Point& place : taken_) {
            if (distance(at, place) < 34) room = 0;
        }
        return room;
    }

    // Writes the value along the line, never upside down.
    void write(const std::string& text, Point at, Point before, Point after) {
        double angle = std::atan2(after.y - before.y, after.x - before.x) * 180 / pi;
        if (angle > 90) angle -= 180;
        if (angle < -90) angle += 180;
        const std::string turn =
            "transform=\"rotate(" + pixels(angle) + " " + pixels(at.x) + " " + pixels(at.y) + ")\"";
        const char* const style =
            "font-size=\"12\" fill=\"#111\" stroke=\"white\" stroke-width=\"3\" "
            "stroke-linejoin=\"round\" paint-order=\"stroke\" text-anchor=\"middle\" "
            "dy=\".35em\" ";
        plot_.svg().text({at.x, at.y}, text, style + turn);
    }

    Plot& plot_;
    const std::vector<Point>& taken_;
    std::vector<Point> places_;  // places of values
};

// taken: places where no value may be written [pixels].
void draw_contours(Plot& plot, const std::vector<ContourLine>& lines, double step,
                   const std::vector<Point>& taken) {
    std::vector<std::pair<std::vector<Point>, std::string>> drawn;
    SvgPath path;
    for (const ContourLine& line : lines) {
        std::vector<Point> pixels = in_pixels(plot, line);
        if (pixels.size() < 2) continue;
        path.move_to(pixels[0]);
        for (std::size_t i = 1; i < pixels.size(); ++i) path.line_to(pixels[i]);
        drawn.emplace_back(std::move(pixels), brief(line.multiple * step + 0.0));
    }
    plot.svg().path(path,
                    "fill=\"none\" stroke=\"#10222e\" stroke-width=\".8\" stroke-opacity=\".75\"");
    std::stable_sort(drawn.begin(), drawn.end(),
                     [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); });
    Labels labels(plot, taken);
    for (const auto& [pixels, text] : drawn) labels.add(pixels, text);
}

namespace function_style {
constexpr const char* wall = "stroke=\"#111\" stroke-width=\"1.8\"";
constexpr const char* curve = "stroke=\"#111\" stroke-width=\"1.8\"";
constexpr const char* polygon = "stroke=\"#555\" stroke-width=\".8\"";
constexpr const char* control = "fill=\"white\" stroke=\"#111\" stroke-width=\"1.2\"";
constexpr const char* chosen = "fill=\"none\" stroke=\"#d6006c\" stroke-width=\"2.6\"";
}  // namespace function_style

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void include(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    double max_size() const { return std::max(std::fabs(low), std::fabs(high)); }
};

// Returns the range of the values that the window shows.
Range visible_range(const Mesh& mesh, const std::vector<FunctionPanel>& panels, const Box& window) {
    Range range;
    for_each_triangle(mesh, window, [&](const Corners& corners) {
        for (const FunctionPanel& panel : panels) {
            for (const std::int32_t corner : corners)
                range.include(panel.values[static_cast<std::size_t>(corner)]);
        }
    });
    if (!(range.low <= range.high)) return {0, 1};
    const double rounding = 1e-9 * range.max_size();
    if (std::fabs(range.low) <= rounding) range.low = 0;
    if (std::fabs(range.high) <= rounding) range.high = 0;
    return range;
}

Range range_of(const FunctionPanel& panel) {
    const auto ends = std::minmax_element(panel.values.begin(), panel.values.end());
    return {*ends.first, *ends.second};
}

const OperatorName& operator_of(const FunctionPanel& panel) {
    return operator_named(panel.basis->info().operator_kind);
}

std::string functions_of(const FunctionPanel& panel) { return operator_of(panel).functions; }

std::string exponent(const FunctionPanel& panel) {
    if (!operator_of(panel).has_exponent) return "";
    return "exponent " + brief(panel.basis->info().exponent);
}

// Names the number of a value that a panel shows.
std::string number_name(const FunctionPanel& panel) {
    static const char* const complex[] = {"real part", "imaginary part"};
    static const char* const matrix[] = {"xx", "xy", "yx", "yy"};
    const std::int32_t numbers = panel.basis->info().numbers_per_value;
    return numbers == 1   ? ""
           : numbers == 2 ? complex[panel.number]
                          : std::string("component ") + matrix[panel.number];
}

// Functions of control points have the numbers of the control points; each rigid body has a
// function for its translation and one for its rotation.
std::string subject(const FunctionPanel& panel) {
    const hm_curves& curves = panel.basis->curves();
    const std::int32_t body_function = panel.function - curves.n_control;
    if (body_function >= 0)
        return std::string(body_function % 2 == 0 ? "shift" : "turn") + " of a rigid body";
    std::string text = "control point " + std::to_string(panel.function + 1);
    if (curves.n_curves < 2) return text;
    for (std::int32_t i = 0; i < curves.n_curves; ++i) {
        const std::int32_t place = place_on_curve(curves, i, panel.function);
        if (place >= 0)
            return text + " (point " + std::to_string(place + 1) + " of curve " +
                   std::to_string(i + 1) + ")";
    }
    return text;
}

std::string rounded(double value) {
    std::string text;
    append_number(text, 'g', 2, value + 0.0);
    return text;
}

std::string joined(const std::string& a, const std::string& b) {
    return a.empty() || b.empty() ? a + b : a + ", " + b;
}

std::string capitalised(std::string text) {
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

// Returns true if all panels have the same text.
template <class Text>
bool common(const std::vector<FunctionPanel>& panels, Text text) {
    return std::all_of(panels.begin(), panels.end(),
                       [&](const FunctionPanel& panel) { return text(panel) == text(panels[0]); });
}

struct Words {
    std::string title, subtitle, quantity;
    std::vector<std::string> heads;
};

// Puts words that are the same for all panels into title and subtitle, and the others into the
// headings of the panels.
Words words_of(const std::vector<FunctionPanel>& panels) {
    const auto kind = [](const FunctionPanel& panel) {
        return joined(functions_of(panel), exponent(panel));
    };
    const bool one_subject = common(panels, subject), one_kind = common(panels, kind),
               one_number = common(panels, number_name);
    const bool of_bodies = panels[0].function >= panels[0].basis->n_control();
    Words words;
    words.title = one_subject ? "Function of " + subject(panels[0])
                              : "Functions of " + std::to_string(panels.size()) + " control points";
    if (one_kind) words.subtitle = capitalised(kind(panels[0]));
    if (one_number) words.subtitle = joined(words.subtitle, number_name(panels[0]));
    words.subtitle += words.subtitle.empty() ? "On" : "; on";
    words.subtitle += of_bodies
                          ? " other boundaries it is 0"
                          : " its curve each is the B-spline basis function of its control point";
    if (panels.size() == 1) {
        words.subtitle =
            joined(capitalised(kind(panels[0])), number_name(panels[0])) +
            (of_bodies ? "" : "; on the curve: the B-spline basis function of the control point");
        const Range range = range_of(panels[0]);
        words.subtitle +=
            "; from " + brief(range.low + 0.0) + " to " + brief(range.high) + " in the whole mesh";
    }
    words.quantity = joined("value of the function", one_number ? number_name(panels[0]) : "");
    for (const FunctionPanel& panel : panels) {
        std::string head = one_subject ? "" : subject(panel);
        if (!one_kind)
            head =
                joined(head, common(panels, functions_of) ? exponent(panel) : functions_of(panel));
        if (!one_number) head = joined(head, number_name(panel));
        const Range range = range_of(panel);
        words.heads.push_back(capitalised(head) + ": " + rounded(range.low) + " to " +
                              rounded(range.high));
    }
    return words;
}

void draw_curves(Plot& plot, const FunctionPanel& panel) {
    const hm_curves& curves = panel.basis->curves();
    draw_outlines(plot, curves, function_style::curve);
    draw_control_polygons(plot, curves, function_style::polygon);
    draw_control_points(plot, curves, 3, function_style::control);
    if (panel.function < curves.n_control)
        plot.svg().circle(plot.pixel(control_point(curves, panel.function)), 7,
                          function_style::chosen);
    draw_numbers(plot, curves, {13, 11, "fill=\"#111\""}, panel.function,
                 {18, 15, "font-weight=\"bold\" fill=\"#a80055\""});
}

}  // namespace

Box function_window(const Mesh& mesh, const Basis& basis) {
    const Box near =
        window_round({box_of(basis.curves()), box_of_bodies(basis.info(), mesh.x, mesh.y)}, .4);
    Box all;
    for (std::size_t point = 0; point < mesh.x.size(); ++point)
        all.include(Point{mesh.x[point], mesh.y[point]});
    return near.common(all.widened(.02 * std::max(all.width(), all.height())));
}

double contour_step(const Mesh& mesh, const std::vector<FunctionPanel>& panels, const Box& window) {
    const Range range = visible_range(mesh, panels, window);
    return Bands(range.low, range.high).step;
}

std::string function_picture(const Mesh& mesh, std::vector<FunctionPanel> panels,
                             const std::optional<Box>& wished) {
    const Words words = words_of(panels);
    const hm_curves& curves = panels[0].basis->curves();
    Sheet sheet(wished ? *wished : function_window(mesh, *panels[0].basis), words.title,
                words.subtitle, {panels.size(), colour_bar_width});
    const Range range = visible_range(mesh, panels, sheet.plot().window());
    const Bands bands(range.low, range.high);
    std::string note;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        for (double& value : panels[k].values) {
            if (std::fabs(value) <= 1e-9 * range.max_size()) value = 0;
        }
        Plot& plot = sheet.plot(k);
        if (panels.size() > 1) sheet.head(k, words.heads[k]);
        plot.begin_inside();
        note = paint_function(plot, mesh, panels[k].values, bands);
        std::vector<Point> numbers;  // places of the numbers of control points
        for (std::int32_t i = 0; i < panels[k].basis->curves().n_control; ++i) {
            numbers.push_back(plot.pixel(control_point(panels[k].basis->curves(), i)));
        }
        draw_contours(plot, contour_lines(mesh, panels[k].values, bands.step, plot.window()),
                      bands.step, numbers);
        draw_boundary(plot, mesh, -1, function_style::wall);
        draw_curves(plot, panels[k]);
        plot.end_inside();
    }
    draw_colour_bar(sheet, bands, words.quantity);
    sheet.legend_line("stroke=\"#10222e\" stroke-width=\".8\"",
                      "contour lines, every " + brief(bands.step));
    if (curves.n_control > 0) {
        sheet.legend_line(function_style::curve, "B-spline");
        sheet.legend_disc(3, function_style::control, "control points, numbered as in moves.txt");
        sheet.legend_disc(7, function_style::chosen, "control point of the function");
    }
    sheet.note(note);
    return sheet.document();
}

}  // namespace cli
