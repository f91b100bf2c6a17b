#include "basis/basis_source.hpp"

#include <cstring>

#include "base/executor.hpp"
#include "base/fixed_sum.hpp"

namespace harmorph {

BasisCounts BasisSource::counts() const noexcept {
    BasisCounts counts;
    counts.points = topology.mesh.n_points;
    counts.cells = topology.mesh.n_given_cells();
    counts.pieces = topology.mesh.n_pieces();
    counts.guards = topology.mesh.n_guards;
    counts.control = curves.empty() ? 0 : curves[0].n_control;
    counts.bodies = demands.bodies;
    counts.kind = method.value_kind(demands);
    counts.curves = curves.count();
    for (Curve const& curve : curves) {
        counts.indices += curve.n_indices;
        counts.knots += curve.n_indices + curve.degree + 1;
    }
    counts.weights = !curves.empty() && curves[0].weights != nullptr ? counts.control : 0;
    counts.wall = wall.count;
    counts.shared = wall.n_shared;
    for_each_joined([&](Index, Index) { ++counts.joined; });
    counts.boundary = boundary.count;
    counts.loops = boundary.n_loops;
    counts.sides = demands.interfaces ? boundary.count : 0;
    counts.conditions = conditions.count();
    counts.along = KeptCurves::count(along);
    return counts.share(0, counts.functions());
}

void init_basis(Basis const& basis, BasisCounts const& counts, BasisSource const& source,
                Executor const& executor) noexcept {
    BasisHeader& header = *basis.header;
    unsigned char* const block = static_cast<unsigned char*>(static_cast<void*>(&header));
    constexpr Size chunk = 65536;
    Size const bytes = Basis::bytes(counts);
    executor.for_ranges(static_cast<Index>(bytes / chunk) + 1, 4, [&](Index begin, Index end) {
        Size const from = chunk * static_cast<Size>(begin),
                   to = min(bytes, chunk * static_cast<Size>(end));
        std::memset(block + from, 0, to - from);
    });
    std::memcpy(header.magic, BasisHeader::expected_magic, sizeof header.magic);
    header.format = BasisHeader::current_format;
    header.byte_order = BasisHeader::native_order;
    header.bytes = bytes;
    header.topology = source.mesh_fingerprint;
    header.conditions = source.conditions_fingerprint;
    header.index_base = source.topology.mesh.index_base;
    header.counts = counts;
    header.method = source.method;

    Index first_index = 0, first_knot = 0;
    for (Index number = 0; number < source.curves.count(); ++number) {
        Curve const& curve = source.curves[number];
        Index const n_knots = curve.n_indices + curve.degree + 1;
        basis.shape[number] = {curve.degree, curve.n_indices, first_index, first_knot};
        for (Index k = 0; k < curve.n_indices; ++k)
            basis.indices[first_index + k] = curve.control_point(k);
        for (Index k = 0; k < n_knots; ++k) basis.knots[first_knot + k] = curve.knots[k];
        first_index += curve.n_indices;
        first_knot += n_knots;
    }
    if (counts.curves > 0) {
        Curve const& any = source.curves[0];
        copy(basis.control, Span<const Real>(any.control, basis.control.size()));
        if (!basis.weights.empty())
            copy(basis.weights, Span<const Real>(any.weights, basis.weights.size()));
    }
    copy(basis.conditions, source.conditions);
    basis.along.copy_from(source.along);
    copy(basis.wall_point, Span<const Index>(source.wall.point.first(counts.wall)));
    copy(basis.wall_curve, Span<const Index>(source.wall.curve.first(counts.wall)));
    copy(basis.wall_u, Span<const Real>(source.wall.u.first(counts.wall)));
    copy(basis.wall_offset, Span<const Vec2>(source.wall.offset.first(counts.wall)));
    for (Index k = 0; k < counts.shared; ++k) {
        SharedPoint const& shared = source.wall.shared[k];
        basis.shared_point[k] = source.wall.point[shared.slot];
        basis.shared_condition[2 * k] = shared.condition[0];
        basis.shared_condition[2 * k + 1] = shared.condition[1];
        basis.shared_place[k] = shared.place;
        basis.shared_slot[k] = shared.slot;
    }
    Points const start = source.topology.mesh.points;
    for (Index slot = 0; slot < counts.wall; ++slot)
        basis.wall_start[slot] = start[basis.wall_point[slot]];
    Index joined = 0;
    source.for_each_joined([&](Index point, Index slot) {
        basis.joined_point[joined] = point;
        basis.joined_slot[joined++] = slot;
    });
    copy(basis.boundary_point, Span<const Index>(source.boundary.point.first(counts.boundary)));
    copy(basis.loop_start, Span<const Index>(source.boundary.loop_start.first(counts.loops + 1)));
    find_interface_sides(source.boundary, source.conditions, basis.interface_side);
    copy(basis.reversed, Span<const std::uint8_t>(source.topology.reversed));
    if (basis.pieces.given()) basis.pieces.copy_from(*source.pieces);
}

void Basis::seal(Real at_least, Executor const& executor) const noexcept {
    Offset const length = block_points * Offset{row_length()};  // The numbers of a block.
    Index const blocks =
        length > 0 ? static_cast<Index>(static_cast<Offset>(value.size()) / length) : 0;
    auto const include = [&](Index begin, Index end, LargestMagnitude& largest) {
        largest.include(Span<const Real>(value.from(begin * length, (end - begin) * length)));
    };
    LargestMagnitude largest = reduce_ranges<LargestMagnitude>(blocks, executor, include);
    for (float const number : single) largest.include(static_cast<Real>(number));
    largest.include(at_least);
    header->largest = largest.value();
    header->solved = 1;
    header->checksum = checksum_of(*header, executor);
}

void Basis::unseal() const noexcept {
    header->solved = 0;
    header->checksum = 0;
}

}  // namespace harmorph
