// Factorisation and substitution of a front with the registers of one instruction set.
// dense.cpp compiles this file for each set. tests/dense/test_dense.cpp and
// tests/dense/test_pivots.cpp cover this file.

#include "dense/dense_tiles.hpp"

namespace harmorph::dense::HARMORPH_SET {

// Sums of rows with the registers of one instruction set.

namespace {

HARMORPH_INLINE Real magnitude(Real x) noexcept { return x < 0 ? -x : x; }
// Returns the absolute values: the sign bits are cleared.
HARMORPH_INLINE Vector magnitudes(Vector v) noexcept {
    using Words = Registers::Words;
    using Word = Registers::Word;
    return Vector(Words(v) & (~Word{0} >> 1));
}

// Returns the sum of a register's numbers.
HARMORPH_INLINE Real total(Vector v) noexcept {
    using Block16 [[gnu::vector_size(16), gnu::aligned(sizeof(Real)), gnu::may_alias]] = Real;
    constexpr Index per_block = static_cast<Index>(sizeof(Block16) / sizeof(Real));
    Real each[lanes];
    store(each, v);
    Block16 sum = *reinterpret_cast<const Block16*>(each);
    for (Index k = per_block; k < lanes; k += per_block)
        sum += *reinterpret_cast<const Block16*>(each + k);
    return sum[0] + sum[1];
}

// The sums of a few rows, and the sums of the magnitudes of their real parts.
template <Index planes, Index rows>
struct RowSums {
    Vector sum[planes][rows] = {}, size[rows] = {};

    // Adds the columns of the range, which begins with the first column of a slab.
    HARMORPH_INLINE void add(Slabs const& u, Index row, Range columns) noexcept {
        for (Index c = columns.begin; c < columns.end; c += slab) {
            const Real* const entries = u.at(row, c);
#pragma GCC unroll 8
            for (Index r = 0; r < rows; ++r) {
#pragma GCC unroll 8
                for (Index v = 0; v < slab; v += lanes) {
                    Vector const real = load(entries + r * step<planes> + v);
                    sum[0][r] += real;
                    size[r] += magnitudes(real);
                    if constexpr (planes == 2)
                        sum[1][r] += load(entries + r * step<planes> + slab + v);
                }
            }
        }
    }
};

// Calls take(row, sums, size) for each row of u. The sums extend over the columns `own` of u, and
// over all columns of `others` if `others` is not null.
template <Index planes, class Take>
HARMORPH_INLINE void sum_rows(Slabs const& u, Range rows, Range own, Slabs const* others,
                              Take const& take) noexcept {
    constexpr Index at_once = 4;
    auto const sum_some = [&](auto& sums, Index row, Index n) {
        sums.add(u, row, own);
        if (others != nullptr) sums.add(*others, row, {0, others->columns});
        for (Index r = 0; r < n; ++r) {
            Real sum[planes];
            for (Index p = 0; p < planes; ++p) sum[p] = total(sums.sum[p][r]);
            take(row + r, sum, total(sums.size[r]));
        }
    };
    Index row = rows.begin;
    for (; row + at_once <= rows.end; row += at_once) {
        RowSums<planes, at_once> sums;
        sum_some(sums, row, at_once);
    }
    for (; row < rows.end; ++row) {
        RowSums<planes, 1> sums;
        sum_some(sums, row, 1);
    }
}

// Computes sums [columns] -= U^H y with n rows of U, beginning at `row`; the columns begin with the
// first column of a slab. `plane` is the distance from real to imaginary parts in sums and in y.
template <Index planes>
void subtract_sums(Slabs const& u, Index row, Index n, Range columns, const Real* y, Real* sums,
                   Offset plane) noexcept {
    for (Index c = columns.begin; c < columns.end; c += lanes) {
        const Real* entries = u.at(row, c);
        Real* const to = sums + (c - columns.begin);
        Vector sum[planes];
        for (Index p = 0; p < planes; ++p) sum[p] = load(to + p * plane);
        for (Index r = 0; r < n; ++r, entries += step<planes>) {
            Vector const real = load(entries);
            sum[0] -= y[r] * real;
            if constexpr (planes == 2) {
                Vector const imaginary = load(entries + slab);
                sum[0] -= y[plane + r] * imaginary;
                sum[1] -= y[plane + r] * real - y[r] * imaginary;
            }
        }
        for (Index p = 0; p < planes; ++p) store(to + p * plane, sum[p]);
    }
}

// Eliminates the row sums of a diagonal block, which is replaced by its inverse already, and
// subtracts the products from the sums of the columns after the block.
template <Index planes>
void eliminate_sums(Slabs const& u, Index first, Index n, Index end, Real* sums,
                    Offset plane) noexcept {
    const Real* const inverse = u.at(first, first);
    for (Index r = n - 1; r >= 0; --r) {
        const Real* const row = inverse + r * step<planes>;
        Real sum[planes] = {};
        for (Index k = 0; k <= r; ++k) {
            sum[0] += row[k] * sums[k];
            if constexpr (planes == 2) {
                Real const imaginary = row[slab + k];
                sum[0] -= imaginary * sums[plane + k];
                sum[1] += row[k] * sums[plane + k] + imaginary * sums[k];
            }
        }
        for (Index p = 0; p < planes; ++p) sums[p * plane + r] = sum[p];
    }
    subtract_sums<planes>(u, first, n, {first + n, end}, sums, sums + n, plane);
}

HARMORPH_INLINE double sqrt(double x) noexcept { return __builtin_sqrt(x); }

// A diagonal block A beside a unit matrix. Elimination without square roots converts [A | 1] into
// [D L^H | L^-1], where A = L D L^H.
template <Index planes>
struct AugmentedBlock {
    static constexpr Index block = slab, width = 2 * block;
    Real at[block][planes][width];

    AugmentedBlock(const Real* a, Index n) noexcept {
        for (Index r = 0; r < n; ++r, a += step<planes>) {
            for (Index plane = 0; plane < planes; ++plane) {
                Real* const row = at[r][plane];
                for (Index c = 0; c < block; c += lanes) {
                    store(row + c, load(a + plane * block + c));
                    store(row + block + c, Vector{});
                }
            }
            at[r][0][block + r] = 1;
        }
    }

    // Subtracts conj(factor) times row k from row r, in column r of A to column k of the unit
    // matrix; all other entries of row k are 0.
    HARMORPH_INLINE void subtract(Index r, Index k, Real real, Real imaginary) noexcept {
        for (Index c = r / lanes * lanes; c <= block + k; c += lanes) {
            Vector const re = load(at[k][0] + c);
            Vector to = load(at[r][0] + c) - real * re;
            if constexpr (planes == 2) {
                Vector const im = load(at[k][1] + c);
                to -= imaginary * im;
                store(at[r][1] + c, load(at[r][1] + c) - real * im + imaginary * re);
            }
            store(at[r][0] + c, to);
        }
    }
};

// Factors a diagonal block of n <= slab pivots; the inverse of U^H replaces the block. `sum` has
// the row sums over the columns of the block; the diagonal entries are not read. `size` has the
// sums of the magnitudes of the same terms. Returns the first pivot that is not larger than `floor`
// times the sum of magnitudes, or none.
template <Index planes>
Index factor_block(Real* a, Index n, Real (&sum)[planes][slab], const Real (&size)[slab],
                   Real floor, Real& min_pivot_ratio) noexcept {
    AugmentedBlock<planes> augmented(a, n);
    Real scale[slab];
    for (Index k = 0; k < n; ++k) {
        Real pivot = sum[0][k], row_size = size[k];
        for (Index c = k + 1; c < n; ++c) {
            pivot -= augmented.at[k][0][c];
            row_size += magnitude(augmented.at[k][0][c]);
        }
        if (!(pivot > floor * row_size)) return k;
        if (pivot < min_pivot_ratio * row_size) min_pivot_ratio = pivot / row_size;
        Real const inverse = 1 / pivot;
        scale[k] = 1 / sqrt(pivot);
        for (Index r = k + 1; r < n; ++r) {
            Real const real = augmented.at[k][0][r] * inverse;
            Real const imaginary = planes == 2 ? augmented.at[k][planes - 1][r] * inverse : 0;
            augmented.subtract(r, k, real, imaginary);
            sum[0][r] -= real * sum[0][k];
            if constexpr (planes == 2) {
                sum[0][r] -= imaginary * sum[1][k];
                sum[1][r] -= real * sum[1][k] - imaginary * sum[0][k];
            }
        }
    }
    for (Index r = 0; r < n; ++r, a += step<planes>) {
        for (Index plane = 0; plane < planes; ++plane) {
            for (Index c = 0; c < slab; c += lanes) {
                store(a + plane * slab + c, scale[r] * load(augmented.at[r][plane] + slab + c));
            }
        }
    }
    return none;
}

// Returns the rows of the right-hand sides that begin with `row`.
template <Index planes>
HARMORPH_INLINE InRows<planes> right_hand_rows(Real* y, Index width, Index row) noexcept {
    return InRows<planes>{y, width}.at(row, 0);
}

template <Index planes>
void subtract_earlier(Slabs const& own, Slabs const& columns, Index first, Index end, Index from,
                      Index to) noexcept {
    bool const upper = own.data == columns.data;  // The columns may begin on the diagonal.
    for (Index k = 0; k < first; k += strip) {
        subtract_product<planes>(own, columns, columns, {k, k + strip}, {first, end}, {from, to},
                                 upper);
    }
}

template <Index planes>
void sum_tails(Panel const& panel, Index first, Index end, Index from, Index to,
               TailSums& tails) noexcept {
    Slabs const own = panel.own(), border = panel.border_columns();
    sum_rows<planes>(own, {from, to}, {end, own.columns}, &border,
                     [&](Index row, const Real* sum, Real size) {
                         for (Index p = 0; p < planes; ++p) tails.sum[p][row - first] = sum[p];
                         tails.size[row - first] = size;
                     });
}

template <Index planes>
Index factor_diagonal(Panel const& panel, Index first, Index end, Real* sums, TailSums& tails,
                      Real floor, Real& min_pivot_ratio) noexcept {
    Slabs const own = panel.own();
    Offset const plane = panel.sums_plane();
    Real inner[planes][strip];  // The sums of the rows over the strip's own columns.
    Index const padded_end = first + (end - first + slab - 1) / slab * slab;
    for (Index p = 0; p < planes; ++p) {
        for (Index r = first; r < end; ++r)
            inner[p][r - first] = sums[p * plane + r] - tails.sum[p][r - first];
        // The loops below compute with whole vectors. The lanes without a row are 0, so that they
        // raise no floating-point exception.
        for (Index r = end; r < padded_end; ++r) inner[p][r - first] = 0;
    }
    for (Index k = first; k < end; k += slab) {
        Index const n = min(slab, end - k), behind = end - k - n;
        if (k > first) subtract_product<planes>(own, own, own, {first, k}, {k, k + n}, {k, end});
        Real sum[planes][slab], size[slab];
        sum_rows<planes>(own, {k, k + n}, {k + n, end}, static_cast<Slabs const*>(nullptr),
                         [&](Index row, const Real* rest, Real row_size) {
                             for (Index p = 0; p < planes; ++p)
                                 sum[p][row - k] = inner[p][row - first] - rest[p];
                             size[row - k] =
                                 magnitude(sums[row]) + tails.size[row - first] + row_size;
                         });
        Index const bad = factor_block<planes>(own.at(k, k), n, sum, size, floor, min_pivot_ratio);
        if (bad != none) return k + bad;
        apply_inverse<planes>(own, k, n, behind, InSlabs<planes>{own, k, k + n});
        eliminate_sums<planes>(own, k, n, end, inner[0] + (k - first), strip);
        eliminate_sums<planes>(own, k, n, end, sums + k, plane);
    }
    return none;
}

template <Index planes>
void finish_columns(Panel const& panel, Slabs const& columns, Index first, Index end, Index from,
                    Index to, Real* sums, Real* column_sums) noexcept {
    Slabs const own = panel.own();
    for (Index c = from; c < to; c += tile_columns<planes>) {
        Range const tile{c, min(to, c + tile_columns<planes>)};
        for (Index k = first; k < end; k += slab) {
            Index const n = min(slab, end - k);
            if constexpr (planes == 1 &&
                          tile_rows<planes> == slab) {  // The whole tile stays in registers.
                if (n == slab) {
                    InSlabs<1> const above{columns, first, c}, block{columns, k, c};
                    any_finish_tile(tile.count(), own.at(first, k), above, k - first, own.at(k, k),
                                    block, sums + k, column_sums + c);
                    continue;
                }
            }
            if (k > first)
                subtract_product<planes>(own, columns, columns, {first, k}, {k, k + n}, tile);
            apply_inverse<planes>(own, k, n, tile.count(), InSlabs<planes>{columns, k, c});
            subtract_sums<planes>(columns, k, n, tile, sums + k, column_sums + c,
                                  panel.sums_plane());
        }
    }
}

template <Index planes>
void update_band(Panel const& panel, UpdateMatrix const& update, Index begin,
                 const Real* sums) noexcept {
    Slabs const border = panel.border_columns(), d = update.all();
    Index const end = min(update.n, begin + strip);
    Real sum[planes][strip];
    for (Index r = begin; r < end; ++r) {
        for (Index p = 0; p < planes; ++p) {
            sum[p][r - begin] = d.at(r, r)[p * slab] + sums[p * panel.sums_plane() + r];
        }
    }
    for (Index c = begin; c < update.n; c += chunk) {
        Range const columns{c, min(update.n, c + chunk)};
        for (Index k = 0; k < panel.pivots; k += strip) {
            subtract_product<planes>(border, border, d, {k, min(panel.pivots, k + strip)},
                                     {begin, end}, columns, true);
        }
    }
    for (Index r = begin; r < end; ++r) {
        for (Index p = 0; p < planes; ++p) d.at(r, r)[p * slab] = sum[p][r - begin];
    }
}

template <Index planes>
void solve_strip_forward(Slabs const& own, Index first, Index end, Real* y, Index row) noexcept {
    for (Index k = first; k < end; k += slab) {
        Index const n = min(slab, end - k);
        InRows<planes> const block = right_hand_rows<planes>(y, row, k);
        if (k > first)
            subtract_from_rows<planes>(own, right_hand_rows<planes>(y, row, first), block,
                                       {first, k}, {k, k + n});
        apply_inverse<planes>(own, k, n, row, block);
    }
}

template <Index planes>
void subtract_forward(Slabs const& columns, Index first, Index end, Real* y, Real* rest, Index row,
                      Index from, Index to) noexcept {
    subtract_from_rows<planes>(columns, right_hand_rows<planes>(y, row, first),
                               right_hand_rows<planes>(rest, row, from), {first, end}, {from, to});
}

template <Index planes>
void subtract_backward(Slabs const& columns, Index begin, Real* y, Real* rest, Index row,
                       Index from, Index to, Offset ahead) noexcept {
    for (Index k = begin; k < columns.columns; k += strip) {
        subtract_across<planes>(columns, {k, min(columns.columns, k + strip)}, {from, to},
                                right_hand_rows<planes>(rest, row, k),
                                right_hand_rows<planes>(y, row, from), ahead);
    }
}

template <Index planes>
void solve_strip_backward(Slabs const& own, Index first, Index end, Real* y, Index row,
                          Offset ahead) noexcept {
    for (Index k = first + (end - 1 - first) / slab * slab; k >= first; k -= slab) {
        Index const n = min(slab, end - k);
        InRows<planes> const block = right_hand_rows<planes>(y, row, k);
        prefetch_rows<planes>(own.at(k, k) + ahead, n);
        if (k + n < end)
            subtract_across<planes>(own, {k + n, end}, {k, k + n}, block.at(n, 0), block, ahead);
        apply_inverse_transposed<planes>(n, own.at(k, k), block);
    }
}

template <Index planes>
constexpr FrontKernels<planes> front_kernels{
    subtract_earlier<planes>, sum_tails<planes>,         factor_diagonal<planes>,
    finish_columns<planes>,   update_band<planes>,       solve_strip_forward<planes>,
    subtract_forward<planes>, subtract_backward<planes>, solve_strip_backward<planes>,
};

}  // namespace
}  // namespace harmorph::dense::HARMORPH_SET

namespace harmorph::simd {
template <Index planes>
inline constexpr const dense::FrontKernels<planes>*
    table<dense::FrontKernels<planes>, Kernel::HARMORPH_SET> =
        &dense::HARMORPH_SET::front_kernels<planes>;
}  // namespace harmorph::simd

namespace harmorph::dense::HARMORPH_SET {

// Moves of numbers between fronts, and between fronts and the caller's rows, with the registers of
// one instruction set.

namespace {

// The columns of a child front that are added to one vector of the parent front:
// neighbours in the child, where they lie in one vector or in two.
struct Source {
    Real* first;
    Real* second;
    Registers::Picks picks;

    // Takes the columns from <= j < to, whose targets are in the vector that begins at column
    // `begin`.
    Source(Slabs const& child, Index from, Index to, const Index* target, Index begin) noexcept {
        Index const column = from / lanes * lanes;
        Index picked[lanes];
        for (Index lane = 0; lane < lanes; ++lane) picked[lane] = none;
        for (Index j = from; j < to; ++j) picked[target[j] - begin] = j - column;
        first = child.at(0, column);
        second = to > column + lanes ? child.at(0, column + lanes) : first;
        picks = Registers::picks_of(picked);
    }
};

// Adds the rows from <= i < to of the child to the rows target[i] of the vector at `into`. Lanes of
// the vector without a source keep their numbers.
template <Index planes>
HARMORPH_INLINE void add_column(Source const& from, const Index* target, Range rows,
                                Real* into) noexcept {
    for (Index i = rows.begin; i < rows.end; ++i) {
        Offset const at = i * step<planes>;
        Real* const to = into + target[i] * step<planes>;
        for (Index p = 0; p < planes; ++p) {
            Offset const plane = p * slab;
            Vector const added = Registers::pick(load(from.first + at + plane),
                                                 load(from.second + at + plane), from.picks);
            store(to + plane, load(to + plane) + added);
        }
    }
}

// Adds whole vectors: entries below the diagonal change, too, but they are never used.
template <Index planes>
void add_front(Slabs const& from, const Index* target, Panel const& panel,
               Slabs const& update) noexcept {
    Slabs const own = panel.own(), border = panel.border_columns();
    Index j = 0;
    while (j < from.columns && target[j] < panel.pivots) {
        Index const begin = target[j] / lanes * lanes;
        Index const end = min(begin + lanes, panel.pivots);
        Index to = j + 1;
        while (to < from.columns && target[to] < end) ++to;
        add_column<planes>(Source(from, j, to, target, begin), target, {0, to}, own.at(0, begin));
        j = to;
    }
    Index const pivots = j;
    while (j < from.columns) {
        Index const begin = (target[j] - panel.pivots) / lanes * lanes;
        Index to = j + 1;
        while (to < from.columns && target[to] < panel.pivots + begin + lanes) ++to;
        Source const columns(from, j, to, target, panel.pivots + begin);
        add_column<planes>(columns, target, {0, pivots}, border.at(0, begin));
        add_column<planes>(columns, target, {pivots, to},
                           update.at(0, begin) - panel.pivots * step<planes>);
        j = to;
    }
}

// Copies the n numbers at `from` to `to`: as many at a time as a register has, and the rest by half
// as many at a time, repeatedly.
template <Index at_once = lanes>
HARMORPH_INLINE void copy_run(const Real* from, Index n, Real* to) noexcept {
    using Reals
        [[gnu::vector_size(at_once * sizeof(Real)), gnu::aligned(sizeof(Real)), gnu::may_alias]] =
            Real;
    Index i = 0;
    for (; i + at_once <= n; i += at_once)
        *reinterpret_cast<Reals*>(to + i) = *reinterpret_cast<const Reals*>(from + i);
    if constexpr (at_once > 1) copy_run<at_once / 2>(from + i, n - i, to + i);
}

// Clears the last `slab` numbers, which may be padding. The number `slab` is a constant, because
// compilers call memset for a variable one.
HARMORPH_INLINE void clear_last(Real* end) noexcept {
    for (Index i = 1; i <= slab; ++i) end[-i] = 0;
}

HARMORPH_INLINE Real* row_at(Real* data, const Index* row_of, Offset length,
                             Index position) noexcept {
    return data + (row_of != nullptr ? row_of[position] : position) * length;
}

// Rows of values are read in an irregular order, so the row that follows at this distance is
// prefetched.
constexpr Index rows_ahead = 16;

HARMORPH_INLINE void prefetch_row(const Real* row, Offset numbers) noexcept {
    constexpr Offset line = 64 / sizeof(Real);
    for (Offset i = 0; i < numbers; i += line) __builtin_prefetch(row + i);
}

void extend_add(UpdateMatrix const& from, const Index* targets, Panel const& panel,
                UpdateMatrix const& update) noexcept {
    if (from.planes == 2) add_front<2>(from.all(), targets, panel, update.all());
    else add_front<1>(from.all(), targets, panel, update.all());
}

void add_rows(Index n, const Real* from, const Index* targets, Real* y, Index length) noexcept {
    for (Index r = 0; r < n; ++r, from += length) {
        Real* const to = y + Offset{targets[r]} * length;
        for (Index c = 0; c < length; c += lanes) store(to + c, load(to + c) + load(from + c));
    }
}

void copy_rows(Index n, const Real* y, const Index* targets, Real* to, Index length) noexcept {
    for (Index r = 0; r < n; ++r, to += length) {
        const Real* const from = y + Offset{targets[r]} * length;
        for (Index c = 0; c < length; c += lanes) store(to + c, load(from + c));
    }
}

void gather(harmorph::Rows const& from, Index begin, Index n, Index behind, Real* y, Index row,
            Index planes) noexcept {
    auto const values = [&](Index k) {
        return row_at(from.data, from.row_of, from.row_length, begin + k);
    };
    Offset const numbers = (planes - 1) * from.plane + from.width;
    for (Index k = 0; k < n; ++k) {
        if (k + rows_ahead < n + behind) prefetch_row(values(k + rows_ahead), numbers);
        const Real* value = values(k);
        for (Index plane = 0; plane < planes; ++plane, value += from.plane, y += row) {
            if (from.width < row) clear_last(y + row);
            copy_run(value, from.width, y);
        }
    }
}

void scatter(const Real* y, Index row, Index planes, harmorph::Rows const& to, Index begin,
             Index n) noexcept {
    for (Index k = 0; k < n; ++k) {
        Real* value = row_at(to.data, to.row_of, to.row_length, begin + k);
        for (Index plane = 0; plane < planes; ++plane, value += to.plane, y += row)
            copy_run(y, to.width, value);
    }
}

constexpr MoveKernels move_kernels{extend_add, add_rows, copy_rows, gather, scatter};

}  // namespace
}  // namespace harmorph::dense::HARMORPH_SET

namespace harmorph::simd {
template <>
inline constexpr const dense::MoveKernels* table<dense::MoveKernels, Kernel::HARMORPH_SET> =
    &dense::HARMORPH_SET::move_kernels;
}  // namespace harmorph::simd
