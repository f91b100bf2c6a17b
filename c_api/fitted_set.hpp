// The results of hm_fit and hm_fit_marker: a set of curves inside the caller's block, and the
// report. tests/c_api/test_fit_marker.cpp covers this file.
#pragma once

#include "views.hpp"

#include "bspline/fit.hpp"

namespace harmorph {

// The curves that the caller receives, index_base 0, and the arrays of these curves. The block of a
// call begins with them; working memory follows.
struct FittedSet {
    Span<hm_curves> set;
    Span<hm_curve> curve;
    Span<Real> control;
    Span<Index> indices;
    Span<Real> knots;
    Index n_curves = 0, n_control = 0;
    Size n_indices = 0, n_knots = 0;

    // Takes memory for the fits of `pieces` pieces with `controls` control points together.
    void lay_out(Arena& arena, Offset pieces, Offset controls, Index degree) noexcept {
        take(arena, 2 * pieces, controls, controls + pieces * (degree + 2),
             controls + pieces * (2 * degree + 5));
    }
    void add(Fit const& fit) noexcept {
        for (Index i = 0; i < fit.n_curves; ++i) {
            Curve const& curve_of_fit = fit.curve[i];
            hm_curve& added = curve[n_curves++];
            added = struct_of(curve_of_fit);
            Index* const own = indices.data() + n_indices;
            Real* const own_knots = knots.data() + n_knots;
            for (Index k = 0; k < curve_of_fit.n_indices; ++k)
                own[k] = n_control + curve_of_fit.control_point(k);
            Index const knots_of_curve = curve_of_fit.n_indices + curve_of_fit.degree + 1;
            for (Index k = 0; k < knots_of_curve; ++k) own_knots[k] = curve_of_fit.knots[k];
            n_indices += static_cast<Size>(curve_of_fit.n_indices);
            n_knots += static_cast<Size>(knots_of_curve);
            added.indices = own;
            added.knots = own_knots;
        }
        for (Index k = 0; k < fit.control.count(); ++k) control[2 * n_control + k] = fit.control[k];
        n_control += fit.control.count() / 2;
    }
    // Moves the arrays of the curves together, to the beginning of the block. used: the bytes of
    // the block up to their end. No array moves beyond the end that it had, so none is overwritten.
    const hm_curves* present(void* block, Size bytes, std::uint64_t& used) const noexcept {
        Arena arena(block, bytes);
        FittedSet packed;
        packed.take(arena, n_curves, n_control, static_cast<Offset>(n_indices),
                    static_cast<Offset>(n_knots));
        std::memmove(packed.control.data(), control.data(), packed.control.size() * sizeof(Real));
        std::memmove(packed.indices.data(), indices.data(), n_indices * sizeof(Index));
        std::memmove(packed.knots.data(), knots.data(), n_knots * sizeof(Real));
        for (hm_curve& one : packed.curve) {
            one.indices = packed.indices.data() + (one.indices - indices.data());
            one.knots = packed.knots.data() + (one.knots - knots.data());
        }
        packed.set[0] = {sizeof(hm_curves), 0,        n_control,          packed.control.data(),
                         nullptr,           n_curves, packed.curve.data()};
        used = static_cast<std::uint64_t>(reinterpret_cast<unsigned char*>(packed.set.data()) -
                                          static_cast<unsigned char*>(block)) +
               arena.used();
        return packed.set.data();
    }

private:
    void take(Arena& arena, Offset curves, Offset controls, Offset all_indices,
              Offset all_knots) noexcept {
        arena.take(set, 1);
        arena.take(curve, curves);
        arena.take(control, 2 * controls);
        arena.take(indices, all_indices);
        arena.take(knots, all_knots);
    }
};

// Points are counted from index_base.
inline hm_fit_report report_of(FitReport const& fitted, Index n_pieces, Index index_base) noexcept {
    hm_fit_report filled = {};
    filled.max_error = fitted.max_error;
    filled.rms_error = fitted.rms_error;
    filled.max_error_point = numbered(fitted.max_error_point, index_base);
    filled.closed = static_cast<std::int32_t>(fitted.closure);
    filled.first_point = numbered(fitted.first_point, index_base);
    filled.base_points = fitted.base_points;
    filled.corners = fitted.corners;
    filled.backtrack_point = numbered(fitted.backtrack_point, index_base);
    filled.pieces = n_pieces;
    filled.departure_point = numbered(fitted.departure_point, index_base);
    filled.max_departure = fitted.max_departure;
    return filled;
}

}  // namespace harmorph
