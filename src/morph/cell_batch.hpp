// Cells in batches, for kernels that look at several cells at a time: corner areas, quality, and
// whether a displacement can invert them. A list holds cells of one shape, so that the kernels have
// no branches.
#pragma once

#include "base/parallel_reduce.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/topology.hpp"
#include "simd/cpu.hpp"

namespace harmorph {

// Cells of one shape, the points of a cell side by side: a part of the caller's list, or a copy.
struct CellList {
    const Index* point = nullptr;  // [n x 3] or [n x 4]
    Index n = 0;
    Index index_base = 0;
    bool reversed = false;  // all cells run clockwise
};

// Up to `most` consecutive cells, by shape.
struct CellBatches {
    static constexpr Index most = 64;
    Index first = 0, n = 0;
    CellList triangles, quads;

    // visit(cell, is it a triangle?, its number in the list of its shape) in the order of the
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
    bool is_triangle[most];  // of copies
    Index triangle_point[3 * most], quad_point[4 * most];
};

// Where the cells are, and by what they are displaced, if at all.
struct CellPlaces {
    Points at, change;
    Points reference;  // where nothing is displaced: cells to compare sizes with, if given

    CellShape displaced(Cell const& cell) const noexcept {
        CellShape shape(cell, at, false);
        if (!change.given()) return shape;
        CellShape const by(cell, change, false);
        for (Index k = 0; k < 4; ++k) shape.at[k] = shape.at[k] + by.at[k];
        return shape;
    }
};

// What other cells have shown so far: the smallest step at which one of them inverts, twice the
// smallest corner area, the smallest quality.
struct CellBounds {
    Real step = infinity, twice_area = infinity, quality = infinity;
};

// Quality of a list of cells, displaced if they are.
struct ListQuality {
    static constexpr Real not_in_range = -1;
    Real twice_smallest[CellBatches::most];  // corner area; NaN where one of a quad is not finite
    // 0 where the cell is inverted; not_in_range: to be computed for this cell by itself, as
    // products of its areas are too large or too small for numbers.
    Real quality[CellBatches::most];
    Real sum = 0;  // of those that are computed
    std::uint64_t notable =
        0;  // bits of cells: inverted, below a bound, or without a quality so far
};

// Looks at a list of cells. Where they are displaced: returns the bits of the cells that have to be
// looked at one by one, as some corner is not seen to keep a positive area up to the step.
// `quality`, if wanted, is that of the displaced cells, compared with the cells before. All this is
// what CellCorners, CellMeasure, Quality::add and AdmissibleStep::add compute for one cell,
// operation by operation; sums have the same order in all kernels. So the bits are the same for all
// instruction sets.
using LookAtCells = std::uint64_t(CellList const& cells, CellPlaces const& places,
                                  CellBounds const& bounds, ListQuality* quality) noexcept;
struct CellKernels {
    LookAtCells *triangles, *quads;
};

// For so many cells; `known`: the best kernel, if known.
CellKernels const& cell_kernels(Kernel known, Index n_cells) noexcept;

// visit(user, batches) for cells begin .. end-1, in their order.
void for_each_batch(OrientedMesh const& cells, Index begin, Index end,
                    void (*visit)(void* user, CellBatches const& batches), void* user) noexcept;
template <class Visit>
void for_each_batch(OrientedMesh const& cells, Index begin, Index end, Visit visit) noexcept {
    auto const call = [](void* user, CellBatches const& batches) {
        (*static_cast<Visit*>(user))(batches);
    };
    for_each_batch(cells, begin, end, call, &visit);
}

// Of all cells: add_batch(kernels, batches, result) where cells are the caller's; add_cell(i,
// result) for i < n where they are pieces of polygons, which kernels do not know.
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
