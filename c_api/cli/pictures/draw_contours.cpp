#include "pictures/draw_contours.hpp"

#include "basics/numbers.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

// Returns the line in pixels, without points that are not visibly apart from the preceding one.
std::vector<Point> in_pixels(const Plot& plot, const ContourLine& line) {
    constexpr double visible = .4;
    std::vector<Point> pixels;
    for (const Point& point : line.points) {
        const Point pixel = plot.pixel(point);
        if (pixels.empty() || distance(pixels.back(), pixel) >= visible) pixels.push_back(pixel);
    }
    if (pixels.size() > 1) pixels.back() = plot.pixel(line.points.back());
    return pixels;
}

// Writes values on lines, inside the frame, at the points farthest from the values already written.
class Labels {
public:
    Labels(Plot& plot, const std::vector<Point>& taken) : plot_(plot), taken_(taken) {}

    void add(const std::vector<Point>& line, const std::string& text) {
        constexpr double min_length = 90, min_room = 46;
        double length = 0;
        for (std::size_t i = 1; i < line.size(); ++i) length += distance(line[i - 1], line[i]);
        if (length < min_length) return;
        double best_room = min_room;
        std::size_t best = 0;
        for (std::size_t i = 2; i + 2 < line.size(); ++i) {
            const double room = room_at(line[i]);
            if (room > best_room) {
                best_room = room;
                best = i;
            }
        }
        if (best == 0) return;
        write(text, line[best], line[best - 2], line[best + 2]);
        places_.push_back(line[best]);
    }

private:
    double room_at(Point at) const {
        constexpr double border = 22, far = 400;
        const Box& frame = plot_.frame();
        if (at.x < frame.low.x + border || at.x > frame.high.x - border) return 0;
        if (at.y < frame.low.y + border || at.y > frame.high.y - border) return 0;
        double room = far;
        for (const Point& place : places_) room = std::min(room, distance(at, place));
        for (const Point& place : taken_) {
            if (distance(at, place) < 34) room = 0;
        }
        return room;
    }

    // Writes the value along the line, never upside down.
    void write(const std::string& text, Point at, Point before, Point after) {
        double angle = std::atan2(after.y - before.y, after.x - before.x) * 180 / pi;
        if (angle > 90) angle -= 180;
        if (angle < -90) angle += 180;
        const std::string turn =
            "transform=\"rotate(" + pixels(angle) + " " + pixels(at.x) + " " + pixels(at.y) + ")\"";
        const char* const style =
            "font-size=\"12\" fill=\"#111\" stroke=\"white\" stroke-width=\"3\" "
            "stroke-linejoin=\"round\" paint-order=\"stroke\" text-anchor=\"middle\" "
            "dy=\".35em\" ";
        plot_.svg().text({at.x, at.y}, text, style + turn);
    }

    Plot& plot_;
    const std::vector<Point>& taken_;
    std::vector<Point> places_;  // places of values
};

}  // namespace

void draw_contours(Plot& plot, const std::vector<ContourLine>& lines, double step,
                   const std::vector<Point>& taken) {
    std::vector<std::pair<std::vector<Point>, std::string>> drawn;
    SvgPath path;
    for (const ContourLine& line : lines) {
        std::vector<Point> pixels = in_pixels(plot, line);
        if (pixels.size() < 2) continue;
        path.move_to(pixels[0]);
        for (std::size_t i = 1; i < pixels.size(); ++i) path.line_to(pixels[i]);
        drawn.emplace_back(std::move(pixels), brief(line.multiple * step + 0.0));
    }
    plot.svg().path(path,
                    "fill=\"none\" stroke=\"#10222e\" stroke-width=\".8\" stroke-opacity=\".75\"");
    std::stable_sort(drawn.begin(), drawn.end(),
                     [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); });
    Labels labels(plot, taken);
    for (const auto& [pixels, text] : drawn) labels.add(pixels, text);
}

}  // namespace cli
