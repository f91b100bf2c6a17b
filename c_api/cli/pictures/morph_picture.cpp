#include "basics/numbers.hpp"
#include "mesh/loops.hpp"
#include "pictures/draw_curves.hpp"
#include "pictures/mesh_lines.hpp"
#include "pictures/pictures.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

namespace morph_style {
constexpr const char* before = "stroke=\"#1f6fd0\" stroke-width=\".7\" stroke-opacity=\".75\"";
constexpr const char* after = "stroke=\"#d62828\" stroke-width=\".7\" stroke-opacity=\".75\"";
constexpr const char* old_curve =
    "stroke=\"#123f7a\" stroke-width=\"1.6\" stroke-dasharray=\"6 4\"";
constexpr const char* new_curve = "stroke=\"#1a1a1a\" stroke-width=\"2.2\"";
constexpr const char* polygon = "stroke=\"#333\" stroke-width=\"1\"";
constexpr const char* old_point = "fill=\"white\" stroke=\"#1f6fd0\" stroke-width=\"1.5\"";
constexpr const char* new_point = "fill=\"#d62828\" stroke=\"white\" stroke-width=\"1\"";
}  // namespace morph_style

void draw_curves_before(Plot& plot, const hm_curves& curves) {
    draw_outlines(plot, curves, morph_style::old_curve);
    draw_control_points(plot, curves, 3.5, morph_style::old_point);
}

void draw_curves_after(Plot& plot, const hm_curves& curves) {
    draw_outlines(plot, curves, morph_style::new_curve);
    draw_control_polygons(plot, curves, morph_style::polygon);
    draw_control_points(plot, curves, 4.5, morph_style::new_point);
    draw_numbers(plot, curves, {15, 12, "fill=\"#111\""});
}

// Bodies where they are after the morph cover the lines of the mesh before. A moving boundary round
// the whole mesh is no body.
void cover_bodies(Plot& plot, const Mesh& mesh, const hm_basis_info& info, const Field& moved) {
    std::vector<bool> moves(mesh.x.size());
    for (std::int32_t k = 0; k < info.curve_points; ++k) moves[place(info.curve_point[k])] = true;
    std::vector<Edge> edges;
    for (std::size_t face = 0; face < mesh.face_points.size(); face += 2) {
        const auto [a, b] = std::minmax(mesh.face_points[face], mesh.face_points[face + 1]);
        if (moves[place(a)] && moves[place(b)]) edges.push_back({a, b});
    }
    remove_repeats(edges);
    Box all;
    for (std::size_t point = 0; point < moved.x.size(); ++point)
        all.include(Point{moved.x[point], moved.y[point]});
    for (const std::vector<std::int32_t>& chain : edge_chains(edges, mesh.points())) {
        if (chain.front() != chain.back()) continue;
        std::vector<Point> outline;
        Box around;
        for (const std::int32_t point : chain) {
            outline.push_back({moved.x[place(point)], moved.y[place(point)]});
            around.include(outline.back());
        }
        const bool is_body = around.low.x > all.low.x && around.high.x < all.high.x;
        if (is_body) plot.svg().path(plot.polyline(outline), "fill=\"white\" stroke=\"none\"");
    }
}

void add_legend(Sheet& sheet, bool has_curves) {
    sheet.legend_line("stroke=\"#1f6fd0\" stroke-width=\"2\"", "mesh before");
    sheet.legend_line("stroke=\"#d62828\" stroke-width=\"2\"", "mesh after");
    if (!has_curves) return;
    sheet.legend_line(morph_style::old_curve, "B-spline before");
    sheet.legend_line(morph_style::new_curve, "B-spline after");
    sheet.legend_disc(3.5, morph_style::old_point, "control points before");
    sheet.legend_disc(4.5, morph_style::new_point, "after, with their numbers");
}

std::string what_moved(const Basis& basis, const Morph& morph) {
    std::string text;
    if (basis.curves().n_control > 0) {
        double largest = 0;
        std::int64_t moved = 0;
        for (std::size_t i = 0; i < 2 * static_cast<std::size_t>(basis.curves().n_control);
             i += 2) {
            const double length = std::hypot(morph.moves[i], morph.moves[i + 1]);
            largest = std::max(largest, length);
            moved += length > 0 ? 1 : 0;
        }
        text = std::to_string(moved) + " of " + plural(basis.curves().n_control, "control point") +
               " moved, by up to " + brief(largest) + "; ";
    }
    if (basis.info().bodies == 0) return text;
    return text + std::to_string(basis.info().bodies) + " rigid " +
           (basis.info().bodies == 1 ? "body; " : "bodies; ");
}

std::string subtitle(const Basis& basis, const Morph& morph) {
    return what_moved(basis, morph) + plural(morph.quality.inverted, "inverted cell") +
           "; size-skew quality " + brief(morph.quality.min_quality) + " at least, " +
           brief(morph.quality.mean_quality) + " on average";
}

}  // namespace

std::string morph_picture(const Mesh& mesh, const Basis& basis, const Morph& morph,
                          const std::optional<Box>& wished) {
    const hm_curves& before = basis.curves();
    const std::vector<double> control = morph.moved_control(basis);
    hm_curves after = before;
    after.control = control.data();
    const Box bodies_before = box_of_bodies(basis.info(), mesh.x, mesh.y);
    const Box bodies_after = box_of_bodies(basis.info(), morph.moved.x, morph.moved.y);
    const Box window =
        window_round({box_of(before), box_of(after), bodies_before, bodies_after}, .25);
    Sheet sheet(wished ? *wished : window, "Mesh and B-spline, morphed together",
                subtitle(basis, morph));
    Plot& plot = sheet.plot();
    plot.begin_inside();
    draw_mesh(plot, mesh, mesh.x, mesh.y, morph_style::before);
    cover_bodies(plot, mesh, basis.info(), morph.moved);
    const std::string note =
        draw_mesh(plot, mesh, morph.moved.x, morph.moved.y, morph_style::after);
    draw_curves_before(plot, before);
    draw_curves_after(plot, after);
    plot.end_inside();
    add_legend(sheet, before.n_control > 0);
    sheet.note(note);
    return sheet.document();
}

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
