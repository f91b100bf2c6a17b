// The dense kernels for one kind of vector register. A file that includes this has defined HARMORPH_KERNEL (a namespace),
// HARMORPH_LANES (numbers in a register), HARMORPH_TILE_ROWS and HARMORPH_FMA(a, b, c) = a * b + c of vectors, and has told
// the compiler which instructions it may use.
// Everything rests on one product, D -= op(A) B or D = op(A) B, a tile of D at a time in registers.
#include "harmorph/dense.hpp"

namespace harmorph::dense::HARMORPH_KERNEL {
namespace {

constexpr Index lanes = HARMORPH_LANES;
constexpr Index tile_rows = HARMORPH_TILE_ROWS;
constexpr Index tile_vectors = 3;
constexpr Index tile_columns = lanes * tile_vectors;

// Vectors that may begin at any number.
typedef Real Vector __attribute__((vector_size(8 * HARMORPH_LANES), aligned(8), may_alias));
#define HARMORPH_INLINE inline __attribute__((always_inline))

// Not the core's: a copy of that compiled here might be linked everywhere.
HARMORPH_INLINE Index smaller(Index a, Index b) noexcept { return b < a ? b : a; }

HARMORPH_INLINE Vector load(const Real* from) noexcept { return *reinterpret_cast<const Vector*>(from); }
HARMORPH_INLINE void store(Real* to, Vector v) noexcept { *reinterpret_cast<Vector*>(to) = v; }

// c + a b for every number of the vectors.
HARMORPH_INLINE Vector multiply_add(Real a, Vector b, Vector c) noexcept {
    Vector const all = a - Vector{};
    return HARMORPH_FMA(all, b, c);
}

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
    Index columns;  // valid ones in the tile; the rest is computed and thrown away
};

template <Op op, Store how, Index rows, Index vectors>
HARMORPH_INLINE void tile(Source const& s, Target const& t) noexcept {
    Vector sum[rows][vectors] = {};
    for (Index k = s.from; k < s.to; ++k) {
        Vector b[vectors];
        for (Index v = 0; v < vectors; ++v) b[v] = load(s.b + k * s.b_row + v * lanes);
        for (Index r = 0; r < rows; ++r) {
            Real const a = op == Op::transposed ? s.a[k * s.a_row + r] : s.a[r * s.a_row + k];
            for (Index v = 0; v < vectors; ++v) sum[r][v] = multiply_add(a, b[v], sum[r][v]);
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

// A block of memory with its row length.
struct Rows {
    const Real* data;
    Offset length;
};

struct Shape {
    Index rows, columns, depth;
};

// D [rows x columns] -= op(A) B, read where they are: for what fits the first-level cache. upper: D begins on the diagonal,
// and what is below it is not wanted.
template <Op op>
void subtract_product(Shape shape, Rows a, Rows b, Real* d, Offset d_row, bool upper = false) noexcept {
    for (Index c = 0; c < shape.columns; c += tile_columns) {
        Index const columns = smaller(tile_columns, shape.columns - c);
        Index const wanted = upper ? smaller(shape.rows, c + tile_columns) : shape.rows;
        for (Index r = 0; r < wanted; r += tile_rows) {
            const Real* const first = op == Op::transposed ? a.data + r : a.data + r * a.length;
            any_tile<op, Store::subtract>(smaller(tile_rows, shape.rows - r),
                                          {first, a.length, b.data + c, b.length, 0, shape.depth},
                                          {d + r * d_row + c, d_row, columns});
        }
    }
}

// Copies `width` columns of a block's `depth` rows next to each other.
HARMORPH_INLINE void pack(Rows from, Index depth, Index width, Real* to) noexcept {
    for (Index k = 0; k < depth; ++k) {
        for (Index i = 0; i < width; ++i) to[k * width + i] = from.data[k * from.length + i];
    }
}

// D [rows x columns] -= A^T B for long rows: A and B are copied piece by piece, so that the tile loop reads contiguous
// memory. depth, rows <= strip.
void subtract_packed(Shape shape, Rows a, Rows b, Real* d, Offset d_row, Real* packing, bool upper) noexcept {
    Real* const packed_a = packing;
    Real* const packed_b = packing + strip * strip;
    Index const whole_rows = shape.rows / tile_rows * tile_rows;
    for (Index r = 0; r < whole_rows; r += tile_rows) {
        pack({a.data + r, a.length}, shape.depth, tile_rows, packed_a + r * shape.depth);
    }
    for (Index c = 0; c < shape.columns; c += tile_columns) {
        Index const columns = smaller(tile_columns, shape.columns - c);
        pack({b.data + c, b.length}, shape.depth, tile_columns, packed_b);
        Index const wanted = upper ? smaller(shape.rows, c + tile_columns) : shape.rows;
        for (Index r = 0; r < wanted; r += tile_rows) {
            bool const whole = r < whole_rows;
            Source const source{whole ? packed_a + r * shape.depth : a.data + r, whole ? Offset{tile_rows} : a.length, packed_b,
                                tile_columns, 0, shape.depth};
            any_tile<Op::transposed, Store::subtract>(smaller(tile_rows, shape.rows - r), source,
                                                      {d + r * d_row + c, d_row, columns});
        }
    }
}

// b [n x columns] = inverse^T b, inverse upper triangular: row r needs rows <= r, so the last rows go first.
void apply_inverse_transposed(Index n, Index columns, Rows inverse, Real* b, Offset b_row) noexcept {
    for (Index c = 0; c < columns; c += tile_columns) {
        for (Index r = (n - 1) / tile_rows * tile_rows; r >= 0; r -= tile_rows) {
            Index const rows = smaller(tile_rows, n - r);
            any_tile<Op::transposed, Store::set>(rows, {inverse.data + r, inverse.length, b + c, b_row, 0, r + rows},
                                                 {b + r * b_row + c, b_row, smaller(tile_columns, columns - c)});
        }
    }
}

// b [n x columns] = inverse b: row r needs rows >= r, so the first rows go first.
void apply_inverse(Index n, Index columns, Rows inverse, Real* b, Offset b_row) noexcept {
    for (Index c = 0; c < columns; c += tile_columns) {
        for (Index r = 0; r < n; r += tile_rows) {
            any_tile<Op::plain, Store::set>(smaller(tile_rows, n - r),
                                            {inverse.data + r * inverse.length, inverse.length, b + c, b_row, r, n},
                                            {b + r * b_row + c, b_row, smaller(tile_columns, columns - c)});
        }
    }
}

// A diagonal block in rows of one fixed length, so that all loops are over whole vectors.
struct Square {
    Real at[block][block];
};
static_assert(block % lanes == 0, "rows are whole vectors");

// row -= factor * other, from the vector that holds column `from` on.
HARMORPH_INLINE void subtract_row(Real* row, Real factor, const Real* other, Index from) noexcept {
    for (Index c = from / lanes * lanes; c < block; c += lanes) store(row + c, multiply_add(-factor, load(other + c), load(row + c)));
}

// Cholesky of the leading n x n part. Returns a pivot that fails, or none.
Index factor_square(Square& a, Index n, Real floor) noexcept {
    Real least[block];
    for (Index k = 0; k < n; ++k) least[k] = floor * a.at[k][k];
    for (Index k = 0; k < n; ++k) {
        Real* const row = a.at[k];
        if (!(row[k] > least[k])) return k;
        Real const root = __builtin_sqrt(row[k]), scale = 1 / root;
        for (Index c = k / lanes * lanes; c < block; c += lanes) store(row + c, scale * load(row + c));
        row[k] = root;
        for (Index r = k + 1; r < n; ++r) subtract_row(a.at[r], row[r], row, r);
    }
    return none;
}

// Rows from the last one up: row k of the inverse is (e_k - sum_j U_kj (row j of the inverse)) / U_kk.
void invert_square(Square const& u, Index n, Square& inverse) noexcept {
    inverse = {};
    for (Index k = n - 1; k >= 0; --k) {
        Real* const row = inverse.at[k];
        for (Index j = k + 1; j < n; ++j) subtract_row(row, u.at[k][j], inverse.at[j], j);
        Real const scale = 1 / u.at[k][k];
        for (Index c = k / lanes * lanes; c < block; c += lanes) store(row + c, scale * load(row + c));
        row[k] = scale;
    }
}

// Cholesky of a diagonal block, and the inverse of its factor in its place.
Index factor_block(Real* a, Offset row, Index n, Real floor) noexcept {
    Square square = {}, inverse;
    for (Index r = 0; r < n; ++r) {
        for (Index c = r; c < n; ++c) square.at[r][c] = a[r * row + c];
    }
    Index const bad = factor_square(square, n, floor);
    if (bad != none) return bad;
    invert_square(square, n, inverse);
    for (Index r = 0; r < n; ++r) {
        for (Index c = 0; c < n; ++c) a[r * row + c] = c < r ? 0 : inverse.at[r][c];
    }
    return none;
}

struct Strip {
    Real* rows;     // its first pivot's column is number 0
    Offset length;
    Index n;
};

Strip strip_of(Panel const& panel, Index first) noexcept {
    return {panel.data + panel.strip_start(first), panel.row_length(first), smaller(strip, panel.pivots - first)};
}

constexpr Index packing_pays = 96;  // rows longer than this are copied before they are multiplied

}  // namespace

void take_off_earlier(Panel const& panel, Index first, Index from, Index to, Real* packing) noexcept {
    Strip const own = strip_of(panel, first);
    bool const diagonal = from == first;
    for (Index earlier = 0; earlier < first; earlier += strip) {
        Strip const above = strip_of(panel, earlier);
        subtract_packed({own.n, to - from, above.n}, {above.rows + (first - earlier), above.length},
                        {above.rows + (from - earlier), above.length}, own.rows + (from - first), own.length, packing,
                        diagonal);
    }
}

Index factor_diagonal(Panel const& panel, Index first, Real floor) noexcept {
    Strip const own = strip_of(panel, first);
    for (Index k = 0; k < own.n; k += block) {
        Index const n = smaller(block, own.n - k);
        Rows const above{own.rows + k, own.length};
        Real* const diagonal = own.rows + k * own.length + k;
        if (k > 0) subtract_product<Op::transposed>({n, own.n - k, k}, above, above, diagonal, own.length);
        Index const bad = factor_block(diagonal, own.length, n, floor);
        if (bad != none) return first + k + bad;
        apply_inverse_transposed(n, own.n - k - n, {diagonal, own.length}, diagonal + n, own.length);
    }
    return none;
}

void finish_columns(Panel const& panel, Index first, Index from, Index to) noexcept {
    Strip const own = strip_of(panel, first);
    Real* const columns = own.rows + (from - first);
    for (Index k = 0; k < own.n; k += block) {
        Index const n = smaller(block, own.n - k);
        Real* const its = columns + k * own.length;
        Rows const above{own.rows + k, own.length};
        if (k > 0) subtract_product<Op::transposed>({n, to - from, k}, above, {columns, own.length}, its, own.length);
        apply_inverse_transposed(n, to - from, {own.rows + k * own.length + k, own.length}, its, own.length);
    }
}

void update_band(Panel const& panel, UpdateMatrix const& update, Index begin, Real* packing) noexcept {
    Index const rows = smaller(strip, update.n - begin), width = padded(update.n - begin);  // padding may be written
    Real* const d = update.row(begin) + begin;
    Offset const d_row = update.row_length(begin);
    for (Index first = 0; first < panel.pivots; first += strip) {
        Strip const own = strip_of(panel, first);
        Rows const columns{own.rows + (panel.pivots - first) + begin, own.length};
        if (own.length > packing_pays) {
            subtract_packed({rows, width, own.n}, columns, columns, d, d_row, packing, true);
        } else {
            subtract_product<Op::transposed>({rows, width, own.n}, columns, columns, d, d_row, true);
        }
    }
}

void solve_strip_forward(Panel const& panel, Index first, Real* y, Index row) noexcept {
    Strip const own = strip_of(panel, first);
    for (Index k = 0; k < own.n; k += block) {
        Index const n = smaller(block, own.n - k);
        const Real* const diagonal = own.rows + k * own.length + k;
        Real* const its = y + Offset{first + k} * row;
        apply_inverse_transposed(n, row, {diagonal, own.length}, its, row);
        subtract_product<Op::transposed>({own.n - k - n, row, n}, {diagonal + n, own.length}, {its, row}, its + Offset{n} * row,
                                         row);
    }
}

void take_off_forward(Panel const& panel, Index first, Real* y, Index row, Index from, Index to) noexcept {
    Strip const own = strip_of(panel, first);
    subtract_product<Op::transposed>({to - from, row, own.n}, {own.rows + (from - first), own.length},
                                     {y + Offset{first} * row, row}, y + Offset{from} * row, row);
}

void take_off_backward(Panel const& panel, Index first, Real* y, Index row, Index from, Index to) noexcept {
    Strip const own = strip_of(panel, first);
    Index const known = first + own.n;
    subtract_product<Op::plain>({to - from, row, panel.front - known},
                                {own.rows + (from - first) * own.length + own.n, own.length}, {y + Offset{known} * row, row},
                                y + Offset{from} * row, row);
}

void solve_strip_backward(Panel const& panel, Index first, Real* y, Index row) noexcept {
    Strip const own = strip_of(panel, first);
    for (Index k = (own.n - 1) / block * block; k >= 0; k -= block) {
        Index const n = smaller(block, own.n - k);
        const Real* const diagonal = own.rows + k * own.length + k;
        Real* const its = y + Offset{first + k} * row;
        subtract_product<Op::plain>({n, row, own.n - k - n}, {diagonal + n, own.length}, {its + Offset{n} * row, row}, its, row);
        apply_inverse(n, row, {diagonal, own.length}, its, row);
    }
}

}  // namespace harmorph::dense::HARMORPH_KERNEL
