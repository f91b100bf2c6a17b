#include "basics/numbers.hpp"
#include "pictures/triangles.hpp"
#include "pictures/draw_curves.hpp"
#include "pictures/mesh_lines.hpp"
#include "pictures/pictures.hpp"

#include <algorithm>
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

namespace {

namespace volume_style {
constexpr const char* edge = "stroke=\"#8494a1\" stroke-width=\"1\"";
constexpr const char* dual = "fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.2\"";
constexpr const char* dual_fill = "fill=\"#56b4e9\" fill-opacity=\".55\"";
constexpr const char* gradient_fill = "fill=\"#e69f00\" fill-opacity=\".4\"";
constexpr const char* chosen = "fill=\"#d55e00\" stroke=\"white\" stroke-width=\"1.5\"";
constexpr const char* middle = "fill=\"#0072b2\"";
constexpr const char* barycentre = "fill=\"white\" stroke=\"#0072b2\" stroke-width=\"1.2\"";
}  // namespace volume_style

void append(SvgPath& path, const Plot& plot, const Point* begin, const Point* end) {
    path.move_to(plot.pixel(*begin));
    for (const Point* at = begin + 1; at != end; ++at) path.line_to(plot.pixel(*at));
    path.close();
}

}  // namespace

std::string volume_picture(const Mesh& mesh, const std::vector<std::int32_t>& points, Volume kind,
                           const std::optional<Box>& wished) {
    const auto is_chosen = [&](std::int32_t point) {
        return std::find(points.begin(), points.end(), point) != points.end();
    };
    Box round;
    for (std::size_t cell = 0; cell < static_cast<std::size_t>(mesh.cells()); ++cell) {
        const CellParts parts(mesh, cell);
        if (std::any_of(parts.points.begin(), parts.points.end(), is_chosen))
            round.include(parts.box);
    }
    const bool is_dual = kind == Volume::dual;
    Sheet sheet(
        wished ? *wished : round.widened(.35 * std::max(round.width(), round.height())),
        is_dual ? "Control volumes of the median dual" : "Volumes for the gradients at points",
        is_dual ? "The flux through a volume's sides is balanced; corners are middles of edges and "
                  "barycentres of cells"
                : "The gradient at a point is a sum over the sides of all cells round it "
                  "(Green-Gauss)");
    Plot& plot = sheet.plot();
    SvgPath filled, sides;
    std::vector<Point> middles, barycentres;
    for (std::size_t cell = 0; cell < static_cast<std::size_t>(mesh.cells()); ++cell) {
        const CellParts parts(mesh, cell);
        if (!parts.box.overlaps(plot.window())) continue;
        const bool touches = std::any_of(parts.points.begin(), parts.points.end(), is_chosen);
        if (!is_dual && touches)
            append(filled, plot, parts.corner.data(), parts.corner.data() + parts.size());
        if (!is_dual) continue;
        barycentres.push_back(parts.barycentre);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const auto part = parts.part(i);
            if (is_chosen(parts.points[i]))
                append(filled, plot, part.data(), part.data() + part.size());
            sides.move_to(plot.pixel(parts.middle[i]));
            sides.line_to(plot.pixel(parts.barycentre));
            middles.push_back(parts.middle[i]);
        }
    }
    plot.begin_inside();
    plot.svg().path(filled, is_dual ? volume_style::dual_fill : volume_style::gradient_fill);
    const std::string note = draw_mesh(plot, mesh, mesh.x, mesh.y, volume_style::edge);
    plot.svg().path(sides, volume_style::dual);
    draw_boundary(plot, mesh, -1, "stroke=\"#111\" stroke-width=\"2\"");
    for (const Point& at : middles) plot.svg().circle(plot.pixel(at), 2, volume_style::middle);
    for (const Point& at : barycentres)
        plot.svg().circle(plot.pixel(at), 2.6, volume_style::barycentre);
    for (const std::int32_t point : points) {
        const Point at = plot.pixel(
            {mesh.x[static_cast<std::size_t>(point)], mesh.y[static_cast<std::size_t>(point)]});
        plot.svg().circle(at, 5.5, volume_style::chosen);
        plot.svg().text({at.x + 9, at.y - 8}, std::to_string(point),
                        "font-size=\"15\" font-weight=\"bold\" fill=\"#111\" stroke=\"white\" "
                        "stroke-width=\"3\" "
                        "paint-order=\"stroke\"");
    }
    plot.end_inside();
    sheet.legend_line(volume_style::edge, "edges of the mesh");
    sheet.legend_disc(5.5, volume_style::chosen,
                      points.size() == 1 ? "the point, numbered as in the file"
                                         : "points, numbered as in the file");
    if (is_dual) {
        sheet.legend_box(volume_style::dual_fill,
                         points.size() == 1 ? "its control volume" : "their control volumes");
        sheet.legend_line(volume_style::dual, "sides of all control volumes");
        sheet.legend_disc(2, volume_style::middle, "middle of an edge");
        sheet.legend_disc(2.6, volume_style::barycentre, "barycentre of a cell");
    } else {
        sheet.legend_box(volume_style::gradient_fill, points.size() == 1
                                                          ? "the cells round it"
                                                          : "the cells round each of them");
    }
    sheet.note(note);
    return sheet.document();
}

}  // namespace cli
