#include "bspline/knots.hpp"

namespace harmorph {
namespace {

constexpr Real unimportant_error = 1e-9;  // in units of the extent; smaller errors move no mass

// The positions first .. last between two corners or ends.
struct KnotSection {
    Index first = 0, last = 0;
};

KnotSection section_of(KnotSites const& sites, Index section) noexcept {
    Index const n_corners = sites.corner.count();
    Index const last = section == n_corners ? sites.u.count() - 1 : sites.corner[section];
    return {section == 0 ? 0 : sites.corner[section - 1], last};
}

Real sum_of(Span<const Real> mass, KnotSection section) noexcept {
    Real sum = 0;
    for (Index k = section.first; k < section.last; ++k) sum += mass[k];
    return sum;
}

// Each section gets one span; each of the others goes to the section with the largest mass per span
// (the method of Sainte-Lague). A section that has as many spans as intervals comes last.
void share_spans(KnotSites const& sites, Index n_spans) noexcept {
    Index const n_sections = sites.section_spans.count();
    fill(sites.section_spans, Index(1));
    if (n_sections == 1) sites.section_spans[0] = n_spans;
    for (Index given = n_sections; n_sections > 1 && given < n_spans; ++given) {
        Index neediest = 0;
        Real need = -1;
        for (Index s = 0; s < n_sections; ++s) {
            KnotSection const section = section_of(sites, s);
            Real const urgency = section.last - section.first > sites.section_spans[s] ? 1 : 1e-6;
            Real const wanted =
                urgency * sum_of(sites.mass, section) / (sites.section_spans[s] + 0.5);
            if (wanted <= need) continue;
            need = wanted;
            neediest = s;
        }
        ++sites.section_spans[neediest];
    }
}

// Limits the mass of an interval to that of one span, so that each span contains a point. This
// ensures the Schoenberg-Whitney condition: points can be assigned one to one to basis functions
// that are not 0 there. If there are too few points, all masses become equal.
void cap_mass(KnotSites const& sites, KnotSection section, Index n_spans) noexcept {
    for (Index k = section.first; k < section.last; ++k) sites.capped[k] = sites.mass[k];
    Real const max_share = 1 / static_cast<Real>(min(n_spans, section.last - section.first));
    bool capped = true;
    for (Index round = 0; capped && round < 50; ++round) {
        Real const cap = max_share * sum_of(sites.capped, section);
        capped = false;
        for (Index k = section.first; k < section.last; ++k) {
            if (sites.capped[k] <= cap * (1 + 1e-9)) continue;
            sites.capped[k] = cap;
            capped = true;
        }
    }
}

// Writes the n_spans - 1 knots inside the section, and returns the place after them.
Real* divide(KnotSites const& sites, KnotSection section, Index n_spans, Real* knot) noexcept {
    cap_mass(sites, section, n_spans);
    Real const sum = sum_of(sites.capped, section);
    Real below = 0;  // mass up to position k
    Index k = section.first;
    for (Index j = 1; j < n_spans; ++j) {
        Real const target = sum * static_cast<Real>(j) / static_cast<Real>(n_spans);
        while (k + 1 < section.last && below + sites.capped[k] < target) below += sites.capped[k++];
        Real const share = clamp((target - below) / sites.capped[k], Real(0), Real(1));
        *knot++ = sites.u[k] + share * (sites.u[k + 1] - sites.u[k]);
    }
    return knot;
}

// Returns x^(1/q) by Newton's method, for 1e-3 <= x <= 1e3.
Real root(Real x, Index q) noexcept {
    Real y = max(x, Real(1));
    for (Index iteration = 0; iteration < 50; ++iteration) {
        Real power = 1;
        for (Index k = 1; k < q; ++k) power *= y;
        y -= (y - x / power) / static_cast<Real>(q);
    }
    return y;
}

// Finds the largest error in each span. A point beside a span counts the less, the farther the
// point is from the span, so that the result changes continuously with parameters and knots: a
// point that crosses a knot by rounding moves no knot.
void gather_errors(Curve const& curve, Span<const Real> u, Span<const Real> error,
                   Span<Real> span_error) noexcept {
    constexpr Real reach = 0.5;  // of the width of the span
    fill(span_error, unimportant_error);
    for (Index k = 0; k < u.count(); ++k) {
        Index const own = knot_span(curve, u[k]);
        span_error[own] = max(span_error[own], error[k]);
        auto const count_beside = [&](Index step) {
            Index span = own + step;
            while (span >= curve.degree && span < curve.n_indices &&
                   curve.knots[span] == curve.knots[span + 1])
                span += step;
            if (span < curve.degree || span >= curve.n_indices) return;
            Real const low = curve.knots[span], high = curve.knots[span + 1];
            Real const off = step < 0 ? u[k] - high : low - u[k];
            Real const share = 1 - off / (reach * (high - low));
            if (share > 0)
                span_error[span] = max(span_error[span], share * share * share * share * error[k]);
        };
        count_beside(-1);
        count_beside(1);
    }
}

// Returns the mean over [low, high] of a function that has one value in each span.
Real mean_over(Curve const& curve, Span<const Real> span_value, Real low, Real high) noexcept {
    Real sum = 0;
    Real at = low;
    for (Index span = knot_span(curve, low); at < high && span < curve.n_indices; ++span) {
        Real const next = min(high, curve.knots[span + 1]);
        sum += (next - at) * span_value[span];
        at = next;
    }
    return sum / (high - low);
}

}  // namespace

void weigh_by_curvature(Span<const Real> arc, Span<const Real> curvature,
                        Span<Real> mass) noexcept {
    for (Index k = 0; k < mass.count(); ++k)
        mass[k] = (arc[k + 1] - arc[k]) * (1 + 8 * sqrt(0.5 * (curvature[k] + curvature[k + 1])));
}

void weigh_by_error(Curve const& curve, Span<const Real> u, Span<const Real> error,
                    KnotSites const& sites, Real pace, Span<Real> span_error) noexcept {
    gather_errors(curve, u, error, span_error);
    Real sum = 0;
    Index n_spans = 0;
    for (Index span = curve.degree; span < curve.n_indices; ++span) {
        if (curve.knots[span] == curve.knots[span + 1]) continue;
        sum += span_error[span];
        ++n_spans;
    }
    for (Index span = curve.degree; span < curve.n_indices; ++span)
        span_error[span] =
            root(clamp(span_error[span] * n_spans / sum, 1e-3, 1e3), curve.degree + 1);
    for (Index k = 0; k < sites.mass.count(); ++k)
        sites.mass[k] *= 1 + pace * (mean_over(curve, span_error, sites.u[k], sites.u[k + 1]) - 1);
}

Index corners_possible(Index degree, Index n_indices) noexcept {
    return (n_indices - degree - 1) / degree;
}

void place_knots(KnotSites const& sites, Index degree, Index n_indices, bool periodic,
                 Span<Real> knots) noexcept {
    Index const n_corners = sites.corner.count();
    share_spans(sites, n_indices - degree - n_corners * (degree - 1));
    fill(knots.first(degree + 1), Real(0));
    Real* knot = knots.data() + degree + 1;
    for (Index s = 0; s <= n_corners; ++s) {
        KnotSection const section = section_of(sites, s);
        knot = divide(sites, section, sites.section_spans[s], knot);
        for (Index fold = 0; s < n_corners && fold < degree; ++fold)
            *knot++ = sites.u[section.last];
    }
    fill(knots.from(n_indices, degree + 1), Real(1));
    for (Index k = 1; periodic && k <= degree; ++k) {
        knots[degree - k] = knots[n_indices - k] - 1;
        knots[n_indices + k] = knots[degree + k] + 1;
    }
}

}  // namespace harmorph
