#include "fields/swept_areas.hpp"

#include "base/double_double.hpp"

namespace harmorph {
namespace {

constexpr Index min_cells_of_task = 2048;

struct ExactVector {
    DoubleDouble x, y;
};
ExactVector operator+(ExactVector a, ExactVector b) noexcept { return {a.x + b.x, a.y + b.y}; }
ExactVector operator-(ExactVector a, ExactVector b) noexcept { return {a.x - b.x, a.y - b.y}; }
ExactVector operator*(Real s, ExactVector a) noexcept { return {s * a.x, s * a.y}; }
DoubleDouble exact_cross(ExactVector a, ExactVector b) noexcept { return a.x * b.y - a.y * b.x; }
ExactVector exact_difference(Vec2 a, Vec2 b) noexcept {
    return {DoubleDouble::difference(a.x, b.x), DoubleDouble::difference(a.y, b.y)};
}

// The mean velocity of a line between two points is (v_a + v_b) / 2, its mean vector (e_from +
// e_to) / 2, and the area is the cross product of both. This holds exactly, because the end points
// move linearly in time.
class CellSweep {
public:
    // `point_of(k)` is point k of the cell, which has `width` entries and n different corners.
    template <class PointOf>
    static void run(SweptAreas const& areas, Offset first, Index width, Index n, Points from,
                    Points to, PointOf const& point_of) noexcept {
        Vec2 const origin_from = from[point_of(0)], origin_to = to[point_of(0)];
        ExactVector sum_from, sum_to, sum_velocity;  // the first two relative to corner 0
        bool const duals = !areas.duals.empty();
        for (Index k = 0; duals && k < n; ++k) {
            Index const p = point_of(k);
            sum_from = sum_from + exact_difference(from[p], origin_from);
            sum_to = sum_to + exact_difference(to[p], origin_to);
            sum_velocity = sum_velocity + exact_difference(to[p], from[p]);
        }
        Real const corners = static_cast<Real>(n);
        for (Index k = 0; k < width; ++k) {
            Index const a = point_of(k), b = point_of(k + 1 == width ? 0 : k + 1);
            ExactVector const velocity_a = exact_difference(to[a], from[a]),
                              velocity_b = exact_difference(to[b], from[b]);
            ExactVector const side =
                exact_difference(from[b], from[a]) + exact_difference(to[b], to[a]);
            if (!areas.sides.empty())
                areas.sides[first + k] = quarter(exact_cross(velocity_a + velocity_b, side));
            if (!areas.halves.empty()) {
                Real* const both = areas.halves.data() + 2 * (first + k);
                both[0] = 0.25 * quarter(exact_cross(3 * velocity_a + velocity_b, side));
                both[1] = 0.25 * quarter(exact_cross(velocity_a + 3 * velocity_b, side));
            }
            if (!duals) continue;
            if (a == b) {
                areas.duals[first + k] = 0;
                continue;
            }
            // 2 n times the line from the middle of the side to the mean of the corners, and 2 n
            // times the sum of the velocities of its ends.
            ExactVector const line =
                2 * (sum_from + sum_to) -
                corners * (exact_difference(from[a], origin_from) +
                           exact_difference(from[b], origin_from) +
                           exact_difference(to[a], origin_to) + exact_difference(to[b], origin_to));
            ExactVector const velocity = corners * (velocity_a + velocity_b) + 2 * sum_velocity;
            areas.duals[first + k] =
                (exact_cross(velocity, line) / (16 * corners * corners)).rounded();
        }
    }

private:
    static Real quarter(DoubleDouble x) noexcept { return 0.25 * x.rounded(); }
};

// Returns the first entry and the number of entries of a cell.
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

}  // namespace

Offset SweptAreas::count_entries(Mesh const& mesh) noexcept {
    EntryPlace const last = place_of_cell(mesh, mesh.n_cells - 1);
    return last.first + last.width;
}

void SweptAreas::compute(Mesh const& mesh, Points from, Points to,
                         Executor const& executor) const noexcept {
    SweptAreas const areas = *this;
    executor.for_ranges(mesh.n_cells, min_cells_of_task, [&](Index begin, Index end) {
        if (mesh.layout == CellLayout::polygons) {
            for (Index i = begin; i < end; ++i) {
                EntryPlace const place = place_of_cell(mesh, i);
                const Index* const corner = mesh.cell_points + place.first;
                CellSweep::run(areas, place.first, place.width, place.width, from, to,
                               [&](Index k) { return from_zero(corner[k], mesh.index_base); });
            }
            return;
        }
        mesh.for_each_cell(begin, end, [&](Index i, Cell const& cell) {
            EntryPlace const place = place_of_cell(mesh, i);
            CellSweep::run(areas, place.first, place.width, cell.n, from, to,
                           [&](Index k) { return cell.point[min(k, cell.n - 1)]; });
        });
    });
}

}  // namespace harmorph
