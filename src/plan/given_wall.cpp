#include "plan/given_wall.hpp"

namespace harmorph {
namespace {

// Returns the first slot of given points; the slots of given points come last.
Index first_given(Analysis const& analysis) noexcept {
    Index const number = analysis.curves().count() + analysis.problem().demands.bodies;
    Index slot = 0;
    while (slot < analysis.wall().count && analysis.wall().curve[slot] != number) ++slot;
    return slot;
}

// Calls visit(point) for the points that are joined to another one.
template <class Visit>
void for_each_joined(Span<const Index> representative, Visit const& visit) noexcept {
    for (Index point = 0; point < representative.count(); ++point) {
        if (representative[point] != point) visit(point);
    }
}

}  // namespace

void GivenWall::lay_out(Arena& arena, Analysis const& analysis) noexcept {
    if (!analysis.problem().demands.given) return;
    Index n_joined = 0;
    for_each_joined(analysis.topology().representative, [&](Index) { ++n_joined; });
    arena.take(point, analysis.wall().count - first_given(analysis));
    arena.take(joined, n_joined);
    arena.take(boundary_point, analysis.boundary().count);
    arena.take(loop_start, Offset{analysis.boundary().n_loops} + 1);
}

Index GivenWall::columns(Analysis const& analysis) noexcept {
    if (!analysis.problem().demands.given) return 0;
    return analysis.matrix_sizes().kind == MatrixKind::real ? 2 * fields_at_once : fields_at_once;
}

void GivenWall::init(Analysis const& analysis) noexcept {
    if (!analysis.problem().demands.given) return;
    first_slot = first_given(analysis);
    copy(point, Span<const Index>(analysis.wall().point.from(first_slot, point.count())));
    Index n_joined = 0;
    for_each_joined(analysis.topology().representative, [&](Index at) { joined[n_joined++] = at; });
    copy(boundary_point,
         Span<const Index>(analysis.boundary().point.first(boundary_point.count())));
    copy(loop_start, Span<const Index>(analysis.boundary().loop_start.first(loop_start.count())));
}

}  // namespace harmorph
