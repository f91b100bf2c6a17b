#include "basis/kept_curves.hpp"

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

}  // namespace harmorph
