#include "operators/unknowns.hpp"

namespace harmorph {

void Unknowns::lay_out_rows(Arena& arena, Index n_points, MatrixKind kind) noexcept {
    kind_ = kind;
    arena.take(row_of_, Offset{components()} * n_points);
}

void Unknowns::lay_out_directions(Arena& arena, Index n_points, bool rotates) noexcept {
    arena.take(direction_, couples_xy() || rotates ? n_points : 0);
}

void Unknowns::find(Span<const Index> representative, Graph const& graph,
                    Span<const Index> position, Span<const Index> slot, Span<const Vec2> tangent,
                    Periodicity const& periodicity) noexcept {
    for (Index point = 0; point < representative.count(); ++point) {
        Index const same = representative[point];
        for (Index c = 0; c < components(); ++c) {
            Index const unknown = graph.unknown[components() * same + c];
            row_of_[components() * point + c] = unknown != none ? position[unknown]
                                                : slot[same] != none
                                                    ? wall(components() * slot[same] + c)
                                                    : none;
        }
        if (couples_xy()) set_tangent(point, tangent[same]);
        else if (!direction_.empty())
            direction_[point] = periodicity.rotation.power(periodicity.times[point]);
    }
}

}  // namespace harmorph
