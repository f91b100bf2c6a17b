// Flows between unknowns for one kind of vector register; see dense_kernel.hpp for what the including file defines, and
// here HARMORPH_LOAD_PART(from, n): the first n <= HARMORPH_LANES numbers, and zeros; HARMORPH_STORE_PART(to, n, v):
// the first n. A column's arithmetic is the same in all kernels, and so are its bits.
#include "harmorph/residual.hpp"

namespace harmorph::HARMORPH_KERNEL {
namespace {

constexpr Index lanes = HARMORPH_LANES;
constexpr Index block = 8;  // columns at a time
constexpr Index vectors = block / lanes;

typedef Real Vector __attribute__((vector_size(8 * HARMORPH_LANES), aligned(8), may_alias));
#define HARMORPH_INLINE inline __attribute__((always_inline))

// A row of a block: all of it, or its first n columns.
template <bool whole>
struct Row {
    Index n;

    HARMORPH_INLINE Index left(Index v) const noexcept {
        Index const n_left = n - v * lanes;
        return n_left < 0 ? 0 : n_left < lanes ? n_left : lanes;
    }
    HARMORPH_INLINE Vector load(const Real* from, Index v) const noexcept {
        from += v * lanes;
        if (whole) return *reinterpret_cast<const Vector*>(from);
        return Vector(HARMORPH_LOAD_PART(from, left(v)));
    }
    HARMORPH_INLINE void store(Real* to, Index v, Vector numbers) const noexcept {
        to += v * lanes;
        if (whole) {
            *reinterpret_cast<Vector*>(to) = numbers;
        } else {
            HARMORPH_STORE_PART(to, left(v), numbers);
        }
    }
};

template <Index planes, bool whole>
void add_block(Matrix const& matrix, Lines const& lines, Index first, Row<whole> const row, Real* value, Index width,
               Real* squares) noexcept {
    Offset const plane = lines.columns(matrix), row_length = Offset{planes} * width;
    Vector sum[vectors] = {};
    for (Index i = 0; i < matrix.n; ++i) {
        const Real* const at = lines.at(i) + first;
        Real* const to = value + i * row_length;
        Vector own[planes][vectors], rest[planes][vectors];
        for (Index p = 0; p < planes; ++p) {
            for (Index v = 0; v < vectors; ++v) {
                own[p][v] = row.load(at + p * plane, v);
                rest[p][v] = row.load(to + p * width, v);
            }
        }
        for (Offset e = matrix.start[i]; e < matrix.start[i + 1]; ++e) {
            const Real* const other = lines.at(matrix.column[e]) + first;
            Real* const its = value + matrix.column[e] * row_length;
            Real const re = matrix.value[e];
            for (Index v = 0; v < vectors; ++v) {
                Vector const rise = row.load(other, v) - own[0][v];
                if constexpr (planes == 1) {
                    Vector const flow = rise * re;
                    rest[0][v] -= flow;
                    row.store(its, v, row.load(its, v) + flow);
                } else {
                    Real const im = matrix.imaginary[e];
                    Vector const turned = row.load(other + plane, v) - own[1][v];
                    Vector const along = rise * re, across = turned * im;
                    Vector const turned_along = turned * re, turned_across = rise * im;
                    rest[0][v] -= along - across;
                    rest[1][v] -= turned_along + turned_across;
                    row.store(its, v, row.load(its, v) + (along + across));
                    row.store(its + width, v, row.load(its + width, v) + (turned_along - turned_across));
                }
            }
        }
        for (Index p = 0; p < planes; ++p) {
            for (Index v = 0; v < vectors; ++v) {
                row.store(to + p * width, v, rest[p][v]);
                sum[v] += rest[p][v] * rest[p][v];
            }
        }
    }
    for (Index v = 0; v < vectors; ++v) row.store(squares, v, sum[v]);
}

template <Index planes>
void add_blocks(Matrix const& matrix, Lines const& lines, Index first, Index n, Real* value, Index width,
                Real* squares) noexcept {
    for (Index k = 0; k < n; k += block) {
        if (n - k >= block) {
            add_block<planes>(matrix, lines, first + k, Row<true>{block}, value + k, width, squares + k);
        } else {
            add_block<planes>(matrix, lines, first + k, Row<false>{n - k}, value + k, width, squares + k);
        }
    }
}

}  // namespace

void add_inner_flows(Matrix const& matrix, Lines const& lines, Index first, Index n, Real* value, Index width,
                     Real* squares) noexcept {
    if (matrix.is_complex()) return add_blocks<2>(matrix, lines, first, n, value, width, squares);
    add_blocks<1>(matrix, lines, first, n, value, width, squares);
}

}  // namespace harmorph::HARMORPH_KERNEL
