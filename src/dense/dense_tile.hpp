// A tile of a product of dense blocks in the registers of one instruction set, and the places of
// the operands in memory. dense_table.cpp compiles this file for each set.
// tests/dense/test_dense.cpp covers this file.

namespace harmorph::dense::HARMORPH_SET {
namespace {

// These functions are not those of base/scalar.hpp, because the linker might use the copy that is
// compiled here, with the instructions of this set, in all other code.
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
// right-hand sides. Both begin at one entry. first(n) returns n vectors; the vectors after them
// repeat the first one.
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

// op(A) of an A in slabs: element (r, k) is that of the conjugate transpose, read from A (k, r), or
// that of A itself, read from A (r, k) within one slab.
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

}  // namespace
}  // namespace harmorph::dense::HARMORPH_SET
