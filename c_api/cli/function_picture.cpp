#include "pictures.hpp"

#include "colour_map.hpp"
#include "draw_curves.hpp"
#include "numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace cli {

namespace {

constexpr double bar_space = 110; // pixels beside the frame

struct Range {
    double low, high;
    double share(double value) const { return high > low ? (value - low) / (high - low) : 0; }
};

// A function is linear on each triangle. What lies between two of its levels is painted in one colour, all of it as one
// path: small files, and bands whose edges are the function's level lines.
class BandPainter {
public:
    BandPainter(Plot& plot, Range range) : plot_(plot), range_(range) {}

    void add(const std::array<Point, 3>& corners, const std::array<double, 3>& values) {
        Piece triangle;
        for (std::size_t i = 0; i < 3; ++i) triangle.push_back({corners[i], range_.share(values[i]) * bands});
        const auto [low, high] = std::minmax({triangle[0].level, triangle[1].level, triangle[2].level});
        const auto first = static_cast<std::size_t>(low);
        const auto last = std::max(first + 1, static_cast<std::size_t>(std::ceil(high))) - 1;
        for (std::size_t band = first; band <= last; ++band) {
            Piece piece = triangle;
            if (band > first) piece = part_above(piece, static_cast<double>(band), 1);
            if (band < last) piece = part_above(piece, static_cast<double>(band + 1), -1);
            if (piece.size() > 2) add(piece, std::min<std::size_t>(band, bands - 1));
        }
    }
    void paint() {
        for (std::size_t band = 0; band < bands; ++band) {
            const std::string shade = colour((static_cast<double>(band) + .5) / bands);
            // The line of the same colour covers the hair lines that renderers leave between neighbours.
            plot_.svg().path(paths_[band], "fill=\"" + shade + "\" stroke=\"" + shade + "\" stroke-width=\".5\"");
        }
    }

private:
    static constexpr std::size_t bands = 40;

    struct Corner {
        Point at;
        double level;
    };
    using Piece = std::vector<Corner>;

    // The part of a convex piece that lies above a level; with the sign -1 below it.
    static Piece part_above(const Piece& piece, double level, double sign) {
        Piece part;
        for (std::size_t i = 0; i < piece.size(); ++i) {
            const Corner& a = piece[i];
            const Corner& b = piece[(i + 1) % piece.size()];
            const double from = sign * (a.level - level), to = sign * (b.level - level);
            if (from >= 0) part.push_back(a);
            if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
                const double t = from / (from - to);
                part.push_back({{a.at.x + t * (b.at.x - a.at.x), a.at.y + t * (b.at.y - a.at.y)}, level});
            }
        }
        return part;
    }
    void add(const Piece& piece, std::size_t band) {
        paths_[band].move_to(plot_.pixel(piece[0].at));
        for (std::size_t i = 1; i < piece.size(); ++i) paths_[band].line_to(plot_.pixel(piece[i].at));
        paths_[band].close();
    }

    Plot& plot_;
    Range range_;
    std::array<SvgPath, bands> paths_;
};

void paint_cells(Plot& plot, const Mesh& mesh, const std::vector<double>& values, Range range) {
    BandPainter painter(plot, range);
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        const auto first = static_cast<std::size_t>(mesh.cell_start[cell]);
        const auto end = static_cast<std::size_t>(mesh.cell_start[cell + 1]);
        for (std::size_t i = first + 1; i + 1 < end; ++i) { // one triangle, or a quad's two
            std::array<Point, 3> corners;
            std::array<double, 3> at_corners;
            Box box;
            std::size_t k = 0;
            for (const std::size_t place : {first, i, i + 1}) {
                const auto corner = static_cast<std::size_t>(mesh.cell_points[place]);
                corners[k] = {mesh.x[corner], mesh.y[corner]};
                box.include(corners[k]);
                at_corners[k++] = values[corner];
            }
            if (box.overlaps(plot.window())) painter.add(corners, at_corners);
        }
    }
    painter.paint();
}

// A round number, so that five to ten ticks fit into the range.
double tick_distance(Range range) {
    const double rough = (range.high - range.low) / 10, power = std::pow(10, std::floor(std::log10(rough)));
    for (const double round : {1.0, 2.0, 5.0}) {
        if (rough <= round * power) return round * power;
    }
    return 10 * power;
}

void draw_colour_bar(Plot& plot, Range range) {
    const Box bar = {{plot.frame().high.x + 22, plot.frame().low.y}, {plot.frame().high.x + 44, plot.frame().high.y}};
    Svg& svg = plot.svg();
    svg.raw("<linearGradient id=\"colours\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">\n" + colour_gradient_stops() +
            "</linearGradient>\n");
    svg.rectangle(bar, "fill=\"url(#colours)\" stroke=\"#666\" stroke-width=\".8\"");
    if (!(range.high > range.low)) return;
    const double distance = tick_distance(range);
    for (double i = std::ceil(range.low / distance); i * distance <= range.high; ++i) {
        const double value = i * distance + 0.0; // not -0
        const double y = bar.high.y - range.share(value) * bar.height();
        svg.line({bar.high.x, y}, {bar.high.x + 6, y}, "stroke=\"#444\"");
        svg.text({bar.high.x + 10, y + 5}, brief(value), "font-size=\"14\" fill=\"#222\"");
    }
}

void mark_control_point(Plot& plot, const hm_curves& curves, std::int32_t function) {
    const Point at = plot.pixel(control_point(curves, function));
    plot.svg().circle(at, 7, "fill=\"#ff3b30\" stroke=\"white\" stroke-width=\"2\"");
    draw_number(plot, curves, function, -20, "font-size=\"16\" font-weight=\"bold\" fill=\"#111\"");
}

std::string operator_name(const hm_basis_info& info) {
    if (info.operator_kind == HM_LAPLACE) return "Harmonic";
    return std::string(info.operator_kind == HM_CONFORMAL ? "Conformal" : "Weighted harmonic") + ", exponent " +
           brief(info.exponent_quarters / 4.0) + ",";
}

// Which of a value's numbers the column has.
std::string number_name(const hm_basis_info& info, const Column& column) {
    if (info.numbers_per_value == 1) return "";
    if (info.numbers_per_value == 2) return column.name == "value" ? ", real part" : ", imaginary part";
    return ", component " + column.name;
}

// Each rigid body has a function for its shift and one for its turn, after those of the control points.
std::string boundary_values(const hm_curves& curves, std::int32_t function) {
    if (function < curves.n_control) {
        return "on the curve it is the B-spline basis function of control point " + std::to_string(function + 1);
    }
    return std::string("it ") + ((function - curves.n_control) % 2 == 0 ? "shifts" : "turns") + " a rigid body";
}

} // namespace

std::string function_picture(const Mesh& mesh, const Basis& basis, std::int32_t function,
                             const Column& column) {
    const Box window = window_round({box_of(basis.curves()), box_of_bodies(basis.info(), mesh.x, mesh.y)}, .4);
    return function_picture(mesh, basis, function, column, window);
}

std::string function_picture(const Mesh& mesh, const Basis& basis, std::int32_t function, const Column& column,
                             const Box& window) {
    const hm_curves& curves = basis.curves();
    const std::vector<double>& values = column.values;
    const auto ends = std::minmax_element(values.begin(), values.end());
    const Range range = {*ends.first, *ends.second};
    Plot plot(window,
              "Function " + std::to_string(function + 1) + " of " + std::to_string(basis.functions()) +
                  number_name(basis.info(), column),
              operator_name(basis.info()) + " in the mesh; " + boundary_values(curves, function) + "; values " +
                  brief(range.low) + " to " + brief(range.high),
              bar_space);
    plot.begin_inside();
    paint_cells(plot, mesh, values, range);
    draw_outlines(plot, curves, "stroke=\"white\" stroke-width=\"2.5\"");
    draw_control_polygons(plot, curves, "stroke=\"white\" stroke-width=\".8\" stroke-dasharray=\"4 4\"");
    draw_control_points(plot, curves, 3.5, "fill=\"white\" stroke=\"#333\"");
    if (function < curves.n_control) mark_control_point(plot, curves, function);
    plot.end_inside();
    draw_colour_bar(plot, range);
    return plot.svg().document();
}

} // namespace cli
