// The C interface: gives a curve more control points.
#include "call.hpp"
#include "bspline/finer_curves.hpp"
#include "views.hpp"

namespace harmorph {
namespace {

// The arguments that a size query and hm_refine have in common: the curves, and the change of one
// of them.
struct FinerTask {
    CurvesView view;
    CurveRefinement refinement;
    FinerCounts counts;
    Index degree = 0;  // the new degree; 0: the degree of the curve stays

    Status open(const hm_curves* curves, CallFault& fault) noexcept {
        HARMORPH_TRY(view_curves(curves, view, fault));
        if (refinement.curve < 0 || refinement.curve >= view.count()) {
            return fault.refuse(Status::bad_argument,
                                "curve # does not exist; curves.n_curves is @",
                                curve_item(refinement.curve), plain(view.count()));
        }
        for (Index i = 0; i < view.count(); ++i) {
            Curve curve;
            HARMORPH_TRY(view.checked_curve(i, curve, fault));
            if (i == refinement.curve) HARMORPH_TRY(check_refinement(curve, fault));
            counts.include(curve, i == refinement.curve, refinement);
        }
        return Status::ok;
    }

private:
    Status check_refinement(Curve const& curve, Fault& fault) const noexcept {
        if (degree != 0 && degree != curve.degree + 1) {
            return fault.refuse(
                Status::bad_argument,
                "degree is @, but a curve of degree # can only be raised by one degree",
                plain(curve.degree), plain(degree));
        }
        return refinement.check(curve, fault);
    }
};

// Reads which curve changes, and how. The degree is checked when the curves have been read.
Status view_refinement(Index curve, Index degree, Index n, const double* u, FinerTask& task,
                       Fault& fault) noexcept {
    constexpr Index max_count = Index{1} << 24;
    if (n < 0 || n > max_count) {
        return fault.refuse(Status::bad_argument, "n must be between 0 and 2^24, not #", plain(n));
    }
    if (degree != 0 && n != 0) {
        return fault.refuse(
            Status::bad_argument,
            "n is #, but it must be 0 where the degree is raised; insert the knots by another call",
            plain(n));
    }
    if (n > 0) HARMORPH_TRY(require({{"u", u}}, fault));
    task.refinement.curve = curve;
    task.refinement.knots = {u, static_cast<Size>(n)};
    task.refinement.elevates = degree != 0;
    task.degree = degree;
    return Status::ok;
}

// The block of the result: the structs for the caller, then the arrays of the core.
struct FinerBlock {
    Span<hm_curves> set;
    Span<hm_curve> curve;
    FinerCurves finer;

    void lay_out(Arena& arena, FinerCounts const& counts) noexcept {
        arena.take(set, 1);
        arena.take(curve, counts.n_curves);
        finer.lay_out(arena, counts);
    }
    const hm_curves* present(Index index_base) const noexcept {
        for (Index i = 0; i < curve.count(); ++i) curve[i] = struct_of(finer.curve[i]);
        const Real* const weights = finer.weights.empty() ? nullptr : finer.weights.data();
        set[0] = {sizeof(hm_curves), index_base,    finer.n_control, finer.control.data(),
                  weights,           curve.count(), curve.data()};
        return set.data();
    }
};

Status make_finer(FinerTask& task, const hm_curves** finer, const double** matrix,
                  hm_memory* memory, const hm_curves* curves, CallFault& fault) noexcept {
    HARMORPH_TRY(task.open(curves, fault));
    FinerBlock made;
    HARMORPH_TRY(place(memory, fault, [&](Arena& arena) { made.lay_out(arena, task.counts); }));
    HARMORPH_TRY(require({{"finer", finer}}, fault));
    for (Index i = 0; i < task.view.count(); ++i)
        task.view.curve(i, made.finer.curve[i], fault);  // cannot fail: open() has checked it
    HARMORPH_TRY(made.finer.run(task.refinement, fault));
    *finer = made.present(task.view.set.index_base);
    if (matrix != nullptr) *matrix = made.finer.matrix.data();
    return Status::ok;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_refine(const hm_curves** finer, const double** matrix, hm_memory* memory,
                    const hm_curves* curves, int32_t curve, int32_t degree, int32_t n,
                    const double* u, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        FinerTask task;
        HARMORPH_TRY(view_refinement(curve, degree, n, u, task, fault));
        return make_finer(task, finer, matrix, memory, curves, fault);
    });
}

}  // extern "C"
