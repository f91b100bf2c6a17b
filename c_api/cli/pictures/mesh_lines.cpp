#include "pictures/mesh_lines.hpp"

#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "mesh/loops.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace cli {

namespace {

constexpr std::size_t max_edges = 80000;

// Edges that are nearer to the next ones than this are faint [pixels].
constexpr double clear_distance = 4;
constexpr std::array<double, 5> line_shades = {1, .6, .36, .22, .13};

// Returns about how far each edge is from the next one beside it: the area of the cells at the
// edge, by its length. `edges` are in order.
std::vector<double> distances_of(const std::vector<Edge>& edges, const Mesh& mesh,
                                 const std::vector<Point>& pixels) {
    std::vector<double> area(edges.size()), cells(edges.size());
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        const std::int32_t* const points = mesh.cell_points.data() + mesh.cell_start[cell];
        const std::int32_t n = mesh.cell_start[cell + 1] - mesh.cell_start[cell];
        double twice = 0;
        for (std::int32_t i = 0; i < n; ++i) {
            const Point a = pixels[place(points[i])], b = pixels[place(points[(i + 1) % n])];
            twice += a.x * b.y - b.x * a.y;
        }
        for (std::int32_t i = 0; i < n; ++i) {
            const auto ends = std::minmax(points[i], points[(i + 1) % n]);
            const Edge edge = {ends.first, ends.second};
            const auto found = std::lower_bound(edges.begin(), edges.end(), edge, precedes);
            if (found == edges.end() || precedes(edge, *found)) continue;
            area[static_cast<std::size_t>(found - edges.begin())] += std::abs(twice) / 2;
            cells[static_cast<std::size_t>(found - edges.begin())] += 1;
        }
    }
    for (std::size_t k = 0; k < edges.size(); ++k) {
        const double length = distance(pixels[place(edges[k].a)], pixels[place(edges[k].b)]);
        area[k] /= std::max(1e-300, length * std::max(1.0, cells[k]));
    }
    return area;
}

std::size_t shade_of(double distance) {
    std::size_t shade = 0;
    while (shade + 1 < line_shades.size() &&
           distance < clear_distance * std::sqrt(line_shades[shade] * line_shades[shade + 1]))
        ++shade;
    return shade;
}

// Replaces each point by the first point in the same square of `side` pixels. Returns the edges
// between different squares.
std::vector<Edge> thinned(const std::vector<Edge>& edges, const std::vector<Point>& pixels,
                          double side) {
    std::unordered_map<std::int64_t, std::int32_t> first;
    const auto stand_in = [&](std::int32_t point) {
        const Point pixel = pixels[place(point)];
        const auto column =
            static_cast<std::int64_t>(std::floor(std::clamp(pixel.x, -1e6, 1e6) / side));
        const auto row =
            static_cast<std::int64_t>(std::floor(std::clamp(pixel.y, -1e6, 1e6) / side));
        return first.try_emplace(column * 4000000 + row, point).first->second;
    };
    std::vector<Edge> fewer;
    for (const Edge edge : edges) {
        const std::int32_t a = stand_in(edge.a), b = stand_in(edge.b);
        if (a != b) fewer.push_back({std::min(a, b), std::max(a, b)});
    }
    remove_repeats(fewer);
    return fewer;
}

}  // namespace

std::string draw_mesh(Plot& plot, const Mesh& mesh, const std::vector<double>& x,
                      const std::vector<double>& y, const std::string& attributes) {
    std::vector<Point> pixels(x.size());
    for (std::size_t point = 0; point < x.size(); ++point)
        pixels[point] = plot.pixel({x[point], y[point]});
    const auto visible = [&](Edge edge) {
        Box box;
        box.include(pixels[place(edge.a)]);
        box.include(pixels[place(edge.b)]);
        return box.overlaps(plot.frame());
    };
    const std::vector<Edge> all = mesh_edges(mesh, visible);
    std::vector<Edge> edges = all;
    double side = 1;
    while (edges.size() > max_edges) edges = thinned(all, pixels, side *= 1.5);
    const bool is_thinned = edges.size() < all.size();
    const std::vector<double> apart =
        is_thinned ? std::vector<double>(edges.size(), side) : distances_of(edges, mesh, pixels);
    for (std::size_t shade = line_shades.size(); shade-- > 0;) {
        std::vector<Edge> alike;
        for (std::size_t k = 0; k < edges.size(); ++k) {
            if (shade_of(apart[k]) == shade) alike.push_back(edges[k]);
        }
        SvgPath path;
        for (const std::vector<std::int32_t>& chain : edge_chains(alike, mesh.points())) {
            path.move_to(pixels[place(chain[0])]);
            for (std::size_t i = 1; i < chain.size(); ++i) path.line_to(pixels[place(chain[i])]);
        }
        const std::string opacity =
            shade == 0 ? "" : " opacity=\"" + brief(line_shades[shade]) + "\"";
        if (!alike.empty()) plot.svg().path(path, "fill=\"none\" " + attributes + opacity);
    }
    if (edges.size() == all.size()) return "";
    return "Thinned: " + std::to_string(edges.size()) + " of " +
           plural(static_cast<std::int64_t>(all.size()), "visible edge") +
           " are drawn, with points in one square of " + brief(side) + " pixels as one.";
}

namespace {

constexpr double margin_of_bodies = .6;  // in parts of their extent
constexpr double small_share = .6;       // of the bodies and their margin, in parts of the mesh
constexpr double inset_share = .24;      // of the frame's shorter side

Box box_of_faces(const Mesh& mesh) {
    Box box;
    for (const std::int32_t point : mesh.face_points)
        box.include(Point{mesh.x[place(point)], mesh.y[place(point)]});
    return box;
}

}  // namespace

std::optional<Box> window_of_bodies(const Mesh& mesh) {
    const BoundaryLoops loops = loops_of(mesh);
    if (loops.count < 2) return {};
    const std::vector<Box> boxes = boxes_of_loops(loops, mesh);
    const auto outer = boxes.begin() + outer_loop(boxes);
    Box bodies;
    for (auto box = boxes.begin(); box != boxes.end(); ++box) {
        if (box != outer) bodies.include(*box);
    }
    const Box window = bodies.widened(margin_of_bodies * bodies.larger_side());
    if (window.larger_side() > small_share * outer->larger_side()) return {};
    return window;
}

void draw_inset(Plot& plot, const Mesh& mesh) {
    const Box whole = box_of_faces(mesh), frame = plot.frame();
    const double scale =
        inset_share * std::min(frame.width(), frame.height()) / whole.larger_side();
    const double width = scale * whole.width(), height = scale * whole.height(), gap = 8;
    const Point corner = {frame.high.x - width - gap, frame.low.y + gap};
    const auto pixel = [&](Point point) {
        return Point{corner.x + scale * (point.x - whole.low.x),
                     corner.y + scale * (whole.high.y - point.y)};
    };
    const Box around = {corner, {corner.x + width, corner.y + height}};
    plot.svg().rectangle(around.widened(4),
                         "fill=\"white\" fill-opacity=\".9\" stroke=\"#999\" class=\"inset\"");
    SvgPath path;
    for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
        for (const std::size_t end : {2 * face, 2 * face + 1}) {
            const auto point = place(mesh.face_points[end]);
            const Point at = pixel({mesh.x[point], mesh.y[point]});
            if (end == 2 * face) path.move_to(at);
            else path.line_to(at);
        }
    }
    plot.svg().path(path, "fill=\"none\" stroke=\"#111\" stroke-width=\".8\"");
    const Box window = plot.window();
    const Point low = pixel(
                    {std::max(window.low.x, whole.low.x), std::min(window.high.y, whole.high.y)}),
                high = pixel(
                    {std::min(window.high.x, whole.high.x), std::max(window.low.y, whole.low.y)});
    plot.svg().rectangle({low, {std::max(high.x, low.x + 2), std::max(high.y, low.y + 2)}},
                         "fill=\"none\" stroke=\"#d55e00\" stroke-width=\"1.4\"");
}

void draw_boundary(Plot& plot, const Mesh& mesh, std::int32_t marker,
                   const std::string& attributes) {
    std::vector<Edge> faces;
    for (std::int32_t face = 0; face < mesh.faces(); ++face) {
        const auto ends =
            std::minmax(mesh.face_points[2 * place(face)], mesh.face_points[2 * place(face) + 1]);
        if (marker < 0 || mesh.face_markers[place(face)] == marker)
            faces.push_back({ends.first, ends.second});
    }
    SvgPath path;
    for (const std::vector<std::int32_t>& chain : edge_chains(faces, mesh.points())) {
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const Point pixel = plot.pixel({mesh.x[place(chain[i])], mesh.y[place(chain[i])]});
            if (i == 0) {
                path.move_to(pixel);
            } else {
                path.line_to(pixel);
            }
        }
    }
    plot.svg().path(path, "fill=\"none\" " + attributes);
}

}  // namespace cli
