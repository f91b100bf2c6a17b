// The products for one kind of vector register; see dense_kernel.hpp for what the including file defines, and here
// HARMORPH_LOAD_PART(from, n): the first n < HARMORPH_LANES numbers, and zeros.
#include "harmorph/product.hpp"

namespace harmorph::HARMORPH_KERNEL {
namespace {

constexpr Index lanes = HARMORPH_LANES;
constexpr Index sums = 8;                // partial sums of a point, in all kernels: number k goes to sum k modulo 8
constexpr Index vectors = sums / lanes;
constexpr Offset prefetch_ahead = 4096;  // bytes
constexpr Index tile_points = 4;         // prefetched together, and in the transpose also added together

typedef Real Vector __attribute__((vector_size(8 * HARMORPH_LANES), aligned(8), may_alias));
typedef Real Two __attribute__((vector_size(16), aligned(8), may_alias));
#define HARMORPH_INLINE inline __attribute__((always_inline))

// Never references to vectors: clang forgets then that they may begin at any number.
HARMORPH_INLINE Vector load(const Real* from) noexcept { return *reinterpret_cast<const Vector*>(from); }
HARMORPH_INLINE void store(Real* to, Vector v) noexcept { *reinterpret_cast<Vector*>(to) = v; }

HARMORPH_INLINE void prefetch(const Real* values, Offset count) noexcept {
    const char* const from = reinterpret_cast<const char*>(values) + prefetch_ahead;
    for (Offset line = 0; line < 8 * count; line += 64) __builtin_prefetch(from + line);
}

// ((0+4)+(2+6)) + ((1+5)+(3+7)), whatever the width.
HARMORPH_INLINE Real total_of(const Vector* partial) noexcept {
    Real s[sums];
    for (Index v = 0; v < vectors; ++v) store(s + v * lanes, partial[v]);
    auto const pair = [&](Index k) -> Two { return *reinterpret_cast<const Two*>(s + k); };
    Two const both = (pair(0) + pair(4)) + (pair(2) + pair(6));
    return both[0] + both[1];
}

HARMORPH_INLINE void multiply_row(const Real* values, Index n, Movements const& by, Real& sum_x, Real& sum_y) noexcept {
    Vector x[vectors] = {}, y[vectors] = {};
    Index k = 0;
    for (; k + sums <= n; k += sums) {
        for (Index v = 0; v < vectors; ++v) {
            Vector const f = load(values + k + v * lanes);
            x[v] += f * load(by.x + k + v * lanes);
            y[v] += f * load(by.y + k + v * lanes);
        }
    }
    for (Index v = 0; v < vectors && k + v * lanes < n; ++v) {
        Index const here = k + v * lanes, left = n - here;
        Vector const f = left >= lanes ? load(values + here) : Vector(HARMORPH_LOAD_PART(values + here, left));
        x[v] += f * load(by.x + here);
        y[v] += f * load(by.y + here);
    }
    sum_x += total_of(x);
    sum_y += total_of(y);
}

template <Index points>
HARMORPH_INLINE void multiply_transposed(const Real* values, Offset row, Index n, const Vec2* by, Movements& total) noexcept {
    for (Index k = 0; k < n; k += lanes) {
        Vector x = load(total.x + k), y = load(total.y + k);
        for (Index p = 0; p < points; ++p) {
            const Real* const from = values + p * row + k;
            Vector const f = n - k >= lanes ? load(from) : Vector(HARMORPH_LOAD_PART(from, n - k));
            x += f * by[p].x;
            y += f * by[p].y;
        }
        store(total.x + k, x);
        store(total.y + k, y);
    }
}

}  // namespace

void multiply_rows(ValueRows const& rows, Movements const& by, Vec2* sum) noexcept {
    for (Index p = 0; p < rows.n_points; ++p) {
        const Real* const values = rows.values + p * rows.row;
        if (p % tile_points == 0) prefetch(values, tile_points * rows.row);
        multiply_row(values, rows.n_functions, by, sum[p].x, sum[p].y);
    }
}

void multiply_rows_transposed(ValueRows const& rows, const Vec2* by, Movements& total) noexcept {
    Index p = 0;
    for (; p + tile_points <= rows.n_points; p += tile_points) {
        const Real* const values = rows.values + p * rows.row;
        prefetch(values, tile_points * rows.row);
        multiply_transposed<tile_points>(values, rows.row, rows.n_functions, by + p, total);
    }
    for (; p < rows.n_points; ++p) {
        multiply_transposed<1>(rows.values + p * rows.row, rows.row, rows.n_functions, by + p, total);
    }
}

}  // namespace harmorph::HARMORPH_KERNEL
