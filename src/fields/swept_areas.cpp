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
        Index const zero = point_of(0);
        CellSweep const sweep{from, to, from[zero], to[zero]};
        bool const duals = !areas.duals.empty();
        ExactVector sum_place, sum_velocity;
        for (Index k = 0; duals && k < n; ++k) {
            Corner const corner = sweep.corner(point_of(k), true);
            sum_place = sum_place + corner.place;
            sum_velocity = sum_velocity + corner.velocity;
        }
        ExactVector const twice_place = 2 * sum_place, twice_velocity = 2 * sum_velocity;
        Real const corners = static_cast<Real>(n), divisor = 16 * corners * corners;
        Corner a = sweep.corner(zero, duals);
        for (Index k = 0; k < width; ++k) {
            Corner const b = sweep.corner(point_of(k + 1 == width ? 0 : k + 1), duals);
            // The two cells of a side subtract the same numbers, so that the areas are opposite.
            ExactVector const side =
                exact_difference(b.from, a.from) + exact_difference(b.to, a.to);
            ExactVector const velocity = a.velocity + b.velocity;
            if (!areas.sides.empty())
                areas.sides[first + k] = 0.25 * exact_cross(velocity, side).rounded();
            if (!areas.halves.empty()) {
                Real* const both = areas.halves.data() + 2 * (first + k);
                both[0] = 0.0625 * exact_cross(2 * a.velocity + velocity, side).rounded();
                both[1] = 0.0625 * exact_cross(2 * b.velocity + velocity, side).rounded();
            }
            if (duals) {
                // 2 n times the line from the middle of the side to the mean of the corners, and
                // 2 n times the sum of the velocities of its ends.
                ExactVector const line = twice_place - corners * (a.place + b.place);
                bool const repeats = width > n && k + 1 == n;  // between two equal points
                areas.duals[first + k] =
                    repeats ? 0
                            : (exact_cross(corners * velocity + twice_velocity, line) / divisor)
                                  .rounded();
            }
            a = b;
        }
    }

private:
    struct Corner {
        Vec2 from, to;
        ExactVector velocity;
        ExactVector place;  // the sum of both places, each relative to the first corner
    };
    Corner corner(Index point, bool needs_place) const noexcept {
        Corner out;
        out.from = from_[point];
        out.to = to_[point];
        out.velocity = exact_difference(out.to, out.from);
        if (needs_place) {
            out.place =
                exact_difference(out.from, origin_from_) + exact_difference(out.to, origin_to_);
        }
        return out;
    }
    CellSweep(Points from, Points to, Vec2 origin_from, Vec2 origin_to) noexcept
        : from_(from), to_(to), origin_from_(origin_from), origin_to_(origin_to) {}

    Points from_, to_;
    Vec2 origin_from_, origin_to_;
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
