#include "plot.hpp"

#include <algorithm>

namespace cli {

namespace {

constexpr double width = 1200, margin = 24, above = 68, below = 46;
constexpr double lowest = 320, highest = 900; // of the frame

Box frame_of(const Box& window, double right) {
    const double frame_width = width - 2 * margin - right;
    const double height = std::clamp(frame_width * window.height() / window.width(), lowest, highest);
    return {{margin, above}, {margin + frame_width, above + height}};
}

// The wished window, and more on two sides where its shape is not that of the frame.
Box fill(const Box& frame, double scale, Point centre) {
    const double x = frame.width() / scale / 2, y = frame.height() / scale / 2;
    return {{centre.x - x, centre.y - y}, {centre.x + x, centre.y + y}};
}

} // namespace

Plot::Plot(const Box& window, const std::string& title, const std::string& subtitle, double right)
    : frame_(frame_of(window, right)),
      scale_(std::min(frame_.width() / window.width(), frame_.height() / window.height())),
      window_(fill(frame_, scale_, window.centre())), svg_(width, frame_.high.y + below) {
    svg_.text({margin, 32}, title, "font-size=\"20\" font-weight=\"bold\" fill=\"#222\"");
    svg_.text({margin, 55}, subtitle, "font-size=\"14\" fill=\"#555\"");
    svg_.raw("<clipPath id=\"frame\">\n");
    svg_.rectangle(frame_, "");
    svg_.raw("</clipPath>\n");
}

Point Plot::pixel(Point point) const {
    return {frame_.low.x + scale_ * (point.x - window_.low.x), frame_.high.y - scale_ * (point.y - window_.low.y)};
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

void Plot::begin_inside() { svg_.raw("<g clip-path=\"url(#frame)\">\n"); }

void Plot::end_inside() {
    svg_.raw("</g>\n");
    svg_.rectangle(frame_, "fill=\"none\" stroke=\"#bbb\"");
}

} // namespace cli
