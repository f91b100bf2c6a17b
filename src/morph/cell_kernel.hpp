// Areas, quality and admissible steps of several cells at a time, with the registers of one
// instruction set; cell_batch.cpp compiles this file for each of them. The formulas are those of
// mesh/cell_shape, morph/quality and morph/admissible_step, in the same order of operations.
#include "morph/cell_places.hpp"

namespace harmorph::cell_looks::HARMORPH_SET {
namespace {

template <Index n>
struct Corners {
    static constexpr Index n_areas = n == 3 ? 1 : 4;
    Vectors side[n];
    Vector twice_area[n_areas];

    // The sides that meet at a corner.
    static constexpr Index before(Index k) noexcept { return n == 3 ? 0 : (k + 3) & 3; }
    static constexpr Index after(Index k) noexcept { return n == 3 ? 1 : k; }

    HARMORPH_INLINE explicit Corners(Shapes<n> const& shapes) noexcept {
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) side[k] = shapes.at[k + 1 == n ? 0 : k + 1] - shapes.at[k];
#pragma GCC unroll 4
        for (Index k = 0; k < n_areas; ++k) twice_area[k] = cross(side[before(k)], side[after(k)]);
    }
    HARMORPH_INLINE Vector smallest() const noexcept {
        if (n == 3) return twice_area[0];
        Vector const* const a = twice_area;
        Vector const sum = (a[0] + a[n_areas / 4]) + (a[n_areas / 2] + a[n_areas - 1]);
        Vector const least =
            least_of(least_of(a[0], a[n_areas / 4]), least_of(a[n_areas / 2], a[n_areas - 1]));
        Vector const zero = sum - sum;
        return zero == 0 ? least : zero;
    }
    HARMORPH_INLINE Vector area() const noexcept {
        return 0.5 * (n == 3 ? twice_area[0] : twice_area[0] + twice_area[n_areas / 2]);
    }
};

// As skew_fraction() and CellMeasure::quality(). Roots come first: they go on while other things
// are computed. Where a cell is inverted, nothing is divided by its areas: that might raise a
// floating-point exception. Without an area of reference: skew quality.
template <Index n>
class Qualities {
public:
    HARMORPH_INLINE void begin(Corners<n> const& corners, bool is_compared,
                               Vector reference_area) noexcept {
        Vector const zero = {}, one = zero + 1;
        Vector cell_area = corners.area(), squares[n];
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) squares[k] = square(corners.side[k]);
#pragma GCC unroll 4
        for (Index k = 0; k < Corners<n>::n_areas; ++k) area_[k] = corners.twice_area[k];
        Vector const sum = n == 3 ? squares[0] + squares[1] + squares[2]
                                  : (squares[0] + squares[n / 2]) + (squares[1] + squares[n - 1]);
        smallest = corners.smallest();
        Vector size = is_compared ? most_of(reference_area, -reference_area) : smallest;
        Vector const least = least_of(size, smallest),
                     most = most_of(sum, size);  // one is NaN where anything is
        regular_ = (Registers::less(zero + min_factor, least) &
                    Registers::less(most, zero + max_factor)) == all;
        if (!regular_) {
            auto const in_range = (least > min_factor) & (most < max_factor);
#pragma GCC unroll 4
            for (Index k = 0; k < n; ++k) squares[k] = in_range ? squares[k] : one;
#pragma GCC unroll 4
            for (Index k = 0; k < Corners<n>::n_areas; ++k) area_[k] = in_range ? area_[k] : one;
            size = in_range ? size : one;
            cell_area = in_range ? cell_area : one;
            in_range_ = in_range ? one : zero;
        }
        if (n == 3) {
            sum_ = squares[0] + squares[1] + squares[2];
        } else {
            sum_ = squares[1] * squares[n / 2];
            root_[0] = Registers::sqrt(squares[0] * squares[1]);
            root_[1] = Registers::sqrt(sum_);
            root_[2] = Registers::sqrt(squares[n / 2] * squares[n - 1]);
        }
        mean_ = is_compared ? Registers::sqrt(cell_area * size) : one;
        larger_ = is_compared ? most_of(cell_area, size) : one;
    }
    HARMORPH_INLINE Vector end() const noexcept {
        Vector above, under;
        if constexpr (n == 3) skew_of_triangle(area_[0], sum_, above, under);
        else skew_of_quad(area_, root_, sum_, above, under);
        Vector const quality = above * mean_ / (under * larger_), zero = {};
        if (regular_) return quality;
        return in_range_ > 0 ? quality : smallest > 0 ? zero + ListQuality::not_in_range : zero;
    }

    Vector smallest = {};  // twice the smallest corner area

private:
    bool regular_ = true;
    Vector in_range_ = {}, larger_ = {},
           mean_ = {};  // of areas: the larger of the two, the geometric mean
    Vector sum_ = {}, root_[3] = {}, area_[Corners<n>::n_areas] = {};
};

// Of c + b s + a s^2: is it positive, and far from a root, for 0 <= s <= step? By its value at
// `step`, which is at least a millionth of its terms, and at its minimum, if that comes before. 1
// in the lanes where that holds, 0 in others. Steps are less than 1e50, or infinite, so that
// nothing overflows.
HARMORPH_INLINE Vector stays_positive(Vector a, Vector b, Vector c, Real step) noexcept {
    constexpr Real most = 1e50, far = 1e-6;
    Vector const zero = {}, one = zero + 1;
    auto const has_minimum = (b < 0) & (a > 0) & (-b < 2 * a * (step < most ? step : most));
    Vector const at_minimum = (has_minimum ? -b : zero) / (has_minimum ? 2 * a : one);
    auto holds = c + 0.5 * b * at_minimum > far * c;
    if (step < infinity) {
        Vector const terms = c + step * ((b < 0 ? -b : b) + step * (a < 0 ? -a : a));
        holds &= c + step * (b + step * a) > far * terms;
    } else {
        holds &= has_minimum | ((a >= 0) & (b >= 0) & (a + b < infinity));
    }
    return holds ? one : zero;
}

// Of triangles: has the product of these two sides the digits of the area? In needles it may not;
// those are left.
template <Index n>
HARMORPH_INLINE unsigned keeps_digits(Corners<n> const& corners) noexcept {
    Vector const product = corners.side[0].x * corners.side[1].y;
    return Registers::less(1e-9 * most_of(product, -product), corners.twice_area[0]);
}

// First a bound of all corners at once: no area is smaller than area + slope s - |curvature| s^2
// with the smallest of each. Then, where that is not enough for a cell, the areas themselves. Bits
// of the cells that are left.
template <Index n>
HARMORPH_INLINE std::uint64_t limiting(Corners<n> const& now, Corners<n> const& change,
                                       Real step) noexcept {
    constexpr Index n_areas = Corners<n>::n_areas;
    Vector const zero = {}, *const area = now.twice_area, *const curvature = change.twice_area;
    Vector slope[n_areas], least, falls, bends, sum;
#pragma GCC unroll 4
    for (Index k = 0; k < n_areas; ++k) {
        Index const before = now.before(k), after = now.after(k);
        slope[k] = cross(now.side[before], change.side[after]) +
                   cross(change.side[before], now.side[after]);
        sum = k == 0 ? area[k] + slope[k] : sum + (area[k] + slope[k]);
        falls = k == 0 ? slope[k] : least_of(falls, slope[k]);
        least = k == 0 ? area[k] : least_of(least, area[k]);
        bends = k == 0 ? curvature[k] : least_of(bends, curvature[k]);
    }
    falls = least_of(falls, zero);
    bends = least_of(bends, zero);
    unsigned const clear = n == 3 ? keeps_digits(now) : all;
    unsigned kept;
    if (step < infinity) {
        kept = Registers::less(sum - sum,
                               least + step * (falls + step * bends));  // nothing is less than NaN
    } else {
#pragma GCC unroll 4
        for (Index k = 0; k < n_areas; ++k) sum += curvature[k];
        kept = Registers::less(sum - sum, least) & ~Registers::less(falls + bends, zero);
    }
    kept &= clear;
    if (kept == all || (step >= 1e50 && step < infinity)) return ~kept & all;
    Vector stays = zero + 1;
#pragma GCC unroll 4
    for (Index k = 0; k < n_areas; ++k)
        stays *= stays_positive(curvature[k], slope[k], area[k], step);
    return ~(kept | (Registers::less(zero, stays) & clear)) & all;
}

// Looks at as many cells as a register has lanes, from cell i of a list on. Adds their qualities to
// `sums`.
template <Index n>
HARMORPH_INLINE std::uint64_t look_at_group(Places<n> const& places, Index i, bool moves,
                                            bool is_compared, CellBounds const& bounds,
                                            ListQuality* quality, Vector& sums) noexcept {
    Vector const zero = {};
    Shapes<n> shapes = places.shapes(i), other = shapes;
    Corners<n> const now(shapes);
    Vector reference_area = zero;
    if (is_compared) {
        other = places.others(i);
        reference_area = moves ? now.area() : other.area();
        if (moves) shapes.move_by(other);
    }
    Qualities<n> qualities;
    if (quality != nullptr) qualities.begin(Corners<n>(shapes), is_compared, reference_area);
    std::uint64_t const found = moves ? limiting<n>(now, Corners<n>(other), bounds.step) : 0;
    if (quality == nullptr) return found << i;
    Vector const smallest = qualities.smallest, its = qualities.end();
    Registers::store(quality->twice_smallest + i, smallest);
    Registers::store(quality->quality + i, its);
    sums += its > 0 ? its : zero;
    std::uint64_t const plain =
        Registers::less(zero, smallest) & ~Registers::less(smallest, zero + bounds.twice_area) &
        ~Registers::less(its, zero + bounds.quality) & Registers::less(its, zero + infinity);
    quality->notable |= (~plain & all) << i;
    return found << i;
}

template <Index n>
std::uint64_t look_at(CellList const& cells, CellPlaces const& its, CellBounds const& bounds,
                      ListQuality* quality) noexcept {
    if (cells.n == 0) return 0;
    constexpr Index groups = eight / lanes;  // as many sums in all kernels
    bool const moves = its.change.given(), is_compared = moves || its.reference.given();
    Places<n> const places(cells, its.at, moves ? its.change : its.reference);
    std::uint64_t found = 0;
    Vector sums[groups] = {};
    Real sum[eight];
    for (Index i = 0; i < cells.n; i += eight) {
        if (cells.n - i < eight) {
            for (Index k = 0; k < groups; ++k) Registers::store(sum + k * lanes, sums[k]);
        }
#pragma GCC unroll 1
        for (Index k = 0; k < groups; ++k) {
            found |= look_at_group<n>(places, i + lanes * k, moves, is_compared, bounds, quality,
                                      sums[k]);
        }
    }
    std::uint64_t const given =
        cells.n == CellBatches::most ? ~std::uint64_t{} : (std::uint64_t{1} << cells.n) - 1;
    if (quality != nullptr) {
        if (cells.n % eight == 0) {
            for (Index k = 0; k < groups; ++k) Registers::store(sum + k * lanes, sums[k]);
        } else {
            Index const last = cells.n - cells.n % eight;
            for (Index i = last; i < cells.n; ++i) sum[i - last] += max(quality->quality[i], 0.0);
        }
        quality->sum =
            ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
        quality->notable &= given;
    }
    return found & given;
}

constexpr CellKernels kernels{look_at<3>, look_at<4>};

}  // namespace
}  // namespace harmorph::cell_looks::HARMORPH_SET

namespace harmorph::simd {
template <>
inline constexpr const CellKernels* table<CellKernels, Kernel::HARMORPH_SET> =
    &harmorph::cell_looks::HARMORPH_SET::kernels;
}  // namespace harmorph::simd
