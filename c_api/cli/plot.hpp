// A picture of a part of the plane: title, frame, and what is drawn inside the frame.
#pragma once

#include "svg.hpp"

#include <string>
#include <vector>

namespace cli {

class Plot {
public:
    // window: what to show at least; right: pixels kept free beside the frame.
    Plot(const Box& window, const std::string& title, const std::string& subtitle, double right = 0);

    const Box& window() const { return window_; }
    const Box& frame() const { return frame_; } // the window in pixels
    Point pixel(Point point) const;
    SvgPath polyline(const std::vector<Point>& points) const;

    Svg& svg() { return svg_; }
    void begin_inside(); // what is drawn from here ...
    void end_inside();   // ... to here is cut off at the frame

private:
    Box frame_;
    double scale_; // pixels per unit of length
    Box window_;
    Svg svg_;
};

} // namespace cli
