// Products of dense blocks with the registers of one instruction set. dense_table.cpp compiles this
// file for each set. All products are D -= op(A) B or D = op(A) B, with one tile of D at a time in
// registers. tests/dense/test_dense.cpp covers this file.
#include "dense/dense_tile.hpp"

namespace harmorph::dense::HARMORPH_SET {
namespace {

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
HARMORPH_INLINE void any_finish_tile(Index columns, const Real* a, InSlabs<1> const& b, Index depth,
                                     const Real* inverse, InSlabs<1> const& d, const Real* y,
                                     Real* column_sums) noexcept {
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
