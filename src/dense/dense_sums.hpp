// Sums of rows with the registers of one instruction set. dense_table.cpp compiles this file for
// each set. tests/dense/test_pivots.cpp covers this file.
#include "dense/dense_tiles.hpp"

namespace harmorph::dense::HARMORPH_SET {
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
    typedef Real Block16 __attribute__((vector_size(16), aligned(sizeof(Real)), may_alias));
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

}  // namespace
}  // namespace harmorph::dense::HARMORPH_SET
