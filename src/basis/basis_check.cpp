#include <cstddef>
#include <cstring>

#include "base/fixed_sum.hpp"
#include "base/hash.hpp"
#include "base/vec2.hpp"
#include "basis/basis.hpp"

namespace harmorph {

// Checksums that recognise a damaged basis, and fingerprints that recognise the mesh of a basis.

namespace {

// Calls visit(cell) for triangles and quads that together have all corners of cell i, in any
// layout. A cell with at most four corners is visited itself.
template <class Visit>
void for_each_section(Mesh const& mesh, Index i, Visit visit) noexcept {
    if (mesh.layout != CellLayout::polygons) return visit(mesh.cell(i));
    const Index* const corner = mesh.cell_points + (Offset{mesh.cell_start[i]} - mesh.index_base);
    Index const n = mesh.cell_start[i + 1] - mesh.cell_start[i];
    auto const at = [&](Index k) { return from_zero(corner[k], mesh.index_base); };
    for (Index k = 1; k + 1 < n; k += 2) {
        visit(k + 2 < n ? Cell{4, {at(0), at(k), at(k + 1), at(k + 2)}}
                        : Cell{3, {at(0), at(k), at(k + 1)}});
    }
}

std::uint64_t pair(Index a, Index b) noexcept {
    return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
}

}  // namespace

std::uint64_t checksum_of(BasisHeader const& header, Executor const& executor) noexcept {
    Size const covered_from = offsetof(BasisHeader, checksum) + sizeof header.checksum;
    const unsigned char* const block = reinterpret_cast<const unsigned char*>(&header);
    return hash_of_block(block + covered_from, static_cast<Size>(header.bytes) - covered_from,
                         executor);
}

MeshFingerprint fingerprint_of(Mesh const& mesh) noexcept {
    Hash front, back;
    front.add(pair(mesh.n_points, mesh.n_cells));
    auto const add = [&](Cell const& cell) {
        front.add(pair(cell.point[0], cell.point[1]));
        back.add(pair(cell.point[2], cell.n == 4 ? cell.point[3] : none));
    };
    if (mesh.layout == CellLayout::polygons) {
        for (Index i = 0; i < mesh.n_cells; ++i) for_each_section(mesh, i, add);
    } else {
        mesh.for_each_cell([&](Index, Cell const& cell) { add(cell); });
    }
    front.add(back.value());
    std::uint64_t sum = 0;  // The sum does not depend on the order of the faces.
    mesh.for_each_face([&](BoundaryFace const& face, Index, Index) {
        Hash face_hash;
        face_hash.add(pair(min(face.begin, face.end), max(face.begin, face.end)));
        face_hash.add(static_cast<std::uint32_t>(face.marker));
        sum += face_hash.value();
        return true;
    });
    return {front.value(), sum, sample_of(mesh)};
}

std::uint64_t sample_of(Mesh const& mesh) noexcept {
    Index const n = min(Index{64}, mesh.n_cells);
    Hash hash;
    for (Index k = 0; k < n; ++k) {
        for_each_section(mesh, static_cast<Index>(Offset{k} * mesh.n_cells / n),
                         [&](Cell const& cell) {
                             hash.add(pair(cell.point[0], cell.point[1]));
                             hash.add(pair(cell.point[2], cell.n == 4 ? cell.point[3] : none));
                         });
    }
    return hash.value();
}

std::uint64_t coordinates_fingerprint(Points points, Index n_points) noexcept {
    Hash x, y;
    for (Index k = 0; k < n_points; ++k) {
        x.add(bits_of(points[k].x));
        y.add(bits_of(points[k].y));
    }
    x.add(y.value());
    return x.value();
}

// Blocks from outside: every number of a block is checked before it is used.

namespace {

// This bound holds for every count: products of two such counts are far from overflow.
constexpr Index max_count = Mesh::max_points;

bool is_within(Index number, Index begin, Index end) noexcept {
    return begin <= number && number < end;
}

bool counts_are_plausible(BasisCounts const& counts) noexcept {
    Index const all[] = {
        counts.points,        counts.cells,         counts.control,     counts.bodies,
        counts.curves,        counts.indices,       counts.knots,       counts.weights,
        counts.wall,          counts.joined,        counts.boundary,    counts.loops,
        counts.conditions,    counts.first_stored,  counts.stored,      counts.combined,
        counts.modes,         counts.pieces,        counts.guards,      counts.sides,
        counts.along.curves,  counts.along.indices, counts.along.knots, counts.along.control,
        counts.along.weights, counts.shared};
    for (Index const count : all) {
        if (!is_within(count, 0, max_count + 1)) return false;
    }
    if (!is_within(counts.combination, 0, 3) || (counts.combination == 0 && counts.combined != 0))
        return false;
    Offset const functions = counts.shapes() + 2 * Offset{counts.bodies} + counts.modes;
    if (functions > max_count || counts.stored > functions - counts.first_stored) return false;
    if (counts.pieces == 0 ? counts.guards != 0
                           : counts.pieces > Mesh::max_cells || counts.guards > Mesh::max_cells)
        return false;
    if (counts.along.weights != 0 && counts.along.weights != counts.along.control) return false;
    if (counts.sides != 0 && counts.sides != counts.boundary) return false;
    // Nothing else in the block grows with the number of bodies, so they need a bound here.
    if (counts.bodies > counts.conditions) return false;
    if (counts.wall > counts.points || (counts.weights != 0 && counts.weights != counts.control))
        return false;
    if (counts.storage != Precision::in_double && counts.storage != Precision::in_single)
        return false;
    return counts.kind == ValueKind::real || counts.kind == ValueKind::complex ||
           counts.kind == ValueKind::matrix;
}

// The contents that the header's counts do not check: numbers that name other things, each of which
// must exist.
class Contents {
public:
    explicit Contents(Basis const& basis) noexcept : basis_(basis), counts_(basis.header->counts) {}

    // Refuses contents that contradict themselves.
    Status check(Fault& fault) const noexcept {
        auto const refuse = [&](const char* why, Item found = {}) {
            return fault.refuse(Status::bad_basis, why, found);
        };
        Method const& method = basis_.header->method;
        Index const operator_number = static_cast<Index>(method.operator_kind),
                    scheme = static_cast<Index>(method.scheme),
                    engine = static_cast<Index>(method.engine);
        if (!has_row(operator_traits, operator_number)) {
            return refuse("the basis is damaged: it names an unknown operator, #",
                          plain(operator_number));
        }
        if (!has_row(scheme_traits, scheme)) {
            return refuse("the basis is damaged: it names an unknown scheme, #", plain(scheme));
        }
        if (!has_row(engine_traits, engine)) {
            return refuse("the basis is damaged: it names an unknown engine, #", plain(engine));
        }
        if (!options_fit()) {
            return refuse("the basis is damaged: an option of its solution is out of range");
        }
        if (!curves_fit() || !basis_.along.fit()) {
            return refuse("the basis is damaged: the data of its curves are inconsistent");
        }
        if (!conditions_fit()) {
            return refuse(
                "the basis is damaged: a condition is unknown, or names a curve or body that does "
                "not exist");
        }
        if (!wall_fits()) {
            return refuse("the basis is damaged: the data of its wall points are inconsistent");
        }
        if (!boundary_fits()) {
            return refuse("the basis is damaged: its boundary loops are inconsistent");
        }
        if (!pieces_fit()) {
            return refuse(
                "the basis is damaged: the pieces of its polygonal cells are inconsistent");
        }
        if (!largest_fits()) {
            return refuse("the basis is damaged: a value exceeds the largest value in the header");
        }
        return Status::ok;
    }

private:
    bool options_fit() const noexcept {
        BasisHeader const& header = *basis_.header;
        Method const& method = header.method;
        return is_within(header.index_base, 0, 2) &&
               is_within(header.filled, 0, counts_.stored + 1) &&
               is_within(method.exponent_quarters, 0, 17) &&
               is_within(method.offset_correction, 0, 2);
    }

    bool curves_fit() const noexcept {
        Index indices = 0, knots = 0;
        for (Index number = 0; number < counts_.curves; ++number) {
            Basis::CurveShape const& curve = basis_.shape[number];
            if (!is_within(curve.degree, 1, max_degree + 1) || curve.first_index != indices ||
                curve.first_knot != knots)
                return false;
            if (!is_within(curve.n_indices, curve.degree + 1, counts_.indices - indices + 1))
                return false;
            if (curve.n_indices + curve.degree + 1 > counts_.knots - knots) return false;
            Fault ignored;
            if (failed(check_curve(basis_.curve(number), number, ignored))) return false;
            indices += curve.n_indices;
            knots += curve.n_indices + curve.degree + 1;
        }
        return indices == counts_.indices && knots == counts_.knots;
    }

    bool conditions_fit() const noexcept {
        for (Condition const& condition : basis_.conditions) {
            if (!condition.is_known()) return false;
            bool const on_curve = condition.kind == ConditionKind::on_curve;
            if (on_curve && !is_within(condition.first_curve, 0, counts_.curves)) return false;
            if (on_curve &&
                !is_within(condition.n_curves, 1, counts_.curves - condition.first_curve + 1))
                return false;
            if (condition.kind == ConditionKind::slip && condition.n_curves != 0 &&
                !basis_.along.is_set(condition.first_curve, condition.n_curves))
                return false;
            if (condition.kind == ConditionKind::rigid &&
                !is_within(condition.body, 0, counts_.bodies))
                return false;
        }
        return true;
    }

    bool wall_fits() const noexcept {
        for (Index slot = 0; slot < counts_.wall; ++slot) {
            if (!is_within(basis_.wall_point[slot], 0, counts_.points)) return false;
            if (!is_within(basis_.wall_curve[slot], 0, counts_.curves + counts_.bodies + 1))
                return false;
            if (!is_finite(basis_.wall_u[slot]) || !is_coordinate(basis_.wall_start[slot]))
                return false;
        }
        for (Index k = 0; k < counts_.shared; ++k) {
            WallPlace const& place = basis_.shared_place[k];
            Index const slot = basis_.shared_slot[k];
            if (!is_within(slot, 0, counts_.wall) ||
                basis_.shared_point[k] != basis_.wall_point[slot])
                return false;
            if (!is_within(place.curve, 0, counts_.curves + counts_.bodies + 1) ||
                !is_finite(place.u) || !is_coordinate(place.offset))
                return false;
            for (Index const condition : basis_.shared_condition.from(2 * k, 2)) {
                if (!is_within(condition, none, counts_.conditions)) return false;
            }
        }
        for (Index k = 0; k < counts_.joined; ++k) {
            if (!is_within(basis_.joined_point[k], 0, counts_.points)) return false;
            if (!is_within(basis_.joined_slot[k], 0, counts_.wall)) return false;
        }
        return true;
    }

    bool boundary_fits() const noexcept {
        for (Index const point : basis_.boundary_point) {
            if (!is_within(point, 0, counts_.points)) return false;
        }
        for (Index loop = 0; loop < counts_.loops; ++loop) {
            if (!is_within(basis_.loop_start[loop], 0, basis_.loop_start[loop + 1])) return false;
        }
        for (Index const side : basis_.interface_side) {
            if (side != none && !is_within(side, 0, max_count)) return false;
        }
        return basis_.loop_start[0] == 0 && basis_.loop_start[counts_.loops] == counts_.boundary;
    }

    bool pieces_fit() const noexcept {
        Pieces const& pieces = basis_.pieces;
        if (!pieces.given()) return true;
        Index const n = counts_.cells, all = counts_.pieces + counts_.guards;
        for (Index cell = 0; cell < n; ++cell) {
            // Each cell has at least one piece.
            if (!is_within(pieces.start[cell], 0, pieces.start[cell + 1])) return false;
            if (!is_within(pieces.guard_start[cell], counts_.pieces,
                           pieces.guard_start[cell + 1] + 1))
                return false;
        }
        for (Index const point : pieces.point) {
            if (!is_within(from_zero(point, basis_.header->index_base), 0, counts_.points))
                return false;
        }
        for (CornerKind const kind : pieces.kind) {
            if (static_cast<Index>(kind) > static_cast<Index>(CornerKind::reflex)) return false;
        }
        return pieces.start[0] == 0 && pieces.start[n] == counts_.pieces &&
               pieces.guard_start[0] == counts_.pieces && pieces.guard_start[n] == all;
    }

    // Checks that no value exceeds the stated largest value, as sums in fixed point would overflow.
    bool largest_fits() const noexcept {
        LargestMagnitude found, stated;
        stated.include(basis_.header->largest);
        found.include(basis_.header->largest);
        found.include(Span<const Real>(basis_.value));
        for (float const number : basis_.single) found.include(static_cast<Real>(number));
        return bits_of(found.value()) == bits_of(stated.value());
    }

    Basis const& basis_;
    BasisCounts const& counts_;
};

// Checks the first bytes and the header, which is copied to `header`, and the checksum of the
// block.
Status check_block(const void* block, Size bytes, BasisHeader& header, Fault& fault) noexcept {
    auto const refuse = [&](const char* why, Real found = 0) {
        return fault.refuse(Status::bad_basis, why, {}, {}, found);
    };
    if (bytes == 0 || std::memcmp(block, BasisHeader::expected_magic,
                                  min(bytes, sizeof BasisHeader::expected_magic)) != 0)
        return refuse("the data are not a harmorph basis: the mark at their start is missing");
    if (bytes < sizeof(BasisHeader)) {
        return refuse("the basis is truncated: at least ~ bytes are missing",
                      static_cast<Real>(sizeof(BasisHeader) - bytes));
    }
    std::memcpy(static_cast<void*>(&header), block, sizeof header);
    if (header.byte_order != BasisHeader::native_order)
        return refuse(
            "the basis was written on a machine with another byte order; solve the basis again on "
            "this machine");
    if (header.format != BasisHeader::current_format) {
        return fault.refuse(Status::bad_basis,
                            "the basis has format version #, but this library reads version @; "
                            "solve the basis again",
                            plain(static_cast<Index>(header.format)),
                            plain(Index{BasisHeader::current_format}));
    }
    if (header.bytes > bytes) {
        return refuse("the basis is truncated: ~ bytes are missing",
                      static_cast<Real>(header.bytes - bytes));
    }
    if (!counts_are_plausible(header.counts) || Basis::bytes(header.counts) != header.bytes) {
        return refuse("the basis is damaged: the counts in its header do not fit its size");
    }
    if (header.solved != 1) return refuse("the basis has not been solved");
    if (checksum_of(*static_cast<const BasisHeader*>(block)) != header.checksum) {
        return refuse("the basis is damaged: its checksum does not match its content");
    }
    return Status::ok;
}

// Checks that the basis belongs to the mesh.
Status check_mesh_of_basis(BasisHeader const& header, Mesh const& mesh, Fault& fault) noexcept {
    auto const refuse = [&](const char* why) { return fault.refuse(Status::bad_basis, why); };
    if (header.counts.cells == 0)
        return refuse(
            "the basis covers a list of points and has no cells, so it cannot be used with a mesh");
    if (header.counts.points != mesh.n_points || header.counts.cells != mesh.n_cells) {
        return fault.refuse(Status::bad_basis,
                            "the basis belongs to another mesh, which has # points and @ cells",
                            plain(header.counts.points), plain(header.counts.cells));
    }
    MeshFingerprint const found = fingerprint_of(mesh);
    if (header.topology.cells != found.cells)
        return refuse("the basis belongs to another mesh: the cells differ");
    if (header.topology.markers != found.markers) {
        return refuse(
            "the basis belongs to another mesh: the markers contain other points or have other "
            "numbers");
    }
    if (header.coordinates == coordinates_fingerprint(mesh.points, mesh.n_points))
        return Status::ok;
    fault.refuse(Status::moved,
                 "the mesh has other coordinates than the mesh on which the basis was solved");
    return Status::moved;
}

}  // namespace

Status check_basis(const void* block, Size bytes, const Mesh* mesh, Fault& fault) noexcept {
    BasisHeader header;
    HARMORPH_TRY(check_block(block, bytes, header, fault));
    HARMORPH_TRY(Contents(Basis::view(block)).check(fault));
    return mesh != nullptr ? check_mesh_of_basis(header, *mesh, fault) : Status::ok;
}

}  // namespace harmorph
