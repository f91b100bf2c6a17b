#include "harmorph/places.hpp"

namespace harmorph {

void Places::lay_out(Arena& arena, Index max_unknowns) noexcept {
    arena.take(place, max_unknowns);
    arena.take(reach, max_unknowns);
    arena.take(queue, max_unknowns);
}

// Breadth first from the unknowns beside curves; what is not reached (no curve in its part of the mesh) is layer 0.
void Places::find_layers(Graph const& graph) const noexcept {
    auto const layer = [&](Index u) -> float& { return place[u].at[layer_direction]; };
    Index filled = 0;
    for (Index u = 0; u < graph.n; ++u) {
        bool const is_first = graph.beside_curve[u] != 0;
        layer(u) = is_first ? 1 : 0;
        if (is_first) queue[filled++] = u;
    }
    for (Index read = 0; read < filled; ++read) {
        Index const u = queue[read];
        for (Index const v : graph.of(u)) {
            if (layer(v) != 0) continue;
            layer(v) = layer(u) + 1;
            queue[filled++] = v;
        }
    }
}

void Places::find_reach(Graph const& graph, Index u) const noexcept {
    constexpr float outwards = 1.000001f;
    Four ahead[halves] = {}, behind[halves] = {};
    for (Index const v : graph.of(u)) {
        for (Index half = 0; half < halves; ++half) {
            Four const step = four(place[v].at, half) - four(place[u].at, half);
            ahead[half] = step > ahead[half] ? step : ahead[half];
            behind[half] = -step > behind[half] ? -step : behind[half];
        }
    }
    for (Index half = 0; half < halves; ++half) {
        set_four(reach[u].ahead, half, outwards * ahead[half]);
        set_four(reach[u].behind, half, outwards * behind[half]);
    }
}

// Coordinates about the first point, which are small numbers where the mesh is fine.
void Places::find(Graph const& graph, Points points, Executor const& executor) const noexcept {
    constexpr Index least = 4096;  // unknowns that are worth a task
    Vec2 const origin = points[graph.point(0)];
    Real largest = 0;
    for (Index u = 0; u < graph.n; ++u) {
        Vec2 const p = points[graph.point(u)] - origin;
        largest = larger(largest, larger(absolute(p.x), absolute(p.y)));
    }
    Real const scale = largest > 1e30 || largest < 1e-30 ? 1 / largest : 1;  // single precision ends at 1e38
    executor.for_ranges(graph.n, least, [&](Index begin, Index end) {
        for (Index u = begin; u < end; ++u) {
            Vec2 const p = scale * (points[graph.point(u)] - origin);
            float const x = static_cast<float>(p.x), y = static_cast<float>(p.y);
            place[u] = {{x, y, x + y, x - y}};
        }
    });
    find_layers(graph);
    executor.for_ranges(graph.n, least, [&](Index begin, Index end) {
        for (Index u = begin; u < end; ++u) find_reach(graph, u);
    });
}

}  // namespace harmorph
