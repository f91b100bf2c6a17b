#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "pictures/triangles.hpp"
#include "pictures/draw_curves.hpp"
#include "pictures/pictures.hpp"
#include "pictures/raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cli {

namespace {

constexpr std::array<const char*, 7> shades = {"#f2d7b6", "#bcd9ea", "#c9e4bd", "#e7c6dd",
                                               "#f1ebab", "#d3d0ea", "#b9e2dc"};
constexpr std::size_t known_shade = shades.size(), side_shade = known_shade + 1;
constexpr const char* known_colour = "#8d969e";
constexpr const char* side_colour = "#333";
constexpr std::size_t max_cells = 40000;  // more cells than these are drawn as a raster

// Returns the merged cell to which a point belongs; a point whose value is known has a cell of its
// own in the picture.
std::int32_t owner(const Level& level, std::int32_t point) {
    const std::int32_t cell = level.cells[place(point)];
    return cell >= 0 ? cell : -1 - point;
}

// Returns a shade for each merged cell, which differs from those of the neighbours if possible.
std::vector<std::size_t> shades_of(const Mesh& mesh, const Level& level) {
    std::vector<std::pair<std::int32_t, std::int32_t>> neighbours;
    for (std::size_t cell = 0; cell < place(mesh.cells()); ++cell) {
        const std::int32_t first = mesh.cell_start[cell], end = mesh.cell_start[cell + 1];
        for (std::int32_t i = first; i < end; ++i) {
            const std::int32_t a = level.cells[place(mesh.cell_points[place(i)])];
            const std::int32_t b =
                level.cells[place(mesh.cell_points[place(i + 1 < end ? i + 1 : first)])];
            if (a < 0 || b < 0 || a == b) continue;
            neighbours.emplace_back(a, b);
            neighbours.emplace_back(b, a);
        }
    }
    std::sort(neighbours.begin(), neighbours.end());
    std::vector<std::size_t> shade(place(level.n_cells), shades.size());
    auto next = neighbours.begin();
    for (std::int32_t cell = 0; cell < level.n_cells; ++cell) {
        std::array<bool, shades.size() + 1> taken = {};
        for (; next != neighbours.end() && next->first == cell; ++next)
            taken[shade[place(next->second)]] = true;
        const std::size_t start = place(cell) % shades.size();  // so that all shades are used
        shade[place(cell)] = start;
        for (std::size_t i = 0; i < shades.size(); ++i) {
            const std::size_t candidate = (start + i) % shades.size();
            if (taken[candidate]) continue;
            shade[place(cell)] = candidate;
            break;
        }
    }
    return shade;
}

class LevelPainter {
public:
    LevelPainter(Plot& plot, const Mesh& mesh, const Level& level)
        : plot_(plot),
          mesh_(mesh),
          level_(level),
          shade_(shades_of(mesh, level)),
          areas_(side_shade + 1) {
        for (std::size_t cell = 0; cell < place(mesh.cells()); ++cell) {
            if (CellParts(mesh, cell).box.overlaps(plot.window())) visible_.push_back(cell);
        }
    }

    std::string paint() {
        const bool is_raster = visible_.size() > max_cells;
        if (is_raster) {
            paint_pixels();
        } else {
            paint_shapes();
        }
        for (std::size_t i = 0; i < areas_.size(); ++i) {
            const std::string shade = i == side_shade    ? side_colour
                                      : i == known_shade ? known_colour
                                                         : shades[i];
            const std::string line = is_raster ? " shape-rendering=\"crispEdges\""
                                               : " stroke=\"" + shade + "\" stroke-width=\".5\"";
            plot_.svg().path(areas_[i], "fill=\"" + shade + "\"" + line);
        }
        plot_.svg().path(sides_, std::string("fill=\"none\" stroke=\"") + side_colour +
                                     "\" stroke-width=\".7\"");
        if (!is_raster) return "";
        return "Of " + plural(static_cast<std::int64_t>(visible_.size()), "visible cell") +
               " of the mesh, volumes are drawn pixel by pixel.";
    }

private:
    std::size_t shade_of(std::int32_t cell_owner) const {
        return cell_owner < 0 ? known_shade : shade_[place(cell_owner)];
    }

    void paint_shapes() {
        for (const std::size_t cell : visible_) {
            const CellParts parts(mesh_, cell);
            for (std::size_t i = 0; i < parts.size(); ++i) {
                const std::int32_t here = owner(level_, parts.points[i]);
                SvgPath& area = areas_[shade_of(here)];
                const auto part = parts.part(i);
                area.move_to(plot_.pixel(part[0]));
                for (std::size_t k = 1; k < part.size(); ++k) area.line_to(plot_.pixel(part[k]));
                area.close();
                if (here == owner(level_, parts.points[(i + 1) % parts.size()])) continue;
                sides_.move_to(plot_.pixel(parts.middle[i]));
                sides_.line_to(plot_.pixel(parts.barycentre));
            }
        }
    }

    void paint_pixels() {
        Raster raster(plot_.frame());
        for (const std::size_t cell : visible_) {
            const CellParts parts(mesh_, cell);
            for (std::size_t i = 0; i < parts.size(); ++i) {
                const double here = owner(level_, parts.points[i]);
                const auto part = parts.part(i);
                for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
                    raster.fill(
                        {plot_.pixel(part[0]), plot_.pixel(part[k]), plot_.pixel(part[k + 1])},
                        {here, here, here});
                }
            }
        }
        raster.runs(areas_, [&](std::size_t column, std::size_t row) {
            const double here = raster.at(column, row);
            if (here == Raster::nothing) return -1;
            const bool ends_right =
                column + 1 < raster.columns() && raster.at(column + 1, row) != here;
            const bool ends_below = row + 1 < raster.rows() && raster.at(column, row + 1) != here;
            const auto volume = static_cast<std::int32_t>(std::lround(here));
            return static_cast<int>(ends_right || ends_below ? side_shade : shade_of(volume));
        });
    }

    Plot& plot_;
    const Mesh& mesh_;
    const Level& level_;
    std::vector<std::size_t> shade_, visible_;
    std::vector<SvgPath> areas_;
    SvgPath sides_;
};

std::string name_of(const Level& level) {
    if (level.number == 0)
        return "Level 0: the " + plural(level.n_cells, "control volume") + " of the mesh's points";
    return "Level " + std::to_string(level.number) + ": " + plural(level.n_cells, "merged volume");
}

}  // namespace

std::string level_picture(const Mesh& mesh, const hm_curves& curves,
                          const std::vector<Level>& levels, const Box& window) {
    const bool is_single = levels.size() == 1;
    Sheet sheet(window, is_single ? name_of(levels[0]) : "Levels of agglomeration",
                "Control volumes of the median dual, merged from level to level; each colour patch "
                "within dark lines "
                "is one volume",
                {levels.size()});
    std::string note;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        Plot& plot = sheet.plot(k);
        if (!is_single) sheet.head(k, name_of(levels[k]));
        plot.begin_inside();
        note = LevelPainter(plot, mesh, levels[k]).paint();
        draw_outlines(plot, curves, "stroke=\"#c03020\" stroke-width=\"1.6\"");
        plot.end_inside();
    }
    sheet.legend_box(std::string("fill=\"") + known_colour + "\"",
                     "volumes of points whose values are known, on the boundary: not merged");
    sheet.legend_line("stroke=\"#c03020\" stroke-width=\"1.6\"", "B-spline");
    sheet.note(note);
    return sheet.document();
}

}  // namespace cli
