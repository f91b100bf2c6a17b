// The products for one kind of vector register; see dense_kernel.hpp for what the including file defines, and here
// HARMORPH_LOAD_PART(from, n): the first n < HARMORPH_LANES numbers, and zeros; HARMORPH_LOAD_SINGLE_PART(from, n): the
// same in single precision.
#include "harmorph/product.hpp"

namespace harmorph::HARMORPH_KERNEL {
namespace {

constexpr Index lanes = HARMORPH_LANES;
constexpr Index sums = 8;                // partial sums of a point, in all kernels: number k goes to sum k modulo 8
constexpr Index vectors = sums / lanes;
constexpr Offset prefetch_ahead = 4096;  // bytes
constexpr Index tile_points = 4;         // prefetched together, and in the transpose also added together

typedef Real Vector __attribute__((vector_size(8 * HARMORPH_LANES), aligned(8), may_alias));
typedef float Singles __attribute__((vector_size(4 * HARMORPH_LANES), aligned(4), may_alias));
typedef Real Two __attribute__((vector_size(16), aligned(8), may_alias));
typedef std::uint64_t Integers __attribute__((vector_size(8 * HARMORPH_LANES), aligned(8), may_alias));
#define HARMORPH_INLINE inline __attribute__((always_inline))

// Never references to vectors: clang forgets then that they may begin at any number.
HARMORPH_INLINE Vector load(const Real* from) noexcept { return *reinterpret_cast<const Vector*>(from); }
HARMORPH_INLINE Vector load(const float* from) noexcept {
    return __builtin_convertvector(*reinterpret_cast<const Singles*>(from), Vector);
}
HARMORPH_INLINE Vector load_part(const Real* from, Index n) noexcept { return Vector(HARMORPH_LOAD_PART(from, n)); }
HARMORPH_INLINE Vector load_part(const float* from, Index n) noexcept {
    return __builtin_convertvector(Singles(HARMORPH_LOAD_SINGLE_PART(from, n)), Vector);
}
HARMORPH_INLINE void store(Real* to, Vector v) noexcept { *reinterpret_cast<Vector*>(to) = v; }

template <class Number>
HARMORPH_INLINE void prefetch(const Number* values, Offset count) noexcept {
    const char* const from = reinterpret_cast<const char*>(values) + prefetch_ahead;
    Offset const bytes = static_cast<Offset>(sizeof(Number)) * count;
    for (Offset line = 0; line < bytes; line += 64) __builtin_prefetch(from + line);
}

// ((0+4)+(2+6)) + ((1+5)+(3+7)), whatever the width.
HARMORPH_INLINE Real total_of(const Vector* partial) noexcept {
    Real s[sums];
    for (Index v = 0; v < vectors; ++v) store(s + v * lanes, partial[v]);
    auto const pair = [&](Index k) -> Two { return *reinterpret_cast<const Two*>(s + k); };
    Two const both = (pair(0) + pair(4)) + (pair(2) + pair(6));
    return both[0] + both[1];
}

template <class Number>
HARMORPH_INLINE void multiply_row(const Number* values, Index n, Movements const& by, Real& sum_x,
                                  Real& sum_y) noexcept {
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
        Vector const f = left >= lanes ? load(values + here) : load_part(values + here, left);
        x[v] += f * load(by.x + here);
        y[v] += f * load(by.y + here);
    }
    sum_x += total_of(x);
    sum_y += total_of(y);
}

HARMORPH_INLINE Integers load(const std::uint64_t* from) noexcept {
    return *reinterpret_cast<const Integers*>(from);
}
HARMORPH_INLINE void store(std::uint64_t* to, Integers v) noexcept { *reinterpret_cast<Integers*>(to) = v; }

// The bits of numbers rounded to FixedSum's grids: multiples of the unit, above the grid's own bits.
HARMORPH_INLINE Integers coarse_bits(Vector t) noexcept {
    return reinterpret_cast<Integers>(t + FixedSum::coarse_grid);
}
HARMORPH_INLINE Integers fine_bits(Vector t) noexcept {
    Vector const coarse = (t + FixedSum::coarse_grid) - FixedSum::coarse_grid;
    return reinterpret_cast<Integers>((t - coarse) + FixedSum::fine_grid);
}

template <Index points, class Number>
HARMORPH_INLINE void multiply_transposed(const Number* values, Offset row, Index n, const Vec2* by,
                                         FixedSums& total) noexcept {
    for (Index k = 0; k < n; k += lanes) {
        Integers coarse_x = load(total.coarse_x + k), coarse_y = load(total.coarse_y + k);
        Integers fine_x = load(total.fine_x + k), fine_y = load(total.fine_y + k);
        for (Index p = 0; p < points; ++p) {
            const Number* const from = values + p * row + k;
            Vector const f = n - k >= lanes ? load(from) : load_part(from, n - k);
            Vector const x = f * by[p].x, y = f * by[p].y;
            coarse_x += coarse_bits(x);
            fine_x += fine_bits(x);
            coarse_y += coarse_bits(y);
            fine_y += fine_bits(y);
        }
        store(total.coarse_x + k, coarse_x);
        store(total.coarse_y + k, coarse_y);
        store(total.fine_x + k, fine_x);
        store(total.fine_y + k, fine_y);
    }
}

// The grids' bits of all points, in whole vectors as they were added.
HARMORPH_INLINE void take_off_grids(Index n_points, Index n, FixedSums& total) noexcept {
    std::uint64_t const times = static_cast<std::uint64_t>(n_points);
    std::uint64_t const coarse = times * bits_of(FixedSum::coarse_grid);
    std::uint64_t const fine = times * bits_of(FixedSum::fine_grid);
    for (Index k = 0; k < (n + lanes - 1) / lanes * lanes; ++k) {
        total.coarse_x[k] -= coarse;
        total.coarse_y[k] -= coarse;
        total.fine_x[k] -= fine;
        total.fine_y[k] -= fine;
    }
}

template <class Number>
HARMORPH_INLINE void multiply_all(ValueRows<Number> const& rows, Movements const& by, Vec2* sum) noexcept {
    for (Index p = 0; p < rows.n_points; ++p) {
        const Number* const values = rows.values + p * rows.row;
        if (p % tile_points == 0) prefetch(values, tile_points * rows.row);
        multiply_row(values, rows.n_functions, by, sum[p].x, sum[p].y);
    }
}

template <class Number>
HARMORPH_INLINE void multiply_all_transposed(ValueRows<Number> const& rows, const Vec2* by, FixedSums& total) noexcept {
    Index p = 0;
    for (; p + tile_points <= rows.n_points; p += tile_points) {
        const Number* const values = rows.values + p * rows.row;
        prefetch(values, tile_points * rows.row);
        multiply_transposed<tile_points>(values, rows.row, rows.n_functions, by + p, total);
    }
    for (; p < rows.n_points; ++p) {
        multiply_transposed<1>(rows.values + p * rows.row, rows.row, rows.n_functions, by + p, total);
    }
    take_off_grids(rows.n_points, rows.n_functions, total);
}

}  // namespace

void multiply_rows(ValueRows<Real> const& rows, Movements const& by, Vec2* sum) noexcept {
    multiply_all(rows, by, sum);
}
void multiply_rows(ValueRows<float> const& rows, Movements const& by, Vec2* sum) noexcept {
    multiply_all(rows, by, sum);
}

void multiply_rows_transposed(ValueRows<Real> const& rows, const Vec2* by, FixedSums& total) noexcept {
    multiply_all_transposed(rows, by, total);
}
void multiply_rows_transposed(ValueRows<float> const& rows, const Vec2* by, FixedSums& total) noexcept {
    multiply_all_transposed(rows, by, total);
}

}  // namespace harmorph::HARMORPH_KERNEL
