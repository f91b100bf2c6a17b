#include "basics/numbers.hpp"
#include "pictures/draw_curves.hpp"
#include "pictures/mesh_lines.hpp"
#include "pictures/pictures.hpp"

#include <array>

namespace cli {

namespace {

// Colour-blind readers distinguish these colours (M. Okabe, K. Ito, Color universal design, 2008).
constexpr std::array<const char*, 7> marker_colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                       "#e69f00", "#56b4e9", "#000000"};

namespace mesh_style {
constexpr const char* curve = "stroke=\"#111\" stroke-width=\"1.2\"";
constexpr const char* polygon = "stroke=\"#666\" stroke-width=\"1\"";
constexpr const char* control = "fill=\"white\" stroke=\"#111\" stroke-width=\"1.3\"";
}  // namespace mesh_style

Box box_of(const Mesh& mesh) {
    Box box;
    for (std::size_t point = 0; point < mesh.x.size(); ++point)
        box.include(Point{mesh.x[point], mesh.y[point]});
    return box;
}

}  // namespace

std::string mesh_picture(const Mesh& mesh, bool boundaries_alone, const hm_curves& curves,
                         const std::optional<Box>& wished) {
    const Box all = box_of(mesh);
    const std::optional<Box> bodies = wished ? std::nullopt : window_of_bodies(mesh);
    const Box window = wished   ? *wished
                       : bodies ? *bodies
                                : all.widened(.02 * std::max(all.width(), all.height()));
    const std::string title = boundaries_alone ? "Boundaries of the mesh" : "The mesh";
    Sheet sheet(window, title + (curves.n_control > 0 ? " and its B-spline" : ""),
                plural(mesh.points(), "point") + ", " + plural(mesh.cells(), "cell") +
                    "; boundaries in colours");
    Plot& plot = sheet.plot();
    std::vector<std::pair<std::string, std::string>> legend;  // attributes and marker
    plot.begin_inside();
    std::string note;
    if (!boundaries_alone)
        note = draw_mesh(plot, mesh, mesh.x, mesh.y, "stroke=\"#5c6b78\" stroke-width=\".6\"");
    for (std::int32_t marker = 0; marker < static_cast<std::int32_t>(mesh.markers.size());
         ++marker) {
        const std::string shade =
            marker_colours[static_cast<std::size_t>(marker) % marker_colours.size()];
        const std::string style = "stroke=\"" + shade + "\" stroke-width=\"2.4\"";
        draw_boundary(plot, mesh, marker, style);
        legend.emplace_back(style, mesh.markers[static_cast<std::size_t>(marker)]);
    }
    draw_outlines(plot, curves, mesh_style::curve);
    draw_control_polygons(plot, curves, mesh_style::polygon);
    draw_control_points(plot, curves, 3.5, mesh_style::control);
    draw_numbers(plot, curves, {14, 12, "fill=\"#111\""});
    if (bodies) draw_inset(plot, mesh);
    plot.end_inside();
    for (const auto& [style, name] : legend) sheet.legend_line(style, name);
    if (curves.n_control > 0) {
        sheet.legend_line(mesh_style::curve, "B-spline");
        sheet.legend_line(mesh_style::polygon, "control polygon");
        sheet.legend_disc(3.5, mesh_style::control, "control points with their numbers");
    }
    sheet.note(note);
    return sheet.document();
}

}  // namespace cli
