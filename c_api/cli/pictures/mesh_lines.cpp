#include "pictures/mesh_lines.hpp"

#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "mesh/loops.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace cli {

namespace {

constexpr std::size_t max_edges = 80000;

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
    SvgPath path;
    for (const std::vector<std::int32_t>& chain : edge_chains(edges, mesh.points())) {
        path.move_to(pixels[place(chain[0])]);
        for (std::size_t i = 1; i < chain.size(); ++i) path.line_to(pixels[place(chain[i])]);
    }
    plot.svg().path(path, "fill=\"none\" " + attributes);
    if (edges.size() == all.size()) return "";
    return "Thinned: " + std::to_string(edges.size()) + " of " +
           plural(static_cast<std::int64_t>(all.size()), "visible edge") +
           " are drawn, with points in one square of " + brief(side) + " pixels as one.";
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
