#include "pictures.hpp"

#include "mesh_lines.hpp"
#include "numbers.hpp"

#include <array>

namespace cli {

namespace {

// Colours that the colour-blind tell apart (M. Okabe, K. Ito, Color universal design, 2008).
constexpr std::array<const char*, 7> marker_colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                       "#e69f00", "#56b4e9", "#000000"};

Box box_of(const Mesh& mesh) {
    Box box;
    for (std::size_t point = 0; point < mesh.x.size(); ++point) box.include(Point{mesh.x[point], mesh.y[point]});
    return box;
}

} // namespace

std::string mesh_picture(const Mesh& mesh, const std::optional<Box>& wished) {
    const Box all = box_of(mesh), window = wished ? *wished : all.widened(.02 * std::max(all.width(), all.height()));
    Sheet sheet(window, "The mesh",
                plural(mesh.points(), "point") + ", " + plural(mesh.cells(), "cell") + "; boundaries in colours");
    Plot& plot = sheet.plot();
    std::vector<std::pair<std::string, std::string>> legend; // attributes, tag
    plot.begin_inside();
    const std::string note = draw_mesh(plot, mesh, mesh.x, mesh.y, "stroke=\"#5c6b78\" stroke-width=\".6\"");
    for (std::int32_t marker = 0; marker < static_cast<std::int32_t>(mesh.markers.size()); ++marker) {
        const std::string shade = marker_colours[static_cast<std::size_t>(marker) % marker_colours.size()];
        const std::string style = "stroke=\"" + shade + "\" stroke-width=\"2.4\"";
        draw_boundary(plot, mesh, marker, style);
        legend.emplace_back(style, mesh.markers[static_cast<std::size_t>(marker)]);
    }
    plot.end_inside();
    for (const auto& [style, name] : legend) sheet.legend_line(style, name);
    sheet.note(note);
    return sheet.document();
}

} // namespace cli
