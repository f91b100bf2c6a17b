#include "morph/quality.hpp"

namespace harmorph {
namespace {

struct Count {
    Index n = 0;
    void merge(Count const& later) noexcept { n += later.n; }
};

}  // namespace

void Quality::merge(Quality const& later) noexcept {
    if (inverted == 0) first_inverted = later.first_inverted;
    inverted += later.inverted;
    min_area = min(min_area, later.min_area);
    if (later.min_quality < min_quality) {
        min_quality = later.min_quality;
        min_quality_cell = later.min_quality_cell;
    }
    quality_sum += later.quality_sum;
    cells += later.cells;
}

void Quality::add(OrientedMesh const& mesh, CellPlaces const& places, CellBatches const& batches,
                  ListQuality const& triangles, ListQuality const& quads, Real* all) noexcept {
    cells += batches.n;
    quality_sum += triangles.sum + quads.sum;
    if (all == nullptr && (triangles.notable | quads.notable) == 0) return;
    batches.for_each([&](Index number, bool is_triangle, Index i) {
        ListQuality const& list = is_triangle ? triangles : quads;
        if (all != nullptr) all[number] = list.quality[i];
        if ((list.notable >> i & 1) == 0) return;
        if (list.quality[i] != ListQuality::not_in_range)
            return note(number, list.twice_smallest[i], list.quality[i]);
        Cell const cell = mesh.cell(number);
        Real reference_area = 0;
        if (places.change.given())
            reference_area = CellCorners(CellShape(cell, places.at, false)).cell_area(cell.n);
        else if (places.reference.given()) reference_area = cell_area(cell, places.reference);
        CellMeasure const measure(cell.n, CellCorners(places.displaced(cell)));
        Real const quality = measure.quality(reference_area);
        note(number, measure.twice_smallest, quality);
        Real const counted = quality > 0 ? quality : 0;
        quality_sum += counted;
        if (all != nullptr) all[number] = counted;
    });
}

CellMeasure measure_cell(OrientedMesh const& cells, Index number, Points points) noexcept {
    return {cells.mesh, number, [&](Index i) { return shape_of(cells, i, points); }};
}

Quality measure_quality(OrientedMesh const& cells, Points points, Points reference,
                        Executor const& executor, Real* all) noexcept {
    auto const add_cell = [&](Index i, Quality& quality) {
        quality.add(i, measure_cell(cells, i, points),
                    reference.given() ? measure_cell(cells, i, reference).area : 0, all);
    };
    CellPlaces const places{points, {}, reference};
    auto const add_batch = [&](CellKernels const& kernels, CellBatches const& batches,
                               Quality& quality) {
        CellBounds const bounds = {infinity, 2 * quality.min_area, quality.min_quality};
        ListQuality triangles, quads;
        kernels.triangles(batches.triangles, places, bounds, &triangles);
        kernels.quads(batches.quads, places, bounds, &quads);
        quality.add(cells, places, batches, triangles, quads, all);
    };
    return reduce_batches<Quality>(cells, cells.mesh.n_given_cells(), executor, add_cell,
                                   add_batch);
}

// With skew quality q a corner's area is at least q / 8 of the sum of the two products of which it
// is the difference, and their rounding is a few epsilon of this sum. Therefore only poor cells
// need the exact test.
Index count_inverted(OrientedMesh const& cells, Points points, Executor const& executor) noexcept {
    constexpr Real surely_positive = 1e-10;  // This is a skew quality.
    auto const is_bad = [&](Index cell) {
        CellShape const shape = shape_of(cells, cell, points);
        return is_inverted(shape) || is_inverted_exactly(shape);
    };
    auto const add_cell = [&](Index cell, Count& count) { count.n += is_bad(cell) ? 1 : 0; };
    auto const add_batch = [&](CellKernels const& kernels, CellBatches const& batches,
                               Count& count) {
        CellBounds const bounds = {infinity, 0, surely_positive};
        ListQuality triangles, quads;
        kernels.triangles(batches.triangles, {points, {}, {}}, bounds, &triangles);
        kernels.quads(batches.quads, {points, {}, {}}, bounds, &quads);
        if ((triangles.notable | quads.notable) == 0) return;
        batches.for_each([&](Index number, bool is_triangle, Index i) {
            bool const is_poor = ((is_triangle ? triangles : quads).notable >> i & 1) != 0;
            if (is_poor) add_cell(number, count);
        });
    };
    return reduce_batches<Count>(cells, cells.mesh.n_checked(), executor, add_cell, add_batch).n;
}

}  // namespace harmorph
