#include "boundary/distance.hpp"

#include "base/sort.hpp"
#include "boundary/distance_table.hpp"

namespace harmorph {
namespace {

constexpr Index in_group = FaceDistance::lanes;

// Sorts points so that neighbours follow each other, independently of their numbers: by the
// squares, in Morton order, of a grid that is finest at the faces and reaches to infinity.
struct SortedPoints {
    static constexpr Index max_points = 512, levels = 5, side = 1 << levels, squares = side * side;

    Index n;  // a multiple of eight; the last point is repeated
    Real x[max_points], y[max_points];
    std::uint16_t number[max_points];

    void sort(FaceDistance const& faces, const Vec2* point, Index n_points) noexcept {
        Index square[max_points];
        std::uint16_t start[squares] = {};
        // Compilers vectorise this loop, because it does nothing else.
        for (Index i = 0; i < n_points; ++i) {
            square[i] = spread(point[i].x - faces.middle.x, faces.half_size.x) |
                        spread(point[i].y - faces.middle.y, faces.half_size.y) << 1;
        }
        for (Index i = 0; i < n_points; ++i) ++start[square[i]];
        counts_to_starts(Span<std::uint16_t>(start, squares));
        for (Index i = 0; i < n_points; ++i) set(start[square[i]]++, point[i], i);
        repeat_last(n_points);
    }
    // Leaves the points in their order.
    void take(const Vec2* point, Index n_points) noexcept {
        for (Index i = 0; i < n_points; ++i) set(i, point[i], i);
        repeat_last(n_points);
    }

private:
    void repeat_last(Index n_points) noexcept {
        for (n = n_points; n % in_group != 0; ++n)
            set(n, {x[n_points - 1], y[n_points - 1]}, number[n_points - 1]);
    }
    void set(Index at, Vec2 point, Index new_number) noexcept {
        x[at] = point.x;
        y[at] = point.y;
        number[at] = static_cast<std::uint16_t>(new_number);
    }
    // Returns the bits of one coordinate, spread to every second bit of the number of a square.
    // Half of the grid lines are within half_size.
    static Index spread(Real from_middle, Real half_size) noexcept {
        Real const scaled = from_middle / (abs(from_middle) + half_size);  // from -1 to 1
        Index bits = static_cast<Index>((0.5 * side - 0.01) * (1 + (scaled > -1 ? scaled : -1)));
        bits = (bits | bits << 4) & 0x10f;
        bits = (bits | bits << 2) & 0x133;
        return (bits | bits << 1) & 0x155;
    }
};

// Computes k [n] at points. for_each_point(begin, end, take) must call take(number, point) for
// these points, in units.
template <class ForEachPoint>
void weigh(FaceDistance const& faces, Index exponent_quarters, Span<Real> k,
           Executor const& executor, ForEachPoint for_each_point) noexcept {
    if (faces.unit == 0 || exponent_quarters == 0) return fill(k, Real{1});
    DistanceKernels const& kernels = distance_kernels(faces.kernel);
    constexpr Index min_blocks = 8;
    constexpr Index block = SortedPoints::max_points;
    executor.for_ranges((k.count() + block - 1) / block, min_blocks, [&](Index begin, Index end) {
        Index group = 0;
        for (Index number = begin; number < end; ++number) {
            Index const first = number * block, n = min(block, k.count() - first);
            Vec2 point[block];
            for_each_point(first, first + n, [&](Index i, Vec2 at) { point[i - first] = at; });
            SortedPoints sorted;
            sorted.sort(faces, point, n);
            for (Index i = 0; i < sorted.n; i += in_group) {
                Real weight[in_group];
                kernels.weigh_eight(faces, exponent_quarters, sorted.x + i, sorted.y + i, weight,
                                    group);
                for (Index lane = 0; lane < in_group; ++lane)
                    k[first + sorted.number[i + lane]] = weight[lane];
            }
        }
    });
}

}  // namespace

Real FaceDistance::distance(Vec2 from) const noexcept {
    if (count == 0) return infinity;
    if (largest_of(from) > range) return length(from - unit * middle);
    Index group = 0;
    return sqrt(distance_kernels(kernel).nearest_square(*this, inverse_unit * from, group)) /
           inverse_unit;
}

FaceDistance::Foot FaceDistance::foot(Vec2 from, Index& group) const noexcept {
    if (count == 0) return {};
    Vec2 const here = in_units(from);
    distance_kernels(kernel).nearest_square(*this, here, group);
    Segments const& segments = groups[group];
    Foot best;
    Real smallest = infinity;
    for (Index lane = 0; lane < in_group && in_group * group + lane < count; ++lane) {
        Vec2 const start{segments.x[lane], segments.y[lane]},
            along{segments.along_x[lane], segments.along_y[lane]};
        Real const t = clamp(dot(here - start, along) * segments.inverse[lane], 0.0, 1.0);
        Real const distance = square(here - start - t * along);
        if (!(distance < smallest)) continue;
        smallest = distance;
        best = {in_group * group + lane, t};
    }
    return best;
}

void FaceDistance::find_nearest(const Vec2* point, Index n, Index* hint) const noexcept {
    static_assert(block == SortedPoints::max_points, "");
    DistanceKernels const& kernels = distance_kernels(kernel);
    SortedPoints sorted;
    // Points with hints begin next to their faces, so their order matters less.
    if (hint[0] == none) {
        sorted.sort(*this, point, n);
    } else {
        sorted.take(point, n);
    }
    Index group = 0;  // without a hint, the group of the last point
    for (Index i = 0; i < sorted.n; i += in_group) {
        Index first[in_group], nearest[in_group];
        for (Index lane = 0; lane < in_group; ++lane) {
            Index const face = hint[sorted.number[i + lane]];
            if (face != none) group = face / in_group;
            first[lane] = group;
        }
        kernels.nearest_faces(*this, sorted.x + i, sorted.y + i, first, nearest);
        // The numbers after the last point repeat its number.
        for (Index lane = 0; lane < in_group; ++lane) hint[sorted.number[i + lane]] = nearest[lane];
        group = nearest[in_group - 1] / in_group;
    }
}

Vec2 FaceDistance::at(Foot const& foot, Points points) const noexcept {
    Face const& face = faces[foot.face];
    return (1 - foot.t) * points[face.point[0]] + foot.t * points[face.point[1]];
}

void weigh_cells(FaceDistance const& faces, Mesh const& mesh, Points points,
                 Index exponent_quarters, Span<Real> k, Executor const& executor) noexcept {
    weigh(faces, exponent_quarters, k, executor, [&](Index begin, Index end, auto take) {
        mesh.for_each_cell(begin, end, [&](Index number, Cell const& cell) {
            Vec2 sum = points[cell.point[0]] + points[cell.point[1]] + points[cell.point[2]];
            if (cell.n == 4) sum = sum + points[cell.point[3]];
            take(number, faces.in_units((cell.n == 4 ? 0.25 : 1.0 / 3) * sum));
        });
    });
}

void weigh_edges(FaceDistance const& faces, Span<const DelaunayEdge> edges, Points points,
                 Index exponent_quarters, Span<Real> k, Executor const& executor) noexcept {
    weigh(faces, exponent_quarters, k, executor, [&](Index begin, Index end, auto take) {
        for (Index i = begin; i < end; ++i) {
            take(i, faces.in_units(0.5 * (points[edges[i].begin] + points[edges[i].end])));
        }
    });
}

}  // namespace harmorph
