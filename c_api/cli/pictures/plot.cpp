#include "pictures/plot.hpp"

#include "basics/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace cli {

namespace {

constexpr double left = 62, right_margin = 20, above = 50, axis_space = 36;
constexpr double line_height = 20;              // height of a line of the subtitle
constexpr double heading_space = 26, gap = 18;  // space between panels
constexpr double row_height = 24;               // height of a row of legend and notes

constexpr const char* number_style = "font-size=\"13\" fill=\"#333\"";
constexpr const char* tick_style = "stroke=\"#444\" stroke-width=\"1\"";

std::size_t columns_for(std::size_t panels) {
    return panels <= 3 ? panels : panels == 4 ? 2 : panels <= 9 ? 3 : 4;
}

// Returns the window of the frame's shape with this centre.
Box fill(const Box& frame, double scale, Point centre) {
    const double x = frame.width() / scale / 2, y = frame.height() / scale / 2;
    return {{centre.x - x, centre.y - y}, {centre.x + x, centre.y + y}};
}

// Breaks a text into lines that fit into a width. Long lines are shorter than the estimate of
// width_of_text(), which is for short labels.
std::vector<std::string> broken(const std::string& text, double font_size, double width) {
    std::vector<std::string> lines(1);
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        std::string& line = lines.back();
        const std::string longer = line.empty() ? word : line + " " + word;
        if (line.empty() || .9 * width_of_text(longer, font_size) <= width) {
            line = longer;
        } else {
            lines.push_back(word);
        }
    }
    return lines;
}

}  // namespace

double round_step(double rough) {
    const double power = std::pow(10, std::floor(std::log10(rough)));
    for (const double round : {1.0, 2.0, 5.0}) {
        if (rough <= round * power * (1 + 1e-9)) return round * power;
    }
    return 10 * power;
}

Plot::Plot(Svg& svg, const Box& frame, const Box& window)
    : svg_(svg),
      frame_(frame),
      scale_(std::min(frame_.width() / window.width(), frame_.height() / window.height())),
      window_(fill(frame_, scale_, window.centre())) {}

Point Plot::pixel(Point point) const {
    return {frame_.low.x + scale_ * (point.x - window_.low.x),
            frame_.high.y - scale_ * (point.y - window_.low.y)};
}

SvgPath Plot::polyline(const std::vector<Point>& points) const {
    SvgPath path;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i == 0) {
            path.move_to(pixel(points[i]));
        } else {
            path.line_to(pixel(points[i]));
        }
    }
    return path;
}

void Plot::begin_inside() {
    const std::string id = "frame" + pixels(frame_.low.x) + "-" + pixels(frame_.low.y);
    svg_.raw("<clipPath id=\"" + id + "\">\n");
    svg_.rectangle(frame_, "");
    svg_.raw("</clipPath>\n<g clip-path=\"url(#" + id + ")\">\n");
}

void Plot::end_inside() {
    svg_.raw("</g>\n");
    svg_.rectangle(frame_, "fill=\"none\" stroke=\"#444\" stroke-width=\"1\"");
}

void Plot::draw_scale(bool numbers_along_x, bool numbers_along_y) {
    double step = round_step(90 / scale_);
    for (double i = std::ceil(window_.low.x / step); i * step <= window_.high.x; ++i) {
        const double x = pixel({i * step, 0}).x;
        svg_.line({x, frame_.high.y}, {x, frame_.high.y + 5}, tick_style);
        if (!numbers_along_x || x > frame_.high.x - 24) continue;  // the place of the letter x
        svg_.text({x, frame_.high.y + 19}, brief(i * step + 0.0),
                  std::string("text-anchor=\"middle\" ") + number_style);
    }
    step = std::min(step, round_step(50 / scale_));
    for (double i = std::ceil(window_.low.y / step); i * step <= window_.high.y; ++i) {
        const double y = pixel({0, i * step}).y;
        svg_.line({frame_.low.x - 5, y}, {frame_.low.x, y}, tick_style);
        if (!numbers_along_y || y < frame_.low.y + 20) continue;  // the place of the letter y
        svg_.text({frame_.low.x - 8, y + 4.5}, brief(i * step + 0.0),
                  std::string("text-anchor=\"end\" ") + number_style);
    }
    const char* const name_style =
        "font-size=\"15\" font-style=\"italic\" fill=\"#111\" text-anchor=\"end\"";
    if (numbers_along_x) svg_.text({frame_.high.x, frame_.high.y + 19}, "x", name_style);
    if (numbers_along_y) svg_.text({frame_.low.x - 9, frame_.low.y + 11}, "y", name_style);
}

Sheet::Sheet(const Box& window, const std::string& title, const std::string& subtitle,
             SheetLayout layout)
    : width_(columns_for(layout.panels) < 3 ? 960 : 1200), svg_(width_, title, subtitle) {
    // The height of a single frame, and of each of several frames.
    constexpr double min_height[] = {320, 180}, max_height[] = {900, 420};
    const std::size_t columns = columns_for(layout.panels);
    const bool is_single = layout.panels == 1;
    const auto n = static_cast<double>(columns);
    const double frame_width = (width_ - left - right_margin - layout.right - gap * (n - 1)) / n;
    const double shape = window.height() / window.width();
    const double height = std::clamp(frame_width * shape, min_height[is_single ? 0 : 1],
                                     max_height[is_single ? 0 : 1]);
    svg_.text({left, 32}, title, "font-size=\"20\" font-weight=\"bold\" fill=\"#111\"");
    double top = above;
    for (const std::string& line : broken(subtitle, 15, width_ - left - right_margin)) {
        svg_.text({left, top + 6}, line, "font-size=\"15\" fill=\"#444\"");
        top += line_height;
    }
    for (std::size_t k = 0; k < layout.panels; ++k) {
        const std::size_t row = k / columns, column = k % columns;
        const double x = left + (frame_width + gap) * static_cast<double>(column);
        const double heading = is_single ? 0 : heading_space;
        const double y = top + heading + (height + heading + gap) * static_cast<double>(row);
        plots_.emplace_back(svg_, Box{{x, y}, {x + frame_width, y + height}}, window);
        plots_.back().draw_scale(k + columns >= layout.panels, column == 0);
    }
    bottom_ = frames().high.y + axis_space;
}

void Sheet::head(std::size_t panel, const std::string& text) {
    const Box& frame = plots_[panel].frame();
    svg_.text({frame.low.x, frame.low.y - 8}, text,
              "font-size=\"14\" font-weight=\"bold\" fill=\"#111\"");
}

Box Sheet::frames() const {
    Box all;
    for (const Plot& plot : plots_) all.include(plot.frame());
    return all;
}

// Returns the place where an entry begins. The next entry follows, on a new row if this row is
// full.
double Sheet::begin_entry(const std::string& text) {
    constexpr double sign = 40;
    const double needed = sign + width_of_text(text, 14) + 22;
    if (legend_x_ == 0 || legend_x_ + needed > width_ - right_margin + 22) {
        legend_x_ = left;
        bottom_ += row_height;
    }
    const double x = legend_x_;
    legend_x_ += needed;
    svg_.text({x + sign, bottom_ - 7}, text, "font-size=\"14\" fill=\"#222\"");
    return x;
}

void Sheet::legend_line(const std::string& attributes, const std::string& text) {
    const double x = begin_entry(text), y = bottom_ - 12;
    svg_.line({x, y}, {x + 32, y}, attributes);
}

void Sheet::legend_disc(double radius, const std::string& attributes, const std::string& text) {
    const double x = begin_entry(text), y = bottom_ - 12;
    svg_.circle({x + 16, y}, radius, attributes);
}

void Sheet::legend_box(const std::string& attributes, const std::string& text) {
    const double x = begin_entry(text), y = bottom_ - 12;
    svg_.rectangle({{x + 4, y - 7}, {x + 30, y + 7}}, attributes);
}

void Sheet::note(const std::string& text) {
    if (text.empty()) return;
    legend_x_ = 0;
    for (const std::string& line : broken(text, 13, width_ - left - right_margin)) {
        bottom_ += row_height;
        svg_.text({left, bottom_ - 7}, line, "font-size=\"13\" fill=\"#666\"");
    }
}

std::string Sheet::document() const { return svg_.document(bottom_ + 8); }

}  // namespace cli
