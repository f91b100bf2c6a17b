#include "boundary/distance.hpp"

#include "base/sort.hpp"
#include "base/vec2.hpp"

namespace harmorph {

// The kernels of FaceDistance for one instruction set.
struct DistanceKernels {
    // Returns the squared distance, in units, of a point in units. The search begins at `group`,
    // where a good guess saves time; `group` then becomes the group of the nearest face.
    Real (*nearest_square)(FaceDistance const& tree, Vec2 from, Index& group) noexcept;
    // Computes k [lanes] of the points (x, y), which are searched together; this is fast if they
    // are neighbours. The search begins at `group`, which then becomes a good guess for the next
    // points.
    void (*weigh_eight)(FaceDistance const& tree, Index exponent_quarters, const Real* x,
                        const Real* y, Real* k, Index& group) noexcept;
    // Finds the nearest face of each of eight points in units, which are searched together; of
    // faces at equal distances, the one with the smallest number. The searches begin at the groups.
    void (*nearest_faces)(FaceDistance const& tree, const Real* x, const Real* y,
                          const Index* groups, Index* faces) noexcept;
};

}  // namespace harmorph

#define HARMORPH_KERNELS "boundary/distance_kernel.hpp"
#include "simd/for_each_set.hpp"

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
    DistanceKernels const& kernels = simd::table_of<DistanceKernels>(faces.kernel);
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
    return sqrt(simd::table_of<DistanceKernels>(kernel).nearest_square(*this, inverse_unit * from,
                                                                       group)) /
           inverse_unit;
}

FaceDistance::Foot FaceDistance::foot(Vec2 from, Index& group) const noexcept {
    if (count == 0) return {};
    Vec2 const here = in_units(from);
    simd::table_of<DistanceKernels>(kernel).nearest_square(*this, here, group);
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
    static_assert(block == SortedPoints::max_points);
    DistanceKernels const& kernels = simd::table_of<DistanceKernels>(kernel);
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

// Lays out and builds the tree of FaceDistance.

namespace {

Index in_eights(Size n) noexcept {
    return static_cast<Index>((n + FaceDistance::lanes - 1) / FaceDistance::lanes);
}

// Returns 0 if the inverse would not be finite, so that no floating-point exception is raised.
Real inverse_of(Real square) noexcept { return square >= 0x1p-1000 ? 1 / square : 0; }

Real distance_from_segment(Vec2 from, Vec2 to, Vec2 point) noexcept {
    Vec2 const along = to - from;
    Real const t = inverse_of(square(along)) * dot(point - from, along);
    return length(point - from - clamp(t, 0.0, 1.0) * along);
}

}  // namespace

void FaceDistance::Segments::set(Index lane, Vec2 from, Vec2 to) noexcept {
    Vec2 const along = to - from;
    x[lane] = from.x;
    y[lane] = from.y;
    along_x[lane] = along.x;
    along_y[lane] = along.y;
    inverse[lane] = inverse_of(square(along));
}

void FaceDistance::Chords::clear(Index lane) noexcept {
    axis.set(lane, {far_away, far_away}, {far_away, far_away});
    radius[lane] = 0;
}

void FaceDistance::Chords::copy(Index lane, Chords const& other, Index other_lane) noexcept {
    axis.x[lane] = other.axis.x[other_lane];
    axis.y[lane] = other.axis.y[other_lane];
    axis.along_x[lane] = other.axis.along_x[other_lane];
    axis.along_y[lane] = other.axis.along_y[other_lane];
    axis.inverse[lane] = other.axis.inverse[other_lane];
    radius[lane] = other.radius[other_lane];
}

void FaceDistance::Boxes::clear(Index lane) noexcept {
    low_x[lane] = low_y[lane] = far_away;
    high_x[lane] = high_y[lane] = -far_away;
}

void FaceDistance::Boxes::copy(Index lane, Boxes const& other, Index other_lane) noexcept {
    low_x[lane] = other.low_x[other_lane];
    low_y[lane] = other.low_y[other_lane];
    high_x[lane] = other.high_x[other_lane];
    high_y[lane] = other.high_y[other_lane];
}

void FaceDistance::lay_out(Arena& arena, Size max_faces) noexcept {
    Index const n_groups = in_eights(max_faces), n_chords = in_eights(static_cast<Size>(n_groups));
    Index n_boxes = 0;
    for (Index n = n_chords; n > 1; n_boxes += n) n = in_eights(static_cast<Size>(n));
    arena.take(faces, max_faces);
    arena.take(groups, n_groups);
    arena.take(chords, n_chords);
    arena.take(boxes, n_boxes);
}

void FaceDistance::build(Points points) noexcept {
    find_unit(points);
    find_images(points);
    root_height = 0;
    if (count == 0) return;
    auto const at = [&](Index point) { return inverse_unit * points[point]; };
    Index const n_groups = in_eights(static_cast<Size>(count));
    for (Index lane = 0; lane < lanes * n_groups; ++lane) {
        Face const& face = faces[min(lane, count - 1)];  // repeats the last face in the last lanes
        groups[lane / lanes].set(lane % lanes, at(face.point[0]), at(face.point[1]));
    }
    Index n_nodes = in_eights(static_cast<Size>(n_groups)), n_boxes = 0;
    for (Index lane = 0; lane < lanes * n_nodes; ++lane)
        set_chord(chords[lane / lanes], lane % lanes, points, lane);
    Offset faces_below = lanes * lanes;  // the number of faces below one lane of a node
    for (root_height = 1; n_nodes > 1; faces_below *= lanes) {
        height_start[++root_height] = n_boxes;
        n_nodes = in_eights(static_cast<Size>(n_nodes));
        for (Index lane = 0; lane < lanes * n_nodes; ++lane) {
            set_box(boxes[n_boxes + lane / lanes], lane % lanes, points, lane * faces_below,
                    (lane + 1) * faces_below);
        }
        n_boxes += n_nodes;
    }
}

void FaceDistance::find_images(Points points) noexcept {
    Vec2 shift[Translations::max_shifts];
    n_images = translations.shifts(points, shift);
    for (Index k = 0; k < n_images; ++k) image[k] = {{1, 0}, inverse_unit * shift[k]};
    if (!rotation.any) return;
    constexpr Index passages = 2;  // blades may overlap two passages on either side
    for (Index times = -passages; times <= passages; ++times) {
        if (times != 0)
            image[n_images++] = {rotation.power(times),
                                 inverse_unit * rotation.image({0, 0}, times)};
    }
}

void FaceDistance::find_unit(Points points) noexcept {
    extent = unit = 0;
    inverse_unit = 1;
    range = infinity;
    middle = half_size = {};
    if (count == 0) return;
    Box all;
    for (Face const& face : faces.first(count)) {
        for (Index const point : face.point) all.include(points[point]);
    }
    extent = all.extent();
    unit = power_of_two_at(extent);  // is 0 for a denormal extent
    if (unit > 0) {
        inverse_unit = 1 / unit;
        if (unit < 1e300 / farthest) range = farthest * unit;
    }
    constexpr Real margin = 1.0 / 32;
    middle = 0.5 * (inverse_unit * all.low + inverse_unit * all.high);
    half_size = 0.5 * (inverse_unit * all.size()) + Vec2{margin, margin};
}

// The chord runs from the beginning of the group's first face to the end of its last face.
void FaceDistance::set_chord(Chords& node, Index lane, Points points, Index group) const noexcept {
    node.clear(lane);
    Index const first = lanes * group, n = min(lanes, count - first);
    if (n <= 0) return;
    Vec2 const from = inverse_unit * points[faces[first].point[0]];
    Vec2 const to = inverse_unit * points[faces[first + n - 1].point[1]];
    // The distance from a chord is convex, so an end of each face is farthest.
    Real radius = 0;
    for (Face const& face : faces.from(first, n)) {
        for (Index const point : face.point) {
            radius = max(radius, distance_from_segment(from, to, inverse_unit * points[point]));
        }
    }
    node.axis.set(lane, from, to);
    node.radius[lane] = radius + slack * (radius + length(to - from));
}

void FaceDistance::set_box(Boxes& node, Index lane, Points points, Offset first,
                           Offset last) const noexcept {
    node.clear(lane);
    if (first >= count) return;
    Box box;
    for (Face const& face : faces.from(first, min(last, Offset{count}) - first)) {
        for (Index const point : face.point) box.include(inverse_unit * points[point]);
    }
    Real const margin = slack * (box.size().x + box.size().y);
    node.low_x[lane] = box.low.x - margin;
    node.low_y[lane] = box.low.y - margin;
    node.high_x[lane] = box.high.x + margin;
    node.high_y[lane] = box.high.y + margin;
}

}  // namespace harmorph
