#include "harmorph/basis.hpp"

#include <cstring>

#include "harmorph/hash.hpp"

namespace harmorph {
namespace {

constexpr char magic[8] = {'h', 'a', 'r', 'm', 'o', 'r', 'p', 'h'};

std::uint64_t checksum_of(BasisHeader const& header) noexcept {
    Size const covered_from = offsetof(BasisHeader, checksum) + sizeof header.checksum;
    const unsigned char* const block = reinterpret_cast<const unsigned char*>(&header);
    return hash_of_block(block + covered_from, header.bytes - covered_from);
}

bool counts_make_sense(BasisCounts const& counts) noexcept {
    Index const all[] = {counts.points,  counts.cells, counts.functions, counts.curves, counts.indices,   counts.knots,
                         counts.weights, counts.wall,  counts.boundary,  counts.loops,  counts.conditions};
    for (Index const count : all) {
        if (count < 0) return false;
    }
    return true;
}

}  // namespace

void Basis::lay_out(Arena& arena, BasisCounts const& counts) noexcept {
    Span<BasisHeader> first;
    arena.take(first, 1);
    header = first.data();
    arena.take(shape, counts.curves);
    arena.take(indices, counts.indices);
    arena.take(knots, counts.knots);
    arena.take(control, 2 * Offset{counts.functions});
    arena.take(weights, counts.weights);
    arena.take(conditions, counts.conditions);
    arena.take(wall_point, counts.wall);
    arena.take(wall_curve, counts.wall);
    arena.take(wall_u, counts.wall);
    arena.take(boundary_point, counts.boundary);
    arena.take(loop_start, Offset{counts.loops} + 1);
    arena.take(reversed, counts.cells);
    arena.take(value, Offset{counts.points} * counts.functions);
}

Size Basis::bytes(BasisCounts const& counts) noexcept {
    Arena counting;
    Basis basis;
    basis.lay_out(counting, counts);
    return counting.used();
}

Basis Basis::view(void* block) noexcept {
    BasisHeader const& header = *static_cast<const BasisHeader*>(block);
    Arena arena = Arena::at_origin(block, header.bytes);
    Basis basis;
    basis.lay_out(arena, header.counts);
    return basis;
}

const Basis Basis::view(const void* block) noexcept { return view(const_cast<void*>(block)); }

Curve Basis::curve(Index number) const noexcept {
    CurveShape const& its = shape[number];
    Curve curve;
    curve.degree = its.degree;
    curve.n_indices = its.n_indices;
    curve.n_control = n_functions();
    curve.indices = indices.data() + its.first_index;
    curve.knots = knots.data() + its.first_knot;
    curve.control = control.data();
    curve.weights = weights.empty() ? nullptr : weights.data();
    return curve;
}

void Basis::seal() const noexcept {
    header->solved = 1;
    header->checksum = checksum_of(*header);
}

void Basis::unseal() const noexcept {
    header->solved = 0;
    header->checksum = 0;
}

std::uint64_t topology_print(Mesh const& mesh) noexcept {
    Hash hash;
    hash.add(static_cast<std::uint64_t>(mesh.n_points));
    hash.add(static_cast<std::uint64_t>(mesh.n_cells));
    for (Index i = 0; i < mesh.n_cells; ++i) {
        Cell const cell = mesh.cell(i);
        for (Index k = 0; k < cell.n; ++k) hash.add(static_cast<std::uint64_t>(cell.point[k]));
    }
    return hash.value();
}

std::uint64_t coordinates_print(Points points, Index n_points) noexcept {
    Hash hash;
    for (Index k = 0; k < n_points; ++k) {
        hash.add(bits_of(points[k].x));
        hash.add(bits_of(points[k].y));
    }
    return hash.value();
}

Status check_basis(const void* block, Size bytes, const Mesh* mesh, Fault& fault) noexcept {
    auto const refuse = [&](const char* why, Real found = 0) {
        return fault.refuse(Status::bad_basis, why, Counts::from_zero, none, none, found);
    };
    if (bytes < sizeof(BasisHeader)) return refuse("the block has only ~ bytes, less than a basis's header", static_cast<Real>(bytes));
    BasisHeader header;
    std::memcpy(&header, block, sizeof header);
    if (std::memcmp(header.magic, magic, sizeof magic) != 0) return refuse("the block is not a harmorph basis");
    if (header.byte_order != BasisHeader::native_order) return refuse("the basis was written with another byte order");
    if (header.format != BasisHeader::current_format) {
        return refuse("the basis has format version ~, which this library does not read", header.format);
    }
    if (header.bytes > bytes) return refuse("the basis is truncated: ~ bytes are missing", static_cast<Real>(header.bytes - bytes));
    if (!counts_make_sense(header.counts) || Basis::bytes(header.counts) != header.bytes) {
        return refuse("the basis is damaged: its sizes contradict each other");
    }
    if (header.solved != 1) return refuse("the basis has not been solved");
    if (checksum_of(*static_cast<const BasisHeader*>(block)) != header.checksum) {
        return refuse("the basis is damaged: its checksum does not fit");
    }
    if (mesh == nullptr) return Status::ok;
    if (header.counts.points != mesh->n_points || header.counts.cells != mesh->n_cells) {
        return fault.refuse(Status::bad_basis, "the basis belongs to another mesh: it has # points and @ cells",
                            Counts::from_zero, header.counts.points, header.counts.cells);
    }
    if (header.topology != topology_print(*mesh)) return refuse("the basis belongs to another mesh: the cells differ");
    if (header.coordinates == coordinates_print(mesh->points, mesh->n_points)) return Status::ok;
    fault.refuse(Status::moved, "the mesh's coordinates are not those the basis was solved on");
    return Status::moved;
}

}  // namespace harmorph
