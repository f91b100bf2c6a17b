// Products of dense blocks for one kind of vector register; see dense_kernel.hpp for what is defined where this is included.
// Everything rests on D -= op(A) B or D = op(A) B, a tile of D at a time in registers.
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

}  // namespace
}  // namespace harmorph::dense::HARMORPH_KERNEL
