#include "pictures/draw_curves.hpp"

#include "basics/library.hpp"

#include <harmorph_design.h>

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

std::vector<Point> outline(const hm_curves& curves, std::int32_t index) {
    std::vector<Point> points;
    for (const double u : sample_parameters(curves.curve[index])) {
        double xy[2];
        call(std::string("curve"), hm_curve_point, &curves, index, u, 0, xy);
        points.push_back({xy[0], xy[1]});
    }
    return points;
}

std::int32_t control_index(const hm_curves& curves, const hm_curve& curve, std::int32_t i) {
    return curve.indices ? curve.indices[i] - curves.index_base : i;
}

// Returns the control points of a curve in order; the polygon of a closed curve ends with the first
// point.
std::vector<std::int32_t> polygon(const hm_curves& curves, std::int32_t index) {
    const hm_curve& curve = curves.curve[index];
    std::vector<std::int32_t> points;
    for (std::int32_t i = 0; i < curve.n_indices; ++i) {
        points.push_back(control_index(curves, curve, i));
        if (i > 0 && points.back() == points.front()) break;
    }
    return points;
}

bool runs_clockwise(const hm_curves& curves, const std::vector<std::int32_t>& polygon) {
    double area = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point a = control_point(curves, polygon[i]);
        const Point b = control_point(curves, polygon[(i + 1) % polygon.size()]);
        area += a.x * b.y - b.x * a.y;
    }
    return area <= 0;
}

// Returns the unit vector that leads away from the polygon at a corner; if the polygon runs
// clockwise, this vector points to the left.
Point outward(const hm_curves& curves, const std::vector<std::int32_t>& polygon,
              std::size_t corner) {
    const std::size_t last = polygon.size() - 1;
    const bool closed = polygon.front() == polygon.back();
    const std::size_t before = corner > 0 ? corner - 1 : closed ? last - 1 : corner;
    const std::size_t after = corner < last ? corner + 1 : closed ? 1 : corner;
    const Point a = control_point(curves, polygon[before]);
    const Point b = control_point(curves, polygon[after]);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0)) return {0, 1};
    const double left = runs_clockwise(curves, polygon) ? 1 : -1;
    return {-left * (b.y - a.y) / length, left * (b.x - a.x) / length};
}

// Returns the place at a distance, in pixels, from a control point to the outside of the control
// polygon, or the control point if it belongs to no polygon.
Point beside(const Plot& plot, const hm_curves& curves, std::int32_t index, double distance) {
    const Point pixel = plot.pixel(control_point(curves, index));
    for (std::int32_t i = 0; i < curves.n_curves; ++i) {
        const std::vector<std::int32_t> corners = polygon(curves, i);
        const auto at = std::find(corners.begin(), corners.end(), index);
        if (at == corners.end()) continue;
        const Point away = outward(curves, corners, static_cast<std::size_t>(at - corners.begin()));
        return {pixel.x + distance * away.x, pixel.y - distance * away.y};
    }
    return pixel;
}

}  // namespace

std::vector<double> sample_parameters(const hm_curve& curve) {
    constexpr int samples = 24;
    std::vector<double> parameters;
    for (std::int32_t span = curve.degree; span < curve.n_indices; ++span) {
        const double begin = curve.knots[span], end = curve.knots[span + 1];
        for (int i = parameters.empty() ? 0 : 1; i <= samples && begin < end; ++i) {
            parameters.push_back(i == samples ? end : begin + (end - begin) * i / samples);
        }
    }
    return parameters;
}

Box box_of(const hm_curves& curves) {
    Box box;
    for (std::int32_t i = 0; i < curves.n_curves; ++i) {
        for (const Point point : outline(curves, i)) box.include(point);
    }
    return box;
}

Box box_of_bodies(const hm_basis_info& info, const std::vector<double>& x,
                  const std::vector<double>& y) {
    Box box;
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        const auto point = static_cast<std::size_t>(info.curve_point[k]);
        if (info.point_curve[k] >= info.curves) box.include(Point{x[point], y[point]});
    }
    return box;
}

Box window_round(const std::vector<Box>& boxes, double chords) {
    Box all;
    for (const Box& box : boxes) all.include(box);
    const double chord = std::max(all.width(), all.height());
    return all.widened(chord > 0 ? chords * chord : 1);  // all control points may lie at one place
}

void draw_outlines(Plot& plot, const hm_curves& curves, const std::string& attributes) {
    for (std::int32_t i = 0; i < curves.n_curves; ++i) {
        plot.svg().path(plot.polyline(outline(curves, i)),
                        "fill=\"none\" stroke-linejoin=\"round\" " + attributes);
    }
}

void draw_control_polygons(Plot& plot, const hm_curves& curves, const std::string& attributes) {
    for (std::int32_t i = 0; i < curves.n_curves; ++i) {
        std::vector<Point> points;
        for (const std::int32_t index : polygon(curves, i))
            points.push_back(control_point(curves, index));
        plot.svg().path(plot.polyline(points), "fill=\"none\" " + attributes);
    }
}

void draw_control_points(Plot& plot, const hm_curves& curves, double radius,
                         const std::string& attributes) {
    for (std::int32_t i = 0; i < curves.n_control; ++i) {
        plot.svg().circle(plot.pixel(control_point(curves, i)), radius, attributes);
    }
}

void draw_numbers(Plot& plot, const hm_curves& curves, const LabelStyle& style, std::int32_t chosen,
                  const LabelStyle& chosen_style) {
    std::vector<Box> taken;
    const auto draw = [&](std::int32_t index, const LabelStyle& label) {
        const Point at = beside(plot, curves, index, label.distance);
        const std::string text = std::to_string(index + 1);
        const double width = width_of_text(text, label.font_size) / 2,
                     height = .4 * label.font_size;
        const Box box = {{at.x - width, at.y - height}, {at.x + width, at.y + height}};
        if (std::any_of(taken.begin(), taken.end(),
                        [&](const Box& other) { return box.overlaps(other); }))
            return;
        taken.push_back(box);
        plot.svg().text({at.x, at.y + .36 * label.font_size}, text,
                        "text-anchor=\"middle\" stroke=\"white\" stroke-width=\"3\" "
                        "paint-order=\"stroke\" font-size=\"" +
                            pixels(label.font_size) + "\" " + label.attributes);
    };
    if (chosen >= 0 && chosen < curves.n_control) draw(chosen, chosen_style);
    for (std::int32_t i = 0; i < curves.n_control; ++i) {
        if (i != chosen) draw(i, style);
    }
}

std::int32_t place_on_curve(const hm_curves& curves, std::int32_t curve, std::int32_t index) {
    const std::vector<std::int32_t> corners = polygon(curves, curve);
    const auto at = std::find(corners.begin(), corners.end(), index);
    return at == corners.end() ? -1 : static_cast<std::int32_t>(at - corners.begin());
}

Point control_point(const hm_curves& curves, std::int32_t index) {
    return {curves.control[2 * index], curves.control[2 * index + 1]};
}

}  // namespace cli
