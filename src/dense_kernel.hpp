// The dense kernels for one kind of vector register. A file that includes this has defined HARMORPH_KERNEL (a namespace),
// HARMORPH_TILE_ROWS, and in that namespace Registers<double> and Registers<float>: see dense_baseline.cpp. It has told the
// compiler which instructions it may use.
#include "dense_sums.hpp"

namespace harmorph::dense::HARMORPH_KERNEL {
namespace {

// to [n] = factor * from, n <= block; whole vectors are read.
template <class Number>
HARMORPH_INLINE void copy_scaled(Number* to, const Number* from, Number factor, Index n) noexcept {
    for (Index c = 0; c < n; c += lanes<Number>) {
        Vector<Number> const v = factor * load(from + c);
        if (n - c >= lanes<Number>) {
            store(to + c, v);
        } else {
            Registers<Number>::store_first(to + c, v, n - c);
        }
    }
}

// A diagonal block A beside a unit matrix. Elimination without roots turns [A | 1] into [D L^H | L^-1], A = L D L^H.
template <Index planes, class Number>
struct BlockBesideUnit {
    static constexpr Index width = 2 * block;
    Number at[block][planes][width + lanes<Number>];

    BlockBesideUnit(Block<Number> a, Index n) noexcept {
        for (Index r = 0; r < n; ++r) {
            for (Index plane = 0; plane < planes; ++plane) {
                Number* const row = at[r][plane];
                copy_scaled(row, a.data + r * a.length + plane * a.plane, Number{1}, block);
                for (Index c = block; c < width; ++c) row[c] = 0;
            }
            at[r][0][block + r] = 1;
        }
    }

    // row r -= conj(factor) * row k, where they differ from 0: from column r of A to column k of the unit matrix.
    HARMORPH_INLINE void subtract(Index r, Index k, Number real, Number imaginary) noexcept {
        for (Index c = r / lanes<Number> * lanes<Number>; c <= block + k; c += lanes<Number>) {
            Vector<Number> const re = load(at[k][0] + c);
            Vector<Number> to = load(at[r][0] + c) - real * re;
            if constexpr (planes == 2) {
                Vector<Number> const im = load(at[k][1] + c);
                to -= imaginary * im;
                store(at[r][1] + c, load(at[r][1] + c) - real * im + imaginary * re);
            }
            store(at[r][0] + c, to);
        }
    }
};

// Cholesky of a diagonal block, whose place the inverse of U^H takes. `sum`: of its rows, with no more than the block's own
// columns; their diagonals are not read. size: what those were summed of, without signs. Returns a pivot of which no more
// than `floor` is left, or none.
template <Index planes, class Number>
Index factor_block(Block<Number> a, Index n, Number (&sum)[planes][block], const Number (&size)[block], Number floor,
                   Number& least_left) noexcept {
    BlockBesideUnit<planes, Number> both(a, n);
    Number scale[block];
    for (Index k = 0; k < n; ++k) {
        Number pivot = sum[0][k], its_size = size[k];
        for (Index c = k + 1; c < n; ++c) {
            pivot -= both.at[k][0][c];
            its_size += magnitude(both.at[k][0][c]);
        }
        if (!(pivot > floor * its_size)) return k;
        if (pivot < least_left * its_size) least_left = pivot / its_size;
        Number const inverse = 1 / pivot;
        scale[k] = 1 / Registers<Number>::square_root(pivot);
        for (Index r = k + 1; r < n; ++r) {
            Number const real = both.at[k][0][r] * inverse, imaginary = planes == 2 ? both.at[k][planes - 1][r] * inverse : 0;
            both.subtract(r, k, real, imaginary);
            sum[0][r] -= real * sum[0][k];
            if constexpr (planes == 2) {
                sum[0][r] -= imaginary * sum[1][k];
                sum[1][r] -= real * sum[1][k] - imaginary * sum[0][k];
            }
        }
    }
    for (Index r = 0; r < n; ++r) {
        for (Index plane = 0; plane < planes; ++plane) {
            copy_scaled(a.data + r * a.length + plane * a.plane, both.at[r][plane] + block, scale[r], n);
        }
    }
    return none;
}

template <class Number>
struct Strip : Block<Number> {  // its first pivot's column is number 0
    Index n;
};

template <Index planes, class Number>
HARMORPH_INLINE Strip<Number> strip_of(Panel<Number> const& panel, Index first) noexcept {
    Offset const plane = panel.front - first;
    return {{panel.data + planes * strip_start(panel.front, first), planes * plane, plane},
            smaller(strip, panel.pivots - first)};
}

// Right-hand sides from a pivot's row on.
template <Index planes, class Number>
HARMORPH_INLINE Block<Number> sides(Number* y, Index row, Index pivot) noexcept {
    return {y + Offset{planes} * row * pivot, Offset{planes} * row, row};
}

constexpr Index packing_pays = 224;  // rows longer than this are copied before they are multiplied

}  // namespace

template <class Number, Index planes>
void take_off_earlier(Panel<Number> const& panel, Index first, Index from, Index to, Number* packing) noexcept {
    Strip<Number> const own = strip_of<planes>(panel, first);
    for (Index earlier = 0; earlier < first; earlier += strip) {
        Strip<Number> const above = strip_of<planes>(panel, earlier);
        subtract_packed<planes>({own.n, to - from, above.n}, above.at(0, first - earlier), above.at(0, from - earlier),
                                own.at(0, from - first), packing, from == first);
    }
}

template <class Number, Index planes>
void sum_tails(Panel<Number> const& panel, Index first, Index from, Index to, TailSums<Number>& tails) noexcept {
    Strip<Number> const own = strip_of<planes>(panel, first);
    for (Index r = from; r < to; ++r) {
        RowSum<planes, Number> const tail(own.at(r, own.n), panel.front - first - own.n);
        for (Index p = 0; p < planes; ++p) tails.sum[p][r] = tail.sum[p];
        tails.size[r] = tail.size;
    }
}

template <class Number, Index planes>
Index factor_diagonal(Panel<Number> const& panel, Index first, Number* sums, TailSums<Number>& tails, Number floor,
                      Number& least_left) noexcept {
    Strip<Number> const own = strip_of<planes>(panel, first);
    Number inner[planes][strip];  // sums of the rows within the strip's own columns
    for (Index p = 0; p < planes; ++p) {
        for (Index r = 0; r < own.n; ++r) inner[p][r] = sums[p * panel.front + first + r] - tails.sum[p][r];
    }
    for (Index k = 0; k < own.n; k += block) {
        Index const n = smaller(block, own.n - k), behind = own.n - k - n;
        Block<Number> const above = own.at(0, k), its = own.at(k, k);
        if (k > 0) subtract_product<Op::conjugate_transposed, planes>({n, own.n - k, k}, above, above, its);
        Number sum[planes][block], size[block];
        for (Index r = 0; r < n; ++r) {
            RowSum<planes, Number> const rest(its.at(r, n), behind);
            for (Index p = 0; p < planes; ++p) sum[p][r] = inner[p][k + r] - rest.sum[p];
            size[r] = magnitude(sums[first + k + r]) + tails.size[k + r] + rest.size;
        }
        Index const bad = factor_block<planes>(its, n, sum, size, floor, least_left);
        if (bad != none) return first + k + bad;
        apply_inverse<planes>(n, behind, its, its.at(0, n));
        eliminate_sums<planes>(its, n, behind, inner[0] + k, strip);
        eliminate_sums<planes>(its, n, behind, sums + first + k, panel.front);
    }
    return none;
}

template <class Number, Index planes>
void finish_columns(Panel<Number> const& panel, Index first, Index from, Index to, Number* sums) noexcept {
    Strip<Number> const own = strip_of<planes>(panel, first);
    Block<Number> const columns = own.at(0, from - first);
    for (Index k = 0; k < own.n; k += block) {
        Index const n = smaller(block, own.n - k);
        Block<Number> const its = columns.at(k, 0);
        if (k > 0) subtract_product<Op::conjugate_transposed, planes>({n, to - from, k}, own.at(0, k), columns, its);
        apply_inverse<planes>(n, to - from, own.at(k, k), its);
        subtract_sums<planes>(its, n, to - from, sums + first + k, sums + from, panel.front);
    }
}

template <class Number, Index planes>
void update_band(Panel<Number> const& panel, UpdateMatrix<Number> const& update, Index begin, const Number* sums,
                 Number* packing) noexcept {
    Offset const plane = padded(update.n - begin);  // padding may be written
    Block<Number> const d{update.data + planes * band_start(update.n, begin), planes * plane, plane};
    Index const rows = smaller(strip, update.n - begin);
    Number sum[planes][strip];
    for (Index p = 0; p < planes; ++p) {
        for (Index r = 0; r < rows; ++r) sum[p][r] = d.at(r, r).data[p * plane] + sums[p * panel.front + begin + r];
    }
    for (Index first = 0; first < panel.pivots; first += strip) {
        Strip<Number> const own = strip_of<planes>(panel, first);
        Block<Number> const columns = own.at(0, panel.pivots - first + begin);
        Shape const shape{rows, static_cast<Index>(plane), own.n};
        if (own.plane > packing_pays) {
            subtract_packed<planes>(shape, columns, columns, d, packing, true);
        } else {
            subtract_product<Op::conjugate_transposed, planes>(shape, columns, columns, d, true);
        }
    }
    for (Index p = 0; p < planes; ++p) {
        for (Index r = 0; r < rows; ++r) d.at(r, r).data[p * plane] = sum[p][r];
    }
}

template <class Number, Index planes>
void solve_strip_forward(Panel<Number> const& panel, Index first, Number* y, Index row) noexcept {
    Strip<Number> const own = strip_of<planes>(panel, first);
    Block<Number> const done = sides<planes>(y, row, first);
    for (Index k = 0; k < own.n; k += block) {
        Index const n = smaller(block, own.n - k);
        Block<Number> const its = done.at(k, 0);
        if (k > 0) subtract_product<Op::conjugate_transposed, planes>({n, row, k}, own.at(0, k), done, its);
        apply_inverse<planes>(n, row, own.at(k, k), its);
    }
}

template <class Number, Index planes>
void take_off_forward(Panel<Number> const& panel, Index first, Number* y, Index row, Index from, Index to) noexcept {
    Strip<Number> const own = strip_of<planes>(panel, first);
    subtract_product<Op::conjugate_transposed, planes>({to - from, row, own.n}, own.at(0, from - first),
                                                       sides<planes>(y, row, first), sides<planes>(y, row, from));
}

template <class Number, Index planes>
void take_off_backward(Panel<Number> const& panel, Index first, Number* y, Index row, Index from, Index to) noexcept {
    Strip<Number> const own = strip_of<planes>(panel, first);
    Index const known = first + own.n;
    subtract_product<Op::plain, planes>({to - from, row, panel.front - known}, own.at(from - first, own.n),
                                        sides<planes>(y, row, known), sides<planes>(y, row, from));
}

template <class Number, Index planes>
void solve_strip_backward(Panel<Number> const& panel, Index first, Number* y, Index row) noexcept {
    Strip<Number> const own = strip_of<planes>(panel, first);
    for (Index k = (own.n - 1) / block * block; k >= 0; k -= block) {
        Index const n = smaller(block, own.n - k);
        Block<Number> const its = sides<planes>(y, row, first + k);
        subtract_product<Op::plain, planes>({n, row, own.n - k - n}, own.at(k, k + n), its.at(n, 0), its);
        apply_inverse_transposed<planes>(n, row, own.at(k, k), its);
    }
}

#define HARMORPH_MAKE(Number, planes)                                                                                      \
    template void take_off_earlier<Number, planes>(Panel<Number> const&, Index, Index, Index, Number*) noexcept;           \
    template void sum_tails<Number, planes>(Panel<Number> const&, Index, Index, Index, TailSums<Number>&) noexcept;        \
    template Index factor_diagonal<Number, planes>(Panel<Number> const&, Index, Number*, TailSums<Number>&, Number,        \
                                                   Number&) noexcept;                                                      \
    template void finish_columns<Number, planes>(Panel<Number> const&, Index, Index, Index, Number*) noexcept;             \
    template void update_band<Number, planes>(Panel<Number> const&, UpdateMatrix<Number> const&, Index, const Number*,     \
                                              Number*) noexcept;                                                           \
    template void solve_strip_forward<Number, planes>(Panel<Number> const&, Index, Number*, Index) noexcept;               \
    template void take_off_forward<Number, planes>(Panel<Number> const&, Index, Number*, Index, Index, Index) noexcept;    \
    template void take_off_backward<Number, planes>(Panel<Number> const&, Index, Number*, Index, Index, Index) noexcept;   \
    template void solve_strip_backward<Number, planes>(Panel<Number> const&, Index, Number*, Index) noexcept;
HARMORPH_MAKE(double, 1)
HARMORPH_MAKE(double, 2)
HARMORPH_MAKE(float, 1)
HARMORPH_MAKE(float, 2)

}  // namespace harmorph::dense::HARMORPH_KERNEL
