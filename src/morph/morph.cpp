#include "harmorph/morph/morph.hpp"

#include "harmorph/morph/product.hpp"

namespace harmorph {
namespace {

constexpr Index block_points = 1024;     // their sums stay in the first-level cache
constexpr Index least_range = 8192;      // points that are worth a thread
// As ProductKernels::add_sums does.
constexpr Real moved(Real from, Real by) noexcept { return by == 0 ? from : from + by; }

// The factors of the numbers of a row of values, in blocks of Movements::most numbers. The first blocks, which are all
// blocks of most bases, are computed once for a morph; further ones do not fit on the stack and are computed for each
// use.
class RowMovements {
public:
    RowMovements(Basis const& basis, const Real* move) noexcept : basis_(basis), move_(move) {
        for (Index block = 0; block < n_stored && block * Movements::most < basis.row_length(); ++block) {
            stored_[block] = made(block * Movements::most);
        }
    }

    // body(first number, how many, movements) for each block.
    template <class Body>
    void for_each_block(Body const& body) const noexcept {
        Index const row_length = basis_.row_length();
        for (Index first = 0; first < row_length; first += Movements::most) {
            Index const width = smaller(Movements::most, row_length - first), block = first / Movements::most;
            if (block < n_stored) body(first, width, stored_[block]);
            else body(first, width, made(first));
        }
    }

private:
    static constexpr Index n_stored = 4;

    Movements made(Index first) const noexcept {
        Movements by = {};
        Index const n = basis_.n_functions(), width = smaller(Movements::most, basis_.row_length() - first);
        Index plane = first / n, function = first % n;
        for (Index k = 0; k < width; ++k) {
            Vec2 const moved = moved_by(basis_.kind(), plane, {move_[2 * function], move_[2 * function + 1]});
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

// Adds row p of n consecutive rows times the movements to point p.
template <class Number>
void add_rows(ProductKernels const& kernels, Basis const& basis, const Number* rows, Index n, RowMovements const& move,
              Sums const& to) noexcept {
    move.for_each_block([&](Index first, Index width, Movements const& by) {
        ValueRows<Number> const block{rows + first, basis.row_length(), n, width};
        kernels.of(block).multiply(block, by, to);
    });
}

void prefetch(const Real* from, Index n) noexcept {
    for (Index i = 0; i < n; i += 8) __builtin_prefetch(from + i);
}

// Points begin .. begin+n-1, n <= block_points.
void morph_block(ProductKernels const& kernels, Basis const& basis, RowMovements const& move, Points from,
                 MutablePoints to,
                 Index begin, Index n) noexcept {
    constexpr Real zero[block_points] = {};
    Real x[block_points] = {}, y[block_points] = {};
    bool const in_rows = (!from.given() || from.stride == 1) && to.stride == 1;
    const Real* const from_x = from.given() ? from.x + begin : zero;
    const Real* const from_y = from.given() ? from.y + begin : zero;
    if (in_rows) {  // prefetched while the sums are computed
        prefetch(from_x, n);
        prefetch(from_y, n);
    }
    if (basis.in_single()) add_rows(kernels, basis, basis.single_row(begin), n, move, {x, y});
    else add_rows(kernels, basis, basis.row(begin), n, move, {x, y});
    if (in_rows) {
        kernels.add_sums(from_x, to.x + begin, x, n);
        kernels.add_sums(from_y, to.y + begin, y, n);
        return;
    }
    for (Index p = 0; p < n; ++p) {
        Vec2 const old = from.given() ? from[begin + p] : Vec2{};
        to.set(begin + p, {moved(old.x, x[p]), moved(old.y, y[p])});
    }
}

// In single-precision storage the rows of points on the wall are 0, so these points have not moved yet.
void morph_wall(ProductKernels const& kernels, Basis const& basis, RowMovements const& move,
                MutablePoints to) noexcept {
    auto const move_point = [&](Index point, Index slot) {
        Vec2 const old = to[point];
        Vec2 sum;
        add_rows(kernels, basis, basis.row(slot), 1, move, {&sum.x, &sum.y});
        to.set(point, {moved(old.x, sum.x), moved(old.y, sum.y)});
    };
    for (Index slot = 0; slot < basis.wall_point.count(); ++slot) move_point(basis.wall_point[slot], slot);
    for (Index k = 0; k < basis.joined_point.count(); ++k) move_point(basis.joined_point[k], basis.joined_slot[k]);
}

}  // namespace

void morph(Basis const& basis, const Real* move, Points from, MutablePoints to, Executor const& executor) noexcept {
    ProductKernels const& kernels = product_kernels_for(Offset{basis.n_points()} * basis.row_length());
    RowMovements const movements(basis, move);
    executor.for_ranges(basis.n_points(), least_range, [&](Index range_begin, Index range_end) {
        for (Index begin = range_begin; begin < range_end; begin += block_points) {
            morph_block(kernels, basis, movements, from, to, begin, smaller(block_points, range_end - begin));
        }
    });
    if (basis.in_single()) morph_wall(kernels, basis, movements, to);
}

}  // namespace harmorph
