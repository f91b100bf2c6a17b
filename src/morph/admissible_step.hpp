// The exact length of the way along a displacement before a cell inverts.
#pragma once

#include "base/executor.hpp"
#include "mesh/cell_shape.hpp"
#include "morph/cell_batch.hpp"
#include "morph/quality.hpp"

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

// The corners that limit the admissible step along a displacement, and the derivatives of their
// steps.

// The area of a corner is 0 at y = x + s d, with positions x, the displacement d and the step s. A
// change of x and d changes the step by ds = -grad A(y) . (dx + s dd) / (grad A(y) . d).
struct StepCorner {
    Real step = infinity;
    Index cell = none;  // the cell or guard
    Index point[3] = {none, none, none};
    Vec2 by_position[3];
    // If false, the area only touches 0, so that the step has no derivative.
    bool has_derivative = false;
};

// Calls visit(user, corner) for the corners whose step is at most `max_step`, in the order of the
// cells. limit is the admissible step, which is positive; `max_step` is finite and not below the
// limit. A corner with the step of the limit is always visited.
void find_step_corners(OrientedMesh const& cells, Points points, Points displacement,
                       AdmissibleStep const& limit, Real max_step, Executor const& executor,
                       void (*visit)(void* user, StepCorner const& found), void* user) noexcept;
template <class Visit>
void find_step_corners(OrientedMesh const& cells, Points points, Points displacement,
                       AdmissibleStep const& limit, Real max_step, Executor const& executor,
                       Visit visit) noexcept {
    auto const call = [](void* user, StepCorner const& found) {
        (*static_cast<Visit*>(user))(found);
    };
    find_step_corners(cells, points, displacement, limit, max_step, executor, call, &visit);
}

// Assesses a displacement in one pass over the cells: the admissible step, and the quality of the
// displaced mesh.
struct Assessment {
    AdmissibleStep limit;
    Quality quality;  // The quality at points + displacement, relative to the mesh at points.

    void merge(Assessment const& later) noexcept {
        limit.merge(later.limit);
        quality.merge(later.quality);
    }
};

// If the step is not wanted, `limit` is not meaningful, and less time is needed.
Assessment assess(OrientedMesh const& cells, Points points, Points displacement,
                  Executor const& executor, bool wants_step = true, Real* all = nullptr) noexcept;

// Returns the quality at points + displacement, relative to the mesh at the coordinates
// `reference`.
Quality displaced_quality(OrientedMesh const& cells, Points points, Points displacement,
                          Points reference, Executor const& executor, Real* all = nullptr) noexcept;

}  // namespace harmorph
