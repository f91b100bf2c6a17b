// The products for one kind of vector register; see dense_kernel.hpp for what the including file defines, and here
// HARMORPH_LOAD_PART(from, n): the first n < HARMORPH_LANES numbers, and zeros.
#include "harmorph/product.hpp"

namespace harmorph::HARMORPH_KERNEL {
namespace {

constexpr Index lanes = HARMORPH_LANES;
constexpr Index sums = 8;                // partial sums of a point, in all kernels: number k goes to sum k modulo 8
constexpr Index vectors = sums / lanes;
constexpr Offset prefetch_ahead = 4096;  // bytes
constexpr Index tile_points = 4;         // of the transpose

typedef Real Vector __attribute__((vector_size(8 * HARMORPH_LANES), aligned(8), may_alias));
#define HARMORPH_INLINE inline __attribute__((always_inline))

HARMORPH_INLINE Vector& at(Real* numbers) noexcept { return *reinterpret_cast<Vector*>(numbers); }
HARMORPH_INLINE Vector const& at(const Real* numbers) noexcept { return *reinterpret_cast<const Vector*>(numbers); }

HARMORPH_INLINE void prefetch(const Real* values, Offset count) noexcept {
    const char* const from = reinterpret_cast<const char*>(values) + prefetch_ahead;
    for (Offset line = 0; line < 8 * count; line += 64) __builtin_prefetch(from + line);
}

// ((0+4)+(2+6)) + ((1+5)+(3+7)), whatever the width.
HARMORPH_INLINE Real total_of(const Vector* partial) noexcept {
    Real s[sums];
    for (Index v = 0; v < vectors; ++v) at(s + v * lanes) = partial[v];
    return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}

HARMORPH_INLINE void multiply_row(const Real* values, Index n, Movements const& by, Real& sum_x, Real& sum_y) noexcept {
    Vector x[vectors] = {}, y[vectors] = {};
    Index k = 0;
    for (; k + sums <= n; k += sums) {
        for (Index v = 0; v < vectors; ++v) {
            Vector const f = at(values + k + v * lanes);
            x[v] += f * at(by.x + k + v * lanes);
            y[v] += f * at(by.y + k + v * lanes);
        }
    }
    for (Index v = 0; v < vectors && k + v * lanes < n; ++v) {
        Index const here = k + v * lanes, left = n - here;
        Vector const f = left >= lanes ? at(values + here) : Vector(HARMORPH_LOAD_PART(values + here, left));
        x[v] += f * at(by.x + here);
        y[v] += f * at(by.y + here);
    }
    sum_x += total_of(x);
    sum_y += total_of(y);
}

template <Index points>
HARMORPH_INLINE void multiply_transposed(const Real* values, Offset row, Index n, const Vec2* by, Movements& total) noexcept {
    for (Index k = 0; k < n; k += lanes) {
        Vector x = at(total.x + k), y = at(total.y + k);
        for (Index p = 0; p < points; ++p) {
            const Real* const from = values + p * row + k;
            Vector const f = n - k >= lanes ? at(from) : Vector(HARMORPH_LOAD_PART(from, n - k));
            x += f * by[p].x;
            y += f * by[p].y;
        }
        at(total.x + k) = x;
        at(total.y + k) = y;
    }
}

}  // namespace

void multiply_rows(ValueRows const& rows, Movements const& by, Vec2* sum) noexcept {
    for (Index p = 0; p < rows.n_points; ++p) {
        const Real* const values = rows.values + p * rows.row;
        prefetch(values, rows.n_functions);
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
