#include "mesh/loops.hpp"

#include "basics/elementary.hpp"
#include "basics/geometry.hpp"
#include "basics/text.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cli {

namespace {

// The edges at each point, with a record of the edges that no chain has used yet.
class UnusedEdges {
public:
    UnusedEdges(const std::vector<Edge>& edges, std::int32_t n_points)
        : edges_(edges), used_(edges.size()), begin_(static_cast<std::size_t>(n_points) + 1) {
        for (const Edge& edge : edges) {
            ++begin_[index(edge.a) + 1];
            ++begin_[index(edge.b) + 1];
        }
        for (std::size_t point = 1; point < begin_.size(); ++point)
            begin_[point] += begin_[point - 1];
        next_ = begin_;
        at_point_.resize(2 * edges.size());
        for (std::size_t edge = 0; edge < edges.size(); ++edge) {
            at_point_[next_[index(edges[edge].a)]++] = edge;
            at_point_[next_[index(edges[edge].b)]++] = edge;
        }
        next_ = begin_;
    }

    // Uses an edge at the point and returns its other point, or -1 if there is no edge left.
    std::int32_t follow(std::int32_t point) {
        std::size_t& next = next_[index(point)];
        for (; next < begin_[index(point) + 1]; ++next) {
            const std::size_t edge = at_point_[next];
            if (used_[edge]) continue;
            used_[edge] = true;
            return edges_[edge].a == point ? edges_[edge].b : edges_[edge].a;
        }
        return -1;
    }

private:
    static std::size_t index(std::int32_t point) { return static_cast<std::size_t>(point); }

    const std::vector<Edge>& edges_;
    std::vector<bool> used_;
    // Compressed rows: the edges of point p are at_point_[begin_[p]] ...; next_[p] is the index of
    // the first one that may be unused.
    std::vector<std::size_t> begin_, next_, at_point_;
};

}  // namespace

void remove_repeats(std::vector<Edge>& edges) {
    const auto is_same = [](Edge one, Edge other) { return one.a == other.a && one.b == other.b; };
    std::sort(edges.begin(), edges.end(), precedes);
    edges.erase(std::unique(edges.begin(), edges.end(), is_same), edges.end());
}

std::vector<Edge> mesh_edges(const Mesh& mesh, const std::function<bool(Edge)>& visible) {
    std::vector<Edge> edges;
    for_each_side(mesh, 0, mesh.cell_start.size() - 1, [&](std::int32_t a, std::int32_t b) {
        const Edge edge = {std::min(a, b), std::max(a, b)};
        if (visible(edge)) edges.push_back(edge);
    });
    remove_repeats(edges);
    return edges;
}

std::vector<std::vector<std::int32_t>> edge_chains(const std::vector<Edge>& edges,
                                                   std::int32_t n_points) {
    UnusedEdges unused(edges, n_points);
    std::vector<std::vector<std::int32_t>> chains;
    for (const Edge& edge : edges) {
        std::vector<std::int32_t> chain = {edge.a};
        for (std::int32_t point = edge.a; (point = unused.follow(point)) >= 0;)
            chain.push_back(point);
        if (chain.size() > 1) chains.push_back(std::move(chain));
    }
    return chains;
}

std::unordered_map<std::int32_t, std::int32_t> points_by_place(
    const Mesh& mesh, const std::vector<std::int32_t>& points) {
    const auto x = [&](std::int32_t p) { return mesh.x[static_cast<std::size_t>(p)]; };
    const auto y = [&](std::int32_t p) { return mesh.y[static_cast<std::size_t>(p)]; };
    const auto along = [&](std::int32_t p) { return x(p) + 0.7548776662466927 * y(p); };
    std::vector<std::int32_t> order(points);
    std::sort(order.begin(), order.end());
    order.erase(std::unique(order.begin(), order.end()), order.end());
    const auto by_x = [&](std::int32_t a, std::int32_t b) { return x(a) < x(b); };
    const auto by_y = [&](std::int32_t a, std::int32_t b) { return y(a) < y(b); };
    std::unordered_map<std::int32_t, std::int32_t> place;
    if (order.empty()) return place;
    const auto [left, right] = std::minmax_element(order.begin(), order.end(), by_x);
    const auto [low, high] = std::minmax_element(order.begin(), order.end(), by_y);
    const double largest = std::max(
        {std::fabs(x(*left)), std::fabs(x(*right)), std::fabs(y(*low)), std::fabs(y(*high))});
    const double tolerance =
        std::max(1e-12 * length_of(x(*right) - x(*left), y(*high) - y(*low)), 1e-15 * largest);
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        return along(a) != along(b) ? along(a) < along(b) : a < b;
    });
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::int32_t here = order[k];
        place[here] = here;
        for (std::size_t before = k; before-- > 0;) {
            const std::int32_t other = order[before];
            if (along(here) - along(other) > 4 * tolerance) break;
            const double apart =
                std::max(std::fabs(x(here) - x(other)), std::fabs(y(here) - y(other)));
            if (apart <= tolerance) place[here] = place[other];
        }
    }
    return place;
}

std::vector<std::int32_t> joined_ends(const Mesh& mesh, std::vector<std::int32_t> ends) {
    std::vector<bool> is_odd(mesh.x.size());
    for (const std::int32_t point : ends) is_odd[place(point)] = !is_odd[place(point)];
    std::vector<std::int32_t> odd;
    for (std::size_t point = 0; point < is_odd.size(); ++point) {
        if (is_odd[point]) odd.push_back(static_cast<std::int32_t>(point));
    }
    const auto at = points_by_place(mesh, odd);
    std::unordered_map<std::int32_t, std::int32_t> smallest;  // by the first point of a place
    for (const std::int32_t point : odd) smallest.emplace(at.at(point), point);
    for (std::int32_t& point : ends) {
        if (is_odd[place(point)]) point = smallest.at(at.at(point));
    }
    return ends;
}

BoundaryLoops::BoundaryLoops(const std::vector<std::int32_t>& ends, std::int32_t n_points) {
    // The points of one loop have one root, which is the smallest of them.
    std::vector<std::int32_t> parent(place(n_points));
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&parent](std::int32_t point) {
        while (parent[place(point)] != point) {
            std::int32_t& up = parent[place(point)];
            point = up = parent[place(up)];
        }
        return point;
    };
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
        const std::int32_t a = root(ends[i]), b = root(ends[i + 1]);
        parent[place(std::max(a, b))] = std::min(a, b);
    }
    std::vector<std::int32_t> number(place(n_points), -1);
    for (const std::int32_t point : ends) number[place(root(point))] = 0;
    for (std::int32_t& loop : number) {
        if (loop == 0) loop = count++;
    }
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
        of_edge.push_back(number[place(root(ends[i]))]);
}

BoundaryLoops loops_of(const Mesh& mesh) {
    return {joined_ends(mesh, mesh.face_points), mesh.points()};
}

std::vector<Box> boxes_of_loops(const BoundaryLoops& loops, const Mesh& mesh) {
    std::vector<Box> boxes(place(loops.count));
    for (std::size_t end = 0; end < mesh.face_points.size(); ++end) {
        const std::int32_t point = mesh.face_points[end];
        boxes[place(loops.of_edge[end / 2])].include(
            Point{mesh.x[place(point)], mesh.y[place(point)]});
    }
    return boxes;
}

std::int32_t outer_loop(const std::vector<Box>& boxes) {
    const auto outer = std::max_element(
        boxes.begin(), boxes.end(),
        [](const Box& one, const Box& other) { return one.larger_side() < other.larger_side(); });
    return outer == boxes.end() ? -1 : static_cast<std::int32_t>(outer - boxes.begin());
}

namespace {

// Counts the loops around one point of a loop, by the parity of the faces to the right of it.
std::int32_t loops_around(const Mesh& mesh, const BoundaryLoops& loops, std::int32_t loop,
                          std::int32_t point, const double* x, const double* y) {
    const double px = x[place(point)], py = y[place(point)];
    std::vector<bool> is_inside(place(loops.count));
    for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
        const auto a = place(mesh.face_points[2 * face]), b = place(mesh.face_points[2 * face + 1]);
        if (loops.of_edge[face] == loop || (y[a] > py) == (y[b] > py)) continue;
        const double crossing = x[a] + (py - y[a]) / (y[b] - y[a]) * (x[b] - x[a]);
        const auto other = place(loops.of_edge[face]);
        if (crossing > px) is_inside[other] = !is_inside[other];
    }
    return static_cast<std::int32_t>(std::count(is_inside.begin(), is_inside.end(), true));
}

}  // namespace

std::string why_bodies_cannot_be_there(const Mesh& mesh, const Field& moved) {
    const BoundaryLoops loops = loops_of(mesh);
    std::vector<bool> is_done(place(loops.count));
    for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
        const std::int32_t loop = loops.of_edge[face], point = mesh.face_points[2 * face];
        if (is_done[place(loop)]) continue;
        is_done[place(loop)] = true;
        const auto around = [&](const double* x, const double* y) {
            return loops_around(mesh, loops, loop, point, x, y);
        };
        const std::int32_t before = around(mesh.x.data(), mesh.y.data());
        const std::int32_t after = around(moved.x.data(), moved.y.data());
        if (before == after) continue;
        return "marker " + in_quotes(mesh.markers[place(mesh.face_markers[face])]) +
               (after < before ? " would be outside the domain" : " would be inside another body");
    }
    return {};
}

}  // namespace cli
