#include "pictures.hpp"

#include "colour_map.hpp"
#include "draw_curves.hpp"
#include "numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cli {

namespace {

constexpr double bar_space = 110; // pixels beside the frame

struct Range {
    double low, high;
    double share(double value) const { return high > low ? (value - low) / (high - low) : 0; }
};

// Cells are painted in so many colours, each of them one path: small files, and steps too fine to be seen.
class CellPainter {
public:
    CellPainter(Plot& plot, Range range) : plot_(plot), range_(range) {}

    void add(const std::vector<Point>& corners, double value) {
        const auto level = static_cast<std::size_t>(range_.share(value) * (levels - 1) + .5);
        SvgPath& path = paths_[std::min<std::size_t>(level, levels - 1)];
        path.move_to(plot_.pixel(corners[0]));
        for (std::size_t i = 1; i < corners.size(); ++i) path.line_to(plot_.pixel(corners[i]));
        path.close();
    }
    void paint() {
        for (std::size_t level = 0; level < levels; ++level) {
            const std::string shade = colour(static_cast<double>(level) / (levels - 1));
            // The line of the same colour covers the hair lines that renderers leave between neighbours.
            plot_.svg().path(paths_[level], "fill=\"" + shade + "\" stroke=\"" + shade + "\" stroke-width=\".5\"");
        }
    }

private:
    static constexpr std::size_t levels = 128;

    Plot& plot_;
    Range range_;
    std::array<SvgPath, levels> paths_;
};

void paint_cells(Plot& plot, const Mesh& mesh, const std::vector<double>& values, Range range) {
    CellPainter painter(plot, range);
    std::vector<Point> corners;
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        corners.clear();
        Box box;
        double sum = 0;
        for (std::int32_t i = mesh.cell_start[cell]; i < mesh.cell_start[cell + 1]; ++i) {
            const auto point = static_cast<std::size_t>(mesh.cell_points[static_cast<std::size_t>(i)]);
            corners.push_back({mesh.x[point], mesh.y[point]});
            box.include(corners.back());
            sum += values[point];
        }
        if (box.overlaps(plot.window())) painter.add(corners, sum / static_cast<double>(corners.size()));
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

} // namespace

std::string function_picture(const Mesh& mesh, const Basis& basis, std::int32_t function,
                             const Column& column) {
    return function_picture(mesh, basis, function, column, window_round({&basis.curves()}, .4));
}

std::string function_picture(const Mesh& mesh, const Basis& basis, std::int32_t function, const Column& column,
                             const Box& window) {
    const hm_curves& curves = basis.curves();
    const std::vector<double>& values = column.values;
    const auto ends = std::minmax_element(values.begin(), values.end());
    const Range range = {*ends.first, *ends.second};
    Plot plot(window,
              "Function " + std::to_string(function + 1) + " of " + std::to_string(basis.functions()) +
                  (basis.info().numbers_per_value > 1 ? ", " + column.name : ""),
              operator_name(basis.info()) + " in the mesh; on the curve it is the B-spline basis function of control point " +
                  std::to_string(function + 1) + "; values " + brief(range.low) + " to " + brief(range.high),
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
