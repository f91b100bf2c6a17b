#include "basis/basis.hpp"

namespace harmorph {

template <class Visit>
Index KeptCurves::for_each(Span<const Curve> curves, Visit const& visit) noexcept {
    Index first_control = 0, n_control = 0;
    for (Index number = 0; number < curves.count(); ++number) {
        Curve const& curve = curves[number];
        bool const is_new = number == 0 || curve.control != curves[number - 1].control ||
                            curve.weights != curves[number - 1].weights ||
                            curve.n_control != curves[number - 1].n_control;
        if (is_new) {
            first_control = n_control;
            n_control += curve.n_control;
        }
        visit(number, first_control, is_new);
    }
    return n_control;
}

KeptCurves::Counts KeptCurves::count(Span<const Curve> curves) noexcept {
    Counts counts;
    bool any_weights = false;
    counts.curves = curves.count();
    counts.control = for_each(curves, [&](Index number, Index, bool) {
        Curve const& curve = curves[number];
        counts.indices += curve.n_indices;
        counts.knots += curve.n_indices + curve.degree + 1;
        any_weights = any_weights || curve.weights != nullptr;
    });
    counts.weights = any_weights ? counts.control : 0;
    return counts;
}

void KeptCurves::lay_out(Arena& arena, Counts const& counts) noexcept {
    arena.take(shape, counts.curves);
    arena.take(indices, counts.indices);
    arena.take(knots, counts.knots);
    arena.take(control, 2 * Offset{counts.control});
    arena.take(weights, counts.weights);
}

void KeptCurves::copy_from(Span<const Curve> curves) const noexcept {
    Index first_index = 0, first_knot = 0;
    for_each(curves, [&](Index number, Index first_control, bool is_new) {
        Curve const& curve = curves[number];
        Index const n_knots = curve.n_indices + curve.degree + 1;
        Index const rational = curve.weights != nullptr ? 1 : 0;
        shape[number] = {curve.degree,  curve.n_indices, first_index, first_knot,
                         first_control, curve.n_control, rational,    0};
        for (Index k = 0; k < curve.n_indices; ++k)
            indices[first_index + k] = curve.control_point(k);
        copy(knots.from(first_knot, n_knots),
             Span<const Real>(curve.knots, static_cast<Size>(n_knots)));
        first_index += curve.n_indices;
        first_knot += n_knots;
        if (!is_new) return;
        Size const n = static_cast<Size>(curve.n_control);
        copy(control.from(2 * Offset{first_control}, 2 * n),
             Span<const Real>(curve.control, 2 * n));
        if (rational == 1) copy(weights.from(first_control, n), Span<const Real>(curve.weights, n));
    });
}

void KeptCurves::copy_from(KeptCurves const& other) const noexcept {
    copy(shape, Span<const Shape>(other.shape));
    copy(indices, Span<const Index>(other.indices));
    copy(knots, Span<const Real>(other.knots));
    copy(control, Span<const Real>(other.control));
    copy(weights, Span<const Real>(other.weights));
}

Curve KeptCurves::curve(Index number) const noexcept {
    Shape const& kept = shape[number];
    Curve curve;
    curve.degree = kept.degree;
    curve.n_indices = kept.n_indices;
    curve.n_control = kept.n_control;
    curve.indices = indices.data() + kept.first_index;
    curve.knots = knots.data() + kept.first_knot;
    curve.control = control.data() + 2 * Offset{kept.first_control};
    curve.weights = kept.rational == 1 ? weights.data() + kept.first_control : nullptr;
    return curve;
}

bool KeptCurves::is_set(Index first, Index count) const noexcept {
    if (first < 0 || count < 0 || count > shape.count() || first > shape.count() - count)
        return false;
    for (Index k = first; k < first + count; ++k) {
        if (shape[k].first_control != shape[first].first_control ||
            shape[k].rational != shape[first].rational)
            return false;
    }
    return true;
}

bool KeptCurves::fit() const noexcept {
    Index n_indices = 0, n_knots = 0, n_control = 0;
    for (Index number = 0; number < shape.count(); ++number) {
        Shape const& kept = shape[number];
        bool const repeats = number > 0 && kept.first_control == shape[number - 1].first_control &&
                             kept.n_control == shape[number - 1].n_control;
        if (kept.degree < 1 || kept.degree > max_degree || kept.first_index != n_indices ||
            kept.first_knot != n_knots || kept.n_indices <= kept.degree ||
            kept.n_indices > indices.count() - n_indices ||
            kept.n_indices + kept.degree + 1 > knots.count() - n_knots)
            return false;
        n_indices += kept.n_indices;
        n_knots += kept.n_indices + kept.degree + 1;
        Index const all = control.count() / 2;
        if (!repeats) {
            if (kept.first_control != n_control || kept.n_control < 2 ||
                kept.n_control > all - n_control)
                return false;
            n_control += kept.n_control;
        }
        if (kept.rational < 0 || kept.rational > 1 || (kept.rational == 1 && weights.empty()))
            return false;
        Fault ignored;
        if (failed(check_curve(curve(number), number, ignored))) return false;
    }
    return n_indices == indices.count() && n_knots == knots.count() &&
           n_control == control.count() / 2;
}

namespace {

Vec2 derivative_of(Curve const& curve, CurveBasis const& functions) noexcept {
    Vec2 sum;
    for (Index k = 0; k < functions.order; ++k) {
        const Real* const point = curve.control + 2 * functions.control[k];
        sum = sum + functions.value[1][k] * Vec2{point[0], point[1]};
    }
    return sum;
}

}  // namespace

void Basis::lay_out(Arena& arena, BasisCounts const& counts) noexcept {
    Span<BasisHeader> first;
    arena.take(first, 1);
    header = first.data();
    arena.take(shape, counts.curves);
    arena.take(indices, counts.indices);
    arena.take(knots, counts.knots);
    arena.take(control, 2 * Offset{counts.control});
    arena.take(weights, counts.weights);
    arena.take(combination, Offset{counts.control} * counts.combined * counts.combination);
    arena.take(conditions, counts.conditions);
    along.lay_out(arena, counts.along);
    arena.take(wall_point, counts.wall);
    arena.take(wall_curve, counts.wall);
    arena.take(wall_u, counts.wall);
    arena.take(wall_offset, counts.wall);
    arena.take(wall_start, counts.wall);
    arena.take(shared_point, counts.shared);
    arena.take(shared_condition, 2 * Offset{counts.shared});
    arena.take(shared_place, counts.shared);
    arena.take(shared_slot, counts.shared);
    arena.take(joined_point, counts.joined);
    arena.take(joined_slot, counts.joined);
    arena.take(boundary_point, counts.boundary);
    arena.take(loop_start, Offset{counts.loops} + 1);
    arena.take(interface_side, counts.sides);
    arena.take(reversed, counts.pieces > 0 ? counts.pieces + counts.guards : counts.cells);
    pieces.lay_out(arena, counts.cells, counts.pieces, counts.guards);
    bool const in_single = counts.storage == Precision::in_single;
    Offset const length = Offset{numbers_of(counts.kind)} * counts.stored;
    arena.take(value, whole_blocks(in_single ? counts.wall : counts.points) * length);
    arena.take(single, whole_blocks(in_single ? counts.points : 0) * length);
}

Size Basis::bytes(BasisCounts const& counts) noexcept {
    Arena counting;
    Basis basis;
    basis.lay_out(counting, counts);
    return counting.used();
}

Basis Basis::view(void* block) noexcept {
    BasisHeader const& header = *static_cast<const BasisHeader*>(block);
    Arena arena = Arena::at_origin(block, static_cast<Size>(header.bytes));
    Basis basis;
    basis.lay_out(arena, header.counts);
    return basis;
}

const Basis Basis::view(const void* block) noexcept { return view(const_cast<void*>(block)); }

Curve Basis::curve(Index number) const noexcept {
    CurveShape const& kept = shape[number];
    Curve curve;
    curve.degree = kept.degree;
    curve.n_indices = kept.n_indices;
    curve.n_control = header->counts.control;
    curve.indices = indices.data() + kept.first_index;
    curve.knots = knots.data() + kept.first_knot;
    curve.control = control.data();
    curve.weights = weights.empty() ? nullptr : weights.data();
    return curve;
}

// At a point of a curve the functions are N_i, or N_i + e N_i' / C' if the point's offset e rotates
// with the curve.
BoundaryFunctions Basis::boundary_functions(WallPlace const& at) const noexcept {
    BoundaryFunctions out;
    Vec2 const offset = at.offset;
    if (is_given(at)) return out;
    if (!is_on_curve(at)) {
        Index const translation = header->counts.shapes() + 2 * (at.curve - header->counts.curves);
        out.order = 2;
        out.function[0] = translation;
        out.value[0] = {1, 0};
        out.function[1] = translation + 1;
        out.value[1] = offset;
        return out;
    }
    bool const rotates = offset.x != 0 || offset.y != 0;
    Curve const spline = curve(at.curve);
    CurveBasis const functions = curve_basis(spline, at.u, 1);
    Vec2 const per_derivative =
        rotates ? quotient(offset, derivative_of(spline, functions)) : Vec2{};
    out.order = functions.order;
    for (Index k = 0; k < max_order; ++k) {  // The values from the order on are 0.
        out.function[k] = functions.control[k];
        out.value[k] = {functions.value[0][k], 0};
        if (rotates) out.value[k] = out.value[k] + functions.value[1][k] * per_derivative;
    }
    return out;
}

BoundaryFunctions Basis::stored_boundary_functions(Index slot) const noexcept {
    BasisCounts const& counts = header->counts;
    BoundaryFunctions const all = boundary_functions(slot);
    BoundaryFunctions out;
    for (Index k = 0; k < all.order; ++k) {
        Index const stored = all.function[k] - counts.first_stored;
        if (stored < 0 || stored >= counts.stored) continue;
        out.function[out.order] = stored;
        out.value[out.order++] = all.value[k];
    }
    return out;
}

Vec2 Basis::combination_at(Index control_point, Index variable) const noexcept {
    Index const numbers = header->counts.combination;
    const Real* const entry =
        combination.data() + (Offset{control_point} * header->counts.combined + variable) * numbers;
    return {entry[0], numbers == 2 ? entry[1] : 0};
}

Vec2 Basis::control_move(Index control_point, const Real* move) const noexcept {
    if (combination.empty()) return {move[2 * control_point], move[2 * control_point + 1]};
    Vec2 sum;
    for (Index k = 0; k < header->counts.combined; ++k) {
        sum = sum + product(combination_at(control_point, k), {move[2 * k], move[2 * k + 1]});
    }
    return sum;
}

namespace {

// Returns the movement of a given point: each mode is a linear map of the movement of its function.
Vec2 given_move(Basis const& basis, Index slot, const Real* move) noexcept {
    auto const row = basis.row(basis.wall_point[slot]);
    Index const n = basis.n_functions();
    Vec2 sum;
    for (Index i = n - basis.header->counts.modes; i < n; ++i) {
        Vec2 const by{move[2 * i], move[2 * i + 1]};
        if (basis.kind() == ValueKind::matrix) {
            sum = sum + Vec2{row[i] * by.x + row[n + i] * by.y,
                             row[2 * n + i] * by.x + row[3 * n + i] * by.y};
        } else {
            sum = sum +
                  product(Vec2{row[i], basis.kind() == ValueKind::complex ? row[n + i] : 0}, by);
        }
    }
    return sum;
}

}  // namespace

Vec2 Basis::wall_move(Index slot, const Real* move) const noexcept {
    return is_given(slot) ? given_move(*this, slot, move) : wall_move(place(slot), move);
}

Vec2 Basis::wall_move(WallPlace const& at, const Real* move) const noexcept {
    BoundaryFunctions const functions = boundary_functions(at);
    Vec2 sum;
    for (Index k = 0; k < functions.order; ++k) {
        Index const i = functions.function[k];
        Vec2 const by =
            is_on_curve(at) ? control_move(i, move) : Vec2{move[2 * i], move[2 * i + 1]};
        sum = sum + product(functions.value[k], by);
    }
    return sum;
}

void Basis::column(Index number, Real* out, Offset stride) const noexcept {
    for (Index point = 0; point < n_points(); ++point) {
        out[point * stride] =
            in_single() ? static_cast<Real>(single_row(point)[number]) : row(point)[number];
    }
    if (!in_single()) return;
    for (Index slot = 0; slot < wall_point.count(); ++slot)
        out[wall_point[slot] * stride] = row(slot)[number];
    for (Index k = 0; k < joined_point.count(); ++k)
        out[joined_point[k] * stride] = row(joined_slot[k])[number];
}

OrientedMesh Basis::cells(Mesh const& mesh) const noexcept {
    if (!pieces.given()) return {mesh, reversed};
    Mesh mesh_of_pieces = pieces.mesh(mesh);
    mesh_of_pieces.n_given = header->counts.cells;
    mesh_of_pieces.index_base = header->index_base;
    return {mesh_of_pieces, reversed};
}

Status Basis::require_double(Fault& fault) const noexcept {
    if (!in_single()) return Status::ok;
    return fault.refuse(Status::unsupported,
                        "the basis stores its functions in single precision, but this call needs a "
                        "basis in double precision");
}

Status Basis::require_control_points(Fault& fault) const noexcept {
    BasisCounts const& counts = header->counts;
    if (counts.combination == 0 && counts.modes == 0) return Status::ok;
    return fault.refuse(Status::unsupported,
                        counts.modes == 0 ? "the basis contains combined functions, but this call "
                                            "needs a basis with the functions of the control points"
                                          : "the basis contains functions that a table gives, but "
                                            "this call needs a basis without such functions");
}

}  // namespace harmorph
