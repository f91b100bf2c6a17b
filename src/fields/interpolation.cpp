#include "fields/interpolation.hpp"

#include "base/executor.hpp"
#include "base/vec2.hpp"

namespace harmorph {
namespace {

// Puts the bits of a number at the even places of the result.
std::uint64_t spread_bits(std::uint32_t number) noexcept {
    std::uint64_t bits = number;
    bits = (bits | bits << 16) & 0x0000FFFF0000FFFF;
    bits = (bits | bits << 8) & 0x00FF00FF00FF00FF;
    bits = (bits | bits << 4) & 0x0F0F0F0F0F0F0F0F;
    bits = (bits | bits << 2) & 0x3333333333333333;
    return (bits | bits << 1) & 0x5555555555555555;
}

}  // namespace

void SortedOrder::sort(Points points) noexcept {
    Index const n = entry.count();
    Box box;
    for (Index k = 0; k < n; ++k) box.include(points[k]);
    Real const extent = box.extent();
    Real const scale = extent > smallest_height ? 0x1.fffffp+31 / extent : 0;
    for (Index k = 0; k < n; ++k) {
        Vec2 const p = scale * (points[k] - box.low);
        entry[k] = {spread_bits(static_cast<std::uint32_t>(p.x)) |
                        spread_bits(static_cast<std::uint32_t>(p.y)) << 1,
                    k};
    }
    // Sorts by one digit after the other, the lowest digit first.
    constexpr Index digits = 8, digit_bits = 8, values = 1 << digit_bits;
    for (Index digit = 0; digit < digits; ++digit) {
        Index start[values + 1] = {};
        auto const value = [&](Entry const& e) {
            return static_cast<Index>(e.key >> digit_bits * digit & (values - 1));
        };
        for (Entry const& e : entry) ++start[value(e) + 1];
        for (Index v = 0; v < values; ++v) start[v + 1] += start[v];
        for (Entry const& e : entry) spare[start[value(e)]++] = e;
        Span<Entry> const sorted = spare;
        spare = entry;
        entry = sorted;
    }
}

namespace {

// Chunks of the sorted points are searched independently of each other, so that the cells found do
// not depend on the number of threads.
constexpr Index points_of_chunk = 4096;
constexpr Index min_points_of_product = 16384;

// Returns the edge between two points, or none. Points that a cut joins have the edges of their
// representatives. The points of periodic pairs are joined, too, but have edges of their own, which
// come first: the edge of the representatives is then a side at the other end of the period.
Index edge_between(Topology const& topology, Index a, Index b) noexcept {
    Index const edge = topology.edges.find(a, b);
    if (edge != none) return edge;
    return topology.edges.find(topology.representative[a], topology.representative[b]);
}

// Finds the cell of a point by walking on a straight line from a place in a known cell.
class StraightWalk {
public:
    StraightWalk(Topology const& topology, Boundary const& boundary, Points at,
                 Span<const Index> neighbour, FaceDistance const& faces) noexcept
        : topology_(topology), boundary_(boundary), at_(at), neighbour_(neighbour), faces_(faces) {}

    struct Found {
        Index cell = none;
        FaceDistance::Foot foot;  // of a point that is on the boundary or outside
        Real distance = 0;        // from the mesh, for a point outside
    };

    Found find(Vec2 to) noexcept {
        Found found;
        if (cell_ != none) found.cell = walk(cell_, from_, to);
        if (found.cell == none) found = find_from_boundary(to);
        if (found.cell != none) {
            cell_ = found.cell;
            from_ = to;
        }
        return found;
    }
    CellShape shape(Index cell) const noexcept { return {topology_.cell(cell), at_, false}; }

private:
    // Returns the cell of `to`, or none if the line leaves the mesh. The line leaves a cell through
    // the side where its parameter is smallest; at a corner, through a side with a neighbour.
    Index walk(Index cell, Vec2 from, Vec2 to) const noexcept {
        Vec2 const along = to - from;
        Index steps = topology_.mesh.n_cells;
        for (Index last = none; steps > 0; --steps) {
            CellShape const corners = shape(cell);
            Real smallest = 1;
            Index next = none;
            bool leaves = false;
            for (Index k = 0; k < corners.n; ++k) {
                Index const beyond = neighbour_[4 * Offset{cell} + k];
                Vec2 const side = corners.at[k + 1 == corners.n ? 0 : k + 1] - corners.at[k];
                if (!(cross(side, to - corners.at[k]) < 0)) continue;
                if (beyond != none && beyond == last) continue;
                Real const outwards = -cross(side, along);
                if (!(outwards > 0)) continue;
                Real const parameter = cross(side, from - corners.at[k]) / outwards;
                bool const better = parameter < smallest || (parameter == smallest && next == none);
                if (leaves && !better) continue;
                leaves = true;
                smallest = min(parameter, smallest);
                next = beyond;
            }
            if (!leaves) return cell;
            if (next == none) return none;
            last = cell;
            cell = next;
        }
        return none;
    }

    // No boundary crosses the line from the nearest place of the boundary to the point: the line
    // is inside the mesh, or outside.
    Found find_from_boundary(Vec2 to) noexcept {
        Found found;
        found.foot = faces_.foot(to, group_);
        FaceDistance::Face const& face = faces_.faces[found.foot.face];
        Vec2 const begin = at_[face.point[0]], end = at_[face.point[1]], along = end - begin;
        Vec2 place = begin + found.foot.t * along;
        if (found.foot.t <= 0) place = begin;
        if (found.foot.t >= 1) place = end;
        Real const distance = length(to - place);
        if (distance <= Interpolation::on_boundary * length(along)) return found;
        Index const start = face_before(to - place, found.foot);
        if (start != none) {
            FaceDistance::Face const& first = faces_.faces[start];
            Index const edge = edge_between(topology_, first.point[0], first.point[1]);
            if (edge != none)
                found.cell = walk(cell_of_side(topology_.edges.first[edge].code), place, to);
        }
        if (found.cell == none) found.distance = distance;
        return found;
    }

    // Returns the face at a foot from whose cell a line in the direction `off` begins, or none if
    // the direction leads out of the mesh. A corner has two faces, and a direction into the mesh
    // makes an angle of at most 180 degrees with one of them: the walk goes about the corner from
    // there.
    Index face_before(Vec2 off, FaceDistance::Foot const& foot) const noexcept {
        auto const inwards = [&](Index face) {
            FaceDistance::Face const& ends = faces_.faces[face];
            return dot(off, left_of(direction(at_[ends.point[1]] - at_[ends.point[0]])));
        };
        Real const own = inwards(foot.face);
        if (foot.t > 0 && foot.t < 1) return own > 0 ? foot.face : none;
        // The faces of the tree are those of the boundary, in the same order.
        Index low = 0, high = boundary_.n_loops;
        while (high - low > 1) {
            Index const middle = low + (high - low) / 2;
            (boundary_.loop_start[middle] <= foot.face ? low : high) = middle;
        }
        Index const first = boundary_.loop_start[low], after = boundary_.loop_start[low + 1];
        Index const next = foot.face + 1 == after ? first : foot.face + 1,
                    previous = foot.face == first ? after - 1 : foot.face - 1,
                    other_face = foot.t > 0 ? next : previous;
        Real const other = inwards(other_face);
        if (!(own + other > 0)) return none;
        return other > own ? other_face : foot.face;
    }

    Topology const& topology_;
    Boundary const& boundary_;
    Points at_;
    Span<const Index> neighbour_;
    FaceDistance const& faces_;
    Index cell_ = none, group_ = 0;
    Vec2 from_;
};

// Computes the weights of a cell and corrects them once, so that they reproduce the place of the
// point to rounding in thin cells, too.
void weigh_precisely(CellShape const& shape, Vec2 to, Real* weight) noexcept {
    weigh_corners(shape, to, weight);
    Vec2 const origin = shape.at[0];
    Vec2 rest = to - origin;
    for (Index k = 1; k < shape.n; ++k) rest = rest - weight[k] * (shape.at[k] - origin);
    Vec2 const a = shape.at[1] - origin, b = shape.at[2] - origin;
    Real const twice_area = cross(a, b);
    if (!(abs(twice_area) > 0)) return;  // one side is too short beside the others
    Real const at_1 = cross(rest, b) / twice_area, at_2 = cross(a, rest) / twice_area;
    weight[1] += at_1;
    weight[2] += at_2;
    weight[0] -= at_1 + at_2;
}

// In a cell so thin that rounding decides where the point is, weights can be anything. The point
// then counts as a place in the cell: a value is never far beyond those of the corners.
void keep_in_cell(Index n, Real* weight) noexcept {
    constexpr Real outside = -1e-6;
    bool is_inside = true;
    for (Index k = 0; k < n; ++k) is_inside = is_inside && weight[k] >= outside;
    if (is_inside) return;
    Real sum = 0;
    for (Index k = 0; k < n; ++k) sum += weight[k] = weight[k] > 0 ? min(weight[k], 1.0) : 0;
    for (Index k = 0; k < n; ++k) weight[k] = sum > 0 ? weight[k] / sum : 1.0 / n;
}

}  // namespace

void Interpolation::lay_out(Arena& arena, Analysis const& from, Index n) noexcept {
    arena.take(point, corners * Offset{n});
    arena.take(weight, corners * Offset{n});
    arena.take(neighbour_, corners * Offset{from.problem().mesh.n_cells});
    boundary_.lay_out(arena, static_cast<Size>(from.boundary().count));
    order_.lay_out(arena, n);
}

Interpolation::Report Interpolation::find(Analysis const& from, Points at, Points to,
                                          Span<Real> distance, Executor const& executor) noexcept {
    Topology const& topology = from.topology();
    Mesh const& mesh = topology.mesh;
    n_mesh_points = mesh.n_points;
    index_base = mesh.index_base;
    executor.for_ranges(mesh.n_cells, points_of_chunk, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            Cell const cell = topology.cell(i);
            for (Index k = 0; k < cell.n; ++k) {
                Index const edge = edge_between(topology, cell.point[k], cell.next(k));
                Index beyond = none;
                if (edge != none) {
                    Index const code = topology.edges.first[edge].code,
                                other = topology.edges.second[edge];
                    if (cell_of_side(code) != i) beyond = cell_of_side(code);
                    else if (other >= 0) beyond = cell_of_side(other);
                }
                neighbour_[corners * Offset{i} + k] = beyond;
            }
        }
    });
    boundary_.kernel = resolved(Kernel::automatic, executor.kernel);
    boundary_.choose(from.boundary(), [](Index) { return true; });
    boundary_.build(at);
    order_.sort(to);
    fill(point, Index{0});
    fill(weight, 0.0);

    struct Tally : Report {
        void merge(Tally const& other) noexcept {
            outside += other.outside;
            bool const is_first =
                other.max_distance == max_distance && other.max_distance_point < max_distance_point;
            if (other.max_distance_point == none ||
                !(other.max_distance > max_distance || is_first))
                return;
            max_distance = other.max_distance;
            max_distance_point = other.max_distance_point;
        }
    };
    Index const chunks = (count() + points_of_chunk - 1) / points_of_chunk;
    auto const search = [&](Index begin, Index end, Tally& tally) {
        for (Index chunk = begin; chunk < end; ++chunk) {
            StraightWalk walk(topology, from.boundary(), at, neighbour_, boundary_);
            Index const last = min(count(), (chunk + 1) * points_of_chunk);
            for (Index sorted = chunk * points_of_chunk; sorted < last; ++sorted) {
                Index const k = order_[sorted];
                Vec2 const here = to[k];
                StraightWalk::Found const found = walk.find(here);
                Index* const own_point = point.data() + corners * Offset{k};
                Real* const own_weight = weight.data() + corners * Offset{k};
                if (!distance.empty()) distance[k] = found.distance;
                if (found.cell != none) {
                    Cell const cell = topology.cell(found.cell);
                    for (Index c = 0; c < cell.n; ++c) own_point[c] = cell.point[c];
                    weigh_precisely(walk.shape(found.cell), here, own_weight);
                    keep_in_cell(cell.n, own_weight);
                    continue;
                }
                FaceDistance::Face const& face = boundary_.faces[found.foot.face];
                for (Index end_of_face = 0; end_of_face < 2; ++end_of_face)
                    own_point[end_of_face] = face.point[end_of_face];
                own_weight[0] = 1 - found.foot.t;
                own_weight[1] = found.foot.t;
                if (!(found.distance > 0)) continue;
                Tally one;
                one.outside = 1;
                one.max_distance = found.distance;
                one.max_distance_point = k;
                tally.merge(one);
            }
        }
    };
    return reduce_ranges<Tally>(chunks, executor, search);
}

void Interpolation::apply(const Real* from, Real* to, Executor const& executor) const noexcept {
    executor.for_ranges(count(), min_points_of_product, [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
            Real sum = 0;
            for (Offset e = corners * Offset{k}; e < corners * (Offset{k} + 1); ++e)
                sum += weight[e] * from[point[e]];
            to[k] = sum;
        }
    });
}

void Interpolation::add_transpose(const Real* to, Real* from) const noexcept {
    for (Index k = 0; k < count(); ++k) {
        for (Offset e = corners * Offset{k}; e < corners * (Offset{k} + 1); ++e)
            from[point[e]] += weight[e] * to[k];
    }
}

}  // namespace harmorph
