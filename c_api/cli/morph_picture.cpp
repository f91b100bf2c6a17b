#include "pictures.hpp"

#include "draw_curves.hpp"
#include "edge_chains.hpp"
#include "numbers.hpp"

#include <cmath>

namespace cli {

namespace {

constexpr const char* before_style = "stroke=\"#1f6fd0\" stroke-width=\".7\" stroke-opacity=\".75\" fill=\"none\"";
constexpr const char* after_style = "stroke=\"#d62828\" stroke-width=\".7\" stroke-opacity=\".75\" fill=\"none\"";
constexpr const char* old_curve_style = "stroke=\"#123f7a\" stroke-width=\"1.6\" stroke-dasharray=\"6 4\"";
constexpr const char* new_curve_style = "stroke=\"#1a1a1a\" stroke-width=\"2.2\"";
constexpr const char* polygon_style = "stroke=\"#333\" stroke-width=\"1\"";
constexpr const char* old_point_style = "fill=\"white\" stroke=\"#1f6fd0\" stroke-width=\"1.5\"";
constexpr const char* new_point_style = "fill=\"#d62828\" stroke=\"white\" stroke-width=\"1\"";
constexpr const char* number_style = "font-size=\"12\" fill=\"#111\"";

void draw_mesh(Plot& plot, const Mesh& mesh, const std::vector<double>& x, const std::vector<double>& y,
               const char* style) {
    const auto at = [&](std::int32_t point) {
        return Point{x[static_cast<std::size_t>(point)], y[static_cast<std::size_t>(point)]};
    };
    const auto visible = [&](Edge edge) {
        Box box;
        box.include(at(edge.a));
        box.include(at(edge.b));
        return box.overlaps(plot.window());
    };
    SvgPath path;
    for (const std::vector<std::int32_t>& chain : edge_chains(mesh_edges(mesh, visible), mesh.points())) {
        path.move_to(plot.pixel(at(chain[0])));
        for (std::size_t i = 1; i < chain.size(); ++i) path.line_to(plot.pixel(at(chain[i])));
    }
    plot.svg().path(path, style);
}

void draw_curves_before(Plot& plot, const hm_curves& curves) {
    draw_outlines(plot, curves, old_curve_style);
    draw_control_points(plot, curves, 3.5, old_point_style);
}

void draw_curves_after(Plot& plot, const hm_curves& curves) {
    draw_outlines(plot, curves, new_curve_style);
    draw_control_polygons(plot, curves, polygon_style);
    draw_control_points(plot, curves, 4.5, new_point_style);
    for (std::int32_t i = 0; i < curves.n_control; ++i) draw_number(plot, curves, i, 15, number_style);
}

void draw_legend(Plot& plot) {
    const double y = plot.frame().high.y + 26;
    double x = plot.frame().low.x;
    Svg& svg = plot.svg();
    const auto entry = [&](const std::string& text, const std::string& line, const std::string& dot, double width) {
        if (!line.empty()) svg.line({x, y}, {x + 30, y}, line);
        if (!dot.empty()) svg.circle({x + 15, y}, 4, dot);
        svg.text({x + 38, y + 5}, text, "font-size=\"14\" fill=\"#222\"");
        x += width;
    };
    entry("mesh before", "stroke=\"#1f6fd0\" stroke-width=\"2\"", "", 160);
    entry("mesh after", "stroke=\"#d62828\" stroke-width=\"2\"", "", 150);
    entry("B-spline before", old_curve_style, old_point_style, 185);
    entry("B-spline after, with its control polygon", new_curve_style, new_point_style, 0);
}

std::string what_moved(const Basis& basis, const Morph& morph) {
    std::string text;
    if (basis.curves().n_control > 0) {
        double largest = 0;
        for (std::size_t i = 0; i < 2 * static_cast<std::size_t>(basis.curves().n_control); i += 2) {
            largest = std::max(largest, std::hypot(morph.moves[i], morph.moves[i + 1]));
        }
        text = plural(basis.curves().n_control, "control point") + ", moved by up to " + brief(largest) + "; ";
    }
    if (basis.info().bodies == 0) return text;
    return text + std::to_string(basis.info().bodies) + " rigid " + (basis.info().bodies == 1 ? "body; " : "bodies; ");
}

std::string subtitle(const Basis& basis, const Morph& morph) {
    return what_moved(basis, morph) + plural(morph.quality.inverted, "inverted cell") + "; size-skew quality " +
           brief(morph.quality.min_quality) + " at least, " + brief(morph.quality.mean_quality) + " on average";
}

std::vector<double> moved_control(const Basis& basis, const std::vector<double>& moves) {
    const hm_curves& before = basis.curves();
    std::vector<double> control(before.control, before.control + 2 * before.n_control);
    for (std::size_t i = 0; i < control.size(); ++i) control[i] += moves[i];
    return control;
}

} // namespace

std::string morph_picture(const Mesh& mesh, const Basis& basis, const Morph& morph) {
    const std::vector<double> control = moved_control(basis, morph.moves);
    hm_curves after = basis.curves();
    after.control = control.data();
    const Box bodies_before = box_of_bodies(basis.info(), mesh.x, mesh.y);
    const Box bodies_after = box_of_bodies(basis.info(), morph.moved.x, morph.moved.y);
    const Box window = window_round({box_of(basis.curves()), box_of(after), bodies_before, bodies_after}, .25);
    return morph_picture(mesh, basis, morph, window);
}

std::string morph_picture(const Mesh& mesh, const Basis& basis, const Morph& morph, const Box& window) {
    const hm_curves& before = basis.curves();
    const std::vector<double> control = moved_control(basis, morph.moves);
    hm_curves after = before;
    after.control = control.data();
    Plot plot(window, "Mesh and B-spline, morphed together", subtitle(basis, morph));
    plot.begin_inside();
    draw_mesh(plot, mesh, mesh.x, mesh.y, before_style);
    draw_mesh(plot, mesh, morph.moved.x, morph.moved.y, after_style);
    draw_curves_before(plot, before);
    draw_curves_after(plot, after);
    plot.end_inside();
    draw_legend(plot);
    return plot.svg().document();
}

} // namespace cli
