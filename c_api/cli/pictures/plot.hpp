// A sheet with one picture, or with several panels of the same part of the plane. A sheet has a
// title, frames with scales along x and y, and a legend and notes below.
#pragma once

#include "pictures/svg.hpp"

#include <deque>
#include <string>
#include <vector>

namespace cli {

// Returns the smallest number not below `rough` that is 1, 2 or 5 times a power of ten. `rough`
// must be positive.
double round_step(double rough);

// A plot is the part of a sheet inside one frame.
class Plot {
public:
    Plot(Svg& svg, const Box& frame, const Box& window);

    const Box& window() const { return window_; }
    const Box& frame() const { return frame_; }  // the window in pixels
    Point pixel(Point point) const;
    SvgPath polyline(const std::vector<Point>& points) const;

    Svg& svg() { return svg_; }
    // Drawings between these two calls are cut off at the frame, which end_inside() draws.
    void begin_inside();
    void end_inside();
    void draw_scale(bool numbers_along_x, bool numbers_along_y);

private:
    Svg& svg_;
    Box frame_;
    double scale_;  // pixels per unit of length
    Box window_;
};

struct SheetLayout {
    std::size_t panels = 1;
    double right = 0;  // free width beside the frames, for a colour bar [pixels]
};

class Sheet {
public:
    // Each panel shows at least the window.
    Sheet(const Box& window, const std::string& title, const std::string& subtitle,
          SheetLayout layout = {});
    Sheet(const Sheet&) = delete;

    std::size_t panels() const { return plots_.size(); }
    Plot& plot(std::size_t panel = 0) { return plots_[panel]; }
    Svg& svg() { return svg_; }
    void head(std::size_t panel, const std::string& text);  // text above a panel
    Box frames() const;                                     // box round all frames

    // Adds an entry to the legend, from left to right: a line, a disc or a box of these attributes,
    // and its meaning.
    void legend_line(const std::string& attributes, const std::string& text);
    void legend_disc(double radius, const std::string& attributes, const std::string& text);
    void legend_box(const std::string& attributes, const std::string& text);
    void note(const std::string& text);  // adds lines below the legend; "" adds none
    std::string document() const;

private:
    double begin_entry(const std::string& text);

    double width_;
    Svg svg_;
    std::deque<Plot> plots_;
    double legend_x_ = 0, bottom_ = 0;
};

}  // namespace cli
