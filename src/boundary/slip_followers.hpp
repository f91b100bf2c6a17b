// How the mesh follows points that are put back onto their curves. A step along tangents by d
// leaves these points about d^2 / (2 R) beside a curve of radius R; were only they put back, the
// cells behind them would become thinner with every step. So inner points are moved by
//     (o / (s + o))^(q + 1) ((1 - t) c_a + t c_b),
// c the displacements by which the sliding points a and b at both ends of the nearest face of a
// curve are put back, t the place of the foot on this face, s the distance from there, o the
// distance from the other boundaries: all on the mesh at the start. The power is what minimises the
// integral of o^-q (dw/ds)^2 between the two boundaries, as the functions of an operator with the
// exponent q do in two dimensions.
#pragma once

#include "boundary/distance.hpp"
#include "boundary/slip_curves.hpp"

namespace harmorph {

struct SlipFollowers {
    Span<Index> slot;   // [n_points] a point follows this slot and the next one; none: it does not.
                        // Points that are joined to one that slides follow it alone
    Span<Real> weight;  // [2 * n_points] of both

    // While find() runs.
    FaceDistance faces;
    Span<Index> slot_at;  // [n_points] where a point begins a face of a curve

    void lay_out(Arena& arena, Index n_points, Size max_faces) noexcept;
    void find(Topology const& topology, Boundary const& boundary, Span<const Condition> conditions,
              Span<const PointKind> kinds, SlipCurves const& curves, Index quarters,
              Executor const& executor) noexcept;
    // Slots and weights alone; n_points 0: there are none.
    void lay_out_copy(Arena& arena, Index n_points) noexcept;
    void copy_from(SlipFollowers const& other) noexcept;

    // visit(point, slot, weight) for each slot whose point slides and that an inner or a joined
    // point follows.
    template <class Visit>
    void for_each(SlipCurves const& curves, Visit const& visit) const noexcept {
        for (Index k = 0; k < slot.count(); ++k) {
            for (Index end = 0; end < 2 && slot[k] != none; ++end) {
                Real const part = weight[2 * k + end];
                if (part != 0 && curves.own[slot[k] + end] != none)
                    visit(k, curves.own[slot[k] + end], part);
            }
        }
    }
};

}  // namespace harmorph
