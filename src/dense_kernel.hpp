// The dense kernels for one kind of vector register. A file that includes this has defined HARMORPH_KERNEL (a namespace),
// HARMORPH_TILE_ROWS, and in that namespace Registers<double> and Registers<float>: see dense_baseline.cpp. It has told the
// compiler which instructions it may use.
// Everything rests on one product, D -= op(A) B or D = op(A) B, a tile of D at a time in registers.
#include "harmorph/dense.hpp"

namespace harmorph::dense::HARMORPH_KERNEL {
namespace {

// Not the core's: a copy of that compiled here might be linked everywhere.
HARMORPH_INLINE Index smaller(Index a, Index b) noexcept { return b < a ? b : a; }

template <class Number>
using Vector = typename Registers<Number>::Vector;
template <class Number>
constexpr Index lanes = static_cast<Index>(sizeof(Vector<Number>) / sizeof(Number));

// A complex tile takes two registers for each one of a real tile.
template <Index planes>
constexpr Index tile_rows = HARMORPH_TILE_ROWS / planes;
constexpr Index tile_vectors = 3;
template <class Number>
constexpr Index tile_columns = tile_vectors * lanes<Number>;
static_assert(block % tile_rows<1> == 0, "a block is a whole number of tiles");

template <class Number>
HARMORPH_INLINE Vector<Number> load(const Number* from) noexcept {
    return *reinterpret_cast<const Vector<Number>*>(from);
}
template <class Number>
HARMORPH_INLINE void store(Number* to, Vector<Number> v) noexcept {
    *reinterpret_cast<Vector<Number>*>(to) = v;
}

// A block of a matrix: from one row to the next, and from a row's real parts to its imaginary parts.
template <class Number>
struct Block {
    Number* data;
    Offset length, plane;

    HARMORPH_INLINE Block at(Index row, Index column) const noexcept { return {data + row * length + column, length, plane}; }
};

struct Shape {
    Index rows, columns, depth;
};

// op(A) of A's element (k, r): its conjugate transpose, or A as it stands, element (r, k).
enum class Op { conjugate_transposed, plain };
enum class Store { subtract, set };

// sum += op(a) b for one plane of b. Both loops are short and unrolled, whatever the compiler's level, so that the sums
// stay in registers.
template <Op op, Index planes, Index plane, Index rows, Index vectors, class Number>
HARMORPH_INLINE void multiply_add(const Number* a, Offset next_row, Offset a_plane, const Number* b,
                                  Vector<Number> (&sum)[planes][rows][vectors]) noexcept {
    Vector<Number> factor[vectors];
#pragma GCC unroll 8
    for (Index v = 0; v < vectors; ++v) factor[v] = load(b + v * lanes<Number>);
#pragma GCC unroll 8
    for (Index r = 0; r < rows; ++r) {
        Vector<Number> const real = a[r * next_row] - Vector<Number>{};
#pragma GCC unroll 8
        for (Index v = 0; v < vectors; ++v) {
            sum[plane][r][v] = Registers<Number>::multiply_add(real, factor[v], sum[plane][r][v]);
        }
        if constexpr (planes == 2) {
            constexpr bool adds = (op == Op::conjugate_transposed) == (plane == 1);  // i * i = -1, and the conjugate's sign
            Vector<Number> const imaginary = a[r * next_row + a_plane] - Vector<Number>{};
#pragma GCC unroll 8
            for (Index v = 0; v < vectors; ++v) {
                Vector<Number>& to = sum[1 - plane][r][v];
                to = adds ? Registers<Number>::multiply_add(imaginary, factor[v], to)
                          : Registers<Number>::multiply_subtract(imaginary, factor[v], to);
            }
        }
    }
}

// The summation index goes from `begin` to `end`; `columns` of D are wanted, the rest is computed and thrown away.
template <Op op, Store how, Index planes, Index rows, Index vectors, class Number>
HARMORPH_INLINE void tile(Block<Number> a, Block<Number> b, Index begin, Index end, Block<Number> d, Index columns) noexcept {
    Offset const next_row = op == Op::plain ? a.length : 1, next_k = op == Op::plain ? 1 : a.length;
    Vector<Number> sum[planes][rows][vectors] = {};
    for (Index k = begin; k < end; ++k) {
        const Number* const from = a.data + k * next_k;
        const Number* const row = b.data + k * b.length;
        multiply_add<op, planes, 0>(from, next_row, a.plane, row, sum);
        if constexpr (planes == 2) {
            asm volatile("" ::: "memory");  // or A's numbers stay in registers that the sums need
            multiply_add<op, planes, 1>(from, next_row, a.plane, row + b.plane, sum);
        }
    }
#pragma GCC unroll 2
    for (Index plane = 0; plane < planes; ++plane) {
#pragma GCC unroll 8
        for (Index r = 0; r < rows; ++r) {
#pragma GCC unroll 8
            for (Index v = 0; v < vectors; ++v) {
                Number* const to = d.data + r * d.length + plane * d.plane + v * lanes<Number>;
                Vector<Number> const found = how == Store::subtract ? load(to) - sum[plane][r][v] : sum[plane][r][v];
                Index const wanted = columns - v * lanes<Number>;
                if (v + 1 < vectors || wanted >= lanes<Number>) {
                    store(to, found);
                } else {
                    Registers<Number>::store_first(to, found, wanted);
                }
            }
        }
    }
}

template <Op op, Store how, Index planes, Index rows, class Number>
void tile_of_rows(Block<Number> a, Block<Number> b, Index begin, Index end, Block<Number> d, Index columns) noexcept {
    static_assert(tile_vectors == 3, "one case for each number of vectors");
    if (columns > 2 * lanes<Number>) return tile<op, how, planes, rows, 3>(a, b, begin, end, d, columns);
    if (columns > lanes<Number>) return tile<op, how, planes, rows, 2>(a, b, begin, end, d, columns);
    return tile<op, how, planes, rows, 1>(a, b, begin, end, d, columns);
}

template <Op op, Store how, Index planes, Index most_rows = tile_rows<planes>, class Number>
HARMORPH_INLINE void any_tile(Index rows, Block<Number> a, Block<Number> b, Index begin, Index end, Block<Number> d,
                              Index columns) noexcept {
    if constexpr (most_rows > 1) {
        if (rows < most_rows) return any_tile<op, how, planes, most_rows - 1>(rows, a, b, begin, end, d, columns);
    }
    return tile_of_rows<op, how, planes, most_rows>(a, b, begin, end, d, columns);
}

// D [rows x columns] -= op(A) B, read where they are. upper: D begins on the diagonal, and what is below it is not wanted.
template <Op op, Index planes, class Number>
void subtract_product(Shape shape, Block<Number> a, Block<Number> b, Block<Number> d, bool upper = false) noexcept {
    for (Index r = 0; r < shape.rows; r += tile_rows<planes>) {
        Index const rows = smaller(tile_rows<planes>, shape.rows - r);
        Block<Number> const its = op == Op::plain ? a.at(r, 0) : a.at(0, r);
        for (Index c = upper ? r : 0; c < shape.columns; c += tile_columns<Number>) {
            any_tile<op, Store::subtract, planes>(rows, its, b.at(0, c), 0, shape.depth, d.at(r, c),
                                                  smaller(tile_columns<Number>, shape.columns - c));
        }
    }
}

// Copies `width` columns next to each other; whole vectors are written.
template <Index planes, Index width, class Number>
HARMORPH_INLINE Block<Number> pack(Block<Number> from, Index depth, Number* to) noexcept {
    for (Index k = 0; k < depth; ++k) {
#pragma GCC unroll 2
        for (Index plane = 0; plane < planes; ++plane) {
            for (Index i = 0; i < width; ++i) {
                to[(k * planes + plane) * width + i] = from.data[k * from.length + plane * from.plane + i];
            }
        }
    }
    return {to, planes * width, width};
}

// D [rows x columns] -= A^H B for long rows: A and B are copied piece by piece, so that the tile loop reads contiguous
// memory. depth, rows <= strip.
template <Index planes, class Number>
void subtract_packed(Shape shape, Block<Number> a, Block<Number> b, Block<Number> d, Number* packing, bool upper) noexcept {
    constexpr Index height = tile_rows<planes>, width = tile_columns<Number>;
    Number* const packed_b = packing + planes * strip * strip;
    Index const whole_rows = shape.rows / height * height;
    auto const packed_a = [&](Index r) { return packing + Offset{planes} * r * shape.depth; };
    for (Index r = 0; r < whole_rows; r += height) pack<planes, height>(a.at(0, r), shape.depth, packed_a(r));
    for (Index c = 0; c < shape.columns; c += width) {
        Block<Number> const factor = pack<planes, width>(b.at(0, c), shape.depth, packed_b);
        Index const wanted = upper ? smaller(shape.rows, c + width) : shape.rows;
        for (Index r = 0; r < wanted; r += height) {
            Block<Number> const its = r < whole_rows ? Block<Number>{packed_a(r), planes * height, height} : a.at(0, r);
            Index const below = upper && r > c ? (r - c) / lanes<Number> * lanes<Number> : 0;  // the diagonal: not wanted
            any_tile<Op::conjugate_transposed, Store::subtract, planes>(smaller(height, shape.rows - r), its,
                                                                        factor.at(0, below), 0, shape.depth,
                                                                        d.at(r, c + below),
                                                                        smaller(width, shape.columns - c) - below);
        }
    }
}

// b [n x columns] = E b, E lower triangular: row r needs rows <= r, so the last rows go first.
template <Index planes, class Number>
void apply_inverse(Index n, Index columns, Block<Number> inverse, Block<Number> b) noexcept {
    for (Index c = 0; c < columns; c += tile_columns<Number>) {
        for (Index r = (n - 1) / tile_rows<planes> * tile_rows<planes>; r >= 0; r -= tile_rows<planes>) {
            Index const rows = smaller(tile_rows<planes>, n - r);
            any_tile<Op::plain, Store::set, planes>(rows, inverse.at(r, 0), b.at(0, c), 0, r + rows, b.at(r, c),
                                                    smaller(tile_columns<Number>, columns - c));
        }
    }
}

// b [n x columns] = E^H b: row r needs rows >= r, so the first rows go first.
template <Index planes, class Number>
void apply_inverse_transposed(Index n, Index columns, Block<Number> inverse, Block<Number> b) noexcept {
    for (Index c = 0; c < columns; c += tile_columns<Number>) {
        for (Index r = 0; r < n; r += tile_rows<planes>) {
            any_tile<Op::conjugate_transposed, Store::set, planes>(smaller(tile_rows<planes>, n - r), inverse.at(0, r),
                                                                   b.at(0, c), r, n, b.at(r, c),
                                                                   smaller(tile_columns<Number>, columns - c));
        }
    }
}

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

// Cholesky of a diagonal block, whose place the inverse of U^H takes. Returns a pivot that is not above `least`, or none.
template <Index planes, class Number>
Index factor_block(Block<Number> a, Index n, const Number* least) noexcept {
    BlockBesideUnit<planes, Number> both(a, n);
    Number pivot[block];
    for (Index k = 0; k < n; ++k) {
        pivot[k] = both.at[k][0][k];
        if (!(pivot[k] > least[k])) return k;
        Number const inverse = 1 / pivot[k];
        for (Index r = k + 1; r < n; ++r) {
            both.subtract(r, k, both.at[k][0][r] * inverse, planes == 2 ? both.at[k][planes - 1][r] * inverse : 0);
        }
    }
    for (Index r = 0; r < n; ++r) {
        Number const scale = 1 / Registers<Number>::square_root(pivot[r]);
        for (Index plane = 0; plane < planes; ++plane) {
            copy_scaled(a.data + r * a.length + plane * a.plane, both.at[r][plane] + block, scale, n);
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
Index factor_diagonal(Panel<Number> const& panel, Index first, const Number* least) noexcept {
    Strip<Number> const own = strip_of<planes>(panel, first);
    for (Index k = 0; k < own.n; k += block) {
        Index const n = smaller(block, own.n - k);
        Block<Number> const above = own.at(0, k), its = own.at(k, k);
        if (k > 0) subtract_product<Op::conjugate_transposed, planes>({n, own.n - k, k}, above, above, its);
        Index const bad = factor_block<planes>(its, n, least + k);
        if (bad != none) return first + k + bad;
        apply_inverse<planes>(n, own.n - k - n, its, its.at(0, n));
    }
    return none;
}

template <class Number, Index planes>
void finish_columns(Panel<Number> const& panel, Index first, Index from, Index to, Number*) noexcept {
    Strip<Number> const own = strip_of<planes>(panel, first);
    Block<Number> const columns = own.at(0, from - first);
    for (Index k = 0; k < own.n; k += block) {
        Index const n = smaller(block, own.n - k);
        Block<Number> const its = columns.at(k, 0);
        if (k > 0) subtract_product<Op::conjugate_transposed, planes>({n, to - from, k}, own.at(0, k), columns, its);
        apply_inverse<planes>(n, to - from, own.at(k, k), its);
    }
}

template <class Number, Index planes>
void update_band(Panel<Number> const& panel, UpdateMatrix<Number> const& update, Index begin, Number* packing) noexcept {
    Offset const plane = padded(update.n - begin);  // padding may be written
    Block<Number> const d{update.data + planes * band_start(update.n, begin), planes * plane, plane};
    Index const rows = smaller(strip, update.n - begin);
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
    template Index factor_diagonal<Number, planes>(Panel<Number> const&, Index, const Number*) noexcept;                   \
    template void finish_columns<Number, planes>(Panel<Number> const&, Index, Index, Index, Number*) noexcept;             \
    template void update_band<Number, planes>(Panel<Number> const&, UpdateMatrix<Number> const&, Index, Number*) noexcept; \
    template void solve_strip_forward<Number, planes>(Panel<Number> const&, Index, Number*, Index) noexcept;               \
    template void take_off_forward<Number, planes>(Panel<Number> const&, Index, Number*, Index, Index, Index) noexcept;    \
    template void take_off_backward<Number, planes>(Panel<Number> const&, Index, Number*, Index, Index, Index) noexcept;   \
    template void solve_strip_backward<Number, planes>(Panel<Number> const&, Index, Number*, Index) noexcept;
HARMORPH_MAKE(double, 1)
HARMORPH_MAKE(double, 2)
HARMORPH_MAKE(float, 1)
HARMORPH_MAKE(float, 2)

}  // namespace harmorph::dense::HARMORPH_KERNEL
