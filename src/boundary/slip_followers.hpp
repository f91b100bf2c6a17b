// Computes how inner points follow slipping points that are moved back onto their curves. A step of
// length d along the tangent leaves a slipping point about d^2 / (2 R) away from a curve of radius
// R. If only the slipping points were moved back, the cells beside them would become thinner with
// each step. Therefore inner points move by
//
//     (o / (s + o))^(q + 1) ((1 - t) c_a + t c_b).
//
// Here c_a and c_b are the displacements that move back the slipping points a and b at both ends of
// the nearest face of a curve; t is the position of the foot on this face, s the distance from the
// foot, and o the distance from the other boundaries, all on the initial mesh. The power minimises
// the integral of o^-q (dw/ds)^2 between the two boundaries, as the functions of an operator with
// the exponent q do in two dimensions. tests/boundary/test_slip_curves.cpp covers this file.
#pragma once

#include "boundary/distance.hpp"
#include "boundary/slip.hpp"

namespace harmorph {

struct SlipFollowers {
    // [n_points] A point follows this slot and the next one, or does not follow if this is none. A
    // point that is joined to a slipping point follows only this point.
    Span<Index> slot;
    Span<Real> weight;  // [2 * n_points] the weights of both slots

    // find() uses the following as working space.
    FaceDistance faces;
    Span<Index> slot_at;  // [n_points] the slot at which a point begins a face of a curve, or none

    void lay_out(Arena& arena, Index n_points, Size max_faces) noexcept;
    void find(Topology const& topology, Boundary const& boundary, Span<const Condition> conditions,
              Span<const PointKind> kinds, SlipCurves const& curves, Index exponent_quarters,
              Executor const& executor) noexcept;
    // A copy has slots and weights only; n_points may be 0.
    void lay_out_copy(Arena& arena, Index n_points) noexcept;
    void copy_from(SlipFollowers const& other) noexcept;

    // Calls visit(point, slot, weight) for each slot that an inner or joined point follows and
    // whose point slips.
    template <class Visit>
    void for_each(SlipCurves const& curves, Visit const& visit) const noexcept {
        for (Index k = 0; k < slot.count(); ++k) {
            for (Index end = 0; end < 2 && slot[k] != none; ++end) {
                Real const share = weight[2 * k + end];
                if (share != 0 && curves.own[slot[k] + end] != none)
                    visit(k, curves.own[slot[k] + end], share);
            }
        }
    }
};

}  // namespace harmorph
