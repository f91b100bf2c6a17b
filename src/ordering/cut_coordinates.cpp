#include "ordering/cut_coordinates.hpp"

namespace harmorph {
namespace {

constexpr float unreached = -1;
// A task of the executor treats at least so many unknowns.
constexpr Index min_task_unknowns = 4096;

// Continues a breadth-first search from the unknowns of the queue that begin at `read`: neighbours
// that are not reached yet get one step more.
Index spread(Graph const& graph, Span<float> step, Span<Index> queue, Index read,
             Index filled) noexcept {
    for (; read < filled; ++read) {
        graph.prefetch_neighbours(queue, read, filled);
        Index const u = queue[read];
        float const next = step[u] + 1;
        for (Index const v : graph.neighbours(u)) {
            if (step[v] >= 0) continue;
            step[v] = next;
            queue[filled++] = v;
        }
    }
    return filled;
}

}  // namespace

void CutCoordinates::lay_out(Arena& arena, Index max_unknowns) noexcept {
    arena.take(position, max_unknowns);
    arena.take(queue, max_unknowns);
    arena.take(step, max_unknowns);
}

void CutCoordinates::lay_out_layers(Arena& arena, Index max_unknowns) noexcept {
    arena.take(layer, max_unknowns);
    arena.take(layer_queue, max_unknowns);
}

// The search starts from the unknowns beside curves. Unknowns in a region of the mesh without
// curves are not reached, and come before all layers.
void CutCoordinates::find_layers(Graph const& graph) const noexcept {
    fill(layer.first(graph.n), unreached);
    Index filled = 0;
    for (Index u = 0; u < graph.n; ++u) {
        if (graph.beside_curve[u] == 0) continue;
        layer[u] = 0;
        layer_queue[filled++] = u;
    }
    spread(graph, layer, layer_queue, 0, filled);
}

void CutCoordinates::find_levels(Graph const& graph, Span<const Index> region,
                                 Span<Index> by_level) const noexcept {
    auto const spread_from = [&](Index u, float level, Index filled) {
        step[u] = level;
        by_level[filled] = u;
        return spread(graph, step, by_level, filled, filled + 1);
    };
    Index start = region[0], filled = 0;
    // The second search starts from the last unknown that the first search reached.
    for (Index sweep = 0; sweep < 2; ++sweep) {
        for (Index const u : region) step[u] = unreached;
        filled = spread_from(start, 0, 0);
        start = by_level[filled - 1];
    }
    // Connected components of the region that the search did not reach get the levels that follow.
    for (Index const u : region) {
        if (step[u] < 0) filled = spread_from(u, step[by_level[filled - 1]] + 1, filled);
    }
    for (Index const u : region) position[u].at[level_direction] = step[u];
}

// Finds the reach in the straight directions.
void CutCoordinates::find_reach(Graph const& graph, Index u) const noexcept {
    constexpr float outwards = 1.000001f;
    Four const here = four(position[u].at, 0);
    Four farthest = {};
    for (Index const v : graph.neighbours(u)) {
        Four const apart = four(position[v].at, 0) - here;
        farthest = apart > farthest ? apart : farthest;
        farthest = -apart > farthest ? -apart : farthest;
    }
    set_four(position[u].reach, 0, outwards * farthest);
}

// Stores the results in the order of memory, which the searches do not follow.
void CutCoordinates::keep_searches(Graph const& graph, Executor const& executor) const noexcept {
    executor.for_ranges(graph.n, min_task_unknowns, [&](Index begin, Index end) {
        for (Index u = begin; u < end; ++u) {
            float const here = step[u];
            float farthest = here != 0 ? 1.0f : 0.0f;
            for (Index const v : graph.neighbours(u)) {
                farthest = max(farthest, here < step[v] ? step[v] - here : here - step[v]);
            }
            set_four(position[u].at, 1, Four{layer[u], here, 0, 0});
            set_four(
                // Layers and levels of neighbours differ by 1 at most.
                position[u].reach, 1, Four{1, farthest, 1, 0});
        }
    });
    fill(step.first(graph.n), 0.0f);
}

// Coordinates are relative to the first point, because single precision would lose the digits of a
// small mesh far from the origin.
void CutCoordinates::place(Graph const& graph, Points points,
                           Executor const& executor) const noexcept {
    Vec2 const origin = points[graph.point(0)];
    Real largest = 0;
    for (Index u = 0; u < graph.n; ++u) {
        Vec2 const p = points[graph.point(u)] - origin;
        largest = max(largest, max(abs(p.x), abs(p.y)));
    }
    // Single precision ends at 1e38. Coordinates are not scaled if all unknowns are in one place.
    Real const scale = largest > 0 && (largest > 1e30 || largest < 1e-30) ? 1 / largest : 1;
    executor.for_ranges(graph.n, min_task_unknowns, [&](Index begin, Index end) {
        for (Index u = begin; u < end; ++u) {
            Vec2 const p = scale * (points[graph.point(u)] - origin);
            float const x = static_cast<float>(p.x), y = static_cast<float>(p.y);
            position[u] = {{x, y, x + y, x - y}, {}};
            step[u] = 0;
        }
    });
    executor.for_ranges(graph.n, min_task_unknowns, [&](Index begin, Index end) {
        for (Index u = begin; u < end; ++u) find_reach(graph, u);
    });
}

}  // namespace harmorph
