// The products of morphing with the registers of one instruction set; product.cpp compiles this file for each of them.

namespace harmorph::HARMORPH_SET {
namespace {

using Registers = simd::HARMORPH_SET::Registers<Real>;
using Vector = Registers::Vector;
using Words = Registers::Words;

constexpr Index lanes = Registers::lanes;
constexpr Index sums = 8;                // partial sums of a point, in all kernels: number k goes to sum k modulo 8
constexpr Index vectors = sums / lanes;
constexpr Index at_once = lanes == 8 ? 8 : lanes == 4 ? 2 : 1;  // points whose partial sums fit into the registers
constexpr Index tile_points = 4;         // the transpose adds the products of so many points at a time in registers
constexpr Index streams = 2;             // rows are read from two streams in turn, as this has more bandwidth than one
constexpr Offset prefetch_ahead = 4096;  // bytes at least: prefetches are a page, or a tile, ahead

// Distance from a number in use to the number prefetched: whole rows, as rows may be longer than the numbers used.
template <class Number>
HARMORPH_INLINE Offset numbers_ahead(ValueRows<Number> const& rows) noexcept {
    Offset const least = prefetch_ahead / static_cast<Offset>(sizeof(Number)), tile = tile_points * rows.row;
    return tile >= least || rows.row == 0 ? tile : (least + rows.row - 1) / rows.row * rows.row;
}

template <Index... lane>
struct Lanes {};
template <Index n, Index... lane>
struct FirstLanes : FirstLanes<n - 1, n - 1, lane...> {};
template <Index... lane>
struct FirstLanes<0, lane...> {
    using All = Lanes<lane...>;
};
using AllLanes = FirstLanes<lanes>::All;

// Adds lanes i and i + distance of a, and likewise of b; the sums of b go to the lanes i + distance.
template <Index distance, Index... lane>
HARMORPH_INLINE Vector fold(Vector a, Vector b, Lanes<lane...>) noexcept {
#if defined(__clang__)
    Vector const unmoved = __builtin_shufflevector(a, b, ((lane & distance) != 0 ? lanes + lane : lane)...);
    Vector const moved =
        __builtin_shufflevector(a, b, ((lane & distance) != 0 ? lanes + lane - distance : lane + distance)...);
#else
    Vector const unmoved = __builtin_shuffle(a, b, Words{((lane & distance) != 0 ? lanes + lane : lane)...});
    Vector const moved =
        __builtin_shuffle(a, b, Words{((lane & distance) != 0 ? lanes + lane - distance : lane + distance)...});
#endif
    return unmoved + moved;
}

// Returns the sum over the lanes of partial[p] in lane p. Overwrites `partial`.
template <Index distance = lanes / 2>
HARMORPH_INLINE Vector totals_of(Vector* partial) noexcept {
    for (Index p = 0; p < distance; ++p) partial[p] = fold<distance>(partial[p], partial[p + distance], AllLanes{});
    if constexpr (distance > 1) return totals_of<distance / 2>(partial);
    else return partial[0];
}

// With totals_of(): ((0+4)+(2+6)) + ((1+5)+(3+7)), whatever the width.
HARMORPH_INLINE Vector folded(const Vector* partial) noexcept {
    if constexpr (vectors == 4) return (partial[0] + partial[2]) + (partial[1] + partial[3]);
    else if constexpr (vectors == 2) return partial[0] + partial[1];
    else return partial[0];
}

// Products of `points` rows with the movements, summed up but for the sum over the lanes.
template <Index points, class Number>
HARMORPH_INLINE void multiply_points(const Number* values, Offset row, Index n, Movements const& by, Offset ahead,
                                     Vector* sum_x, Vector* sum_y) noexcept {
    Vector x[points][vectors] = {}, y[points][vectors] = {};
    Index k = 0;
    for (; k + sums <= n; k += sums) {
        for (Index p = 0; p < points; ++p) __builtin_prefetch(values + p * row + k + ahead);
        for (Index v = 0; v < vectors; ++v) {
            Vector const by_x = Registers::load(by.x + k + v * lanes), by_y = Registers::load(by.y + k + v * lanes);
            for (Index p = 0; p < points; ++p) {
                Vector const f = Registers::load(values + p * row + k + v * lanes);
                x[p][v] += f * by_x;
                y[p][v] += f * by_y;
            }
        }
    }
    for (Index v = 0; v < vectors && k + v * lanes < n; ++v) {
        Index const here = k + v * lanes, left = n - here;
        Vector const by_x = Registers::load(by.x + here), by_y = Registers::load(by.y + here);
        for (Index p = 0; p < points; ++p) {
            const Number* const from = values + p * row + here;
            Vector const f = left >= lanes ? Registers::load(from) : Registers::load_part(from, left);
            x[p][v] += f * by_x;
            y[p][v] += f * by_y;
        }
    }
    for (Index p = 0; p < points; ++p) {
        sum_x[p] = folded(x[p]);
        sum_y[p] = folded(y[p]);
    }
}

template <class Number>
HARMORPH_INLINE void multiply_group(ValueRows<Number> const& rows, Index p, Movements const& by, Offset ahead,
                                    Sums const& to) noexcept {
    Vector x[lanes], y[lanes];
    for (Index i = 0; i < lanes; i += at_once) {
        multiply_points<at_once>(rows.values + (p + i) * rows.row, rows.row, rows.n_functions, by, ahead, x + i, y + i);
    }
    Registers::store(to.x + p, Registers::load(to.x + p) + totals_of(x));
    Registers::store(to.y + p, Registers::load(to.y + p) + totals_of(y));
}

template <class Number>
void multiply_rows(ValueRows<Number> const& rows, Movements const& by, Sums const& to) noexcept {
    Offset const ahead = numbers_ahead(rows);
    Index const stream = rows.n_points / streams / lanes * lanes;
    for (Index p = 0; p < stream; p += lanes) {
        for (Index s = 0; s < streams; ++s) multiply_group(rows, s * stream + p, by, ahead, to);
    }
    Index p = streams * stream;
    for (; p + lanes <= rows.n_points; p += lanes) multiply_group(rows, p, by, ahead, to);
    if (p == rows.n_points) return;
    Vector x[lanes] = {}, y[lanes] = {};
    for (Index i = 0; p + i < rows.n_points; ++i) {
        multiply_points<1>(rows.values + (p + i) * rows.row, rows.row, rows.n_functions, by, ahead, x + i, y + i);
    }
    Vector const total_x = totals_of(x), total_y = totals_of(y);
    for (Index i = 0; p + i < rows.n_points; ++i) {
        to.x[p + i] += total_x[i];
        to.y[p + i] += total_y[i];
    }
}

// Two sums of products in fixed point, see FixedSum, of which settled() makes the coarse and the fine one.
template <class Of, bool rounds = Of::rounds>
struct SumIn;

template <class Of>
struct SumIn<Of, true> {
    Words first, second;

    // The sum modulo 2^64, and in floating point: the error of the latter is far below 2^63, so the multiple of 2^64
    // that is missing in the former is known.
    HARMORPH_INLINE void add(Vector t) noexcept {
        first += Of::round(t);
        second = reinterpret_cast<Words>(reinterpret_cast<Vector>(second) + t);
    }
    static HARMORPH_INLINE FixedSum settled(std::uint64_t first, std::uint64_t second, Index) noexcept {
        Real rough;
        std::memcpy(&rough, &second, sizeof rough);
        Real const missing = (rough - static_cast<Real>(first)) * 0x1p-64;
        std::int64_t const times = static_cast<std::int64_t>(missing + (missing < 0 ? -0.5 : 0.5));
        constexpr std::int64_t coarse_in_word = std::int64_t{1} << (64 - FixedSum::fine_bits);
        return {times * coarse_in_word + static_cast<std::int64_t>(first >> FixedSum::fine_bits),
                static_cast<std::int64_t>(first & FixedSum::fine_mask)};
    }
};

template <class Of>
struct SumIn<Of, false> {
    Words first, second;

    // Sums the bits of numbers rounded to the grids of FixedSum: multiples of its units, plus the bits of the grid
    // itself.
    HARMORPH_INLINE void add(Vector t) noexcept {
        Vector const on_grid = t + FixedSum::coarse_grid;
        first += reinterpret_cast<Words>(on_grid);
        second += reinterpret_cast<Words>((t - (on_grid - FixedSum::coarse_grid)) + FixedSum::fine_grid);
    }
    static HARMORPH_INLINE FixedSum settled(std::uint64_t first, std::uint64_t second, Index n_points) noexcept {
        std::uint64_t const times = static_cast<std::uint64_t>(n_points);
        return {static_cast<std::int64_t>(first - times * FixedSum::bits_of_coarse_grid),
                static_cast<std::int64_t>(second - times * FixedSum::bits_of_fine_grid)};
    }
};

using Sum = SumIn<Registers>;

struct BlockOfSums {
    std::uint64_t first[Movements::most], second[Movements::most];

    HARMORPH_INLINE Sum at(Index k) const noexcept {
        return {Registers::load_words(first + k), Registers::load_words(second + k)};
    }
    HARMORPH_INLINE void set(Index k, Sum sum) noexcept {
        Registers::store_words(first + k, sum.first);
        Registers::store_words(second + k, sum.second);
    }
};

template <Index points, class Number>
HARMORPH_INLINE void multiply_transposed(const Number* values, Offset row, Index n, const Vec2* by, Offset ahead,
                                         BlockOfSums& sum_x, BlockOfSums& sum_y) noexcept {
    for (Index k = 0; k < n; k += lanes) {
        Sum x = sum_x.at(k), y = sum_y.at(k);
        for (Index p = 0; p < points; ++p) {
            const Number* const from = values + p * row + k;
            if (k % sums == 0) __builtin_prefetch(from + ahead);
            Vector const f = n - k >= lanes ? Registers::load(from) : Registers::load_part(from, n - k);
            x.add(f * by[p].x);
            y.add(f * by[p].y);
        }
        sum_x.set(k, x);
        sum_y.set(k, y);
    }
}

template <class Number>
void multiply_rows_transposed(ValueRows<Number> const& rows, const Vec2* by, FixedSums& total) noexcept {
    Offset const ahead = numbers_ahead(rows);
    Index const n = rows.n_functions;
    BlockOfSums x, y;
    for (Index k = 0; k < n; k += lanes) {
        x.set(k, Sum{});
        y.set(k, Sum{});
    }
    Index const stream = rows.n_points / streams / tile_points * tile_points;
    for (Index p = 0; p < stream; p += tile_points) {
        for (Index s = 0; s < streams; ++s) {
            Index const first = s * stream + p;
            multiply_transposed<tile_points>(rows.values + first * rows.row, rows.row, n, by + first, ahead, x, y);
        }
    }
    for (Index p = streams * stream; p < rows.n_points; ++p) {
        multiply_transposed<1>(rows.values + p * rows.row, rows.row, n, by + p, ahead, x, y);
    }
    for (Index k = 0; k < n; ++k) {
        total.x[k] += Sum::settled(x.first[k], x.second[k], rows.n_points);
        total.y[k] += Sum::settled(y.first[k], y.second[k], rows.n_points);
    }
}

void add_sums(const Real* from, Real* to, const Real* sum, Index n) noexcept {
    Index i = 0;
    for (; i + lanes <= n; i += lanes) {
        Vector const old = Registers::load(from + i), by = Registers::load(sum + i);
        Registers::store(to + i, by == 0 ? old : old + by);
    }
    for (; i < n; ++i) to[i] = sum[i] == 0 ? from[i] : from[i] + sum[i];
}

constexpr ProductKernels kernels{{multiply_rows<Real>, multiply_rows_transposed<Real>},
                                 {multiply_rows<float>, multiply_rows_transposed<float>},
                                 add_sums};

}  // namespace
}  // namespace harmorph::HARMORPH_SET

namespace harmorph::simd {
template <>
inline constexpr const ProductKernels* table<ProductKernels, Kernel::HARMORPH_SET> = &harmorph::HARMORPH_SET::kernels;
}  // namespace harmorph::simd
