#include "pictures.hpp"

#include "draw_curves.hpp"
#include "numbers.hpp"

namespace cli {

namespace {

constexpr const char* before_style = "stroke=\"#1f6fd0\" stroke-width=\"1.4\" stroke-dasharray=\"6 4\"";
constexpr const char* after_style = "stroke=\"#1a1a1a\" stroke-width=\"1.6\"";
constexpr const char* point_style = "fill=\"none\" stroke=\"#d62828\" stroke-width=\"1.3\"";
constexpr const char* control_style = "fill=\"#1a1a1a\"";
constexpr double radius = 3.2; // of the circles round the mesh's points

void draw_boundary_points(Plot& plot, const hm_basis_info& info, const Field& moved) {
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        const auto point = static_cast<std::size_t>(info.curve_point[k]);
        plot.svg().circle(plot.pixel({moved.x[point], moved.y[point]}), radius, point_style);
    }
}

void draw_legend(Plot& plot) {
    const double y = plot.frame().high.y + 26;
    double x = plot.frame().low.x;
    Svg& svg = plot.svg();
    const auto entry = [&](const std::string& text, double width) {
        svg.text({x + 38, y + 5}, text, "font-size=\"14\" fill=\"#222\"");
        x += width;
    };
    svg.line({x, y}, {x + 30, y}, before_style);
    entry("before", 120);
    svg.line({x, y}, {x + 30, y}, after_style);
    entry("B-spline of the moved control points", 320);
    svg.circle({x + 20, y}, radius, point_style);
    entry("points of the mesh, moved by the functions", 0);
}

} // namespace

std::string boundary_picture(const Basis& basis, const Morph& morph) {
    const hm_curves& before = basis.curves();
    std::vector<double> control(before.control, before.control + 2 * before.n_control);
    for (std::size_t i = 0; i < control.size(); ++i) control[i] += morph.moves[i];
    hm_curves after = before;
    after.control = control.data();

    const Box bodies = box_of_bodies(basis.info(), morph.moved.x, morph.moved.y);
    const Box window = window_round({box_of(before), box_of(after), bodies}, .1);
    Plot plot(window, "The boundary, by the B-spline and by the functions",
              plural(basis.info().curve_points, "point") + " of the mesh; largest difference between their movement and " +
                  "the B-spline's: " + brief(morph.boundary_error));
    plot.begin_inside();
    draw_outlines(plot, before, before_style);
    draw_outlines(plot, after, after_style);
    draw_control_points(plot, after, 2.2, control_style);
    draw_boundary_points(plot, basis.info(), morph.moved);
    plot.end_inside();
    draw_legend(plot);
    return plot.svg().document();
}

} // namespace cli
