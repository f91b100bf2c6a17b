// Searches the tree of FaceDistance with the registers of one instruction set; distance.cpp
// compiles this file for each set. All sets find the minimum of the same numbers, whichever nodes
// of the tree they skip, so the bits are the same. tests/boundary/test_distance.cpp covers this
// file.

namespace harmorph::distances::HARMORPH_SET {

// Selects the nodes of the tree of FaceDistance that may contain the nearest face, with the
// registers of one instruction set.

namespace {

using Registers = simd::HARMORPH_SET::Registers<Real>;
using Vector = Registers::Vector;

constexpr Index lanes = FaceDistance::lanes;
constexpr Index width = Registers::lanes;
constexpr Index vectors = lanes / width;
constexpr Real slack = FaceDistance::slack;
constexpr Real min_distance = 1e-30;
constexpr Real min_reach = 1e-150;  // The square is a normal number.

HARMORPH_INLINE Real largest_of(Real* eight) noexcept {
    for (Index n = lanes / 2; n > 0; n /= 2) {
        for (Index k = 0; k < n; ++k) eight[k] = max(eight[k], eight[k + n]);
    }
    return eight[0];
}
HARMORPH_INLINE Real smallest_of(Real* eight) noexcept {
    for (Index n = lanes / 2; n > 0; n /= 2) {
        for (Index k = 0; k < n; ++k) eight[k] = min(eight[k], eight[k + n]);
    }
    return eight[0];
}

// Returns squared distances from several segments to one point, or from one segment to several
// points.
template <class Segment, class Point>
HARMORPH_INLINE Vector square_from(Segment begin_x, Segment begin_y, Segment along_x,
                                   Segment along_y, Segment inverse, Point point_x,
                                   Point point_y) noexcept {
    Vector x = point_x - begin_x, y = point_y - begin_y;
    Vector const nearest = (x * along_x + y * along_y) * inverse;
    Vector const t = Registers::min(Registers::max(nearest, Vector{}), Vector{} + 1);
    x -= t * along_x;
    y -= t * along_y;
    return x * x + y * y;
}
HARMORPH_INLINE Vector square_from(FaceDistance::Segments const& segments, Index lane,
                                   Vec2 point) noexcept {
    return square_from(Registers::load(segments.x + lane), Registers::load(segments.y + lane),
                       Registers::load(segments.along_x + lane),
                       Registers::load(segments.along_y + lane),
                       Registers::load(segments.inverse + lane), point.x, point.y);
}
HARMORPH_INLINE Vector square_from(FaceDistance::Segments const& segments, Index lane, Vector x,
                                   Vector y) noexcept {
    return square_from(segments.x[lane], segments.y[lane], segments.along_x[lane],
                       segments.along_y[lane], segments.inverse[lane], x, y);
}

template <class Corner, class Point>
HARMORPH_INLINE Vector square_outside(Corner low_x, Corner low_y, Corner high_x, Corner high_y,
                                      Point point_x, Point point_y) noexcept {
    Vector const x = Registers::max(Registers::max(low_x - point_x, point_x - high_x), Vector{});
    Vector const y = Registers::max(Registers::max(low_y - point_y, point_y - high_y), Vector{});
    return x * x + y * y;
}

// Enumerates the nodes, out of eight, that may contain a face within `reach` of a point: first the
// node with the smallest bound, then the others in order.
class Candidates {
public:
    HARMORPH_INLINE Candidates(FaceDistance::Boxes const& boxes, Vec2 from, Real reach) noexcept {
        for (Index k = 0; k < lanes; k += width) {
            add(k,
                square_outside(Registers::load(boxes.low_x + k), Registers::load(boxes.low_y + k),
                               Registers::load(boxes.high_x + k), Registers::load(boxes.high_y + k),
                               from.x, from.y),
                Vector{} + (1 + 2 * slack) * reach * reach);
        }
    }
    HARMORPH_INLINE Candidates(FaceDistance::Chords const& chords, Vec2 from, Real reach) noexcept {
        for (Index k = 0; k < lanes; k += width) {
            Vector const limit = (1 + slack) * (reach + Registers::load(chords.radius + k));
            add(k, square_from(chords.axis, k, from), limit * limit);
        }
    }
    HARMORPH_INLINE void leave_out(Index lane) noexcept {
        if (lane >= 0 && lane < lanes) left_ &= ~(1u << lane);
    }
    HARMORPH_INLINE bool next(Index& lane) noexcept {
        if (left_ == 0) return false;
        lane = __builtin_ctz(left_);
        for (unsigned others = nearest_is_out_ ? 0 : left_ & (left_ - 1); others != 0;
             others &= others - 1) {
            Index const other = __builtin_ctz(others);
            lane = square_[other] < square_[lane] ? other : lane;
        }
        nearest_is_out_ = true;
        left_ &= ~(1u << lane);
        return true;
    }
    HARMORPH_INLINE Real square(Index lane) const noexcept { return square_[lane]; }

private:
    HARMORPH_INLINE void add(Index first, Vector squares, Vector limits) noexcept {
        Registers::store(square_ + first, squares);
        left_ |= Registers::less(squares, limits) << first;
    }

    unsigned left_ = 0;
    bool nearest_is_out_ = false;
    Real square_[lanes];
};

// The state of a search for the face nearest to one point.
struct One {
    Vec2 centre;
    Index group;  // the group of the nearest face so far; initially the group that is tried first
    Real square = infinity, reach = infinity;

    HARMORPH_INLINE One(Vec2 point, Index first_group) noexcept
        : centre(point), group(first_group) {}

    HARMORPH_INLINE bool reaches(FaceDistance::Boxes const&, Index, Real bound) const noexcept {
        return bound < (1 + 2 * slack) * reach * reach;
    }
    HARMORPH_INLINE bool reaches(FaceDistance::Chords const& chords, Index lane,
                                 Real bound) const noexcept {
        Real const limit = (1 + slack) * (reach + chords.radius[lane]);
        return bound < limit * limit;
    }
    HARMORPH_INLINE void try_group(FaceDistance::Segments const& segments, Index tried) noexcept {
        Real squares[lanes];
        for (Index k = 0; k < lanes; k += width)
            Registers::store(squares + k, square_from(segments, k, centre));
        Real const nearest = smallest_of(squares);
        // At equal distances the group with the smallest number counts, so that the result does not
        // depend on the group that was tried first.
        if (!(nearest < square || (nearest == square && tried < group))) return;
        square = nearest;
        // A point on a face reaches the other faces at distance 0, too.
        reach = max(sqrt(nearest), min_reach);
        group = tried;
    }
};

// The state of a search for the faces nearest to each of eight points. The points should be
// neighbours, because they share the branches, which are hard to predict.
struct Eight {
    Vec2 centre;
    Index group;  // the last group that was nearest to one of the points
    // The face nearest to any of the points is not farther than this from the centre.
    Real reach = infinity;
    Vector x[vectors], y[vectors], square[vectors], distance[vectors], from_centre[vectors];

    HARMORPH_INLINE Eight(const Real* new_x, const Real* new_y, Index first_group) noexcept
        : group(first_group) {
        for (Index v = 0; v < vectors; ++v) square[v] = distance[v] = Vector{} + infinity;
        move(new_x, new_y, {});
    }
    // Continues with images of the points; the distances found so far remain upper bounds.
    HARMORPH_INLINE void move(const Real* new_x, const Real* new_y,
                              FaceDistance::Image const& to) noexcept {
        for (Index v = 0; v < vectors; ++v) {
            Vector const from_x = Registers::load(new_x + v * width),
                         from_y = Registers::load(new_y + v * width);
            x[v] = from_x * to.rotation.x - from_y * to.rotation.y + to.shift.x;
            y[v] = from_y * to.rotation.x + from_x * to.rotation.y + to.shift.y;
        }
        set_centre();
    }

    HARMORPH_INLINE bool reaches(FaceDistance::Boxes const& boxes, Index lane,
                                 Real) const noexcept {
        unsigned any = 0;
        for (Index v = 0; v < vectors; ++v) {
            Vector const bound = square_outside(boxes.low_x[lane], boxes.low_y[lane],
                                                boxes.high_x[lane], boxes.high_y[lane], x[v], y[v]);
            any |= Registers::less(bound, (1 + 2 * slack) * square[v]);
        }
        return any != 0;
    }
    HARMORPH_INLINE bool reaches(FaceDistance::Chords const& chords, Index lane,
                                 Real) const noexcept {
        unsigned any = 0;
        for (Index v = 0; v < vectors; ++v) {
            Vector const limit = (1 + slack) * (distance[v] + chords.radius[lane]);
            any |= Registers::less(square_from(chords.axis, lane, x[v], y[v]), limit * limit);
        }
        return any != 0;
    }
    HARMORPH_INLINE void try_group(FaceDistance::Segments const& segments, Index tried) noexcept {
        Vector nearest[vectors];
        for (Index v = 0; v < vectors; ++v) nearest[v] = square[v];
        for (Index lane = 0; lane < lanes; ++lane) {
            for (Index v = 0; v < vectors; ++v) {
                nearest[v] = Registers::min(nearest[v], square_from(segments, lane, x[v], y[v]));
            }
        }
        unsigned any = 0;
        for (Index v = 0; v < vectors; ++v) {
            any |= Registers::less(nearest[v], square[v]);
            square[v] = nearest[v];
            distance[v] = Registers::sqrt(nearest[v]);
        }
        if (any == 0) return;
        group = tried;
        set_reach();
    }

    HARMORPH_INLINE void set_centre() noexcept {
        Vector sum_x{}, sum_y{};
        for (Index v = 0; v < vectors; ++v) {
            sum_x += x[v];
            sum_y += y[v];
        }
        centre = {0, 0};
        for (Index k = 0; k < width; ++k) centre = centre + 1.0 / lanes * Vec2{sum_x[k], sum_y[k]};
        for (Index v = 0; v < vectors; ++v) {
            Vector const to_x = x[v] - centre.x, to_y = y[v] - centre.y;
            from_centre[v] = Registers::sqrt(to_x * to_x + to_y * to_y);
        }
        set_reach();
    }
    HARMORPH_INLINE void set_reach() noexcept {
        Real farthest[lanes];
        for (Index v = 0; v < vectors; ++v)
            Registers::store(farthest + v * width, from_centre[v] + distance[v]);
        reach = (1 + slack) * largest_of(farthest);
    }
};

// Finds the nearest face for each of eight points.
struct EightFeet : Eight {
    using Eight::reaches;
    Vector faces[vectors];  // numbers, which are exact in doubles
    Index tried[lanes], n_tried = 0;

    // Tries the groups `first` of the eight points.
    HARMORPH_INLINE EightFeet(FaceDistance const& tree, const Real* new_x, const Real* new_y,
                              const Index* first) noexcept
        : Eight(new_x, new_y, first[0]) {
        for (Index v = 0; v < vectors; ++v) faces[v] = Vector{};
        for (Index k = 0; k < lanes; ++k) {
            bool is_new = k == 0 || first[k] != first[k - 1];
            for (Index j = 0; is_new && j < n_tried; ++j) is_new = tried[j] != first[k];
            if (!is_new) continue;
            tried[n_tried++] = first[k];
            improve(tree.groups[first[k]], first[k]);
        }
        set_reach();
    }
    HARMORPH_INLINE bool reaches(FaceDistance::Boxes const& boxes, Index lane,
                                 Real) const noexcept {
        unsigned any = 0;
        for (Index v = 0; v < vectors; ++v) {
            Vector const bound = square_outside(boxes.low_x[lane], boxes.low_y[lane],
                                                boxes.high_x[lane], boxes.high_y[lane], x[v], y[v]);
            any |= Registers::less(bound, (1 + 2 * slack) * distance[v] * distance[v]);
        }
        return any != 0;
    }
    HARMORPH_INLINE void try_group(FaceDistance::Segments const& segments, Index number) noexcept {
        if (improve(segments, number)) set_reach();
    }

private:
    // Returns true if a face of the group is closer to one of the points than all faces before.
    HARMORPH_INLINE bool improve(FaceDistance::Segments const& segments, Index number) noexcept {
        unsigned closer = 0;
        for (Index v = 0; v < vectors; ++v) {
            Vector nearest = square_from(segments, 0, x[v], y[v]), lane_of = Vector{};
            for (Index lane = 1; lane < lanes; ++lane) {
                Vector const here = square_from(segments, lane, x[v], y[v]);
                lane_of = here < nearest ? Vector{} + static_cast<Real>(lane) : lane_of;
                nearest = Registers::min(nearest, here);
            }
            // At equal distances the face with the smallest number counts.
            Vector const face = lane_of + static_cast<Real>(lanes * number);
            Vector const at_equal =
                nearest == square[v] ? Registers::min(face, faces[v]) : faces[v];
            faces[v] = nearest < square[v] ? face : at_equal;
            closer |= Registers::less(nearest, square[v]);
            square[v] = Registers::min(nearest, square[v]);
            // A point on a face reaches the other faces at distance 0, too.
            distance[v] = Registers::max(Registers::sqrt(square[v]), Vector{} + min_reach);
        }
        return closer != 0;
    }
};

template <class Searches>
class Search {
public:
    // `tried` [n_tried] are groups that the searches have tried already.
    HARMORPH_INLINE Search(FaceDistance const& tree, Searches& searches, const Index* tried,
                           Index n_tried) noexcept
        : tree_(tree), searches_(searches), tried_(tried), n_tried_(n_tried) {}
    HARMORPH_INLINE void run() noexcept { visit(tree_.root_height, 0); }

private:
    void visit(Index height, Index node) noexcept {
        Index lane;
        if (height > 1) {
            FaceDistance::Boxes const& boxes = tree_.boxes[tree_.height_start[height] + node];
            Candidates candidates(boxes, searches_.centre, searches_.reach);
            while (candidates.next(lane)) {
                if (searches_.reaches(boxes, lane, candidates.square(lane)))
                    visit(height - 1, lanes * node + lane);
            }
            return;
        }
        FaceDistance::Chords const& chords = tree_.chords[node];
        Candidates candidates(chords, searches_.centre, searches_.reach);
        for (Index k = 0; k < n_tried_; ++k) candidates.leave_out(tried_[k] - lanes * node);
        while (candidates.next(lane)) {
            if (!searches_.reaches(chords, lane, candidates.square(lane))) continue;
            searches_.try_group(tree_.groups[lanes * node + lane], lanes * node + lane);
        }
    }

    FaceDistance const& tree_;
    Searches& searches_;
    const Index* tried_;
    Index n_tried_;
};

// Returns d^(-exponent_quarters / 4), computed by square roots alone.
HARMORPH_INLINE Vector weight_of(Vector square, Index exponent_quarters) noexcept {
    // The order of the arguments keeps NaN.
    Vector const d = Registers::max(Vector{} + min_distance, Registers::sqrt(square));
    Vector power = Vector{} + 1;
    if ((exponent_quarters & 16) != 0) power *= (d * d) * (d * d);
    if ((exponent_quarters & 8) != 0) power *= d * d;
    if ((exponent_quarters & 4) != 0) power *= d;
    if ((exponent_quarters & 3) != 0) {
        Vector const root = Registers::sqrt(d);
        if ((exponent_quarters & 2) != 0) power *= root;
        if ((exponent_quarters & 1) != 0) power *= Registers::sqrt(root);
    }
    return 1 / power;
}

Real nearest_square(FaceDistance const& tree, Vec2 from, Index& group) noexcept {
    One point(from, group);
    point.try_group(tree.groups[group], group);
    Search<One>(tree, point, &group, 1).run();
    group = point.group;
    return point.square;
}

void weigh_eight(FaceDistance const& tree, Index exponent_quarters, const Real* x, const Real* y,
                 Real* k, Index& group) noexcept {
    Eight searches(x, y, group);
    searches.try_group(tree.groups[group], group);
    Search<Eight>(tree, searches, &group, 1).run();
    group = searches.group;
    for (Index number = 0; number < tree.n_images; ++number) {
        searches.move(x, y, tree.image[number]);
        Search<Eight>(tree, searches, nullptr, 0).run();
    }
    for (Index v = 0; v < vectors; ++v)
        Registers::store(k + v * width, weight_of(searches.square[v], exponent_quarters));
}

void nearest_faces(FaceDistance const& tree, const Real* x, const Real* y, const Index* groups,
                   Index* faces) noexcept {
    EightFeet searches(tree, x, y, groups);
    Search<EightFeet>(tree, searches, searches.tried, searches.n_tried).run();
    Real nearest[lanes];
    for (Index v = 0; v < vectors; ++v) Registers::store(nearest + v * width, searches.faces[v]);
    for (Index k = 0; k < lanes; ++k) faces[k] = static_cast<Index>(nearest[k]);
}

constexpr DistanceKernels kernels{nearest_square, weigh_eight, nearest_faces};

}  // namespace
}  // namespace harmorph::distances::HARMORPH_SET

namespace harmorph::simd {
template <>
inline constexpr const DistanceKernels* table<DistanceKernels, Kernel::HARMORPH_SET> =
    &harmorph::distances::HARMORPH_SET::kernels;
}  // namespace harmorph::simd
