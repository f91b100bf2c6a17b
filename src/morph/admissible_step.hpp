// The exact length of the way along a displacement before a cell inverts.
#pragma once

#include "mesh/guard_shape.hpp"
#include "morph/cell_batch.hpp"
#include "base/executor.hpp"

namespace harmorph {

struct AdmissibleStep {
    Real step = infinity;
    // The corner of `cell` (or guard) whose area becomes 0 first.
    Index cell = none, corner = none;

    // Adds the cell or guard `number`, which has n points and moves from `now` by `change`.
    inline void add(Index number, Index n, CellCorners const& now,
                    CellCorners const& change) noexcept;
    // Adds the cells of some batches whose bits are set in the number of their shape.
    void add(OrientedMesh const& cells, CellPlaces const& places, CellBatches const& batches,
             std::uint64_t triangles, std::uint64_t quads) noexcept;
    void merge(AdmissibleStep const& later) noexcept {
        if (later.step < step) *this = later;
    }
};

// Returns the smallest s > 0 with c + b s + a s^2 = 0, where c > 0; infinite if there is none.
Real smallest_positive_root(Real a, Real b, Real c) noexcept;

// Returns the corner of a triangle between the two shorter sides. In a needle, the area as a
// product of the two long sides would have lost the digits of the short one.
inline Index corner_between_shorter_sides(CellCorners const& corners) noexcept {
    Real const length[] = {square(corners.side[0]), square(corners.side[1]),
                           square(corners.side[2])};
    if (length[0] >= length[1] && length[0] >= length[2]) return 2;
    return length[1] >= length[2] ? 0 : 1;
}

inline void AdmissibleStep::add(Index number, Index n, CellCorners const& now,
                                CellCorners const& change) noexcept {
    Index const first = n == 3 ? corner_between_shorter_sides(now) : 0, n_areas = n == 3 ? 1 : 4;
    for (Index k = first; k < first + n_areas; ++k) {
        Index const before = k == 0 ? n - 1 : k - 1;
        Vec2 const in = now.side[before], in_moves = change.side[before];
        Vec2 const out = now.side[k], out_moves = change.side[k];
        Real const area = cross(in, out), slope = cross(in, out_moves) + cross(in_moves, out);
        Real const curvature = cross(in_moves, out_moves);
        // Most corners cannot become 0 before the limit so far, as area + slope s - |curvature| s^2
        // > 0 at this limit.
        if (area > 0 && is_finite(area) && step < infinity &&
            area + step * (min(slope, 0.0) + step * min(curvature, 0.0)) > 0)
            continue;
        Real const corner_step = area > 0 ? smallest_positive_root(curvature, slope, area) : 0;
        if (corner_step < step) *this = {corner_step, number, k};
    }
}

// Returns the smallest s >= 0 at which a corner of points + s displacement has no positive area:
// the smallest non-negative root of the corners' quadratics.
AdmissibleStep admissible_step(OrientedMesh const& cells, Points points, Points displacement,
                               Executor const& executor) noexcept;

// Returns the mesh point of a limiting corner.
Index limiting_point(OrientedMesh const& cells, AdmissibleStep const& limit) noexcept;

}  // namespace harmorph
