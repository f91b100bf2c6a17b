#include "harmorph/morph/morph.hpp"

#include "harmorph/morph/product.hpp"

namespace harmorph {
namespace {

constexpr Index block_points = 1024;     // their sums stay in the first-level cache
constexpr Index least_range = 8192;      // points that are worth a thread
// As add_sums() does.
constexpr Real moved(Real from, Real by) noexcept { return by == 0 ? from : from + by; }

// The movements of numbers first .. first+width-1 of a row of values.
Movements movements_of(Basis const& basis, const Real* move, Index first, Index width) noexcept {
    Movements by = {};
    Index const n = basis.n_functions();
    Index plane = first / n, function = first % n;
    for (Index k = 0; k < width; ++k) {
        Vec2 const moved = moved_by(basis.kind(), plane, {move[2 * function], move[2 * function + 1]});
        by.x[k] = moved.x;
        by.y[k] = moved.y;
        if (++function < n) continue;
        function = 0;
        ++plane;
    }
    return by;
}

// Row p of `rows`, which follow one another, times the movements, is added to point p.
template <class Number>
void add_rows(Kernel kernel, Basis const& basis, const Number* rows, Index n, const Real* move,
              Sums const& to) noexcept {
    Index const row_length = basis.row_length();
    for (Index first = 0; first < row_length; first += Movements::most) {
        Index const width = smaller(Movements::most, row_length - first);
        Movements const by = movements_of(basis, move, first, width);
        multiply_rows(kernel, ValueRows<Number>{rows + first, row_length, n, width}, by, to);
    }
}

void prefetch(const Real* from, Index n) noexcept {
    for (Index i = 0; i < n; i += 8) __builtin_prefetch(from + i);
}

// Points begin .. begin+n-1, n <= block_points.
void morph_block(Kernel kernel, Basis const& basis, const Real* move, Points from, MutablePoints to, Index begin,
                 Index n) noexcept {
    constexpr Real zero[block_points] = {};
    Real x[block_points] = {}, y[block_points] = {};
    bool const in_rows = (!from.given() || from.stride == 1) && to.stride == 1;
    const Real* const from_x = from.given() ? from.x + begin : zero;
    const Real* const from_y = from.given() ? from.y + begin : zero;
    if (in_rows) {  // they come while the sums are computed
        prefetch(from_x, n);
        prefetch(from_y, n);
    }
    if (basis.in_single()) add_rows(kernel, basis, basis.single_row(begin), n, move, {x, y});
    else add_rows(kernel, basis, basis.row(begin), n, move, {x, y});
    if (in_rows) {
        add_sums(kernel, from_x, to.x + begin, x, n);
        add_sums(kernel, from_y, to.y + begin, y, n);
        return;
    }
    for (Index p = 0; p < n; ++p) {
        Vec2 const old = from.given() ? from[begin + p] : Vec2{};
        to.set(begin + p, {moved(old.x, x[p]), moved(old.y, y[p])});
    }
}

// In single storage the wall has not moved yet: its rows there are 0.
void morph_wall(Kernel kernel, Basis const& basis, const Real* move, MutablePoints to) noexcept {
    auto const move_point = [&](Index point, Index slot) {
        Vec2 const old = to[point];
        Vec2 sum;
        add_rows(kernel, basis, basis.row(slot), 1, move, {&sum.x, &sum.y});
        to.set(point, {moved(old.x, sum.x), moved(old.y, sum.y)});
    };
    for (Index slot = 0; slot < basis.wall_point.count(); ++slot) move_point(basis.wall_point[slot], slot);
    for (Index k = 0; k < basis.joined_point.count(); ++k) move_point(basis.joined_point[k], basis.joined_slot[k]);
}

}  // namespace

void morph(Basis const& basis, const Real* move, Points from, MutablePoints to, Executor const& executor) noexcept {
    Kernel const kernel = product_kernel(Offset{basis.n_points()} * basis.row_length());
    executor.for_ranges(basis.n_points(), least_range, [&](Index range_begin, Index range_end) {
        for (Index begin = range_begin; begin < range_end; begin += block_points) {
            morph_block(kernel, basis, move, from, to, begin, smaller(block_points, range_end - begin));
        }
    });
    if (basis.in_single()) morph_wall(kernel, basis, move, to);
}

}  // namespace harmorph
