// Searches of the tree of FaceDistance with the registers of one instruction set; compiled for each by distance_table.cpp. All of
// them find the least of the same numbers, whichever they pass over: so the bits are the same.

namespace harmorph::HARMORPH_SET {
namespace {

using Registers = simd::HARMORPH_SET::Registers<Real>;
using Vector = Registers::Vector;

constexpr Index lanes = FaceDistance::lanes;
constexpr Index width = Registers::lanes;
constexpr Index vectors = lanes / width;
constexpr Real slack = FaceDistance::slack;
constexpr Real least_distance = 1e-30;

HARMORPH_INLINE Real largest_of(Real* eight) noexcept {
    for (Index half = lanes / 2; half > 0; half /= 2) {
        for (Index k = 0; k < half; ++k) eight[k] = larger(eight[k], eight[k + half]);
    }
    return eight[0];
}
HARMORPH_INLINE Real smallest_of(Real* eight) noexcept {
    for (Index half = lanes / 2; half > 0; half /= 2) {
        for (Index k = 0; k < half; ++k) eight[k] = smaller(eight[k], eight[k + half]);
    }
    return eight[0];
}

// Squared distances from several segments to one place, or from one segment to several places.
template <class Segment, class Place>
HARMORPH_INLINE Vector square_from(Segment begin_x, Segment begin_y, Segment along_x, Segment along_y, Segment inverse,
                                   Place place_x, Place place_y) noexcept {
    Vector x = place_x - begin_x, y = place_y - begin_y;
    Vector const nearest = (x * along_x + y * along_y) * inverse;
    Vector const t = Registers::smaller(Registers::larger(nearest, Vector{}), Vector{} + 1);
    x -= t * along_x;
    y -= t * along_y;
    return x * x + y * y;
}
HARMORPH_INLINE Vector square_from(FaceDistance::Segments const& its, Index lane, Vec2 place) noexcept {
    return square_from(Registers::load(its.x + lane), Registers::load(its.y + lane), Registers::load(its.along_x + lane), Registers::load(its.along_y + lane),
                       Registers::load(its.inverse + lane), place.x, place.y);
}
HARMORPH_INLINE Vector square_from(FaceDistance::Segments const& its, Index lane, Vector x, Vector y) noexcept {
    return square_from(its.x[lane], its.y[lane], its.along_x[lane], its.along_y[lane], its.inverse[lane], x, y);
}

template <class Corner, class Place>
HARMORPH_INLINE Vector square_outside(Corner low_x, Corner low_y, Corner high_x, Corner high_y, Place place_x,
                                      Place place_y) noexcept {
    Vector const x = Registers::larger(Registers::larger(low_x - place_x, place_x - high_x), Vector{});
    Vector const y = Registers::larger(Registers::larger(low_y - place_y, place_y - high_y), Vector{});
    return x * x + y * y;
}

// Those of eight nodes that may hold a face at a distance from a place of `reach` or less: the nearest bound first,
// then the others in their order.
class Candidates {
public:
    HARMORPH_INLINE Candidates(FaceDistance::Boxes const& its, Vec2 from, Real reach) noexcept {
        for (Index k = 0; k < lanes; k += width) {
            add(k, square_outside(Registers::load(its.low_x + k), Registers::load(its.low_y + k), Registers::load(its.high_x + k), Registers::load(its.high_y + k),
                                  from.x, from.y), Vector{} + (1 + 2 * slack) * reach * reach);
        }
    }
    HARMORPH_INLINE Candidates(FaceDistance::Chords const& its, Vec2 from, Real reach) noexcept {
        for (Index k = 0; k < lanes; k += width) {
            Vector const limit = (1 + slack) * (reach + Registers::load(its.radius + k));
            add(k, square_from(its.axis, k, from), limit * limit);
        }
    }
    HARMORPH_INLINE void leave_out(Index lane) noexcept {
        if (lane >= 0 && lane < lanes) left_ &= ~(1u << lane);
    }
    HARMORPH_INLINE bool next(Index& lane) noexcept {
        if (left_ == 0) return false;
        lane = __builtin_ctz(left_);
        for (unsigned others = nearest_is_out_ ? 0 : left_ & (left_ - 1); others != 0; others &= others - 1) {
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

// A search is for what is nearest to one place.
struct One {
    Vec2 centre;
    Index group;  // the nearest; at first, where it is tried
    Real square = infinity, reach = infinity;

    HARMORPH_INLINE One(Vec2 place, Index first_group) noexcept : centre(place), group(first_group) {}

    HARMORPH_INLINE bool reaches(FaceDistance::Boxes const&, Index, Real its_square) const noexcept {
        return its_square < (1 + 2 * slack) * square;
    }
    HARMORPH_INLINE bool reaches(FaceDistance::Chords const& chords, Index lane, Real its_square) const noexcept {
        Real const limit = (1 + slack) * (reach + chords.radius[lane]);
        return its_square < limit * limit;
    }
    HARMORPH_INLINE void try_group(FaceDistance::Segments const& segments, Index its) noexcept {
        Real squares[lanes];
        for (Index k = 0; k < lanes; k += width) Registers::store(squares + k, square_from(segments, k, centre));
        Real const nearest = smallest_of(squares);
        if (!(nearest < square || (nearest == square && its < group))) return;  // whichever was tried first
        square = nearest;
        reach = square_root(nearest);
        group = its;
    }
};

// Or to each of eight places, which should be neighbours: each alone would be a chain of branches that nobody can
// predict.
struct Eight {
    Vec2 centre;
    Index group;  // the last that was the nearest of one of them
    Real reach = infinity;  // whatever is nearest to one of them is no farther from the centre
    Vector x[vectors], y[vectors], square[vectors], distance[vectors], from_centre[vectors];

    HARMORPH_INLINE Eight(const Real* its_x, const Real* its_y, Index first_group) noexcept : group(first_group) {
        for (Index v = 0; v < vectors; ++v) square[v] = distance[v] = Vector{} + infinity;
        move(its_x, its_y, {0, 0});
    }
    // To their images, of which the distances found so far are bounds as well.
    HARMORPH_INLINE void move(const Real* its_x, const Real* its_y, Vec2 shift) noexcept {
        for (Index v = 0; v < vectors; ++v) {
            x[v] = Registers::load(its_x + v * width) + shift.x;
            y[v] = Registers::load(its_y + v * width) + shift.y;
        }
        set_centre();
    }

    HARMORPH_INLINE bool reaches(FaceDistance::Boxes const& its, Index lane, Real) const noexcept {
        unsigned any = 0;
        for (Index v = 0; v < vectors; ++v) {
            Vector const bound =
                square_outside(its.low_x[lane], its.low_y[lane], its.high_x[lane], its.high_y[lane], x[v], y[v]);
            any |= Registers::less(bound, (1 + 2 * slack) * square[v]);
        }
        return any != 0;
    }
    HARMORPH_INLINE bool reaches(FaceDistance::Chords const& its, Index lane, Real) const noexcept {
        unsigned any = 0;
        for (Index v = 0; v < vectors; ++v) {
            Vector const limit = (1 + slack) * (distance[v] + its.radius[lane]);
            any |= Registers::less(square_from(its.axis, lane, x[v], y[v]), limit * limit);
        }
        return any != 0;
    }
    HARMORPH_INLINE void try_group(FaceDistance::Segments const& segments, Index its) noexcept {
        Vector nearest[vectors];
        for (Index v = 0; v < vectors; ++v) nearest[v] = square[v];
        for (Index lane = 0; lane < lanes; ++lane) {
            for (Index v = 0; v < vectors; ++v) {
                nearest[v] = Registers::smaller(nearest[v], square_from(segments, lane, x[v], y[v]));
            }
        }
        unsigned any = 0;
        for (Index v = 0; v < vectors; ++v) {
            any |= Registers::less(nearest[v], square[v]);
            square[v] = nearest[v];
            distance[v] = Registers::square_root(nearest[v]);
        }
        if (any == 0) return;
        group = its;
        set_reach();
    }

private:
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
            from_centre[v] = Registers::square_root(to_x * to_x + to_y * to_y);
        }
        set_reach();
    }
    HARMORPH_INLINE void set_reach() noexcept {
        Real farthest[lanes];
        for (Index v = 0; v < vectors; ++v) Registers::store(farthest + v * width, from_centre[v] + distance[v]);
        reach = (1 + slack) * largest_of(farthest);
    }
};

template <class Places>
class Search {
public:
    HARMORPH_INLINE Search(FaceDistance const& tree, Places& places, Index tried) noexcept
        : tree_(tree), places_(places), tried_(tried) {}
    HARMORPH_INLINE void run() noexcept { visit(tree_.root_height, 0); }

private:
    void visit(Index height, Index node) noexcept {
        Index lane;
        if (height > 1) {
            FaceDistance::Boxes const& boxes = tree_.boxes[tree_.height_start[height] + node];
            Candidates candidates(boxes, places_.centre, places_.reach);
            while (candidates.next(lane)) {
                if (places_.reaches(boxes, lane, candidates.square(lane))) visit(height - 1, lanes * node + lane);
            }
            return;
        }
        FaceDistance::Chords const& chords = tree_.chords[node];
        Candidates candidates(chords, places_.centre, places_.reach);
        candidates.leave_out(tried_ - lanes * node);
        while (candidates.next(lane)) {
            if (!places_.reaches(chords, lane, candidates.square(lane))) continue;
            places_.try_group(tree_.groups[lanes * node + lane], lanes * node + lane);
        }
    }

    FaceDistance const& tree_;
    Places& places_;
    Index tried_;
};

// d^(-quarters / 4), from square roots alone.
HARMORPH_INLINE Vector weight_of(Vector square, Index quarters) noexcept {
    Vector const d = Registers::larger(Vector{} + least_distance, Registers::square_root(square));  // NaN stays
    Vector power = Vector{} + 1;
    if ((quarters & 16) != 0) power *= (d * d) * (d * d);
    if ((quarters & 8) != 0) power *= d * d;
    if ((quarters & 4) != 0) power *= d;
    if ((quarters & 3) != 0) {
        Vector const root = Registers::square_root(d);
        if ((quarters & 2) != 0) power *= root;
        if ((quarters & 1) != 0) power *= Registers::square_root(root);
    }
    return 1 / power;
}

Real nearest_square(FaceDistance const& tree, Vec2 from, Index& group) noexcept {
    One place(from, group);
    place.try_group(tree.groups[group], group);
    Search<One>(tree, place, group).run();
    group = place.group;
    return place.square;
}

void weigh_eight(FaceDistance const& tree, Index quarters, const Real* x, const Real* y, Real* k,
                 Index& group) noexcept {
    Eight places(x, y, group);
    places.try_group(tree.groups[group], group);
    Search<Eight>(tree, places, group).run();
    group = places.group;
    for (Index image = 0; image < tree.n_shifts; ++image) {
        places.move(x, y, tree.shift[image]);
        Search<Eight>(tree, places, none).run();
    }
    for (Index v = 0; v < vectors; ++v) Registers::store(k + v * width, weight_of(places.square[v], quarters));
}

constexpr DistanceKernels kernels{nearest_square, weigh_eight};

}  // namespace
}  // namespace harmorph::HARMORPH_SET

namespace harmorph::simd {
template <>
inline constexpr const DistanceKernels* table<DistanceKernels, Kernel::HARMORPH_SET> = &harmorph::HARMORPH_SET::kernels;
}  // namespace harmorph::simd
