// Cells in batches, for kernels that look at several cells at a time: corner areas, quality, and whether a displacement
// can invert them. A batch holds cells of one shape, so that the kernels have no branches.
#pragma once

#include "harmorph/mesh/topology.hpp"
#include "harmorph/simd/cpu.hpp"

namespace harmorph {

// Cells of one shape, corner by corner and counter-clockwise; the fourth corner of a triangle is the first again. Behind
// the last cell, whole registers are filled with the last cell.
struct CellBatch {
    static constexpr Index most = 64, widest_register = 8;
    Index n = 0;
    Index point[4][most];

    void add(Cell const& cell, bool reversed) noexcept {
        for (Index k = 0; k < cell.n; ++k) point[k][n] = cell.point[reversed ? cell.n - 1 - k : k];
        if (cell.n == 3) point[3][n] = point[0][n];
        ++n;
    }
    void fill_register() noexcept {
        for (Index i = n; i % widest_register != 0; ++i) {
            for (Index k = 0; k < 4; ++k) point[k][i] = point[k][n - 1];
        }
    }
};

// For each cell of a batch.
struct BatchQuality {
    Real twice_smallest[CellBatch::most];  // twice the smallest corner area, or NaN
    Real quality[CellBatch::most];         // 0 where the cell is inverted
};

// Where the cells are, and by what they are displaced, if at all.
struct CellPlaces {
    Points at, change;
    Points reference;  // where nothing is displaced: cells to compare sizes with, if given
};

// Looks at cells of one shape. Where they are displaced: returns the bits of the cells that have to be looked at one by
// one, as some corner is not seen to keep a positive area up to `step`. `quality`, if wanted, is that of the displaced
// cells, compared with the cells before. All this is what CellCorners, skew_quality, Quality::add and AdmissibleStep::add
// compute for one cell, operation by operation: the bits are the same for all instruction sets.
using LookAtCells = std::uint64_t(CellBatch const& cells, CellPlaces const& places, Real step,
                                  BatchQuality* quality) noexcept;
struct CellKernels {
    LookAtCells *triangles, *quads;
};

// For so many cells; `known`: the best kernel, if known.
CellKernels const& cell_kernels(Kernel known, Index n_cells) noexcept;

// Up to CellBatch::most consecutive cells, by shape.
struct CellBatches {
    Index first = 0, n = 0;
    CellBatch triangles, quads;
    bool is_triangle[CellBatch::most];  // where there are both

    void add(Cell const& cell, bool reversed) noexcept {
        is_triangle[n++] = cell.n == 3;
        (cell.n == 3 ? triangles : quads).add(cell, reversed);
    }
    // visit(cell, is it a triangle?, its number in the batch of its shape) in the order of the cells.
    template <class Visit>
    void for_each(Visit const& visit) const noexcept {
        if (triangles.n == 0 || quads.n == 0) {
            for (Index i = 0; i < n; ++i) visit(first + i, triangles.n > 0, i);
            return;
        }
        Index next[2] = {};
        for (Index i = 0; i < n; ++i) visit(first + i, is_triangle[i], next[is_triangle[i] ? 1 : 0]++);
    }
};

// visit(user, batches) for cells begin .. end-1, in their order.
void for_each_batch(OrientedMesh const& cells, Index begin, Index end,
                    void (*visit)(void* user, CellBatches const& batches), void* user) noexcept;
template <class Visit>
void for_each_batch(OrientedMesh const& cells, Index begin, Index end, Visit visit) noexcept {
    for_each_batch(
        cells, begin, end, [](void* user, CellBatches const& batches) { (*static_cast<Visit*>(user))(batches); }, &visit);
}

}  // namespace harmorph
