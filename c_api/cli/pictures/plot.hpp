// A sheet with one picture, or with several panels of the same part of the plane: title, frames
// with scales along x and y, what is drawn inside the frames, legend and notes below.
#pragma once

#include "pictures/svg.hpp"

#include <deque>
#include <string>
#include <vector>

namespace cli {

// The least of 1, 2, 5 times a power of ten that is not below `rough`, which is positive.
double round_step(double rough);

// The part of a sheet inside one frame.
class Plot {
public:
    Plot(Svg& svg, const Box& frame, const Box& window);

    const Box& window() const { return window_; }
    const Box& frame() const { return frame_; }  // the window in pixels
    Point pixel(Point point) const;
    SvgPath polyline(const std::vector<Point>& points) const;

    Svg& svg() { return svg_; }
    void begin_inside();  // what is drawn from here ...
    void end_inside();    // ... to here is cut off at the frame, which is drawn then
    void draw_scale(bool numbers_along_x, bool numbers_along_y);

private:
    Svg& svg_;
    Box frame_;
    double scale_;  // pixels per unit of length
    Box window_;
};

struct SheetLayout {
    std::size_t panels = 1;
    double right = 0;  // pixels kept free beside the frames, for a colour bar
};

class Sheet {
public:
    // window: what each panel shows at least.
    Sheet(const Box& window, const std::string& title, const std::string& subtitle,
          SheetLayout layout = {});
    Sheet(const Sheet&) = delete;

    std::size_t panels() const { return plots_.size(); }
    Plot& plot(std::size_t panel = 0) { return plots_[panel]; }
    Svg& svg() { return svg_; }
    void head(std::size_t panel, const std::string& text);  // over a panel
    Box frames() const;                                     // round all of them

    // Entries of the legend from left to right: a line, a disc or a box of these attributes, and
    // what it stands for.
    void legend_line(const std::string& attributes, const std::string& text);
    void legend_disc(double radius, const std::string& attributes, const std::string& text);
    void legend_box(const std::string& attributes, const std::string& text);
    void note(const std::string& text);  // lines of their own below; "" adds none
    std::string document() const;

private:
    double begin_entry(const std::string& text);

    double width_;
    Svg svg_;
    std::deque<Plot> plots_;
    double legend_x_ = 0, bottom_ = 0;
};

}  // namespace cli
