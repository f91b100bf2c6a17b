#include "morph/morph.hpp"

#include "morph/product.hpp"

namespace harmorph {
namespace {

// The sums of their points stay in the first-level cache, and leave a small stack enough room.
constexpr Index chunk_blocks = 24;
constexpr Index chunk_points = chunk_blocks * block_points;
constexpr Index least_blocks_to_morph = 512;  // blocks that are worth a thread
constexpr Offset worth_asking = Offset{1} << 17;
// As BlockProducts::move does.
constexpr Real moved(Real from, Real by) noexcept { return by == 0 ? from : from + by; }

// The factors of the numbers of a row of values, Movements::most numbers at a time. The first few,
// which are all of most bases, are computed once for a morph; further ones do not fit on the stack
// and are computed for each use.
class RowMovements {
public:
    RowMovements(Basis const& basis, const Real* move) noexcept : basis_(basis), move_(move) {
        for (Index part = 0; part < n_stored && part * Movements::most < basis.row_length();
             ++part) {
            stored_[part] = made(part * Movements::most);
        }
    }

    // body(first number, how many, movements) for each part of a row.
    template <class Body>
    void for_each_part(Body const& body) const noexcept {
        Index const row_length = basis_.row_length();
        for (Index first = 0; first < row_length; first += Movements::most) {
            Index const width = min(Movements::most, row_length - first),
                        part = first / Movements::most;
            if (part < n_stored) body(first, width, stored_[part]);
            else body(first, width, made(first));
        }
    }

private:
    static constexpr Index n_stored = 2;

    Movements made(Index first) const noexcept {
        Movements by = {};
        Index const n = basis_.n_functions(),
                    width = min(Movements::most, basis_.row_length() - first);
        Index plane = first / n, function = first % n;
        for (Index k = 0; k < width; ++k) {
            Vec2 const moved =
                moved_by(basis_.kind(), plane, {move_[2 * function], move_[2 * function + 1]});
            by.x[k] = moved.x;
            by.y[k] = moved.y;
            if (++function < n) continue;
            function = 0;
            ++plane;
        }
        return by;
    }

    Basis const& basis_;
    const Real* move_;
    Movements stored_[n_stored];
};

// The sums of the points of at most chunk_blocks blocks, or of slots of the wall.
struct Chunk {
    Real x[chunk_points], y[chunk_points];

    explicit Chunk(Index n_blocks) noexcept {
        for (Index k = 0; k < n_blocks * block_points; ++k) x[k] = y[k] = 0;
    }

    // Of blocks first .. first+n-1 of the values of a basis with rows of that length.
    template <class Number>
    void add(ProductKernels const& kernels, Span<Number> values, Index row_length,
             RowMovements const& move, Index first, Index n) noexcept {
        Offset const stride = Offset{row_length} * block_points;
        move.for_each_part([&](Index number, Index width, Movements const& by) {
            Number* const first_value =
                values.data() + first * stride + Offset{number} * block_points;
            ValueBlocks<Number> const blocks{first_value, stride, n, width};
            kernels.of(blocks).multiply(blocks, by, {x, y});
        });
    }
    Vec2 move_point(Vec2 old, Index k) const noexcept {
        return {moved(old.x, x[k]), moved(old.y, y[k])};
    }
};

// Moves the points of blocks first .. first+n-1, n <= chunk_blocks, of any arrays. Not inlined: the
// sums of both precisions and of the wall would be on the stack together.
template <class Number>
__attribute__((noinline)) void morph_chunk(ProductKernels const& kernels, Span<Number> values,
                                           Basis const& basis, RowMovements const& move,
                                           Points from, MutablePoints to, Index first,
                                           Index n) noexcept {
    Chunk sums(n);
    sums.add(kernels, values, basis.row_length(), move, first, n);
    Index const begin = first * block_points,
                n_points = min(n * block_points, basis.n_points() - begin);
    for (Index k = 0; k < n_points; ++k) {
        to.set(begin + k, sums.move_point(from.given() ? from[begin + k] : Vec2{}, k));
    }
}

// Moves the points of blocks begin .. end-1. Coordinates that lie side by side are read and written
// by the kernels, but those of a block that is filled in part.
template <class Number>
void morph_blocks(ProductKernels const& kernels, Span<Number> values, Basis const& basis,
                  RowMovements const& move, Points from, MutablePoints to, Index begin,
                  Index end) noexcept {
    bool const side_by_side = (!from.given() || from.stride == 1) && to.stride == 1;
    if (side_by_side && basis.row_length() <= Movements::most) {
        Index const whole = min(end, basis.n_points() / block_points), point = begin * block_points;
        move.for_each_part([&](Index, Index width, Movements const& by) {
            Offset const stride = Offset{width} * block_points;
            ValueBlocks<Number> const blocks{values.data() + begin * stride, stride, whole - begin,
                                             width};
            bool const given = from.given();
            PerPoint<const Real> const before = {given ? from.x + point : nullptr,
                                                 given ? from.y + point : nullptr};
            kernels.of(blocks).move(blocks, by, before, {to.x + point, to.y + point});
        });
        begin = whole;
    }
    for (Index first = begin; first < end; first += chunk_blocks) {
        morph_chunk(kernels, values, basis, move, from, to, first, min(chunk_blocks, end - first));
    }
}

// The products of one row in double precision, added up in the order of the kernels.
Vec2 sum_of_row(Basis const& basis, RowMovements const& move, Index slot) noexcept {
    Vec2 sum;
    RowInBlock<Real> const row = basis.row(slot);
    move.for_each_part([&](Index first, Index width, Movements const& by) {
        for (Index k = 0; k < width; ++k) sum = sum + row[first + k] * Vec2{by.x[k], by.y[k]};
    });
    return sum;
}

// In single-precision storage the rows of points on the wall are 0, so these points have not moved
// yet.
__attribute__((noinline)) void morph_wall(ProductKernels const& kernels, Basis const& basis,
                                          RowMovements const& move, MutablePoints to) noexcept {
    Index const n_slots = basis.wall_point.count(), n_blocks = blocks_of(n_slots);
    for (Index first = 0; first < n_blocks; first += chunk_blocks) {
        Index const n = min(chunk_blocks, n_blocks - first), begin = first * block_points;
        Chunk sums(n);
        sums.add(kernels, basis.value, basis.row_length(), move, first, n);
        for (Index k = 0; k < n * block_points && begin + k < n_slots; ++k) {
            Index const point = basis.wall_point[begin + k];
            to.set(point, sums.move_point(to[point], k));
        }
    }
    for (Index k = 0; k < basis.joined_point.count(); ++k) {
        Index const point = basis.joined_point[k];
        Vec2 const old = to[point], by = sum_of_row(basis, move, basis.joined_slot[k]);
        to.set(point, {moved(old.x, by.x), moved(old.y, by.y)});
    }
}

}  // namespace

void morph(Basis const& basis, const Real* move, Points from, MutablePoints to,
           Executor const& executor) noexcept {
    ProductKernels const& kernels = product_kernels_for(
        executor.kernel, Offset{basis.n_points()} * basis.row_length(), worth_asking);
    RowMovements const movements(basis, move);
    executor.for_ranges(
        blocks_of(basis.n_points()), least_blocks_to_morph, [&](Index begin, Index end) {
            if (basis.in_single())
                morph_blocks(kernels, basis.single, basis, movements, from, to, begin, end);
            else morph_blocks(kernels, basis.value, basis, movements, from, to, begin, end);
        });
    if (basis.in_single()) morph_wall(kernels, basis, movements, to);
}

}  // namespace harmorph
