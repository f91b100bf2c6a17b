#include "basis/derived_basis.hpp"

#include <cstring>

namespace harmorph {

void begin_derived(Basis const& from, BasisCounts const& counts, Basis const& to) noexcept {
    std::memset(static_cast<void*>(to.header), 0, Basis::bytes(counts));
    *to.header = *from.header;
    to.header->counts = counts;
    to.header->bytes = Basis::bytes(counts);
    to.header->filled = counts.stored;
    to.unseal();
    copy(to.shape, Span<const Basis::CurveShape>(from.shape));
    copy(to.indices, Span<const Index>(from.indices));
    copy(to.knots, Span<const Real>(from.knots));
    copy(to.control, Span<const Real>(from.control));
    copy(to.weights, Span<const Real>(from.weights));
    copy(to.conditions, Span<const Condition>(from.conditions));
    to.along.copy_from(from.along);
    copy(to.wall_point, Span<const Index>(from.wall_point));
    copy(to.wall_curve, Span<const Index>(from.wall_curve));
    copy(to.wall_u, Span<const Real>(from.wall_u));
    copy(to.wall_offset, Span<const Vec2>(from.wall_offset));
    copy(to.wall_start, Span<const Vec2>(from.wall_start));
    copy(to.shared_point, Span<const Index>(from.shared_point));
    copy(to.shared_condition, Span<const Index>(from.shared_condition));
    copy(to.shared_place, Span<const WallPlace>(from.shared_place));
    copy(to.shared_slot, Span<const Index>(from.shared_slot));
    copy(to.joined_point, Span<const Index>(from.joined_point));
    copy(to.joined_slot, Span<const Index>(from.joined_slot));
    copy(to.boundary_point, Span<const Index>(from.boundary_point));
    copy(to.loop_start, Span<const Index>(from.loop_start));
    copy(to.interface_side, Span<const Index>(from.interface_side));
    copy(to.reversed, Span<const std::uint8_t>(from.reversed));
    if (to.pieces.given()) to.pieces.copy_from(from.pieces);
}

}  // namespace harmorph
