#include "harmorph/distance.hpp"

namespace harmorph {
namespace {

constexpr Index lanes = FaceDistance::lanes;
constexpr Real slack = FaceDistance::slack;
constexpr Real least_distance = 1e-30;

// Wider vectors would be taken apart on the plain architecture. Never references to them: see Four.
typedef Real Two __attribute__((vector_size(16), aligned(8), may_alias));

#define HARMORPH_INLINE inline __attribute__((always_inline))

HARMORPH_INLINE Two two(const Real* from) noexcept { return *reinterpret_cast<const Two*>(from); }
HARMORPH_INLINE void set_two(Real* to, Two numbers) noexcept { *reinterpret_cast<Two*>(to) = numbers; }
HARMORPH_INLINE Two larger_of(Two a, Two b) noexcept { return a > b ? a : b; }
HARMORPH_INLINE Two smaller_of(Two a, Two b) noexcept { return a < b ? a : b; }

// Squared distances.
HARMORPH_INLINE Two squares(FaceDistance::Segments const& segments, Index lane, Vec2 from) noexcept {
    Two const along_x = two(segments.along_x + lane), along_y = two(segments.along_y + lane);
    Two x = from.x - two(segments.x + lane), y = from.y - two(segments.y + lane);
    Two const nearest = (x * along_x + y * along_y) * two(segments.inverse + lane);
    Two const t = smaller_of(larger_of(nearest, Two{0, 0}), Two{1, 1});
    x -= t * along_x;
    y -= t * along_y;
    return x * x + y * y;
}

HARMORPH_INLINE Two squares(FaceDistance::Boxes const& boxes, Index lane, Vec2 from) noexcept {
    Two const x = larger_of(two(boxes.low_x + lane) - from.x, from.x - two(boxes.high_x + lane));
    Two const y = larger_of(two(boxes.low_y + lane) - from.y, from.y - two(boxes.high_y + lane));
    Two const outside_x = larger_of(x, Two{0, 0}), outside_y = larger_of(y, Two{0, 0});
    return outside_x * outside_x + outside_y * outside_y;
}

HARMORPH_INLINE Real nearest_square(FaceDistance::Segments const& segments, Vec2 from) noexcept {
    Two nearest = squares(segments, 0, from);
    for (Index lane = 2; lane < lanes; lane += 2) nearest = smaller_of(nearest, squares(segments, lane, from));
    return smaller(nearest[0], nearest[1]);
}

// Those of eight nodes that may hold a face at a distance from a point of `reach` or less: nearest bound first.
struct Candidates {
    Index n = 0;
    Index lane[lanes];
    Real square[lanes];  // to the chord or box, by lane

    HARMORPH_INLINE Candidates(FaceDistance::Boxes const& boxes, Vec2 from, Real square_reach) noexcept {
        for (Index k = 0; k < lanes; k += 2) set_two(square + k, squares(boxes, k, from));
        Real const limit = (1 + 2 * slack) * square_reach;
        for (Index k = 0; k < lanes; ++k) add_if(square[k] < limit, k);
        nearest_first();
    }
    HARMORPH_INLINE Candidates(FaceDistance::Chords const& chords, Vec2 from, Real reach) noexcept {
        Real limit[lanes];
        for (Index k = 0; k < lanes; k += 2) {
            Two const both = (1 + slack) * (reach + two(chords.radius + k));
            set_two(limit + k, both * both);
            set_two(square + k, squares(chords.axis, k, from));
        }
        for (Index k = 0; k < lanes; ++k) add_if(square[k] < limit[k], k);
        nearest_first();
    }

private:
    // Without a branch, which nobody could predict.
    HARMORPH_INLINE void add_if(bool is_one, Index k) noexcept {
        lane[n] = k;
        n += is_one ? 1 : 0;
    }
    HARMORPH_INLINE void nearest_first() noexcept {
        Index best = 0;
        for (Index k = 1; k < n; ++k) best = square[lane[k]] < square[lane[best]] ? k : best;
        if (n < 2) return;
        Index const first = lane[best];
        lane[best] = lane[0];
        lane[0] = first;
    }
};

// Up to eight nodes of one height (0: groups of faces) with their chords or boxes: all that can be nearest to a place.
struct Start {
    Index height;
    Index node[lanes];
    FaceDistance::Chords chords;  // at height 0
    FaceDistance::Boxes boxes;    // at other heights
};

class Search {
public:
    explicit Search(FaceDistance const& tree) noexcept : tree_(tree) {}

    // The group that is tried first; a good guess saves time.
    Index group = 0;

    // Squared distance in units, from a point in units.
    Real from_anywhere(Vec2 from) noexcept {
        begin(from);
        visit(tree_.root_height, 0);
        return square_;
    }
    Real from_near(Start const& start, Vec2 from) noexcept {
        begin(from);
        if (start.height == 0) {
            try_groups(start.chords, start.node);
        } else {
            visit_nodes(start.boxes, start.height, start.node);
        }
        return square_;
    }

private:
    void begin(Vec2 from) noexcept {
        from_ = from;
        square_ = nearest_square(tree_.groups[group], from);
        tried_ = group;
    }
    void visit(Index height, Index node) noexcept {
        Index child[lanes];
        for (Index k = 0; k < lanes; ++k) child[k] = lanes * node + k;
        if (height == 1) return try_groups(tree_.chords[node], child);
        visit_nodes(tree_.boxes[tree_.height_start[height] + node], height - 1, child);
    }
    void visit_nodes(FaceDistance::Boxes const& boxes, Index height, const Index* node) noexcept {
        Candidates const candidates(boxes, from_, square_);
        for (Index k = 0; k < candidates.n; ++k) {
            Index const lane = candidates.lane[k];
            if (candidates.square[lane] < (1 + 2 * slack) * square_) visit(height, node[lane]);
        }
    }
    void try_groups(FaceDistance::Chords const& chords, const Index* node) noexcept {
        Real reach = square_root(square_);
        Candidates const candidates(chords, from_, reach);
        for (Index k = 0; k < candidates.n; ++k) {
            Index const lane = candidates.lane[k];
            Real const limit = (1 + slack) * (reach + chords.radius[lane]);
            if (node[lane] == tried_ || !(candidates.square[lane] < limit * limit)) continue;
            Real const square = nearest_square(tree_.groups[node[lane]], from_);
            if (!(square < square_ || (square == square_ && node[lane] < group))) continue;  // whatever the guess was
            square_ = square;
            reach = square_root(square);
            group = node[lane];
        }
    }

    FaceDistance const& tree_;
    Vec2 from_;
    Real square_ = infinity;
    Index tried_ = none;
};

// Replaces the nodes by those of their children that come within reach of the centre. False, and nothing done, if these
// are more than eight.
bool descend(FaceDistance const& tree, Vec2 centre, Real reach, Index n, Start& start, Index& n_next) noexcept {
    Start next;
    next.height = start.height - 1;
    n_next = 0;
    for (Index k = 0; k < n; ++k) {
        Index const node = start.node[k];
        bool const of_chords = start.height == 1;
        Index const place = of_chords ? 0 : tree.height_start[start.height] + node;
        Candidates const found = of_chords ? Candidates(tree.chords[node], centre, reach)
                                           : Candidates(tree.boxes[place], centre, reach * reach);
        if (n_next + found.n > lanes) return false;
        for (Index j = 0; j < found.n; ++j) {
            Index const lane = found.lane[j];
            next.node[n_next] = lanes * node + lane;
            if (of_chords) {
                next.chords.copy(n_next++, tree.chords[node], lane);
            } else {
                next.boxes.copy(n_next++, tree.boxes[place], lane);
            }
        }
    }
    for (Index k = n_next; k < lanes; ++k) {
        next.node[k] = 0;
        next.chords.clear(k);
        next.boxes.clear(k);
    }
    start = next;
    return true;
}

// Where to start the search for the faces nearest to any point within a radius of the centre: such a face is at most two
// radii farther from the centre than the nearest to the centre itself.
Start start_near(FaceDistance const& tree, Vec2 centre, Real reach) noexcept {
    Start start;
    start.height = tree.root_height;
    for (Index k = 0; k < lanes; ++k) {
        start.node[k] = 0;
        start.boxes.clear(k);
    }
    start.boxes.low_x[0] = start.boxes.low_y[0] = -FaceDistance::far_away;
    start.boxes.high_x[0] = start.boxes.high_y[0] = FaceDistance::far_away;
    Index n = 1, n_next = 0;
    while (start.height > 0 && descend(tree, centre, reach, n, start, n_next)) n = n_next;
    return start;
}

// Cells or edges with consecutive numbers, most often neighbours: they share what the tree is asked.
struct Block {
    static constexpr Index most = 32;

    Index n;
    Vec2 place[most];  // in units
    Vec2 centre;
    Real radius;

    // place_of(number) for all numbers below `end`.
    template <class PlaceOf>
    Block(Index first, Index end, PlaceOf place_of) noexcept : n(smaller(most, end - first)) {
        Vec2 low{infinity, infinity}, high{-infinity, -infinity};
        for (Index k = 0; k < n; ++k) {
            Vec2 const p = place_of(first + k);
            low = {smaller(low.x, p.x), smaller(low.y, p.y)};
            high = {larger(high.x, p.x), larger(high.y, p.y)};
            place[k] = p;
        }
        centre = 0.5 * (low + high);
        radius = 0.5 * length(high - low);
    }
};

// Squared distances to d^(-quarters / 4), from square roots alone.
void to_weights(Span<Real> numbers, Index quarters) noexcept {
    Real power[Block::most];
    for (Index k = 0; k < numbers.count(); ++k) {
        numbers[k] = larger(square_root(numbers[k]), least_distance);
        power[k] = 1;
    }
    auto const times = [&](auto factor) {
        for (Index k = 0; k < numbers.count(); ++k) power[k] *= factor(numbers[k]);
    };
    if ((quarters & 16) != 0) times([](Real d) { return (d * d) * (d * d); });
    if ((quarters & 8) != 0) times([](Real d) { return d * d; });
    if ((quarters & 4) != 0) times([](Real d) { return d; });
    if ((quarters & 2) != 0) times([](Real d) { return square_root(d); });
    if ((quarters & 1) != 0) times([](Real d) { return square_root(square_root(d)); });
    for (Index k = 0; k < numbers.count(); ++k) numbers[k] = 1 / power[k];
}

// k [n] at place_of(number), in units.
template <class PlaceOf>
void weigh(FaceDistance const& faces, Index quarters, Span<Real> k, Executor const& executor, PlaceOf place_of) noexcept {
    if (faces.unit == 0 || quarters == 0) return fill(k, Real{1});
    constexpr Index least_blocks = 128;
    executor.for_ranges((k.count() + Block::most - 1) / Block::most, least_blocks, [&](Index begin, Index end) {
        Search search(faces);
        for (Index number = begin; number < end; ++number) {
            Block const block(number * Block::most, k.count(), place_of);
            Span<Real> const its = k.from(number * Block::most, block.n);
            Real const nearest = square_root(search.from_anywhere(block.centre));
            Start const start = start_near(faces, block.centre, (1 + slack) * (nearest + 2 * block.radius));
            for (Index i = 0; i < block.n; ++i) its[i] = search.from_near(start, block.place[i]);
            for (Vec2 const& shift : Span<const Vec2>(faces.shift, static_cast<Size>(faces.n_shifts))) {
                Real const other = square_root(search.from_anywhere(block.centre + shift));
                if (other > (1 + slack) * (nearest + 2 * block.radius)) continue;  // nobody's nearest face is there
                Start const there = start_near(faces, block.centre + shift, (1 + slack) * (other + 2 * block.radius));
                for (Index i = 0; i < block.n; ++i) {
                    its[i] = smaller(its[i], search.from_near(there, block.place[i] + shift));
                }
            }
            to_weights(its, quarters);
        }
    });
}

}  // namespace

Real FaceDistance::distance(Vec2 from) const noexcept {
    if (count == 0) return infinity;
    return square_root(Search(*this).from_anywhere(inverse_unit * from)) / inverse_unit;
}

FaceDistance::Foot FaceDistance::foot(Vec2 from, Index& group) const noexcept {
    if (count == 0) return {};
    Search search(*this);
    search.group = group;
    Vec2 const here = inverse_unit * from;
    search.from_anywhere(here);
    group = search.group;
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
    weigh(faces, quarters, k, executor, [&](Index number) {
        Cell const cell = mesh.cell(number);
        Vec2 sum = points[cell.point[0]] + points[cell.point[1]] + points[cell.point[2]];
        if (cell.n == 4) sum = sum + points[cell.point[3]];
        return (cell.n == 4 ? 0.25 * faces.inverse_unit : faces.inverse_unit / 3) * sum;
    });
}

void weigh_edges(FaceDistance const& faces, Span<const DelaunayEdge> edges, Points points, Index quarters, Span<Real> k,
                 Executor const& executor) noexcept {
    weigh(faces, quarters, k, executor, [&](Index number) {
        return 0.5 * faces.inverse_unit * (points[edges[number].begin] + points[edges[number].end]);
    });
}

}  // namespace harmorph
