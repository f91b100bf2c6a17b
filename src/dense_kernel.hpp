// The one product behind all dense kernels: D = D - op(A) B or D = op(A) B, tile by tile in vector registers. The file that
// includes this says how wide the registers are (HARMORPH_LANES numbers) and how many there are.
#pragma once

#include "harmorph/dense.hpp"
#include "harmorph/scalar.hpp"

namespace harmorph::dense {
namespace {

constexpr Index lanes = HARMORPH_LANES;
constexpr Index tile_rows = HARMORPH_TILE_ROWS;
constexpr Index tile_vectors = HARMORPH_TILE_VECTORS;
constexpr Index tile_columns = lanes * tile_vectors;

// Vectors that may begin at any number.
typedef Real Vector __attribute__((vector_size(8 * HARMORPH_LANES), aligned(8), may_alias));
#define HARMORPH_INLINE inline __attribute__((always_inline))

HARMORPH_INLINE Vector load(const Real* from) noexcept { return *reinterpret_cast<const Vector*>(from); }
HARMORPH_INLINE void store(Real* to, Vector v) noexcept { *reinterpret_cast<Vector*>(to) = v; }
HARMORPH_INLINE Vector spread(Real x) noexcept { return x - Vector{}; }

// A is read transposed (element (k, r) at a[k * row + r]) or plainly (element (r, k) at a[r * row + k]).
enum class Op { transposed, plain };
enum class Store { subtract, set };

struct Source {
    const Real* a;
    Offset a_row;
    const Real* b;
    Offset b_row;
    Index from, to;  // the summation index k
};

struct Target {
    Real* d;
    Offset row;
    Index columns;  // valid ones in a tile; the rest is computed and thrown away
};

template <Op op, Store how, Index rows, Index vectors>
HARMORPH_INLINE void tile(Source const& s, Target const& t) noexcept {
    Vector sum[rows][vectors] = {};
    for (Index k = s.from; k < s.to; ++k) {
        Vector b[vectors];
        for (Index v = 0; v < vectors; ++v) b[v] = load(s.b + k * s.b_row + v * lanes);
        for (Index r = 0; r < rows; ++r) {
            Vector const a = spread(op == Op::transposed ? s.a[k * s.a_row + r] : s.a[r * s.a_row + k]);
            for (Index v = 0; v < vectors; ++v) sum[r][v] += a * b[v];
        }
    }
    for (Index r = 0; r < rows; ++r) {
        for (Index v = 0; v < vectors; ++v) {
            Real* const to = t.d + r * t.row + v * lanes;
            if ((v + 1) * lanes <= t.columns) {
                store(to, how == Store::subtract ? load(to) - sum[r][v] : sum[r][v]);
            } else {
                for (Index lane = 0; lane < t.columns - v * lanes; ++lane) {
                    to[lane] = how == Store::subtract ? to[lane] - sum[r][v][lane] : sum[r][v][lane];
                }
            }
        }
    }
}

template <Op op, Store how, Index rows>
HARMORPH_INLINE void tile_of_rows(Source const& s, Target const& t) noexcept {
    static_assert(tile_vectors == 3, "one case for each number of vectors");
    if (t.columns > 2 * lanes) return tile<op, how, rows, 3>(s, t);
    if (t.columns > lanes) return tile<op, how, rows, 2>(s, t);
    return tile<op, how, rows, 1>(s, t);
}

template <Op op, Store how>
void any_tile(Index rows, Source const& s, Target const& t) noexcept {
    switch (rows) {
        case 1: return tile_of_rows<op, how, 1>(s, t);
        case 2: return tile_of_rows<op, how, 2>(s, t);
        case 3: return tile_of_rows<op, how, 3>(s, t);
        case 4: return tile_of_rows<op, how, 4>(s, t);
#if HARMORPH_TILE_ROWS == 8
        case 5: return tile_of_rows<op, how, 5>(s, t);
        case 6: return tile_of_rows<op, how, 6>(s, t);
        case 7: return tile_of_rows<op, how, 7>(s, t);
        case 8: return tile_of_rows<op, how, 8>(s, t);
#endif
        default: return;
    }
}

struct Shape {
    Index rows, columns, depth;
};

// D [rows x columns] -= op(A) B.
template <Op op>
void subtract_product(Shape shape, const Real* a, Offset a_row, const Real* b, Offset b_row, Real* d, Offset d_row) noexcept {
    for (Index c = 0; c < shape.columns; c += tile_columns) {
        for (Index r = 0; r < shape.rows; r += tile_rows) {
            Source const source{op == Op::transposed ? a + r : a + r * a_row, a_row, b + c, b_row, 0, shape.depth};
            any_tile<op, Store::subtract>(smaller(tile_rows, shape.rows - r), source,
                                          {d + r * d_row + c, d_row, smaller(tile_columns, shape.columns - c)});
        }
    }
}

// b [n x columns] = inverse^T b, inverse upper triangular: row r needs rows <= r, so the last rows go first.
void apply_inverse_transposed(Index n, Index columns, const Real* inverse, Offset inverse_row, Real* b, Offset b_row) noexcept {
    for (Index c = 0; c < columns; c += tile_columns) {
        for (Index r = (n - 1) / tile_rows * tile_rows; r >= 0; r -= tile_rows) {
            Index const rows = smaller(tile_rows, n - r);
            any_tile<Op::transposed, Store::set>(rows, {inverse + r, inverse_row, b + c, b_row, 0, r + rows},
                                                 {b + r * b_row + c, b_row, smaller(tile_columns, columns - c)});
        }
    }
}

// b [n x columns] = inverse b: row r needs rows >= r, so the first rows go first.
void apply_inverse(Index n, Index columns, const Real* inverse, Offset inverse_row, Real* b, Offset b_row) noexcept {
    for (Index c = 0; c < columns; c += tile_columns) {
        for (Index r = 0; r < n; r += tile_rows) {
            any_tile<Op::plain, Store::set>(smaller(tile_rows, n - r),
                                            {inverse + r * inverse_row, inverse_row, b + c, b_row, r, n},
                                            {b + r * b_row + c, b_row, smaller(tile_columns, columns - c)});
        }
    }
}

// Cholesky of a diagonal block, and then the inverse of its factor in its place. Returns a pivot that fails, or none.
Index factor_block(Real* a, Offset row, Index n, Real floor) noexcept {
    Real least[block];
    for (Index k = 0; k < n; ++k) least[k] = floor * a[k * row + k];
    for (Index k = 0; k < n; ++k) {
        Real* const pivot_row = a + k * row;
        if (!(pivot_row[k] > least[k])) return k;
        Real const root = square_root(pivot_row[k]), scale = 1 / root;
        pivot_row[k] = root;
        for (Index c = k + 1; c < n; ++c) pivot_row[c] *= scale;
        for (Index r = k + 1; r < n; ++r) {
            Real const factor = pivot_row[r];
            for (Index c = r; c < n; ++c) a[r * row + c] -= factor * pivot_row[c];
        }
    }
    // Row k of the inverse is e_k - sum_j U_kj (row j of the inverse), over U_kk: from the last row up, in place.
    for (Index k = n - 1; k >= 0; --k) {
        Real inverse_row[block] = {};
        for (Index j = k + 1; j < n; ++j) {
            Real const factor = a[k * row + j];
            for (Index c = j; c < n; ++c) inverse_row[c] -= factor * a[j * row + c];
        }
        Real const scale = 1 / a[k * row + k];
        for (Index c = 0; c < k; ++c) a[k * row + c] = 0;
        a[k * row + k] = scale;
        for (Index c = k + 1; c < n; ++c) a[k * row + c] = scale * inverse_row[c];
    }
    return none;
}

Index factor_panel(Panel const& panel, Real floor) noexcept {
    Offset const row = panel.front;
    for (Index k = 0; k < panel.pivots; k += block) {
        Index const n = smaller(block, panel.pivots - k);
        Real* const rows = panel.data + k * row;
        // What the earlier pivots take off this block's rows, all at once: every number is touched once.
        subtract_product<Op::transposed>({n, panel.front - k, k}, panel.data + k, row, panel.data + k, row, rows + k, row);
        Index const bad = factor_block(rows + k, row, n, floor);
        if (bad != none) return k + bad;
        apply_inverse_transposed(n, panel.front - k - n, rows + k, row, rows + k + n, row);
    }
    return none;
}

void subtract_border_square(Panel const& panel, Real* c, Offset c_row) noexcept {
    Index const border = panel.border();
    const Real* const u = panel.data + panel.pivots;
    for (Index column = 0; column < border; column += tile_columns) {
        Index const columns = smaller(tile_columns, static_cast<Index>(c_row) - column);  // padding may be written
        for (Index r = 0; r < smaller(border, column + tile_columns); r += tile_rows) {
            any_tile<Op::transposed, Store::subtract>(smaller(tile_rows, border - r),
                                                      {u + r, panel.front, u + column, panel.front, 0, panel.pivots},
                                                      {c + r * c_row + column, c_row, columns});
        }
    }
}

void forward(Panel const& panel, Real* y, Index y_row) noexcept {
    for (Index k = 0; k < panel.pivots; k += block) {
        Index const n = smaller(block, panel.pivots - k), rest = panel.front - k - n;
        const Real* const rows = panel.data + Offset{k} * panel.front + k;
        Real* const own = y + Offset{k} * y_row;
        apply_inverse_transposed(n, y_row, rows, panel.front, own, y_row);
        subtract_product<Op::transposed>({rest, y_row, n}, rows + n, panel.front, own, y_row, own + Offset{n} * y_row, y_row);
    }
}

void backward(Panel const& panel, Real* y, Index y_row) noexcept {
    for (Index k = (panel.pivots - 1) / block * block; k >= 0; k -= block) {
        Index const n = smaller(block, panel.pivots - k), rest = panel.front - k - n;
        const Real* const rows = panel.data + Offset{k} * panel.front + k;
        Real* const own = y + Offset{k} * y_row;
        subtract_product<Op::plain>({n, y_row, rest}, rows + n, panel.front, own + Offset{n} * y_row, y_row, own, y_row);
        apply_inverse(n, y_row, rows, panel.front, own, y_row);
    }
}

}  // namespace
}  // namespace harmorph::dense
