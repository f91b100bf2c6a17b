// Factorisation and substitution of a front with the registers of one instruction set.
// dense_table.cpp compiles this file for each set. tests/dense/test_dense.cpp and
// tests/dense/test_pivots.cpp cover this file.
#include "dense/dense_sums.hpp"

namespace harmorph::dense::HARMORPH_SET {
namespace {

HARMORPH_INLINE double sqrt(double x) noexcept { return __builtin_sqrt(x); }

// A diagonal block A beside a unit matrix. Elimination without square roots turns [A | 1] into [D
// L^H | L^-1], where A = L D L^H.
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
    Real inner[planes][strip];  // These are the sums of the rows over the strip's own columns.
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
