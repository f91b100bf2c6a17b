#include "basics/numbers.hpp"
#include "pictures/draw_curves.hpp"
#include "pictures/pictures.hpp"

namespace cli {

namespace {

namespace boundary_style {
constexpr const char* before = "stroke=\"#1f6fd0\" stroke-width=\"1.4\" stroke-dasharray=\"6 4\"";
constexpr const char* after = "stroke=\"#1a1a1a\" stroke-width=\"1.6\"";
constexpr const char* point = "fill=\"none\" stroke=\"#d62828\" stroke-width=\"1.3\"";
constexpr const char* polygon = "stroke=\"#888\" stroke-width=\".9\"";
constexpr const char* control = "fill=\"#1a1a1a\"";
}  // namespace boundary_style
constexpr double point_radius = 3.2;  // radius of the circles round the mesh points [pixels]

void draw_boundary_points(Plot& plot, const hm_basis_info& info, const Field& moved) {
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        const auto point = static_cast<std::size_t>(info.curve_point[k]);
        plot.svg().circle(plot.pixel({moved.x[point], moved.y[point]}), point_radius,
                          boundary_style::point);
    }
}

}  // namespace

std::string boundary_picture(const Basis& basis, const Morph& morph) {
    const hm_curves& before = basis.curves();
    const std::vector<double> control = morph.moved_control(basis);
    hm_curves after = before;
    after.control = control.data();

    const Box bodies = box_of_bodies(basis.info(), morph.moved.x, morph.moved.y);
    Sheet sheet(window_round({box_of(before), box_of(after), bodies}, .1),
                "The boundary, by the B-spline and by the functions",
                plural(basis.info().curve_points, "point") +
                    " of the mesh; largest difference between their movement and " +
                    "the B-spline's: " + brief(morph.boundary_error));
    Plot& plot = sheet.plot();
    plot.begin_inside();
    draw_outlines(plot, before, boundary_style::before);
    draw_control_polygons(plot, after, boundary_style::polygon);
    draw_outlines(plot, after, boundary_style::after);
    draw_control_points(plot, after, 2.6, boundary_style::control);
    draw_boundary_points(plot, basis.info(), morph.moved);
    draw_numbers(plot, after, {13, 12, "fill=\"#111\""});
    plot.end_inside();
    if (after.n_control > 0) {
        sheet.legend_line(boundary_style::before, "before");
        sheet.legend_line(boundary_style::after, "B-spline of the moved control points");
        sheet.legend_disc(2.6, boundary_style::control, "these control points");
    }
    sheet.legend_disc(point_radius, boundary_style::point,
                      "points of the mesh, moved by the functions");
    return sheet.document();
}

}  // namespace cli
