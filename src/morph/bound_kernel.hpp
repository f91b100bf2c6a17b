// The smooth quality and the relative corner areas of several cells at a time, with weights and
// derivatives, with the registers of one instruction set; cell_kernel.hpp includes this file for
// each set. morph/odd_cells has the same formulas for one cell. tests/morph/test_cell_bounds.cpp
// covers this file.

namespace harmorph::cell_measures::HARMORPH_SET {
namespace {

// Returns e^x in each lane; numbers above 600 count as 600, and below x = -600 the result is 0. The
// relative error is a few units in the last place. The number n nearest to x / log 2 is found by
// adding 1.5 * 2^52, of which n then is the lowest bits.
HARMORPH_INLINE Vector exponentials(Vector x) noexcept {
    constexpr Real min_exponent = -600, max_exponent = 600, grid = 0x1.8p52,
                   per_log_2 = 1.4426950408889634;
    Vector const zero = {},
                 within = lanes_min(lanes_max(x, zero + min_exponent), zero + max_exponent);
    Vector const shifted = within * per_log_2 + grid, n = shifted - grid;
    Vector series;
    exponential_series((within - n * log_2_high) - n * log_2_low, series);
    Vector const result = (Vector)((Words)series + ((Words)shifted << 52));
    return x > min_exponent ? result : zero;
}

// Replaces four numbers by their inverses with one division. Products of four must not overflow or
// underflow.
HARMORPH_INLINE void invert(Vector (&number)[4]) noexcept {
    Vector const first = number[0] * number[1], last = number[2] * number[3];
    Vector const inverse = 1 / (first * last), of_first = inverse * last, of_last = inverse * first;
    Vector const a = number[0], c = number[2];
    number[0] = of_first * number[1];
    number[1] = of_first * a;
    number[2] = of_last * number[3];
    number[3] = of_last * c;
}
HARMORPH_INLINE void invert(Vector (&number)[1]) noexcept { number[0] = 1 / number[0]; }

// The sides and areas of cells, of which those that are odd are replaced by harmless numbers.
template <Index n>
struct SmoothCorners : Corners<n> {
    static constexpr Index n_areas = Corners<n>::n_areas;
    Vector square_of[n];

    HARMORPH_INLINE explicit SmoothCorners(Shapes<n> const& shapes) noexcept : Corners<n>(shapes) {
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) square_of[k] = square(this->side[k]);
    }
    // Returns 1 in the lanes in which products of four areas, or of four squares of sides, neither
    // overflow nor underflow, and 0 in others.
    HARMORPH_INLINE Vector in_range() const noexcept {
        Vector lowest = this->smallest(), highest = square_of[0];
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) {
            lowest = lanes_min(lowest, square_of[k]);
            highest = lanes_max(highest, square_of[k]);
        }
        Vector const zero = {}, one = zero + 1;
        return ((lowest > min_factor) & (highest < max_factor)) ? one : zero;
    }
    HARMORPH_INLINE void keep(Vector lanes_to_keep) noexcept {
        Vector const zero = {}, one = zero + 1;
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) {
            this->side[k].x = lanes_to_keep > 0 ? this->side[k].x : zero;
            this->side[k].y = lanes_to_keep > 0 ? this->side[k].y : zero;
            square_of[k] = lanes_to_keep > 0 ? square_of[k] : one;
        }
#pragma GCC unroll 4
        for (Index k = 0; k < n_areas; ++k)
            this->twice_area[k] = lanes_to_keep > 0 ? this->twice_area[k] : one;
    }
};

// A value, and its derivatives: the derivative is the sum of by_area[k] d(twice_area[k]) and
// by_side[k] side[k] . d(side[k]).
template <Index n>
struct SmoothValue {
    Vector value = {}, by_area[Corners<n>::n_areas] = {}, by_side[n] = {};
};

// Computes the skew quality f. For a quad, 1 / sin = r / A at each corner, with r the product of
// the lengths of the two sides and A twice the area, and f = 4 / (sum of 1 / sin).
template <Index n>
HARMORPH_INLINE SmoothValue<n> smooth_skew(SmoothCorners<n> const& corners) noexcept {
    SmoothValue<n> skew;
    Vector const* const s = corners.square_of;
    if constexpr (n == 3) {
        Vector const per_squares = 1 / (s[0] + s[1] + s[2]);
        skew.by_area[0] = 2 * 1.7320508075688772 * per_squares;
        skew.value = skew.by_area[0] * corners.twice_area[0];
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) skew.by_side[k] = -2 * skew.value * per_squares;
    } else {
        Vector per_area[4], per_square[4], inverse_sine[4];
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) {
            per_area[k] = corners.twice_area[k];
            per_square[k] = s[k];
        }
        invert(per_area);
        invert(per_square);
        Vector const root[3] = {Registers::sqrt(s[0] * s[1]), Registers::sqrt(s[1] * s[2]),
                                Registers::sqrt(s[2] * s[3])};
        // The product of the lengths of sides 3 and 0 follows from the other three products.
        Vector const last = root[0] * root[2] * root[1] * (per_square[1] * per_square[2]);
        inverse_sine[0] = last * per_area[0];
#pragma GCC unroll 4
        for (Index k = 1; k < n; ++k) inverse_sine[k] = root[k - 1] * per_area[k];
        skew.value =
            4 / ((inverse_sine[0] + inverse_sine[1]) + (inverse_sine[2] + inverse_sine[3]));
        Vector const factor = 0.25 * skew.value * skew.value;
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) {
            skew.by_area[k] = factor * inverse_sine[k] * per_area[k];
            skew.by_side[k] =
                -factor * (inverse_sine[k] + inverse_sine[(k + 1) & 3]) * per_square[k];
        }
    }
    return skew;
}

// Multiplies f by the size term s(t) = sqrt(2 t / (1 + t^2)), with t = a / b for the areas a and b
// of the cell now and at the start: ds/da = s (b^2 - a^2) / (2 a (a^2 + b^2)).
template <Index n>
HARMORPH_INLINE void multiply_by_size(SmoothValue<n>& quality, Vector a, Vector b) noexcept {
    Vector const squares = a * a + b * b, inverse = 1 / (a * squares);
    Vector const size = Registers::sqrt(2 * (a * a * b * inverse));
    Vector const by_cell_area = quality.value * (0.5 * size) * (b * b - a * a) * inverse;
    quality.value = quality.value * size;
#pragma GCC unroll 4
    for (Index k = 0; k < n; ++k) quality.by_side[k] = quality.by_side[k] * size;
#pragma GCC unroll 4
    for (Index k = 0; k < Corners<n>::n_areas; ++k) {
        quality.by_area[k] = quality.by_area[k] * size;
        if (k % 2 == 0) quality.by_area[k] = quality.by_area[k] + 0.5 * by_cell_area;
    }
}

// Stores the derivatives by the corners, given those by areas, and by sides unless they are 0.
template <Index n, bool has_sides>
HARMORPH_INLINE void store_slopes(SmoothCorners<n> const& corners, SmoothValue<n> const& value,
                                  Index i, SmoothSlopes& slopes) noexcept {
    Vectors by[n] = {};
#pragma GCC unroll 4
    for (Index k = 0; k < n; ++k) {
        if (has_sides)
            by[k] = {value.by_side[k] * corners.side[k].x, value.by_side[k] * corners.side[k].y};
    }
#pragma GCC unroll 4
    for (Index k = 0; k < Corners<n>::n_areas; ++k) {
        Index const in = corners.before(k), out = corners.after(k);
        Vector const factor = value.by_area[k];
        by[out] = by[out] + Vectors{-factor * corners.side[in].y, factor * corners.side[in].x};
        by[in] = by[in] + Vectors{factor * corners.side[out].y, -factor * corners.side[out].x};
    }
#pragma GCC unroll 4
    for (Index k = 0; k < n; ++k) {
        Vectors const at = by[k == 0 ? n - 1 : k - 1] - by[k];
        Registers::store(slopes.x[k] + i, at.x);
        Registers::store(slopes.y[k] + i, at.y);
    }
}

template <Index n>
HARMORPH_INLINE void store_quality(SmoothCorners<n> const& corners, SmoothCorners<n> const& start,
                                   SmoothRequest const& request, Index i,
                                   SmoothList& list) noexcept {
    SmoothValue<n> quality = smooth_skew(corners);
    if (request.kept) {
        Vector const per_start = 1 / smooth_skew(start).value;
        quality.value = quality.value * per_start;
#pragma GCC unroll 4
        for (Index k = 0; k < Corners<n>::n_areas; ++k)
            quality.by_area[k] = quality.by_area[k] * per_start;
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) quality.by_side[k] = quality.by_side[k] * per_start;
    }
    multiply_by_size(quality, corners.area(), start.area());
    Vector const weight =
        exponentials(request.quality_sharpness * (request.quality_shift - quality.value));
    Registers::store(list.quality + i, quality.value);
    Registers::store(list.quality_weight + i, weight);
    if (!request.slopes) return;
#pragma GCC unroll 4
    for (Index k = 0; k < Corners<n>::n_areas; ++k)
        quality.by_area[k] = weight * quality.by_area[k];
#pragma GCC unroll 4
    for (Index k = 0; k < n; ++k) quality.by_side[k] = weight * quality.by_side[k];
    store_slopes<n, true>(corners, quality, i, list.by_quality);
}

template <Index n>
HARMORPH_INLINE void store_areas(SmoothCorners<n> const& corners, SmoothCorners<n> const& start,
                                 SmoothRequest const& request, Index i, SmoothList& list) noexcept {
    constexpr Index n_areas = Corners<n>::n_areas;
    SmoothValue<n> area;
    Vector per_start[n_areas], weight_sum = {};
#pragma GCC unroll 4
    for (Index k = 0; k < n_areas; ++k) per_start[k] = start.twice_area[k];
    invert(per_start);
#pragma GCC unroll 4
    for (Index k = 0; k < n_areas; ++k) {
        Vector const ratio = corners.twice_area[k] * per_start[k];
        Vector const weight = exponentials(request.area_sharpness * (request.area_shift - ratio));
        area.value = k == 0 ? ratio : lanes_min(ratio, area.value);
        area.by_area[k] = weight * per_start[k];
        weight_sum = weight_sum + weight;
    }
    Registers::store(list.area + i, area.value);
    Registers::store(list.area_weight + i, weight_sum);
    if (request.slopes) store_slopes<n, false>(corners, area, i, list.by_area);
}

template <Index n>
void smooth(CellList const& cells, CellPlaces const& given_places, SmoothRequest const& request,
            SmoothList& list) noexcept {
    list.odd = 0;
    if (cells.n == 0) return;
    Places<n> const places(cells, given_places.at, given_places.reference);
    for (Index i = 0; i < cells.n; i += lanes) {
        SmoothCorners<n> corners(places.shapes(i)), start(places.others(i));
        Vector const zero = {}, kept = corners.in_range() * start.in_range();
        unsigned const regular = Registers::less(zero, kept);
        if (regular != all) {
            corners.keep(kept);
            start.keep(kept);
            list.odd |= std::uint64_t{~regular & all} << i;
        }
        if (request.quality) store_quality(corners, start, request, i, list);
        if (request.area) store_areas(corners, start, request, i, list);
    }
    if (cells.n < CellBatches::max_count) list.odd &= (std::uint64_t{1} << cells.n) - 1;
}

constexpr SmoothKernels smooth_kernels{smooth<3>, smooth<4>};

}  // namespace
}  // namespace harmorph::cell_measures::HARMORPH_SET

namespace harmorph::simd {
template <>
inline constexpr const SmoothKernels* table<SmoothKernels, Kernel::HARMORPH_SET> =
    &harmorph::cell_measures::HARMORPH_SET::smooth_kernels;
}  // namespace harmorph::simd
