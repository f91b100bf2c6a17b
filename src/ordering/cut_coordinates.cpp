#include "harmorph/ordering/cut_coordinates.hpp"

namespace harmorph {
namespace {

constexpr float unreached = -1;

}  // namespace

void Places::lay_out(Arena& arena, Index max_unknowns) noexcept {
    arena.take(place, max_unknowns);
    arena.take(queue, max_unknowns);
    arena.take(step, max_unknowns);
}

// Breadth first: unknowns of the queue, from `read` on, hand their numbers, plus 1, to neighbours that have none.
Index Places::spread(Graph const& graph, Span<Index> its_queue, Index read, Index filled) const noexcept {
    for (; read < filled; ++read) {
        graph.expect(its_queue, read, filled);
        Index const u = its_queue[read];
        float const next = step[u] + 1;
        for (Index const v : graph.of(u)) {
            if (step[v] >= 0) continue;
            step[v] = next;
            its_queue[filled++] = v;
        }
    }
    return filled;
}

// From the unknowns beside curves; what is not reached (no curve in its part of the mesh) is before all layers.
void Places::find_layers(Graph const& graph) const noexcept {
    fill(step.first(graph.n), unreached);
    Index filled = 0;
    for (Index u = 0; u < graph.n; ++u) {
        if (graph.beside_curve[u] == 0) continue;
        step[u] = 0;
        queue[filled++] = u;
    }
    spread(graph, queue, 0, filled);
}

void Places::find_levels(Graph const& graph, Span<const Index> part, Span<Index> its_queue) const noexcept {
    auto const spread_from = [&](Index u, float its_level, Index filled) {
        step[u] = its_level;
        its_queue[filled] = u;
        return spread(graph, its_queue, filled, filled + 1);
    };
    Index start = part[0], filled = 0;
    for (Index sweep = 0; sweep < 2; ++sweep) {  // the second from where the first one ends
        for (Index const u : part) step[u] = unreached;
        filled = spread_from(start, 0, 0);
        start = its_queue[filled - 1];
    }
    for (Index const u : part) {  // what hangs apart comes behind
        if (step[u] < 0) filled = spread_from(u, step[its_queue[filled - 1]] + 1, filled);
    }
    for (Index const u : part) place[u].at[level_direction] = step[u];
}

void Places::find_reach(Graph const& graph, Index u) const noexcept {
    constexpr float outwards = 1.000001f;
    Four farthest[halves] = {};
    for (Index const v : graph.of(u)) {
        for (Index half = 0; half < halves; ++half) {
            Four const apart = four(place[v].at, half) - four(place[u].at, half);
            farthest[half] = apart > farthest[half] ? apart : farthest[half];
            farthest[half] = -apart > farthest[half] ? -apart : farthest[half];
        }
    }
    for (Index half = 0; half < halves; ++half) set_four(place[u].reach, half, outwards * farthest[half]);
    place[u].reach[level_direction] = 1;
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
    find_layers(graph);
    executor.for_ranges(graph.n, least, [&](Index begin, Index end) {
        for (Index u = begin; u < end; ++u) {
            Vec2 const p = scale * (points[graph.point(u)] - origin);
            float const x = static_cast<float>(p.x), y = static_cast<float>(p.y);
            place[u] = {{x, y, x + y, x - y, step[u], 0, 0, 0}, {}};
            step[u] = 0;
        }
    });
    executor.for_ranges(graph.n, least, [&](Index begin, Index end) {
        for (Index u = begin; u < end; ++u) find_reach(graph, u);
    });
}

}  // namespace harmorph
