#include "fields/swept_areas.hpp"

#include "base/double_double.hpp"
#include "simd/kernel_table.hpp"

namespace harmorph {

// Cells of one shape, one in each lane; each array has a row for each corner or side.
struct SweptBatch {
    static constexpr Index size = 8;
    bool wants_sides, wants_duals, wants_halves;
    Real from_x[4][size], from_y[4][size], to_x[4][size], to_y[4][size];
    Real sides[4][size], duals[4][size], halves[8][size];
};

struct SweptKernels {
    // Computes what is wanted of cells with n corners, 3 or 4.
    void (*sweep)(SweptBatch& cells, Index n) noexcept;
};

}  // namespace harmorph

#define HARMORPH_KERNELS "fields/swept_kernel.hpp"
#include "simd/for_each_set.hpp"

namespace harmorph {
namespace {

constexpr Index min_cells_of_task = 2048;

using Xy [[gnu::vector_size(16)]] = Real;  // x and y
using ExactVector = DoubleDoubleOf<Xy>;

ExactVector exact_difference(Vec2 a, Vec2 b) noexcept {
    return ExactVector::difference(Xy{a.x, a.y}, Xy{b.x, b.y});
}
// Returns the cross product with an error of a few times 2^-104 of the sum of both its terms.
// Exchanged arguments give the opposite bits.
DoubleDouble exact_cross(ExactVector a, ExactVector b) noexcept {
    Xy const high{b.high[1], b.high[0]}, low{b.low[1], b.low[0]};
    ExactVector const terms = ExactVector::product(a.high, high);
    Xy const mixed = terms.low + (a.high * low + a.low * high);
    DoubleDouble const leading = DoubleDouble::difference(terms.high[0], terms.high[1]);
    return normalised(leading.high, leading.low + (mixed[0] - mixed[1]));
}

// The two positions of the points of a mesh.
struct LinearMotion {
    Points from, to;

    ExactVector velocity(Index point) const noexcept {
        return exact_difference(to[point], from[point]);
    }
    // The diagonals of the quadrilateral that the side from a to b sweeps. Two cells subtract the
    // same numbers at their common side, so that their areas are opposite.
    ExactVector diagonal(Index a, Index b) const noexcept {
        return exact_difference(to[b], from[a]);
    }
    ExactVector back_diagonal(Index a, Index b) const noexcept {
        return exact_difference(from[b], to[a]);
    }
    // The sum of the vectors from one point to another in both positions.
    ExactVector line(Index a, Index b) const noexcept {
        return exact_difference(from[b], from[a]) + exact_difference(to[b], to[a]);
    }
};

// A side from point a to point b. Its mean velocity is (v_a + v_b) / 2, its mean vector
// (e_from + e_to) / 2, and the area is the cross product of both, exactly, because the points move
// linearly in time. With the diagonals d_1 = b_to - a_from and d_2 = b_from - a_to of the swept
// quadrilateral, v_a + v_b = d_1 - d_2 and e_from + e_to = d_1 + d_2, so that the area is half of
// the cross product of d_1 and d_2. The half at a sweeps 1/8 of this product and 1/8 of that of v_a
// and d_1 + d_2.
struct MovingSide {
    ExactVector first, second, velocity_a, velocity_b;  // first and second: the diagonals

    void write(SweptAreas const& areas, Offset entry) const noexcept {
        DoubleDouble const area = exact_cross(first, second);
        if (!areas.sides.empty()) areas.sides[entry] = 0.5 * area.rounded();
        if (areas.halves.empty()) return;
        Real* const halves = areas.halves.data() + 2 * entry;
        halves[0] = 0.125 * (area + exact_cross(velocity_a, first + second)).rounded();
        halves[1] = 0.125 * (area + exact_cross(velocity_b, first + second)).rounded();
    }
};

// Computes the areas of a polygon of any number n of corners; `point_of(k)` is corner k. A face of
// the dual runs from the middle of its side to the mean of the corners; in a quadrilateral, four
// times its vector, or in a triangle six times, is the next side minus the side before.
template <class PointOf>
void sweep_polygon(SweptAreas const& areas, LinearMotion const& points, Offset first, Index n,
                   PointOf const& point_of) noexcept {
    Index const zero = point_of(0);
    Real const corners = static_cast<Real>(n), divisor = 16 * corners * corners;
    ExactVector twice_place, twice_velocity;  // sums of all corners, relative to the first one
    for (Index k = 0; k < n && !areas.duals.empty(); ++k) {
        twice_place = twice_place + doubled(points.line(zero, point_of(k)));
        twice_velocity = twice_velocity + doubled(points.velocity(point_of(k)));
    }
    for (Index k = 0; k < n; ++k) {
        Index const a = point_of(k), b = point_of(k + 1 == n ? 0 : k + 1);
        MovingSide const side{points.diagonal(a, b), points.back_diagonal(a, b), points.velocity(a),
                              points.velocity(b)};
        side.write(areas, first + k);
        if (areas.duals.empty()) continue;
        // 2 n times the line from the middle of the side to the mean of the corners, and 2 n times
        // the sum of the velocities of its ends
        ExactVector const line =
            twice_place - corners * (points.line(zero, a) + points.line(zero, b));
        areas.duals[first + k] =
            (exact_cross(corners * (side.velocity_a + side.velocity_b) + twice_velocity, line) /
             divisor)
                .rounded();
    }
}

// A quadrilateral that repeats its last point has no area at the side between the repetitions.
void clear_entry(SweptAreas const& areas, Offset entry) noexcept {
    if (!areas.sides.empty()) areas.sides[entry] = 0;
    if (!areas.duals.empty()) areas.duals[entry] = 0;
    if (!areas.halves.empty()) areas.halves[2 * entry] = areas.halves[2 * entry + 1] = 0;
}

// The first entry and the number of entries of a cell.
struct EntryPlace {
    Offset first;
    Index width;
};
EntryPlace place_of_cell(Mesh const& mesh, Index i) noexcept {
    switch (mesh.layout) {
        case CellLayout::rows:
        case CellLayout::polygons:
            return {Offset{mesh.cell_start[i]} - mesh.index_base,
                    mesh.cell_start[i + 1] - mesh.cell_start[i]};
        case CellLayout::triangles: return {Offset{3} * i, 3};
        case CellLayout::mixed: {
            Index const triangles = mesh.n_triangles();
            if (i < triangles) return {Offset{3} * i, 3};
            return {Offset{3} * triangles + Offset{4} * (i - triangles), 4};
        }
        default: return {Offset{4} * i, 4};
    }
}

// Collects triangles and quadrilaterals until the lanes of a batch are full.
class Batches {
public:
    Batches(SweptAreas const& areas, LinearMotion const& points,
            SweptKernels const& kernels) noexcept
        : areas_(areas), points_(points), kernels_(kernels) {
        for (SweptBatch& batch : batch_) {
            batch.wants_sides = !areas.sides.empty();
            batch.wants_duals = !areas.duals.empty();
            batch.wants_halves = !areas.halves.empty();
        }
    }
    // `entry_of(k)` is the entry of side k.
    template <Index n, class EntryOf>
    void add(const Index* corner, EntryOf const& entry_of) noexcept {
        SweptBatch& batch = batch_[n - 3];
        Index& count = count_[n - 3];
        for (Index k = 0; k < n; ++k) {
            Vec2 const from = points_.from[corner[k]], to = points_.to[corner[k]];
            batch.from_x[k][count] = from.x;
            batch.from_y[k][count] = from.y;
            batch.to_x[k][count] = to.x;
            batch.to_y[k][count] = to.y;
            entry_[n - 3][k][count] = entry_of(k);
        }
        if (++count == SweptBatch::size) sweep(n);
    }
    void end() noexcept {
        for (Index n = 3; n <= 4; ++n) {
            if (count_[n - 3] > 0) sweep(n);
        }
    }

private:
    void sweep(Index n) noexcept {
        SweptBatch& batch = batch_[n - 3];
        Index const count = count_[n - 3];
        // Lanes without a cell repeat the first one.
        for (Index k = 0; k < n; ++k) {
            for (Index lane = count; lane < SweptBatch::size; ++lane) {
                batch.from_x[k][lane] = batch.from_x[k][0];
                batch.from_y[k][lane] = batch.from_y[k][0];
                batch.to_x[k][lane] = batch.to_x[k][0];
                batch.to_y[k][lane] = batch.to_y[k][0];
            }
        }
        kernels_.sweep(batch, n);
        for (Index lane = 0; lane < count; ++lane) {
            for (Index k = 0; k < n; ++k) write(batch, k, lane, entry_[n - 3][k][lane]);
        }
        count_[n - 3] = 0;
    }
    void write(SweptBatch const& batch, Index k, Index lane, Offset entry) const noexcept {
        if (batch.wants_sides) areas_.sides[entry] = batch.sides[k][lane];
        if (batch.wants_duals) areas_.duals[entry] = batch.duals[k][lane];
        if (!batch.wants_halves) return;
        areas_.halves[2 * entry] = batch.halves[2 * k][lane];
        areas_.halves[2 * entry + 1] = batch.halves[2 * k + 1][lane];
    }

    SweptAreas const& areas_;
    LinearMotion const& points_;
    SweptKernels const& kernels_;
    SweptBatch batch_[2];  // triangles and quadrilaterals
    Offset entry_[2][4][SweptBatch::size];
    Index count_[2] = {};
};

// Below this number of cells CPUID costs more time than a better kernel saves.
constexpr Index min_detected_cells = 4096;

}  // namespace

Offset SweptAreas::count_entries(Mesh const& mesh) noexcept {
    EntryPlace const last = place_of_cell(mesh, mesh.n_cells - 1);
    return last.first + last.width;
}

void SweptAreas::compute(Mesh const& mesh, Points from, Points to,
                         Executor const& executor) const noexcept {
    SweptAreas const areas = *this;
    LinearMotion const points{from, to};
    SweptKernels const& kernels = simd::table_of<SweptKernels>(resolved(
        executor.kernel, mesh.n_cells < min_detected_cells ? Kernel::baseline : Kernel::automatic));
    executor.for_ranges(mesh.n_cells, min_cells_of_task, [&](Index begin, Index end) {
        if (mesh.layout == CellLayout::polygons) {
            for (Index i = begin; i < end; ++i) {
                EntryPlace const place = place_of_cell(mesh, i);
                const Index* const corner = mesh.cell_points + place.first;
                sweep_polygon(areas, points, place.first, place.width,
                              [&](Index k) { return from_zero(corner[k], mesh.index_base); });
            }
            return;
        }
        Batches batches(areas, points, kernels);
        mesh.for_each_cell(begin, end, [&](Index i, Cell const& cell) {
            EntryPlace const place = place_of_cell(mesh, i);
            if (cell.n == 4) {
                batches.add<4>(cell.point, [&](Index k) { return place.first + k; });
                return;
            }
            Index const repeated = place.width - 3;
            if (repeated > 0) clear_entry(areas, place.first + 2);
            batches.add<3>(cell.point,
                           [&](Index k) { return place.first + k + (k == 2 ? repeated : 0); });
        });
        batches.end();
    });
}

}  // namespace harmorph
