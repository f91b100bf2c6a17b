#include "harmorph/morph/cell_batch.hpp"

#define HARMORPH_KERNELS "morph/cell_kernel.hpp"
#include "harmorph/simd/for_each_set.hpp"

namespace harmorph {
namespace {

// Adds n cells whose `width` points stand side by side, from the first on; false: a quadrilateral is a triangle.
template <Index width>
bool add_list(const Index* points, const std::uint8_t* reversed, Index n, Index index_base, CellBatch& to) noexcept {
    bool all = true;
    for (Index i = 0; i < n; ++i) {
        const Index* const its = points + width * i;
        bool const back = reversed[i] != 0;
        Index const first = its[back ? width - 1 : 0], last = its[back ? 0 : width - 1];
        to.point[0][i] = from_zero(first, index_base);
        to.point[1][i] = from_zero(width == 3 ? its[1] : its[back ? 2 : 1], index_base);
        to.point[2][i] = from_zero(width == 3 ? last : its[back ? 1 : 2], index_base);
        to.point[3][i] = from_zero(width == 3 ? first : last, index_base);
        if (width == 4) all &= its[2] != its[3];
    }
    to.n = all ? n : 0;
    return all;
}

struct Collector {
    OrientedMesh const& cells;
    void (*visit)(void* user, CellBatches const& batches);
    void* user;
    CellBatches batches;

    void begin(Index first) noexcept {
        batches.first = first;
        batches.n = batches.triangles.n = batches.quads.n = 0;
    }
    void finish() noexcept {
        if (batches.n == 0) return;
        batches.triangles.fill_register();
        batches.quads.fill_register();
        visit(user, batches);
        begin(batches.first + batches.n);
    }
    void add_one_by_one(Index first, Index end) noexcept {
        begin(first);
        cells.mesh.for_each_cell(first, end, [this](Index i, Cell const& cell) {
            batches.add(cell, cells.reversed[i] != 0);
            if (batches.n == CellBatch::most) finish();
        });
        finish();
    }
    // Cells first .. end-1 of a list of `width` points for each; `points`: those of cell first.
    template <Index width>
    void add_list_of(const Index* points, Index first, Index end) noexcept {
        for (begin(first); batches.first < end; finish()) {
            Index const i = batches.first, n = smaller(CellBatch::most, end - i);
            CellBatch& to = width == 3 ? batches.triangles : batches.quads;
            if (add_list<width>(points + Offset{width} * (i - first), cells.reversed.data() + i, n,
                                cells.mesh.index_base, to)) {
                batches.n = n;
                continue;
            }
            for (Index k = 0; k < n; ++k) batches.add(cells.mesh.cell(i + k), cells.reversed[i + k] != 0);
        }
    }
};

}  // namespace

void for_each_batch(OrientedMesh const& cells, Index begin, Index end,
                    void (*visit)(void* user, CellBatches const& batches), void* user) noexcept {
    Mesh const& mesh = cells.mesh;
    Collector collector{cells, visit, user, {}};
    if (mesh.layout == CellLayout::quads) {
        collector.add_list_of<4>(mesh.cell_points + Offset{4} * begin, begin, end);
    } else if (mesh.layout == CellLayout::triangles) {
        collector.add_list_of<3>(mesh.cell_points + Offset{3} * begin, begin, end);
    } else if (mesh.layout == CellLayout::mixed) {
        Index const n = mesh.n_triangles(), triangles_end = smaller(end, n), first_quad = larger(begin, n);
        if (begin < triangles_end) {
            collector.add_list_of<3>(mesh.cell_points + Offset{3} * begin, begin, triangles_end);
        }
        if (first_quad < end) {
            collector.add_list_of<4>(mesh.quad_points + Offset{4} * (first_quad - n), first_quad, end);
        }
    } else {
        collector.add_one_by_one(begin, end);
    }
}

CellKernels const& cell_kernels(Kernel known, Index n_cells) noexcept {
    constexpr Index worth_asking = 4096;  // below, CPUID costs more time than a better kernel saves
    return simd::table_of<CellKernels>(resolved(known, n_cells < worth_asking ? Kernel::baseline : Kernel::automatic));
}

}  // namespace harmorph
