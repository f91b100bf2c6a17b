// Selects the nodes of the tree of FaceDistance that may contain the nearest face, with the
// registers of one instruction set; distance_kernel.hpp includes this file.
// tests/boundary/test_distance.cpp covers this file.

namespace harmorph::distances::HARMORPH_SET {
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

// Enumerates those of eight nodes that may contain a face within `reach` of a point: first the node
// with the smallest bound, then the others in order.
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

}  // namespace
}  // namespace harmorph::distances::HARMORPH_SET
