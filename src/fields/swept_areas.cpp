#include "fields/swept_areas.hpp"

#include "base/double_double.hpp"

namespace harmorph {
namespace {

constexpr Index min_cells_of_task = 2048;

typedef Real Xy __attribute__((vector_size(16)));  // x and y
using ExactVector = DoubleDoubleOf<Xy>;

ExactVector exact_difference(Vec2 a, Vec2 b) noexcept {
    return ExactVector::difference(Xy{a.x, a.y}, Xy{b.x, b.y});
}
// Returns the cross product with an error of a few times 2^-104 of the sum of both its terms.
DoubleDouble exact_cross(ExactVector a, ExactVector b) noexcept {
    Xy const high{b.high[1], b.high[0]}, low{b.low[1], b.low[0]};
    ExactVector const terms = ExactVector::product(a.high, high);
    Xy const mixed = terms.low + (a.high * low + a.low * high);
    DoubleDouble const most = DoubleDouble::difference(terms.high[0], terms.high[1]);
    return normalised(most.high, most.low + (mixed[0] - mixed[1]));
}

// The two positions of the points of a mesh.
struct LinearMotion {
    Points from, to;

    ExactVector velocity(Index point) const noexcept {
        return exact_difference(to[point], from[point]);
    }
    // The sum of the vectors from one point to another in both positions. Two cells subtract the
    // same numbers at their common side, so that their areas are opposite.
    ExactVector line(Index a, Index b) const noexcept {
        return exact_difference(from[b], from[a]) + exact_difference(to[b], to[a]);
    }
};

// A line from one point to another, in both positions together, and the velocities of its ends. The
// mean velocity of a line is (v_a + v_b) / 2, its mean vector (e_from + e_to) / 2, and the area is
// the cross product of both. This holds exactly, because the end points move linearly in time.
struct MovingSide {
    ExactVector line, velocity_a, velocity_b, sum;  // the sum of the velocities

    void write(SweptAreas const& areas, Offset entry) const noexcept {
        if (!areas.sides.empty()) areas.sides[entry] = 0.25 * exact_cross(sum, line).rounded();
        if (areas.halves.empty()) return;
        Real* const both = areas.halves.data() + 2 * entry;
        both[0] = 0.0625 * exact_cross(doubled(velocity_a) + sum, line).rounded();
        both[1] = 0.0625 * exact_cross(doubled(velocity_b) + sum, line).rounded();
    }
};

// Computes the areas of a triangle or quadrilateral. A face of the dual runs from the middle of its
// side to the mean of the corners. Four times its vector in a quadrilateral, or six times in a
// triangle, is the next side minus the side before. `entry_of(k)` is the entry of side k.
template <Index n, class EntryOf>
void sweep(SweptAreas const& areas, LinearMotion const& points, const Index* corner,
           EntryOf entry_of) noexcept {
    ExactVector velocity[n];
    MovingSide side[n];
    for (Index k = 0; k < n; ++k) velocity[k] = points.velocity(corner[k]);
    for (Index k = 0; k < n; ++k) {
        Index const next = (k + 1) % n;
        side[k] = {points.line(corner[k], corner[next]), velocity[k], velocity[next],
                   velocity[k] + velocity[next]};
        side[k].write(areas, entry_of(k));
    }
    if (areas.duals.empty()) return;
    ExactVector const total = side[0].sum + (n == 4 ? side[2].sum : velocity[2]);
    for (Index k = 0; k < n; ++k) {
        ExactVector const line = side[(k + 1) % n].line - side[(k + n - 1) % n].line,
                          twice = doubled(side[k].sum);
        // 4 or 6 times the sum of the velocities of both ends of the line
        Real& area = areas.duals[entry_of(k)];
        if (n == 4) {
            area = exact_cross(twice + total, line).rounded() / 64;
        } else {
            area = exact_cross(twice + side[k].sum + doubled(total), line).rounded() / 144;
        }
    }
}

// Does the same for a polygon of any number n of corners; `point_of(k)` is corner k.
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
        ExactVector const at_a = points.velocity(a), at_b = points.velocity(b);
        MovingSide const side{points.line(a, b), at_a, at_b, at_a + at_b};
        side.write(areas, first + k);
        if (areas.duals.empty()) continue;
        // 2 n times the line from the middle of the side to the mean of the corners, and 2 n times
        // the sum of the velocities of its ends
        ExactVector const line =
            twice_place - corners * (points.line(zero, a) + points.line(zero, b));
        areas.duals[first + k] =
            (exact_cross(corners * side.sum + twice_velocity, line) / divisor).rounded();
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

}  // namespace

Offset SweptAreas::count_entries(Mesh const& mesh) noexcept {
    EntryPlace const last = place_of_cell(mesh, mesh.n_cells - 1);
    return last.first + last.width;
}

void SweptAreas::compute(Mesh const& mesh, Points from, Points to,
                         Executor const& executor) const noexcept {
    SweptAreas const areas = *this;
    LinearMotion const points{from, to};
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
        mesh.for_each_cell(begin, end, [&](Index i, Cell const& cell) {
            EntryPlace const place = place_of_cell(mesh, i);
            if (cell.n == 4) {
                sweep<4>(areas, points, cell.point, [&](Index k) { return place.first + k; });
                return;
            }
            Index const repeated = place.width - 3;
            if (repeated > 0) clear_entry(areas, place.first + 2);
            sweep<3>(areas, points, cell.point,
                     [&](Index k) { return place.first + k + (k == 2 ? repeated : 0); });
        });
    });
}

}  // namespace harmorph
