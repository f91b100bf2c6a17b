#include "pictures/function_bands.hpp"

#include "basics/numbers.hpp"
#include "pictures/raster.hpp"
#include "pictures/triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace cli {

namespace {

// Colours for values of both signs. Colour-blind readers can distinguish them, and their order
// remains visible in grey print. The colour is nearly white at 0; positive values are green, blue
// and dark blue, negative values are orange and brown.

struct Colour {
    double red, green, blue;
};

// The colours at equal distances from 0 on. Colours between two of them are interpolated.
constexpr Colour upwards[] = {{250, 252, 247}, {214, 239, 209}, {150, 213, 195}, {78, 175, 195},
                              {40, 125, 182},  {35, 74, 147},   {20, 28, 84}};
constexpr Colour downwards[] = {{250, 252, 247}, {254, 226, 190}, {252, 187, 120}, {238, 137, 58},
                                {204, 90, 20},   {150, 56, 8},    {92, 30, 4}};
constexpr int n_intervals = sizeof upwards / sizeof upwards[0] - 1;

std::string colour_text(const Colour& colour) {
    std::string text = "#";
    for (const double part : {colour.red, colour.green, colour.blue})
        text += hexadecimal(static_cast<std::uint32_t>(std::lround(part)), 2);
    return text;
}

// "#rrggbb"; values outside -1..1 have the colour of -1 or of 1
std::string colour(double value) {
    const Colour* const anchors = value < 0 ? downwards : upwards;
    const double position = std::min(std::fabs(value), 1.0) * n_intervals;
    const int interval = std::min(static_cast<int>(position), n_intervals - 1);
    const Colour& a = anchors[interval];
    const Colour& b = anchors[interval + 1];
    const double t = position - interval;
    return colour_text({a.red + t * (b.red - a.red), a.green + t * (b.green - a.green),
                        a.blue + t * (b.blue - a.blue)});
}

// Scales a value between -max and max to -1 .. 1, by the power 2/3, because harmonic functions have
// small values nearly everywhere.
double colour_place(double value, double max) {
    return max > 0 ? std::copysign(std::pow(std::min(std::fabs(value) / max, 1.0), 2. / 3), value)
                   : 0;
}

// Up to max_triangles triangles are drawn as shapes if they have min_pixels pixels on average.
// Otherwise a raster makes a smaller file.
constexpr double max_triangles = 60000, min_pixels = 16;

// A function is linear on each triangle. The parts of all triangles between two levels are one
// path, so that files are small, and the edges of the bands are level lines of the function.
class BandPainter {
public:
    explicit BandPainter(const Bands& bands)
        : bands_(bands), paths_(static_cast<std::size_t>(bands.count())) {}

    // Adds a triangle with its corners in pixels.
    void add(const std::array<Point, 3>& corners, const std::array<double, 3>& values) {
        Piece triangle;
        for (std::size_t i = 0; i < 3; ++i)
            triangle.push_back({corners[i], values[i] / bands_.step - bands_.first});
        const auto [low, high] =
            std::minmax({triangle[0].level, triangle[1].level, triangle[2].level});
        const double last_band = bands_.count() - 1;
        const auto first = static_cast<std::size_t>(std::clamp(std::floor(low), 0.0, last_band));
        const auto last = static_cast<std::size_t>(
            std::clamp(std::ceil(high) - 1, static_cast<double>(first), last_band));
        for (std::size_t band = first; band <= last; ++band) {
            Piece piece = triangle;
            if (band > first) piece = part_above(piece, static_cast<double>(band), 1);
            if (band < last) piece = part_above(piece, static_cast<double>(band + 1), -1);
            if (piece.size() > 2) add(piece, band);
        }
    }
    std::vector<SvgPath>& paths() { return paths_; }

private:
    struct Corner {
        Point at;
        double level;
    };
    using Piece = std::vector<Corner>;

    // Returns the part of a convex piece above a level, or below the level if the sign is -1.
    static Piece part_above(const Piece& piece, double level, double sign) {
        Piece part;
        for (std::size_t i = 0; i < piece.size(); ++i) {
            const Corner& a = piece[i];
            const Corner& b = piece[(i + 1) % piece.size()];
            const double from = sign * (a.level - level), to = sign * (b.level - level);
            if (from >= 0) part.push_back(a);
            if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
                const double t = from / (from - to);
                part.push_back(
                    {{a.at.x + t * (b.at.x - a.at.x), a.at.y + t * (b.at.y - a.at.y)}, level});
            }
        }
        return part;
    }
    void add(const Piece& piece, std::size_t band) {
        paths_[band].move_to(piece[0].at);
        for (std::size_t i = 1; i < piece.size(); ++i) paths_[band].line_to(piece[i].at);
        paths_[band].close();
    }

    const Bands& bands_;
    std::vector<SvgPath> paths_;
};

}  // namespace

Bands::Bands(double low, double high) {
    step = high > low ? round_step((high - low) / 20) : 1;
    first = static_cast<std::int32_t>(std::floor(low / step + 1e-9));
    last = std::max(first + 1, static_cast<std::int32_t>(std::ceil(high / step - 1e-9)));
}

std::string Bands::colour(std::int32_t band) const {
    const double max = step * std::max(std::abs(first), std::abs(last));
    return cli::colour(colour_place((first + band + .5) * step, max));
}

std::string paint_function(Plot& plot, const Mesh& mesh, const std::vector<double>& values,
                           const Bands& bands) {
    std::size_t triangles = 0;
    for_each_triangle(mesh, plot.window(), [&](const Corners&) { ++triangles; });
    const double max_shapes =
        std::min(max_triangles, plot.frame().width() * plot.frame().height() / min_pixels);
    const bool is_raster = static_cast<double>(triangles) > max_shapes;
    BandPainter painter(bands);
    Raster raster(is_raster ? plot.frame() : Box{{0, 0}, {1, 1}});
    for_each_triangle(mesh, plot.window(), [&](const Corners& corners) {
        std::array<Point, 3> at;
        std::array<double, 3> at_corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto corner = static_cast<std::size_t>(corners[i]);
            at[i] = plot.pixel({mesh.x[corner], mesh.y[corner]});
            at_corners[i] = values[corner];
        }
        if (is_raster) {
            raster.fill(at, at_corners);
        } else {
            painter.add(at, at_corners);
        }
    });
    if (is_raster) {
        raster.runs(painter.paths(), [&](std::size_t column, std::size_t row) {
            const double value = raster.at(column, row);
            if (value == Raster::nothing) return -1;
            return std::clamp(static_cast<int>(std::floor(value / bands.step)) - bands.first, 0,
                              bands.count() - 1);
        });
    }
    for (std::int32_t band = 0; band < bands.count(); ++band) {
        const std::string shade = bands.colour(band);
        // A line of the same colour covers the thin gaps that renderers leave between neighbours.
        const std::string line = is_raster ? " shape-rendering=\"crispEdges\""
                                           : " stroke=\"" + shade + "\" stroke-width=\".5\"";
        plot.svg().path(painter.paths()[static_cast<std::size_t>(band)],
                        "fill=\"" + shade + "\"" + line);
    }
    if (!is_raster) return "";
    return "Of " + plural(static_cast<std::int64_t>(triangles), "triangle") +
           ", colours are drawn pixel by pixel; contour lines are exact.";
}

void draw_colour_bar(Sheet& sheet, const Bands& bands, const std::string& name) {
    constexpr double min_between = 20;  // the smallest distance of two numbers [pixels]
    const Box frames = sheet.frames();
    const Box bar = {{frames.high.x + 20, frames.low.y}, {frames.high.x + 40, frames.high.y}};
    const double height = bar.height() / bands.count();
    const auto every = static_cast<std::int32_t>(std::ceil(min_between / height));
    Svg& svg = sheet.svg();
    double widest = 0;
    for (std::int32_t band = 0; band <= bands.count(); ++band) {
        const double y = bar.high.y - height * band;
        if (band < bands.count())
            svg.rectangle({{bar.low.x, y - height}, {bar.high.x, y}},
                          "fill=\"" + bands.colour(band) + "\"");
        if ((bands.first + band) % every != 0) continue;
        const std::string number = brief(bands.level(band));
        svg.line({bar.high.x, y}, {bar.high.x + 5, y}, "stroke=\"#444\"");
        svg.text({bar.high.x + 9, y + 4.5}, number, "font-size=\"13\" fill=\"#333\"");
        widest = std::max(widest, width_of_text(number, 13));
    }
    svg.rectangle(bar, "fill=\"none\" stroke=\"#444\" stroke-width=\"1\"");
    const Point at = {bar.high.x + 9 + widest + 18, bar.centre().y};
    const std::string turn = "transform=\"rotate(-90 " + pixels(at.x) + " " + pixels(at.y) + ")\"";
    svg.text(at, name, "font-size=\"14\" fill=\"#111\" text-anchor=\"middle\" " + turn);
}

}  // namespace cli
