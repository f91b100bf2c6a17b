#include "pictures.hpp"

#include "draw_curves.hpp"
#include "mesh_lines.hpp"
#include "numbers.hpp"

#include <cmath>

namespace cli {

namespace {

constexpr const char* before_style = "stroke=\"#1f6fd0\" stroke-width=\".7\" stroke-opacity=\".75\"";
constexpr const char* after_style = "stroke=\"#d62828\" stroke-width=\".7\" stroke-opacity=\".75\"";
constexpr const char* old_curve_style = "stroke=\"#123f7a\" stroke-width=\"1.6\" stroke-dasharray=\"6 4\"";
constexpr const char* new_curve_style = "stroke=\"#1a1a1a\" stroke-width=\"2.2\"";
constexpr const char* polygon_style = "stroke=\"#333\" stroke-width=\"1\"";
constexpr const char* old_point_style = "fill=\"white\" stroke=\"#1f6fd0\" stroke-width=\"1.5\"";
constexpr const char* new_point_style = "fill=\"#d62828\" stroke=\"white\" stroke-width=\"1\"";

void draw_curves_before(Plot& plot, const hm_curves& curves) {
    draw_outlines(plot, curves, old_curve_style);
    draw_control_points(plot, curves, 3.5, old_point_style);
}

void draw_curves_after(Plot& plot, const hm_curves& curves) {
    draw_outlines(plot, curves, new_curve_style);
    draw_control_polygons(plot, curves, polygon_style);
    draw_control_points(plot, curves, 4.5, new_point_style);
    draw_numbers(plot, curves, {15, 12, "fill=\"#111\""});
}

void add_legend(Sheet& sheet, bool has_curves) {
    sheet.legend_line("stroke=\"#1f6fd0\" stroke-width=\"2\"", "mesh before");
    sheet.legend_line("stroke=\"#d62828\" stroke-width=\"2\"", "mesh after");
    if (!has_curves) return;
    sheet.legend_line(old_curve_style, "B-spline before");
    sheet.legend_line(new_curve_style, "B-spline after");
    sheet.legend_disc(3.5, old_point_style, "control points before");
    sheet.legend_disc(4.5, new_point_style, "after, with their numbers");
}

std::string what_moved(const Basis& basis, const Morph& morph) {
    std::string text;
    if (basis.curves().n_control > 0) {
        double largest = 0;
        std::int64_t moved = 0;
        for (std::size_t i = 0; i < 2 * static_cast<std::size_t>(basis.curves().n_control); i += 2) {
            const double length = std::hypot(morph.moves[i], morph.moves[i + 1]);
            largest = std::max(largest, length);
            moved += length > 0 ? 1 : 0;
        }
        text = std::to_string(moved) + " of " + plural(basis.curves().n_control, "control point") +
               " moved, by up to " + brief(largest) + "; ";
    }
    if (basis.info().bodies == 0) return text;
    return text + std::to_string(basis.info().bodies) + " rigid " + (basis.info().bodies == 1 ? "body; " : "bodies; ");
}

std::string subtitle(const Basis& basis, const Morph& morph) {
    return what_moved(basis, morph) + plural(morph.quality.inverted, "inverted cell") + "; size-skew quality " +
           brief(morph.quality.min_quality) + " at least, " + brief(morph.quality.mean_quality) + " on average";
}

} // namespace

std::string morph_picture(const Mesh& mesh, const Basis& basis, const Morph& morph, const std::optional<Box>& wished) {
    const hm_curves& before = basis.curves();
    const std::vector<double> control = morph.moved_control(basis);
    hm_curves after = before;
    after.control = control.data();
    const Box bodies_before = box_of_bodies(basis.info(), mesh.x, mesh.y);
    const Box bodies_after = box_of_bodies(basis.info(), morph.moved.x, morph.moved.y);
    const Box window = window_round({box_of(before), box_of(after), bodies_before, bodies_after}, .25);
    Sheet sheet(wished ? *wished : window, "Mesh and B-spline, morphed together", subtitle(basis, morph));
    Plot& plot = sheet.plot();
    plot.begin_inside();
    draw_mesh(plot, mesh, mesh.x, mesh.y, before_style);
    const std::string note = draw_mesh(plot, mesh, morph.moved.x, morph.moved.y, after_style);
    draw_curves_before(plot, before);
    draw_curves_after(plot, after);
    plot.end_inside();
    add_legend(sheet, before.n_control > 0);
    sheet.note(note);
    return sheet.document();
}

} // namespace cli
