// Products of dense blocks with the registers of one instruction set; compiled for each by dense_table.cpp. All of them
// are D -= op(A) B or D = op(A) B, with a tile of D at a time in registers.

namespace harmorph::dense::HARMORPH_SET {
namespace {

// Not those of base/scalar.hpp: the linker might take the copy compiled here for all other code.
HARMORPH_INLINE constexpr Index smaller(Index a, Index b) noexcept { return b < a ? b : a; }
HARMORPH_INLINE Index larger(Index a, Index b) noexcept { return a < b ? b : a; }

template <class Number>
using Registers = simd::HARMORPH_SET::Registers<Number>;
template <class Number>
using Vector = typename Registers<Number>::Vector;
template <class Number>
constexpr Index lanes = Registers<Number>::lanes;

// The sums of a tile take three quarters of the processor's registers; a complex tile has two sums for each number.
constexpr Index tile_vectors = 3;
template <Index planes>
constexpr Index tile_rows = Registers<double>::count / 4 / planes;
template <class Number>
constexpr Index tile_columns = tile_vectors * lanes<Number>;
static_assert(slab % lanes<double> == 0 && slab % lanes<float> == 0, "a slab is a whole number of vectors");
static_assert(slab % tile_rows<1> == 0 && strip % slab == 0 && chunk % (3 * slab) == 0, "whole tiles, whole blocks");

template <class Number>
HARMORPH_INLINE Vector<Number> load(const Number* from) noexcept { return Registers<Number>::load(from); }
template <class Number>
HARMORPH_INLINE void store(Number* to, Vector<Number> v) noexcept { Registers<Number>::store(to, v); }
template <class Number>
HARMORPH_INLINE Vector<Number> all(Number x) noexcept { return Registers<Number>::all(x); }

// From one row of a slab to the next.
template <Index planes>
constexpr Offset step = planes * slab;

// Up to tile_vectors vectors side by side; `row` numbers further on, the vectors of the next row. Filled and read number
// by number, never copied as a whole: a wide load waits for narrow stores that went just before.
template <class Number>
struct Vectors {
    Number* at[tile_vectors];
    Offset row, plane;

    HARMORPH_INLINE void move_down(Offset rows) noexcept {
        for (Number*& vector : at) vector += rows * row;
    }
};

// Where the vectors of a tile are in memory: in a matrix in slabs, or in right-hand sides, from an entry on. first(n):
// n vectors; the rest of the three repeat the first one.
template <class Number, Index planes>
struct InSlabs {
    Slabs<Number> const& slabs;
    Index row, column;

    HARMORPH_INLINE InSlabs at(Index down, Index right) const noexcept { return {slabs, row + down, column + right}; }
    HARMORPH_INLINE void first(Index n, Vectors<Number>& out) const noexcept {
        for (Index v = 0; v < tile_vectors; ++v) out.at[v] = slabs.at(row, v < n ? column + v * lanes<Number> : column);
        out.row = step<planes>;
        out.plane = slab;
    }
};
template <class Number, Index planes>
struct InRows {
    Number* entry;
    Offset width;

    HARMORPH_INLINE InRows at(Index row, Index column) const noexcept {
        return {entry + planes * width * row + column, width};
    }
    HARMORPH_INLINE void first(Index n, Vectors<Number>& out) const noexcept {
        for (Index v = 0; v < tile_vectors; ++v) out.at[v] = v < n ? entry + v * lanes<Number> : entry;
        out.row = planes * width;
        out.plane = width;
    }
};

// op(A) of an A in slabs, element (r, k): its conjugate transpose, A (k, r), or A as it stands, A (r, k) within one
// slab.
enum class Op { conjugate_transposed, plain };
enum class Store { subtract, set };

// Vectors are copies: the compiler knows that no store changes them. Loops are short and unrolled, whatever the
// compiler's level, so that the sums stay in registers.
template <Index planes, Index rows, Index vectors, class Number>
struct Tile {
    Vector<Number> sum[planes][rows][vectors] = {};

    // sum += op(a) b, `depth` rows of b from `first` on.
    template <Op op>
    HARMORPH_INLINE void add(const Number* a, Vectors<Number> b, Index depth, Offset first = 0) noexcept {
        constexpr Offset next = op == Op::plain ? 1 : step<planes>;
        for (Index k = 0; k < depth; ++k) {
            add_plane<op, 0>(a + k * next, b, (first + k) * b.row);
            if constexpr (planes == 2) {
                asm volatile("" ::: "memory");  // no numbers of A stay in registers: the sums need these
                add_plane<op, 1>(a + k * next, b, (first + k) * b.row + b.plane);
            }
        }
    }

    template <Store how>
    HARMORPH_INLINE void leave(Vectors<Number> d) const noexcept {
#pragma GCC unroll 2
        for (Index plane = 0; plane < planes; ++plane) {
#pragma GCC unroll 8
            for (Index r = 0; r < rows; ++r) {
#pragma GCC unroll 8
                for (Index v = 0; v < vectors; ++v) {
                    Number* const to = d.at[v] + r * d.row + plane * d.plane;
                    store(to, how == Store::subtract ? load(to) - sum[plane][r][v] : sum[plane][r][v]);
                }
            }
        }
    }

    // Finishes the rows of a diagonal block: d = inverse (d - sums), and column_sums -= y^T d.
    HARMORPH_INLINE void finish(const Number* inverse, Vectors<Number> d, const Number* y,
                                Number* column_sums) const noexcept {
        static_assert(planes == 1, "real blocks fit into the registers");
        Vector<Number> row[rows][vectors], taken[vectors] = {};
#pragma GCC unroll 8
        for (Index r = 0; r < rows; ++r) {
#pragma GCC unroll 8
            for (Index v = 0; v < vectors; ++v) row[r][v] = load(d.at[v] + r * d.row) - sum[0][r][v];
        }
#pragma GCC unroll 8
        for (Index r = rows - 1; r >= 0; --r) {  // needs no later row
#pragma GCC unroll 8
            for (Index v = 0; v < vectors; ++v) row[r][v] *= inverse[r * slab + r];
#pragma GCC unroll 8
            for (Index k = 0; k < r; ++k) {
                Vector<Number> const factor = all(inverse[r * slab + k]);
#pragma GCC unroll 8
                for (Index v = 0; v < vectors; ++v) row[r][v] = Registers<Number>::multiply_add(factor, row[k][v],
                                                                                                row[r][v]);
            }
#pragma GCC unroll 8
            for (Index v = 0; v < vectors; ++v) {
                store(d.at[v] + r * d.row, row[r][v]);
                taken[v] = Registers<Number>::multiply_add(all(y[r]), row[r][v], taken[v]);
            }
        }
#pragma GCC unroll 8
        for (Index v = 0; v < vectors; ++v) {
            Number* const to = column_sums + v * lanes<Number>;
            store(to, load(to) - taken[v]);
        }
    }

private:
    // For one plane of b.
    template <Op op, Index plane>
    HARMORPH_INLINE void add_plane(const Number* a, Vectors<Number> const& b, Offset at) noexcept {
        constexpr Offset next_row = op == Op::plain ? step<planes> : 1;
        Vector<Number> factor[vectors];
#pragma GCC unroll 8
        for (Index v = 0; v < vectors; ++v) factor[v] = load(b.at[v] + at);
#pragma GCC unroll 8
        for (Index r = 0; r < rows; ++r) {
            Vector<Number> const real = all(a[r * next_row]);
#pragma GCC unroll 8
            for (Index v = 0; v < vectors; ++v) {
                sum[plane][r][v] = Registers<Number>::multiply_add(real, factor[v], sum[plane][r][v]);
            }
            if constexpr (planes == 2) {
                // i * i = -1, and the conjugate changes the sign once more.
                constexpr bool adds = (op == Op::conjugate_transposed) == (plane == 1);
                Vector<Number> const imaginary = all(a[r * next_row + slab]);
#pragma GCC unroll 8
                for (Index v = 0; v < vectors; ++v) {
                    if (adds) sum[1 - plane][r][v] = Registers<Number>::multiply_add(imaginary, factor[v],
                                                                                     sum[1 - plane][r][v]);
                    else sum[1 - plane][r][v] = Registers<Number>::multiply_subtract(imaginary, factor[v],
                                                                                     sum[1 - plane][r][v]);
                }
            }
        }
    }
};

struct Range {
    Index begin, end;

    Index count() const noexcept { return end - begin; }
};

// What a product reads and changes. One function has both endings, as the ending is a small part of a tile's code.
template <class Number>
struct Product {
    Store how;
    Vectors<Number> b, d;

    template <class Sums>
    HARMORPH_INLINE void leave(Sums const& sums) const noexcept {
        if (how == Store::subtract) sums.template leave<Store::subtract>(d);
        else sums.template leave<Store::set>(d);
    }
};

// A^H B: `depth` rows of a slab of A from `a` on.
template <Index planes, Index rows, Index vectors, class Number>
void tile_down(const Number* a, Index depth, Product<Number> const& product) noexcept {
    Tile<planes, rows, vectors, Number> sums;
    sums.template add<Op::conjugate_transposed>(a, product.b, depth);
    product.leave(sums);
}

// Rows of a slab that are needed soon, into the second-level cache.
template <Index planes, class Number>
HARMORPH_INLINE void prefetch_rows(const Number* row, Index rows) noexcept {
    constexpr Offset line = 64 / sizeof(Number);
    for (Offset k = 0; k < rows * step<planes>; k += line) __builtin_prefetch(row + k, 0, 2);
}

// A B: columns k of A, rows from i on; a slab begins at k.begin. What is `ahead` numbers further on is prefetched, unless
// that is 0.
template <Index planes, Index rows, Index vectors, class Number>
void tile_across(Slabs<Number> const& a, Index i, Range k, Product<Number> const& product, Offset ahead) noexcept {
    Tile<planes, rows, vectors, Number> sums;
    const Number* entries = a.at(i, k.begin);
    for (Index c = k.begin; c < k.end; c += slab) {
        if (ahead != 0) prefetch_rows<planes>(entries + ahead, rows);
        sums.template add<Op::plain>(entries, product.b, smaller(slab, k.end - c), c - k.begin);
        entries += step<planes> * a.rows_of_slab(c / slab);
    }
    product.leave(sums);
}

// Tiles have 1, 2, 4 .. tile_rows rows, which keeps the code small: an odd number of rows is an even one and one more.
template <Index planes, class Number>
struct Tiles {
    struct OfWidth {
        void (*down)(const Number* a, Index depth, Product<Number> const& product) noexcept;
        void (*across)(Slabs<Number> const& a, Index i, Range k, Product<Number> const& product,
                       Offset ahead) noexcept;
    };
    struct OfHeight {
        OfWidth of_width[tile_vectors];
    };
    static HARMORPH_INLINE OfWidth const& of(Index rows, Index vectors) noexcept {
        return all[rows / 2].of_width[vectors - 1];
    }

private:
    template <Index rows>
    static constexpr OfHeight of_height{{{tile_down<planes, rows, 1, Number>, tile_across<planes, rows, 1, Number>},
                                         {tile_down<planes, rows, 2, Number>, tile_across<planes, rows, 2, Number>},
                                         {tile_down<planes, rows, 3, Number>, tile_across<planes, rows, 3, Number>}}};
    static constexpr Index most = tile_rows<planes>;
    static constexpr OfHeight all[] = {of_height<1>, of_height<2>, of_height<smaller(4, most)>,
                                       of_height<smaller(6, most)>, of_height<smaller(8, most)>};
    static_assert(most == 2 || most == 4 || most == 8, "the heights that `all` has");
};

// How many vectors hold the columns, up to those of a tile.
template <class Number>
HARMORPH_INLINE Index vectors_of(Index columns) noexcept {
    static_assert(tile_vectors == 3, "one case for each number of vectors");
    return columns > 2 * lanes<Number> ? 3 : columns > lanes<Number> ? 2 : 1;
}

// D [rows x columns] -= or = A^H B with the columns of A from `a` on; whole vectors are written.
template <Index planes, class Number, class Block>
HARMORPH_INLINE void any_tile_down(Store how, Index rows, Index columns, const Number* a, Block const& b, Index depth,
                                   Block const& d) noexcept {
    Index const vectors = vectors_of<Number>(columns), even = rows / 2 * 2;
    Product<Number> product;
    product.how = how;
    b.first(vectors, product.b);
    d.first(vectors, product.d);
    if (even > 0) Tiles<planes, Number>::of(even, vectors).down(a, depth, product);
    if (even == rows) return;
    product.d.move_down(even);
    Tiles<planes, Number>::of(1, vectors).down(a + even, depth, product);
}
// The same with rows of A from i on. The last row goes first: where D is B, other rows do not need it.
template <Index planes, class Number, class Block>
HARMORPH_INLINE void any_tile_across(Store how, Index rows, Index columns, Slabs<Number> const& a, Index i, Range k,
                                     Block const& b, Block const& d, Offset ahead) noexcept {
    Index const vectors = vectors_of<Number>(columns), even = rows / 2 * 2;
    Product<Number> product;
    product.how = how;
    b.first(vectors, product.b);
    d.first(vectors, product.d);
    if (even < rows) {
        product.d.move_down(even);
        Tiles<planes, Number>::of(1, vectors).across(a, i + even, k, product, ahead);
        product.d.move_down(-even);
    }
    if (even > 0) Tiles<planes, Number>::of(even, vectors).across(a, i, k, product, ahead);
}

template <Index vectors, class Number>
void finish_tile(const Number* a, InSlabs<Number, 1> const& b, Index depth, const Number* inverse,
                 InSlabs<Number, 1> const& d, const Number* y, Number* column_sums) noexcept {
    Vectors<Number> from, to;
    b.first(vectors, from);
    d.first(vectors, to);
    Tile<1, slab, vectors, Number> product;
    product.template add<Op::conjugate_transposed>(a, from, depth);
    product.finish(inverse, to, y, column_sums);
}
template <class Number>
HARMORPH_INLINE void any_finish_tile(Index columns, const Number* a, InSlabs<Number, 1> const& b, Index depth,
                                     const Number* inverse, InSlabs<Number, 1> const& d, const Number* y,
                                     Number* column_sums) noexcept {
    Index const vectors = vectors_of<Number>(columns);
    auto const finish = vectors == 3 ? finish_tile<3, Number> : vectors == 2 ? finish_tile<2, Number>
                                                                             : finish_tile<1, Number>;
    finish(a, b, depth, inverse, d, y, column_sums);
}

// Rows i and columns j of D -= A^H B, summed over rows k of A and B. upper: only the upper triangle of D is needed.
template <Index planes, class Number>
void subtract_product(Slabs<Number> const& a, Slabs<Number> const& b, Slabs<Number> const& d, Range k, Range i, Range j,
                      bool upper = false) noexcept {
    using Block = InSlabs<Number, planes>;
    for (Index c = j.begin; c < j.end; c += tile_columns<Number>) {
        Index const end = smaller(j.end, c + tile_columns<Number>), last = upper ? smaller(i.end, end) : i.end;
        for (Index r = i.begin; r < last; r += tile_rows<planes>) {
            Index const from = upper ? larger(c, r / lanes<Number> * lanes<Number>) : c;
            any_tile_down<planes>(Store::subtract, smaller(tile_rows<planes>, last - r), end - from, a.at(k.begin, r),
                                  Block{b, k.begin, from}, k.count(), Block{d, r, from});
        }
    }
}

// The same for right-hand sides: row 0 of d is row i.begin of D, row 0 of b is row k.begin of B.
template <Index planes, class Number>
void subtract_from_rows(Slabs<Number> const& a, InRows<Number, planes> b, InRows<Number, planes> d, Range k,
                        Range i) noexcept {
    for (Index r = i.begin; r < i.end; r += tile_rows<planes>) {
        for (Index c = 0; c < d.width; c += tile_columns<Number>) {
            any_tile_down<planes>(Store::subtract, smaller(tile_rows<planes>, i.end - r),
                                  static_cast<Index>(d.width) - c, a.at(k.begin, r), b.at(0, c), k.count(),
                                  d.at(r - i.begin, c));
        }
    }
}

// b [n x columns] = E b, E the inverse that stands in u at (first, first). E is lower triangular: row r needs rows <= r,
// so the last rows go first.
template <Index planes, class Number, class Block>
HARMORPH_INLINE void apply_inverse(Slabs<Number> const& u, Index first, Index n, Index columns,
                                   Block const& b) noexcept {
    for (Index c = 0; c < columns; c += tile_columns<Number>) {
        for (Index r = (n - 1) / tile_rows<planes> * tile_rows<planes>; r >= 0; r -= tile_rows<planes>) {
            Index const rows = smaller(tile_rows<planes>, n - r);
            any_tile_across<planes>(Store::set, rows, columns - c, u, first + r, {first, first + r + rows}, b.at(0, c),
                                    b.at(r, c), 0);
        }
    }
}

// b [n x width] = E^H b: row r needs rows >= r, so the first rows go first.
template <Index planes, class Number>
void apply_inverse_transposed(Index n, const Number* inverse, InRows<Number, planes> b) noexcept {
    for (Index c = 0; c < b.width; c += tile_columns<Number>) {
        for (Index r = 0; r < n; r += tile_rows<planes>) {
            any_tile_down<planes>(Store::set, smaller(tile_rows<planes>, n - r), static_cast<Index>(b.width) - c,
                                  inverse + r * step<planes> + r, b.at(r, c), n - r, b.at(r, c));
        }
    }
}

// d -= A (i, k) b, all rows i. Row 0 of b is row k.begin, where a slab begins; row 0 of d is row i.begin.
template <Index planes, class Number>
void subtract_across(Slabs<Number> const& a, Range k, Range i, InRows<Number, planes> b, InRows<Number, planes> d,
                     Offset ahead) noexcept {
    for (Index r = i.begin; r < i.end; r += tile_rows<planes>) {
        for (Index c = 0; c < d.width; c += tile_columns<Number>) {
            any_tile_across<planes>(Store::subtract, smaller(tile_rows<planes>, i.end - r),
                                    static_cast<Index>(d.width) - c, a, r, k, b.at(0, c), d.at(r - i.begin, c),
                                    c == 0 ? ahead : 0);
        }
    }
}

}  // namespace
}  // namespace harmorph::dense::HARMORPH_SET
