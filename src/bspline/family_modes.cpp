#include "bspline/family_modes.hpp"

#include "base/range.hpp"
#include "bspline/quadrature.hpp"

namespace harmorph {
namespace {

constexpr Index max_sweeps = 60;         // about six suffice
constexpr Real smallest_cosine = 1e-15;  // between movements that count as orthogonal
constexpr Real smallest_value = 1e-12;   // of the largest singular value

}  // namespace

void FamilyModes::lay_out(Arena& arena, Index n_control) noexcept {
    arena.take(weight_, n_control);
}

void FamilyModes::start() noexcept { fill(weight_, Real(0)); }

void FamilyModes::add(Curve const& curve) noexcept {
    for (Index span = curve.degree; span < curve.n_indices; ++span) {
        Real const low = curve.knots[span], high = curve.knots[span + 1];
        if (!(low < high)) continue;
        auto const speed_at = [&](Real u) {
            Vec2 c[2];
            curve_point_in(curve, span, u, 1, c);
            return length(c[1]);
        };
        // The integrals of all functions that are not 0 there; the arc length is their size.
        auto const integrand = [&](Real u) {
            Sums<2 * max_order> at;
            CurveBasis const basis = curve_basis_in(curve, span, u, 0);
            Real const speed = speed_at(u);
            for (Index k = 0; k < basis.order; ++k) {
                at.value[k] = speed * basis.value[0][k];
                at.value[max_order + k] = speed;
            }
            return at;
        };
        for_converged<2 * max_order>(low, high, integrand, [&](Real from, Real to) {
            Gauss10::for_each(from, to, [&](Real u, Real weight) {
                CurveBasis const basis = curve_basis_in(curve, span, u, 0);
                for (Index k = 0; k < basis.order; ++k)
                    weight_[basis.control[k]] += weight * speed_at(u) * basis.value[0][k];
            });
        });
    }
}

Real FamilyModes::dot_of(const Real* a, const Real* b) const noexcept {
    Real sum = 0;
    for (Index i = 0; i < weight_.count(); ++i)
        sum += weight_[i] * (a[2 * i] * b[2 * i] + a[2 * i + 1] * b[2 * i + 1]);
    return sum;
}

Status FamilyModes::run(Index n, Real* movements, Real* singular, Fault& fault) noexcept {
    Offset const length = 2 * Offset{weight_.count()};
    Real total = 0, largest = 0;
    for (Real const w : weight_) total += w;
    for (Offset k = 0; k < n * length; ++k) {
        if (!is_at_most(movements[k], largest_coordinate)) {
            return fault.refuse(Status::bad_argument,
                                "movement # has a number that is not finite or beyond 1e100",
                                entry_item(static_cast<Index>(k / length)));
        }
        if (weight_[static_cast<Index>(k % length / 2)] > 0)
            largest = max(largest, abs(movements[k]));
    }
    if (!(total > 0) || !(largest > 0))
        return fault.refuse(Status::bad_argument, "the movements move no point of the curves");
    for (Real& w : weight_) w /= total;
    for (Offset k = 0; k < n * length; ++k) {
        bool const counts = weight_[static_cast<Index>(k % length / 2)] > 0;
        movements[k] = counts ? movements[k] / largest : 0;
    }
    bool is_orthogonal = false;
    for (Index sweep = 0; sweep < max_sweeps && !is_orthogonal; ++sweep) {
        is_orthogonal = true;
        for (Index p = 0; p + 1 < n; ++p) {
            for (Index q = p + 1; q < n; ++q) {
                Real *const a = movements + p * length, *const b = movements + q * length;
                Real const aa = dot_of(a, a), bb = dot_of(b, b), ab = dot_of(a, b);
                if (!(abs(ab) > smallest_cosine * sqrt(aa * bb)) || abs(ab) < 1e-300) continue;
                is_orthogonal = false;
                Real const z = (bb - aa) / (2 * ab);
                Real const t = (z < 0 ? -1 : 1) / (abs(z) + sqrt(1 + z * z));
                Real const cosine = 1 / sqrt(1 + t * t), sine = t * cosine;
                for (Offset k = 0; k < length; ++k) {
                    Real const at = a[k];
                    a[k] = cosine * at - sine * b[k];
                    b[k] = sine * at + cosine * b[k];
                }
            }
        }
    }
    for (Index k = 0; k < n; ++k) {
        const Real* const mode = movements + k * length;
        singular[k] = sqrt(dot_of(mode, mode));
    }
    order(n, movements, singular);
    for (Index k = 0; k < n; ++k) {
        Real* const mode = movements + k * length;
        Real farthest = 0;
        for (Offset i = 0; i < length; ++i)
            if (abs(mode[i]) > abs(farthest)) farthest = mode[i];
        bool const counts = singular[k] > smallest_value * singular[0];
        Real const factor = !counts ? 0 : (farthest < 0 ? -1 : 1) / singular[k];
        for (Offset i = 0; i < length; ++i) mode[i] *= factor;
    }
    for (Index k = 0; k < n; ++k) singular[k] *= largest;
    return Status::ok;
}

// Puts the largest singular values first.
void FamilyModes::order(Index n, Real* movements, Real* singular) const noexcept {
    Offset const length = 2 * Offset{weight_.count()};
    auto const swap = [](Real& a, Real& b) {
        Real const kept = a;
        a = b;
        b = kept;
    };
    for (Index k = 0; k + 1 < n; ++k) {
        Index best = k;
        for (Index j = k + 1; j < n; ++j)
            if (singular[j] > singular[best]) best = j;
        if (best == k) continue;
        swap(singular[k], singular[best]);
        for (Offset i = 0; i < length; ++i)
            swap(movements[k * length + i], movements[best * length + i]);
    }
}

}  // namespace harmorph
