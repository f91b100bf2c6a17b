#include "pictures.hpp"

#include "draw_curves.hpp"
#include "numbers.hpp"

#include <array>

namespace cli {

namespace {

constexpr std::array<const char*, 6> shades = {"#f2d7b6", "#bcd9ea", "#c9e4bd", "#e7c6dd", "#f1ebab", "#d3d0ea"};

// The parts of one mesh cell in its corners' control volumes, bounded by the middles of its sides and its barycentre.
struct Parts {
    std::vector<Point> corner, middle; // middle[i]: of the side from corner i to the next one
    Point barycentre = {0, 0};
    Box box;

    Parts(const Mesh& mesh, std::size_t cell) {
        for (std::int32_t i = mesh.cell_start[cell]; i < mesh.cell_start[cell + 1]; ++i) {
            const auto point = static_cast<std::size_t>(mesh.cell_points[static_cast<std::size_t>(i)]);
            corner.push_back({mesh.x[point], mesh.y[point]});
            box.include(corner.back());
        }
        const auto n = static_cast<double>(corner.size());
        for (std::size_t i = 0; i < corner.size(); ++i) {
            const Point here = corner[i], next = corner[(i + 1) % corner.size()];
            middle.push_back({(here.x + next.x) / 2, (here.y + next.y) / 2});
            barycentre.x += here.x / n;
            barycentre.y += here.y / n;
        }
    }
};

} // namespace

std::string level_picture(const Mesh& mesh, const hm_curves& curves, const Level& level, const Box& window) {
    Plot plot(window, "Level " + std::to_string(level.number) + " of agglomeration",
              plural(level.n_cells, "merged cell") + "; level 0 is the mesh's own control volumes; white: values are known");
    std::array<SvgPath, shades.size()> areas;
    SvgPath sides;
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        const Parts parts(mesh, cell);
        if (!parts.box.overlaps(plot.window())) continue;
        const std::size_t n = parts.corner.size();
        const std::int32_t* const points = mesh.cell_points.data() + mesh.cell_start[cell];
        for (std::size_t i = 0; i < n; ++i) {
            const std::int32_t merged = level.cells[static_cast<std::size_t>(points[i])];
            const Point before = parts.middle[(i + n - 1) % n];
            if (merged >= 0) {
                SvgPath& area = areas[static_cast<std::size_t>(merged) % shades.size()];
                area.move_to(plot.pixel(before));
                for (const Point at : {parts.corner[i], parts.middle[i], parts.barycentre}) area.line_to(plot.pixel(at));
                area.close();
            }
            if (merged == level.cells[static_cast<std::size_t>(points[(i + 1) % n])]) continue;
            sides.move_to(plot.pixel(parts.middle[i]));
            sides.line_to(plot.pixel(parts.barycentre));
        }
    }
    plot.begin_inside();
    for (std::size_t i = 0; i < shades.size(); ++i) {
        const std::string shade = shades[i];
        plot.svg().path(areas[i], "fill=\"" + shade + "\" stroke=\"" + shade + "\" stroke-width=\".5\"");
    }
    plot.svg().path(sides, "fill=\"none\" stroke=\"#444\" stroke-width=\".7\"");
    draw_outlines(plot, curves, "stroke=\"#c03020\" stroke-width=\"1.5\"");
    plot.end_inside();
    return plot.svg().document();
}

} // namespace cli
