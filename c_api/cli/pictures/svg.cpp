#include "pictures/svg.hpp"

#include "basics/print.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

std::int64_t hundredths(double value) {
    constexpr double far_away = 1e7;  // larger numbers of pixels look the same
    return std::llround(100 * std::clamp(value, -far_away, far_away));
}

// Returns a number as short as SVG allows: "-12.3", ".05", "7".
std::string short_decimal(std::int64_t hundredths) {
    const std::int64_t size = std::abs(hundredths), whole = size / 100, rest = size % 100;
    std::string text = hundredths < 0 ? "-" : "";
    if (whole > 0 || rest == 0) text += std::to_string(whole);
    if (rest > 0)
        text += rest < 10 ? ".0" + std::to_string(rest)
                          : "." + std::to_string(rest % 10 ? rest : rest / 10);
    return text;
}

std::string attribute(const char* name, double value) {
    return std::string(" ") + name + "=\"" + pixels(value) + "\"";
}

}  // namespace

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : readable(text)) {
        if (c == '<') result += "&lt;";
        else if (c == '>') result += "&gt;";
        else if (c == '&') result += "&amp;";
        else if (c == '"') result += "&quot;";
        else result += c;
    }
    return result;
}

SvgPath::Grid SvgPath::rounded(Point pixel) { return {hundredths(pixel.x), hundredths(pixel.y)}; }

void SvgPath::append_pair(std::int64_t x, std::int64_t y) {
    const bool needs_blank = !data_.empty() && data_.back() != 'l' && data_.back() != 'M' && x >= 0;
    data_ += (needs_blank ? " " : "") + short_decimal(x) + (y >= 0 ? " " : "") + short_decimal(y);
}

void SvgPath::move_to(Point pixel) {
    at_ = rounded(pixel);
    data_ += 'M';
    append_pair(at_.x, at_.y);
    in_steps_ = false;
}

void SvgPath::line_to(Point pixel) {
    const Grid next = rounded(pixel);
    if (next.x == at_.x && next.y == at_.y) return;
    if (!in_steps_) data_ += 'l';
    append_pair(next.x - at_.x, next.y - at_.y);
    at_ = next;
    in_steps_ = true;
}

void SvgPath::close() {
    data_ += 'z';
    in_steps_ = false;
}

void SvgPath::rectangle(const Box& box) {
    move_to(box.low);
    data_ +=
        "h" + pixels(box.width()) + "v" + pixels(box.height()) + "h" + pixels(-box.width()) + "z";
    in_steps_ = false;
}

Svg::Svg(double width, const std::string& title, const std::string& description)
    : width_(width), title_(title), description_(description) {}

void Svg::path(const SvgPath& path, const std::string& attributes) {
    if (!path.data().empty()) body_ += "<path " + attributes + " d=\"" + path.data() + "\"/>\n";
}

void Svg::line(Point from, Point to, const std::string& attributes) {
    body_ += "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) +
             attribute("y2", to.y) + " " + attributes + "/>\n";
}

void Svg::circle(Point centre, double radius, const std::string& attributes) {
    body_ += "<circle" + attribute("cx", centre.x) + attribute("cy", centre.y) +
             attribute("r", radius) + " " + attributes + "/>\n";
}

void Svg::rectangle(const Box& box, const std::string& attributes) {
    body_ += "<rect" + attribute("x", box.low.x) + attribute("y", box.low.y) +
             attribute("width", box.width()) + attribute("height", box.height()) + " " +
             attributes + "/>\n";
}

void Svg::text(Point at, const std::string& text, const std::string& attributes) {
    body_ += "<text" + attribute("x", at.x) + attribute("y", at.y) + " " + attributes + ">" +
             escaped(text) + "</text>\n";
}

std::string Svg::document(double document_height) const {
    const std::string width = pixels(width_), height = pixels(document_height);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height +
           "\" viewBox=\"0 0 " + width + " " + height +
           "\" role=\"img\" font-family=\"Helvetica, Arial, sans-serif\">\n<title>" +
           escaped(title_) + "</title>\n<desc>" + escaped(description_) +
           "</desc>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" + body_ + "</svg>\n";
}

std::string pixels(double value) { return short_decimal(hundredths(value)); }

double width_of_text(const std::string& text, double font_size) {
    return .55 * font_size * static_cast<double>(readable(text).size());
}

}  // namespace cli
