// Writes SVG documents. Coordinates are in pixels, with y downwards.
#pragma once

#include "basics/geometry.hpp"

#include <cstdint>
#include <string>

namespace cli {

// Returns the text for markup of SVG and HTML, quoted attributes included: readable, on one line.
std::string escaped(const std::string& text);

// The data of a path element. Points are rounded to hundredths of pixels, and written as short
// steps from point to point.
class SvgPath {
public:
    void move_to(Point pixel);
    void line_to(Point pixel);
    void close();
    void rectangle(const Box& box);
    const std::string& data() const { return data_; }

private:
    struct Grid {  // a point in hundredths of pixels; steps between such points have no rounding
                   // errors
        std::int64_t x, y;
    };
    static Grid rounded(Point pixel);
    void append_pair(std::int64_t x, std::int64_t y);

    std::string data_;
    Grid at_ = {0, 0};
    bool in_steps_ = false;  // the last command was a step, so that the next one needs no letter
};

class Svg {
public:
    // Browsers, screen readers and search engines read title and description, which are not drawn.
    Svg(double width, const std::string& title, const std::string& description);

    void path(const SvgPath& path, const std::string& attributes);
    void line(Point from, Point to, const std::string& attributes);
    void circle(Point centre, double radius, const std::string& attributes);
    void rectangle(const Box& box, const std::string& attributes);
    void text(Point at, const std::string& text,
              const std::string& attributes);  // text() escapes the text
    void raw(const std::string& markup) { body_ += markup; }
    std::string document(double height) const;  // the background is white

private:
    double width_;
    std::string title_, description_, body_;
};

std::string pixels(double value);                                 // at most two decimals, "12.5"
double width_of_text(const std::string& text, double font_size);  // estimate in pixels

}  // namespace cli
