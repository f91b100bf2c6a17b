// Products of dense blocks with the registers of one instruction set. dense.cpp compiles this
// file for each set. All products are D -= op(A) B or D = op(A) B, with one tile of D at a time in
// registers. tests/dense/test_dense.cpp covers this file.

namespace harmorph::dense::HARMORPH_SET {

// A tile of a product of dense blocks in the registers of one instruction set, and the places of
// the operands in memory.

namespace {

// base/scalar.hpp has the same functions, which are not used here, because the linker might use the
// copy that is compiled here, with the instructions of this set, in all other code.
HARMORPH_INLINE constexpr Index min(Index a, Index b) noexcept { return b < a ? b : a; }
HARMORPH_INLINE Index max(Index a, Index b) noexcept { return a < b ? b : a; }

using Registers = simd::HARMORPH_SET::Registers<Real>;
using Vector = Registers::Vector;
constexpr Index lanes = Registers::lanes;

// Products of complex numbers are computed by three real ones if this is true; see
// ThreeProductsTile.
constexpr bool three_products = Registers::count >= 32;
// The sums of a tile take three quarters of the processor's registers.
constexpr Index max_vectors = 3;
template <Index planes>
constexpr Index tile_vectors = planes == 2 && three_products ? 2 : max_vectors;
template <Index planes>
constexpr Index tile_rows = Registers::count / 4 / planes;
template <Index planes>
constexpr Index tile_columns = tile_vectors<planes>* lanes;
static_assert(slab % lanes == 0, "a slab is a whole number of vectors");
static_assert(slab % tile_rows<1> == 0 && strip % slab == 0 && chunk % (6 * slab) == 0,
              "strips and chunks are whole numbers of tiles and slabs");

HARMORPH_INLINE Vector load(const Real* from) noexcept { return Registers::load(from); }
HARMORPH_INLINE void store(Real* to, Vector v) noexcept { Registers::store(to, v); }
HARMORPH_INLINE Vector all(Real x) noexcept { return Registers::all(x); }

// The distance from one row of a slab to the next.
template <Index planes>
constexpr Offset step = planes* slab;

// Up to max_vectors vectors side by side; the vectors of the next row are `row` numbers further on.
// The struct is filled and read number by number, and never copied as a whole, because a wide load
// waits for narrow stores just before it.
struct Vectors {
    Real* at[max_vectors];
    Offset row, plane;

    HARMORPH_INLINE void move_down(Offset rows) noexcept {
        for (Real*& vector : at) vector += rows * row;
    }
};

// InSlabs and InRows tell where the vectors of a tile are in memory: in a matrix in slabs, or in
// right-hand sides. The vectors begin at one entry. first(n) returns n vectors; the vectors after
// them repeat the first one.
template <Index planes>
struct InSlabs {
    Slabs const& slabs;
    Index row, column;

    HARMORPH_INLINE InSlabs at(Index down, Index right) const noexcept {
        return {slabs, row + down, column + right};
    }
    HARMORPH_INLINE void first(Index n, Vectors& out) const noexcept {
        for (Index v = 0; v < max_vectors; ++v)
            out.at[v] = slabs.at(row, v < n ? column + v * lanes : column);
        out.row = step<planes>;
        out.plane = slab;
    }
};
template <Index planes>
struct InRows {
    Real* entry;
    Offset width;

    HARMORPH_INLINE InRows at(Index row, Index column) const noexcept {
        return {entry + planes * width * row + column, width};
    }
    HARMORPH_INLINE void first(Index n, Vectors& out) const noexcept {
        for (Index v = 0; v < max_vectors; ++v) out.at[v] = v < n ? entry + v * lanes : entry;
        out.row = planes * width;
        out.plane = width;
    }
};

// op(A) of an A in slabs: the conjugate transpose, whose element (r, k) is read from A (k, r), or A
// itself, whose element is read from A (r, k) within one slab.
enum class Op { conjugate_transposed, plain };
enum class Store { subtract, set };

// Sums of products in registers. The vectors are copies, so that the compiler knows that no store
// changes them. Loops are short and unrolled at each optimisation level, so that the sums stay in
// registers.
template <Index planes, Index rows, Index vectors>
struct Tile {
    Vector sum[planes][rows][vectors] = {};

    // Computes sum += op(a) b with `depth` rows of b, beginning at row `first`.
    template <Op op>
    HARMORPH_INLINE void add(const Real* a, Vectors b, Index depth, Offset first = 0) noexcept {
        constexpr Offset next = op == Op::plain ? 1 : step<planes>;
        for (Index k = 0; k < depth; ++k) {
            add_plane<op, 0>(a + k * next, b, (first + k) * b.row);
            if constexpr (planes == 2) {
                // No numbers of A stay in registers here, as the sums need all of them.
                asm volatile("" ::: "memory");
                add_plane<op, 1>(a + k * next, b, (first + k) * b.row + b.plane);
            }
        }
    }

    template <Op, Store how>
    HARMORPH_INLINE void write_to(Vectors d) const noexcept {
#pragma GCC unroll 2
        for (Index plane = 0; plane < planes; ++plane) {
#pragma GCC unroll 8
            for (Index r = 0; r < rows; ++r) {
#pragma GCC unroll 8
                for (Index v = 0; v < vectors; ++v) {
                    Real* const to = d.at[v] + r * d.row + plane * d.plane;
                    store(to,
                          how == Store::subtract ? load(to) - sum[plane][r][v] : sum[plane][r][v]);
                }
            }
        }
    }

    // Finishes the rows of a diagonal block: d = inverse (d - sums), and column_sums -= y^T d.
    HARMORPH_INLINE void finish(const Real* inverse, Vectors d, const Real* y,
                                Real* column_sums) const noexcept {
        static_assert(planes == 1, "only blocks of real numbers fit into the registers");
        Vector row[rows][vectors], taken[vectors] = {};
#pragma GCC unroll 8
        for (Index r = 0; r < rows; ++r) {
#pragma GCC unroll 8
            for (Index v = 0; v < vectors; ++v)
                row[r][v] = load(d.at[v] + r * d.row) - sum[0][r][v];
        }
#pragma GCC unroll 8
        for (Index r = rows - 1; r >= 0; --r) {  // Row r needs no later row.
#pragma GCC unroll 8
            for (Index v = 0; v < vectors; ++v) row[r][v] *= inverse[r * slab + r];
#pragma GCC unroll 8
            for (Index k = 0; k < r; ++k) {
                Vector const factor = all(inverse[r * slab + k]);
#pragma GCC unroll 8
                for (Index v = 0; v < vectors; ++v) {
                    row[r][v] = Registers::multiply_add(factor, row[k][v], row[r][v]);
                }
            }
#pragma GCC unroll 8
            for (Index v = 0; v < vectors; ++v) {
                store(d.at[v] + r * d.row, row[r][v]);
                taken[v] = Registers::multiply_add(all(y[r]), row[r][v], taken[v]);
            }
        }
#pragma GCC unroll 8
        for (Index v = 0; v < vectors; ++v) {
            Real* const to = column_sums + v * lanes;
            store(to, load(to) - taken[v]);
        }
    }

private:
    // Adds the products with one plane of b.
    template <Op op, Index plane>
    HARMORPH_INLINE void add_plane(const Real* a, Vectors const& b, Offset at) noexcept {
        constexpr Offset next_row = op == Op::plain ? step<planes> : 1;
        Vector factor[vectors];
#pragma GCC unroll 8
        for (Index v = 0; v < vectors; ++v) factor[v] = load(b.at[v] + at);
#pragma GCC unroll 8
        for (Index r = 0; r < rows; ++r) {
            Vector const real = all(a[r * next_row]);
#pragma GCC unroll 8
            for (Index v = 0; v < vectors; ++v) {
                sum[plane][r][v] = Registers::multiply_add(real, factor[v], sum[plane][r][v]);
            }
            if constexpr (planes == 2) {
                // The product of two imaginary parts has the sign of i * i = -1, and the conjugate
                // changes the sign once more.
                constexpr bool adds = (op == Op::conjugate_transposed) == (plane == 1);
                Vector const imaginary = all(a[r * next_row + slab]);
#pragma GCC unroll 8
                for (Index v = 0; v < vectors; ++v) {
                    Vector& other = sum[1 - plane][r][v];
                    if (adds) other = Registers::multiply_add(imaginary, factor[v], other);
                    else other = Registers::multiply_subtract(imaginary, factor[v], other);
                }
            }
        }
    }
};

// A tile for complex numbers that computes three real products in place of four. Let index 1 mean
// real parts and 2 imaginary parts, p = a1 b2 and q = a2 b1. With r = (a1 - a2) (b1 - b2), conj(a)
// b = (r + p + q) + i (p - q); with r = (a1 + a2) (b1 - b2), a b = (r + p - q) + i (p + q). The
// tile sums p, q and r. Among the ways to save a product, this one computes the imaginary part as
// accurately as four products do; the imaginary parts are much smaller than the real ones if cells
// are thin. Three sums for each number leave room for a useful tile only with 32 registers.
template <Index rows, Index vectors>
struct ThreeProductsTile {
    Vector sum[3][rows][vectors] = {};

    template <Op op>
    HARMORPH_INLINE void add(const Real* a, Vectors b, Index depth, Offset first = 0) noexcept {
        constexpr Offset next = op == Op::plain ? 1 : step<2>;
        for (Index k = 0; k < depth; ++k) add_row<op>(a + k * next, b, (first + k) * b.row);
    }

    template <Op op, Store how>
    HARMORPH_INLINE void write_to(Vectors d) const noexcept {
#pragma GCC unroll 8
        for (Index r = 0; r < rows; ++r) {
#pragma GCC unroll 8
            for (Index v = 0; v < vectors; ++v) {
                Vector const p = sum[0][r][v], q = sum[1][r][v];
                Real* const to = d.at[v] + r * d.row;
                put<how>(sum[2][r][v] + (op == Op::plain ? p - q : p + q), to);
                put<how>(op == Op::plain ? p + q : p - q, to + d.plane);
            }
        }
    }

private:
    template <Store how>
    static HARMORPH_INLINE void put(Vector v, Real* to) noexcept {
        store(to, how == Store::subtract ? load(to) - v : v);
    }

    template <Op op>
    HARMORPH_INLINE void add_row(const Real* a, Vectors const& b, Offset at) noexcept {
        constexpr Offset next_row = op == Op::plain ? step<2> : 1;
        Vector real[vectors], imaginary[vectors], difference[vectors];
#pragma GCC unroll 8
        for (Index v = 0; v < vectors; ++v) {
            real[v] = load(b.at[v] + at);
            imaginary[v] = load(b.at[v] + at + b.plane);
            difference[v] = real[v] - imaginary[v];
        }
#pragma GCC unroll 8
        for (Index r = 0; r < rows; ++r) {
            Vector const a_real = all(a[r * next_row]), a_imaginary = all(a[r * next_row + slab]);
            add_products<0>(r, a_real, imaginary);
            add_products<1>(r, a_imaginary, real);
            add_products<2>(r, op == Op::plain ? a_real + a_imaginary : a_real - a_imaginary,
                            difference);
        }
    }

    template <Index number>
    HARMORPH_INLINE void add_products(Index r, Vector a, const Vector (&b)[vectors]) noexcept {
#pragma GCC unroll 8
        for (Index v = 0; v < vectors; ++v) {
            sum[number][r][v] = Registers::multiply_add(a, b[v], sum[number][r][v]);
        }
    }
};

// The faster of both kinds of tile.
template <Index planes, Index rows, Index vectors>
using TileOf = std::conditional_t<planes == 2 && three_products, ThreeProductsTile<rows, vectors>,
                                  Tile<planes, rows, vectors>>;

struct Range {
    Index begin, end;

    Index count() const noexcept { return end - begin; }
};

// The operand and the result of a product. One function serves both kinds of Store, as writing is a
// small part of the code of a tile.
struct Product {
    Store how;
    Vectors b, d;

    template <Op op, class Sums>
    HARMORPH_INLINE void write_to(Sums const& sums) const noexcept {
        if (how == Store::subtract) sums.template write_to<op, Store::subtract>(d);
        else sums.template write_to<op, Store::set>(d);
    }
};

// Computes a tile of A^H B with `depth` rows of a slab of A, beginning at `a`.
template <Index planes, Index rows, Index vectors>
void tile_down(const Real* a, Index depth, Product const& product) noexcept {
    TileOf<planes, rows, vectors> sums;
    sums.template add<Op::conjugate_transposed>(a, product.b, depth);
    product.template write_to<Op::conjugate_transposed>(sums);
}

// Prefetches rows of a slab, which are needed soon, into the second-level cache.
template <Index planes>
HARMORPH_INLINE void prefetch_rows(const Real* row, Index rows) noexcept {
    constexpr Offset line = 64 / sizeof(Real);
    for (Offset k = 0; k < rows * step<planes>; k += line) __builtin_prefetch(row + k, 0, 2);
}

// Computes a tile of A B with the columns k of A and the rows of A that begin at i; a slab begins
// at k.begin. The numbers `ahead` further on are prefetched, unless `ahead` is 0.
template <Index planes, Index rows, Index vectors>
void tile_across(Slabs const& a, Index i, Range k, Product const& product, Offset ahead) noexcept {
    TileOf<planes, rows, vectors> sums;
    const Real* entries = a.at(i, k.begin);
    for (Index c = k.begin; c < k.end; c += slab) {
        if (ahead != 0) prefetch_rows<planes>(entries + ahead, rows);
        sums.template add<Op::plain>(entries, product.b, min(slab, k.end - c), c - k.begin);
        entries += step<planes> * a.rows_of_slab(c / slab);
    }
    product.template write_to<Op::plain>(sums);
}

// Tiles have 1, 2, 4 .. tile_rows rows, which keeps the code small: an odd number of rows is
// divided into an even one and one more.
template <Index planes>
struct Tiles {
    struct TileFunctions {
        void (*down)(const Real* a, Index depth, Product const& product) noexcept;
        void (*across)(Slabs const& a, Index i, Range k, Product const& product,
                       Offset ahead) noexcept;
    };
    struct FunctionsOfHeight {
        TileFunctions of_width[max_vectors];
    };
    static HARMORPH_INLINE TileFunctions const& functions(Index rows, Index vectors) noexcept {
        return all[rows / 2].of_width[vectors - 1];
    }

private:
    template <Index rows, Index vectors>
    static constexpr TileFunctions tile{tile_down<planes, rows, vectors>,
                                        tile_across<planes, rows, vectors>};
    static constexpr Index widest = tile_vectors<planes>;
    template <Index rows>
    static constexpr FunctionsOfHeight of_height{
        {tile<rows, 1>, tile<rows, 2>, tile<rows, widest>}};
    static constexpr Index max_rows = tile_rows<planes>;
    static constexpr FunctionsOfHeight all[] = {
        of_height<1>, of_height<2>, of_height<min(4, max_rows)>, of_height<min(6, max_rows)>,
        of_height<min(8, max_rows)>};
    static_assert(max_rows == 2 || max_rows == 4 || max_rows == 8,
                  "the table `all` has an entry for each even height");
};

// Returns how many vectors hold the columns, at most as many as a tile has.
template <Index planes>
HARMORPH_INLINE Index vectors_of(Index columns) noexcept {
    return columns <= lanes ? 1 : columns <= 2 * lanes ? 2 : tile_vectors<planes>;
}

// Computes D [rows x columns] -= or = A^H B with the columns of A that begin at `a`; whole vectors
// are written.
template <Index planes, class Block>
HARMORPH_INLINE void any_tile_down(Store how, Index rows, Index columns, const Real* a,
                                   Block const& b, Index depth, Block const& d) noexcept {
    Index const vectors = vectors_of<planes>(columns), even = rows / 2 * 2;
    Product product;
    product.how = how;
    b.first(vectors, product.b);
    d.first(vectors, product.d);
    if (even > 0) Tiles<planes>::functions(even, vectors).down(a, depth, product);
    if (even == rows) return;
    product.d.move_down(even);
    Tiles<planes>::functions(1, vectors).down(a + even, depth, product);
}
// Computes D [rows x columns] -= or = A B with the rows of A that begin at i. The last row goes
// first: if D is B, the other rows do not need the last one.
template <Index planes, class Block>
HARMORPH_INLINE void any_tile_across(Store how, Index rows, Index columns, Slabs const& a, Index i,
                                     Range k, Block const& b, Block const& d,
                                     Offset ahead) noexcept {
    Index const vectors = vectors_of<planes>(columns), even = rows / 2 * 2;
    Product product;
    product.how = how;
    b.first(vectors, product.b);
    d.first(vectors, product.d);
    if (even < rows) {
        product.d.move_down(even);
        Tiles<planes>::functions(1, vectors).across(a, i + even, k, product, ahead);
        product.d.move_down(-even);
    }
    if (even > 0) Tiles<planes>::functions(even, vectors).across(a, i, k, product, ahead);
}

template <Index vectors>
void finish_tile(const Real* a, InSlabs<1> const& b, Index depth, const Real* inverse,
                 InSlabs<1> const& d, const Real* y, Real* column_sums) noexcept {
    Vectors from, to;
    b.first(vectors, from);
    d.first(vectors, to);
    Tile<1, slab, vectors> product;
    product.template add<Op::conjugate_transposed>(a, from, depth);
    product.finish(inverse, to, y, column_sums);
}
[[maybe_unused]] HARMORPH_INLINE void any_finish_tile(Index columns, const Real* a,
                                                      InSlabs<1> const& b, Index depth,
                                                      const Real* inverse, InSlabs<1> const& d,
                                                      const Real* y, Real* column_sums) noexcept {
    Index const vectors = vectors_of<1>(columns);
    auto const finish = vectors == 3   ? finish_tile<3>
                        : vectors == 2 ? finish_tile<2>
                                       : finish_tile<1>;
    finish(a, b, depth, inverse, d, y, column_sums);
}

// Computes rows i and columns j of D -= A^H B, summed over the rows k of A and B. If `upper` is
// true, only the upper triangle of D is needed.
template <Index planes>
void subtract_product(Slabs const& a, Slabs const& b, Slabs const& d, Range k, Range i, Range j,
                      bool upper = false) noexcept {
    using Block = InSlabs<planes>;
    for (Index c = j.begin; c < j.end; c += tile_columns<planes>) {
        Index const end = min(j.end, c + tile_columns<planes>),
                    last = upper ? min(i.end, end) : i.end;
        for (Index r = i.begin; r < last; r += tile_rows<planes>) {
            Index const from = upper ? max(c, r / lanes * lanes) : c;
            any_tile_down<planes>(Store::subtract, min(tile_rows<planes>, last - r), end - from,
                                  a.at(k.begin, r), Block{b, k.begin, from}, k.count(),
                                  Block{d, r, from});
        }
    }
}

// Subtracts the product from right-hand sides: row 0 of d is row i.begin of D, row 0 of b is row
// k.begin of B.
template <Index planes>
void subtract_from_rows(Slabs const& a, InRows<planes> b, InRows<planes> d, Range k,
                        Range i) noexcept {
    for (Index r = i.begin; r < i.end; r += tile_rows<planes>) {
        for (Index c = 0; c < d.width; c += tile_columns<planes>) {
            any_tile_down<planes>(Store::subtract, min(tile_rows<planes>, i.end - r),
                                  static_cast<Index>(d.width) - c, a.at(k.begin, r), b.at(0, c),
                                  k.count(), d.at(r - i.begin, c));
        }
    }
}

// Computes b [n x columns] = E b, where E is the inverse that is stored in u at (first, first). E
// is lower triangular: row r needs the rows <= r, so the last rows go first.
template <Index planes, class Block>
HARMORPH_INLINE void apply_inverse(Slabs const& u, Index first, Index n, Index columns,
                                   Block const& b) noexcept {
    for (Index c = 0; c < columns; c += tile_columns<planes>) {
        for (Index r = (n - 1) / tile_rows<planes> * tile_rows<planes>; r >= 0;
             r -= tile_rows<planes>) {
            Index const rows = min(tile_rows<planes>, n - r);
            any_tile_across<planes>(Store::set, rows, columns - c, u, first + r,
                                    {first, first + r + rows}, b.at(0, c), b.at(r, c), 0);
        }
    }
}

// Computes b [n x width] = E^H b. Row r needs the rows >= r, so the first rows go first.
template <Index planes>
void apply_inverse_transposed(Index n, const Real* inverse, InRows<planes> b) noexcept {
    for (Index c = 0; c < b.width; c += tile_columns<planes>) {
        for (Index r = 0; r < n; r += tile_rows<planes>) {
            any_tile_down<planes>(Store::set, min(tile_rows<planes>, n - r),
                                  static_cast<Index>(b.width) - c, inverse + r * step<planes> + r,
                                  b.at(r, c), n - r, b.at(r, c));
        }
    }
}

// Computes d -= A (i, k) b for all rows i. Row 0 of b is row k.begin, where a slab begins; row 0 of
// d is row i.begin.
template <Index planes>
void subtract_across(Slabs const& a, Range k, Range i, InRows<planes> b, InRows<planes> d,
                     Offset ahead) noexcept {
    for (Index r = i.begin; r < i.end; r += tile_rows<planes>) {
        for (Index c = 0; c < d.width; c += tile_columns<planes>) {
            any_tile_across<planes>(Store::subtract, min(tile_rows<planes>, i.end - r),
                                    static_cast<Index>(d.width) - c, a, r, k, b.at(0, c),
                                    d.at(r - i.begin, c), c == 0 ? ahead : 0);
        }
    }
}

}  // namespace
}  // namespace harmorph::dense::HARMORPH_SET
