#include "harmorph/boundary/distance.hpp"

#include "harmorph/base/sort.hpp"
#include "distance_table.hpp"

namespace harmorph {
namespace {

constexpr Index lanes = FaceDistance::lanes;

// Places in an order in which neighbours follow each other, whatever their numbers: by the squares of a grid that is
// finest at the faces and reaches to infinity, in Morton's order.
struct SortedPlaces {
    static constexpr Index most = 512, levels = 5, side = 1 << levels, squares = side * side;

    Index n;  // whole eights: the last place comes several times
    Real x[most], y[most];
    std::uint16_t number[most];

    void sort(FaceDistance const& faces, const Vec2* place, Index its_n) noexcept {
        Index square[most];
        std::uint16_t start[squares] = {};
        for (Index i = 0; i < its_n; ++i) {  // nothing else, so that compilers make vectors of it
            square[i] = spread(place[i].x - faces.middle.x, faces.half_size.x) |
                        spread(place[i].y - faces.middle.y, faces.half_size.y) << 1;
        }
        for (Index i = 0; i < its_n; ++i) ++start[square[i]];
        counts_to_starts(Span<std::uint16_t>(start, squares));
        for (Index i = 0; i < its_n; ++i) set(start[square[i]]++, place[i], i);
        for (n = its_n; n % lanes != 0; ++n) set(n, {x[its_n - 1], y[its_n - 1]}, number[its_n - 1]);
    }

private:
    void set(Index at, Vec2 place, Index its_number) noexcept {
        x[at] = place.x;
        y[at] = place.y;
        number[at] = static_cast<std::uint16_t>(its_number);
    }
    // One coordinate's bits of a square's number, a place apart. Half of the grid is within half_size.
    static Index spread(Real from_middle, Real half_size) noexcept {
        Real const part = from_middle / (absolute(from_middle) + half_size);  // -1 .. 1
        Index bits = static_cast<Index>((0.5 * side - 0.01) * (1 + (part > -1 ? part : -1)));
        bits = (bits | bits << 4) & 0x10f;
        bits = (bits | bits << 2) & 0x133;
        return (bits | bits << 1) & 0x155;
    }
};

// k [n] at the places of its numbers, in units. for_each_place(begin, end, take(number, place)).
template <class ForEachPlace>
void weigh(FaceDistance const& faces, Index quarters, Span<Real> k, Executor const& executor,
           ForEachPlace for_each_place) noexcept {
    if (faces.unit == 0 || quarters == 0) return fill(k, Real{1});
    DistanceKernels const& kernels = distance_kernels(faces.kernel);
    constexpr Index least_blocks = 8;
    constexpr Index block = SortedPlaces::most;
    executor.for_ranges((k.count() + block - 1) / block, least_blocks, [&](Index begin, Index end) {
        Index group = 0;
        for (Index number = begin; number < end; ++number) {
            Index const first = number * block, n = smaller(block, k.count() - first);
            Vec2 place[block];
            for_each_place(first, first + n, [&](Index i, Vec2 its) { place[i - first] = its; });
            SortedPlaces sorted;
            sorted.sort(faces, place, n);
            for (Index i = 0; i < sorted.n; i += lanes) {
                Real its[lanes];
                kernels.weigh_eight(faces, quarters, sorted.x + i, sorted.y + i, its, group);
                for (Index lane = 0; lane < lanes; ++lane) k[first + sorted.number[i + lane]] = its[lane];
            }
        }
    });
}

}  // namespace

Real FaceDistance::distance(Vec2 from) const noexcept {
    if (count == 0) return infinity;
    Index group = 0;
    return square_root(distance_kernels(kernel).nearest_square(*this, inverse_unit * from, group)) / inverse_unit;
}

FaceDistance::Foot FaceDistance::foot(Vec2 from, Index& group) const noexcept {
    if (count == 0) return {};
    Vec2 const here = inverse_unit * from;
    distance_kernels(kernel).nearest_square(*this, here, group);
    Segments const& its = groups[group];
    Foot best;
    Real least = infinity;
    for (Index lane = 0; lane < lanes && lanes * group + lane < count; ++lane) {
        Vec2 const start{its.x[lane], its.y[lane]}, along{its.along_x[lane], its.along_y[lane]};
        Real const t = clamp(dot(here - start, along) * its.inverse[lane], 0.0, 1.0);
        Real const distance = square(here - start - t * along);
        if (!(distance < least)) continue;
        least = distance;
        best = {lanes * group + lane, t};
    }
    return best;
}

Vec2 FaceDistance::at(Foot const& foot, Points points) const noexcept {
    Face const& face = faces[foot.face];
    return (1 - foot.t) * points[face.point[0]] + foot.t * points[face.point[1]];
}

void weigh_cells(FaceDistance const& faces, Mesh const& mesh, Points points, Index quarters, Span<Real> k,
                 Executor const& executor) noexcept {
    weigh(faces, quarters, k, executor, [&](Index begin, Index end, auto take) {
        mesh.for_each_cell(begin, end, [&](Index number, Cell const& cell) {
            Vec2 sum = points[cell.point[0]] + points[cell.point[1]] + points[cell.point[2]];
            if (cell.n == 4) sum = sum + points[cell.point[3]];
            take(number, (cell.n == 4 ? 0.25 * faces.inverse_unit : faces.inverse_unit / 3) * sum);
        });
    });
}

void weigh_edges(FaceDistance const& faces, Span<const DelaunayEdge> edges, Points points, Index quarters, Span<Real> k,
                 Executor const& executor) noexcept {
    weigh(faces, quarters, k, executor, [&](Index begin, Index end, auto take) {
        for (Index i = begin; i < end; ++i) {
            take(i, 0.5 * faces.inverse_unit * (points[edges[i].begin] + points[edges[i].end]));
        }
    });
}

}  // namespace harmorph
