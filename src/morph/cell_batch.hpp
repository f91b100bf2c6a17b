// Cells in batches, for kernels that compute several cells at a time: corner areas, quality, and
// whether a displacement can invert them. A list contains cells of one shape, so that the kernels
// have no branches.
#pragma once

#include "base/executor.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/topology.hpp"
#include "simd/cpu.hpp"

namespace harmorph {

// Cells of one shape; the points of a cell are side by side. The list is a section of the caller's
// list, or a copy.
struct CellList {
    const Index* point = nullptr;  // [n x 3] or [n x 4]
    Index n = 0;
    Index index_base = 0;
    bool reversed = false;  // All cells are clockwise.
};

// Up to `max_count` consecutive cells, by shape.
struct CellBatches {
    static constexpr Index max_count = 64;
    Index first = 0, n = 0;
    CellList triangles, quads;

    // Calls visit(cell, is it a triangle?, its number in the list of its shape) in the order of the
    // cells.
    template <class Visit>
    void for_each(Visit const& visit) const noexcept {
        if (triangles.n == 0 || quads.n == 0) {
            for (Index i = 0; i < n; ++i) visit(first + i, triangles.n > 0, i);
            return;
        }
        Index next[2] = {};
        for (Index i = 0; i < n; ++i)
            visit(first + i, is_triangle[i], next[is_triangle[i] ? 1 : 0]++);
    }

    // Copies cells one by one, counter-clockwise.
    void begin_copies(Index first_cell) noexcept {
        first = first_cell;
        n = 0;
        triangles = {triangle_point, 0, 0, false};
        quads = {quad_point, 0, 0, false};
    }
    void add_copy(Cell const& cell, bool reversed) noexcept {
        Index* const to =
            cell.n == 3 ? triangle_point + 3 * triangles.n++ : quad_point + 4 * quads.n++;
        for (Index k = 0; k < cell.n; ++k) to[k] = cell.point[reversed ? cell.n - 1 - k : k];
        is_triangle[n++] = cell.n == 3;
    }

private:
    bool is_triangle[max_count];  // One flag for each copied cell.
    Index triangle_point[3 * max_count], quad_point[4 * max_count];
};

// The coordinates of the cells, and their displacements, if any.
struct CellPlaces {
    Points at, change;
    // If nothing is displaced: coordinates of the cells whose sizes are compared, if given.
    Points reference;

    CellShape displaced(Cell const& cell) const noexcept {
        CellShape shape(cell, at, false);
        if (!change.given()) return shape;
        CellShape const by(cell, change, false);
        for (Index k = 0; k < 4; ++k) shape.at[k] = shape.at[k] + by.at[k];
        return shape;
    }
};

// The extremes of the cells measured so far: the smallest step at which one of them inverts, twice
// the smallest corner area, and the smallest quality.
struct CellBounds {
    Real step = infinity, twice_area = infinity, quality = infinity;
};

// The quality of a list of cells, after the displacement if there is one.
struct ListQuality {
    static constexpr Real not_in_range = -1;
    // Twice the smallest corner area; NaN if an area of a quad is not finite.
    Real twice_smallest[CellBatches::max_count];
    // The quality, 0 if the cell is inverted. not_in_range means that the quality must be computed
    // for this cell by itself, as products of its areas would overflow or underflow.
    Real quality[CellBatches::max_count];
    Real sum = 0;  // The sum of the qualities that are computed.
    // The bits of cells that are inverted, below a bound, or without a quality so far.
    std::uint64_t notable = 0;
};

// Measures a list of cells. If they are displaced, returns the bits of the cells that must be
// examined one by one, as some corner may lose its positive area before the step. `quality`, unless
// null, receives the quality of the displaced cells, compared with the cells before. The results
// are those of CellCorners, CellMeasure, Quality::add and AdmissibleStep::add for one cell,
// operation by operation; sums have the same order in all kernels. The bits are therefore the same
// for all instruction sets.
using MeasureCells = std::uint64_t(CellList const& cells, CellPlaces const& places,
                                   CellBounds const& bounds, ListQuality* quality) noexcept;

// The smooth values of cells that a kernel computes, see morph/cell_bounds.hpp. Weights are
// exp(sharpness * (shift - value)).
struct SmoothRequest {
    // Values to compute: the quality (also divided by the skew quality of the start), the corner
    // areas divided by those of the start, and the derivatives.
    bool quality = false, kept = false, area = false, slopes = false;
    Real quality_sharpness = 0, quality_shift = 0, area_sharpness = 0, area_shift = 0;
};
// The derivatives of the value of a cell by the coordinates of its corners, multiplied by its
// weight.
struct SmoothSlopes {
    Real x[4][CellBatches::max_count], y[4][CellBatches::max_count];
};
struct SmoothList {
    Real quality[CellBatches::max_count], quality_weight[CellBatches::max_count];
    // The smallest value of the corners of each cell, and the sum of the weights of all corners.
    Real area[CellBatches::max_count], area_weight[CellBatches::max_count];
    SmoothSlopes by_quality, by_area;
    // The bits of cells that must be computed one by one: they are inverted, or products of their
    // areas would overflow or underflow. The numbers of odd cells above are not set.
    std::uint64_t odd = 0;
};
// Computes the smooth values of a list of cells at places.at, compared with places.reference. The
// results have the same bits in all kernels.
using SmoothCells = void(CellList const& cells, CellPlaces const& places,
                         SmoothRequest const& request, SmoothList& list) noexcept;
struct CellKernels {
    MeasureCells *triangles, *quads;
};
// A table of their own: programs without smooth values do not link these kernels.
struct SmoothKernels {
    SmoothCells *triangles, *quads;
};

// Returns the kernels for so many cells; `known` is the best kernel, if known.
CellKernels const& cell_kernels(Kernel known, Index n_cells) noexcept;
SmoothKernels const& smooth_kernels(Kernel known, Index n_cells) noexcept;

// Calls visit(user, batches) for cells begin .. end-1, in their order.
void for_each_batch(OrientedMesh const& cells, Index begin, Index end,
                    void (*visit)(void* user, CellBatches const& batches), void* user) noexcept;
template <class Visit>
void for_each_batch(OrientedMesh const& cells, Index begin, Index end, Visit visit) noexcept {
    auto const call = [](void* user, CellBatches const& batches) {
        (*static_cast<Visit*>(user))(batches);
    };
    for_each_batch(cells, begin, end, call, &visit);
}

// Reduces all cells. add_batch(kernels, batches, result) is called for the caller's cells;
// add_cell(i, result) for i < n is called if the cells are pieces of polygons, for which there are
// no kernels.
template <class Result, class AddCell, class AddBatch>
Result reduce_batches(OrientedMesh const& cells, Index n, Executor const& executor,
                      AddCell const& add_cell, AddBatch const& add_batch) noexcept {
    if (cells.mesh.has_pieces()) return reduce_cells<Result>(n, executor, add_cell);
    CellKernels const& kernels = cell_kernels(executor.kernel, cells.mesh.n_cells);
    return reduce_ranges<Result>(
        cells.mesh.n_cells, executor, [&](Index begin, Index end, Result& result) {
            Result found;
            for_each_batch(cells, begin, end,
                           [&](CellBatches const& batches) { add_batch(kernels, batches, found); });
            result = found;
        });
}

}  // namespace harmorph
