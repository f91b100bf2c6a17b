#include "morph/cell_batch.hpp"

#include "base/elementary.hpp"
#include "morph/quality.hpp"

#define HARMORPH_KERNELS "morph/cell_kernel.hpp"
#include "simd/for_each_set.hpp"

namespace harmorph {
namespace {

// Tells whether n cells of a list, beginning with `first`, have the same orientation, and sets that
// orientation.
bool have_one_orientation(const std::uint8_t* first, Index n, bool& reversed) noexcept {
    reversed = *first != 0;
    if (n == CellBatches::max_count) {
        constexpr Index words = CellBatches::max_count / 8;
        std::uint64_t const expected = reversed ? 0x0101010101010101 : 0;
        std::uint64_t word[words], differs = 0;
        std::memcpy(word, first, sizeof word);
        for (Index k = 0; k < words; ++k) differs |= word[k] ^ expected;
        return differs == 0;
    }
    for (Index i = 1; i < n; ++i) {
        if ((first[i] != 0) != reversed) return false;
    }
    return true;
}

// Tells whether none of n quadrilaterals repeats its last point.
bool have_four_points(const Index* points, Index n) noexcept {
    bool all = true;
    for (Index i = 0; i < n; ++i) all &= points[4 * i + 2] != points[4 * i + 3];
    return all;
}

struct Collector {
    OrientedMesh const& cells;
    void (*visit)(void* user, CellBatches const& batches);
    void* user;
    CellBatches batches;

    void copy_one_by_one(Index first, Index end) noexcept {
        batches.begin_copies(first);
        cells.mesh.for_each_cell(first, end, [this](Index i, Cell const& cell) {
            batches.add_copy(cell, cells.reversed[i] != 0);
            if (batches.n < CellBatches::max_count) return;
            visit(user, batches);
            batches.begin_copies(i + 1);
        });
        if (batches.n > 0) visit(user, batches);
    }
    // Visits n cells of `width` points each; `points` are those of cell `first`. The list is
    // visited without copies if the cells are alike.
    template <Index width>
    void take(const Index* points, Index first, Index n) noexcept {
        bool reversed = false;
        if (!have_one_orientation(cells.reversed.data() + first, n, reversed) ||
            (width == 4 && !have_four_points(points, n))) {
            return copy_one_by_one(first, first + n);
        }
        // While the kernels compute, the points of the next cells come from memory. Prefetching
        // after the end of the list does no harm.
        for (Index k = 0; k < width * CellBatches::max_count; k += 16)
            __builtin_prefetch(points + width * n + k);
        visit_list<width>({points, n, cells.mesh.index_base, reversed}, first);
    }
    // Visits cells first .. end-1, which are in a list of `width` points for each; the list begins
    // with cell `begin`.
    template <Index width>
    void take_list(const Index* points, Index begin, Index first, Index end) noexcept {
        for (Index n = 0; first < end; first += n) {
            n = min(CellBatches::max_count, end - first);
            take<width>(points + Offset{width} * (first - begin), first, n);
        }
    }
    void take_rows(Index first, Index end) noexcept {
        for (Index n = 0; first < end; first += n) {
            n = min(CellBatches::max_count, end - first);
            const Index* const start = cells.mesh.cell_start + first;
            const Index* const points =
                cells.mesh.cell_points + (Offset{*start} - cells.mesh.index_base);
            // The width is 3 or 4 for each row; the sum of the widths tells whether all rows are
            // alike.
            Index const width = start[1] - start[0];
            __builtin_prefetch(start + 2 * n);
            if (start[n] - start[0] != n * width) {
                copy_one_by_one(first, first + n);
            } else if (width == 3) {
                take<3>(points, first, n);
            } else {
                take<4>(points, first, n);
            }
        }
    }
    // Visits cells of structured blocks, row by row. Batches continue from block to block, as in
    // lists.
    void take_grid(Index begin, Index end) noexcept {
        Index points[4 * CellBatches::max_count], n = 0;
        auto const take_block = [&](GridBlock const& block) {
            Index const last = min(end, block.first_cell + block.n_cells()), width = block.ni - 1;
            for (Index i = max(begin, block.first_cell), added = 0; i < last; i += added) {
                Index const in_block = i - block.first_cell, left_in_row = width - in_block % width;
                added = min(min(last - i, left_in_row), CellBatches::max_count - n);
                Index corner = block.cell(in_block).point[0];
                for (Index* to = points + 4 * n; to < points + 4 * (n + added); to += 4, ++corner) {
                    to[0] = corner;
                    to[1] = corner + 1;
                    to[2] = corner + 1 + block.ni;
                    to[3] = corner + block.ni;
                }
                n += added;
                if (n < CellBatches::max_count) continue;
                take_quads(points, i + added - n, n);
                n = 0;
            }
            return last >= end;
        };
        Mesh const& mesh = cells.mesh;
        if (mesh.layout == CellLayout::structured) take_block({mesh.ni, mesh.nj, 0, 0});
        else mesh.find_block(take_block);
        if (n > 0) take_quads(points, end - n, n);
    }
    // Visits n quadrilaterals with points counted from 0.
    void take_quads(const Index* points, Index first, Index n) noexcept {
        bool reversed = false;
        if (!have_one_orientation(cells.reversed.data() + first, n, reversed))
            return copy_one_by_one(first, first + n);
        visit_list<4>({points, n, 0, reversed}, first);
    }
    template <Index width>
    void visit_list(CellList const& list, Index first) noexcept {
        batches.first = first;
        batches.n = list.n;
        batches.triangles = width == 3 ? list : CellList();
        batches.quads = width == 4 ? list : CellList();
        visit(user, batches);
    }
};

}  // namespace

void for_each_batch(OrientedMesh const& cells, Index begin, Index end,
                    void (*visit)(void* user, CellBatches const& batches), void* user) noexcept {
    Mesh const& mesh = cells.mesh;
    Collector collector{cells, visit, user, {}};
    if (mesh.layout == CellLayout::quads) {
        collector.take_list<4>(mesh.cell_points, 0, begin, end);
    } else if (mesh.layout == CellLayout::triangles) {
        collector.take_list<3>(mesh.cell_points, 0, begin, end);
    } else if (mesh.layout == CellLayout::mixed) {
        Index const n = mesh.n_triangles();
        collector.take_list<3>(mesh.cell_points, 0, begin, min(end, n));
        collector.take_list<4>(mesh.quad_points, n, max(begin, n), end);
    } else if (mesh.layout == CellLayout::rows) {
        collector.take_rows(begin, end);
    } else if (mesh.layout == CellLayout::structured || mesh.layout == CellLayout::blocks) {
        collector.take_grid(begin, end);
    } else {
        collector.copy_one_by_one(begin, end);
    }
}

namespace {
Kernel kernel_for(Kernel known, Index n_cells) noexcept {
    // Below this number CPUID costs more time than a better kernel saves.
    constexpr Index detection_threshold = 4096;
    return resolved(known, n_cells < detection_threshold ? Kernel::baseline : Kernel::automatic);
}
}  // namespace

CellKernels const& cell_kernels(Kernel known, Index n_cells) noexcept {
    return simd::table_of<CellKernels>(kernel_for(known, n_cells));
}
SmoothKernels const& smooth_kernels(Kernel known, Index n_cells) noexcept {
    return simd::table_of<SmoothKernels>(kernel_for(known, n_cells));
}

}  // namespace harmorph
