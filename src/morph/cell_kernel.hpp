// Areas, quality and admissible steps of several cells at a time, with the registers of one
// instruction set; cell_batch.cpp compiles this file for each set. The formulas are those of
// mesh/cell_shape, morph/quality and morph/admissible_step, in the same order of operations.
// tests/morph/test_cell_batch.cpp covers this file.

namespace harmorph::cell_measures::HARMORPH_SET {
namespace {

// The corners of several cells, with their sides and areas. Coordinates are gathered from lists of
// cells, or side by side in the rows of a structured mesh.

using Registers = simd::HARMORPH_SET::Registers<Real>;
using Vector = Registers::Vector;
using Words = Registers::Words;

constexpr Index lanes = Registers::lanes;
constexpr Index eight = 8;  // All kernels measure cells in groups of eight.
// So many lanes are gathered at a time; 8 are no faster.
constexpr Index few = lanes < 4 ? lanes : 4;
using Few [[gnu::vector_size(8 * few)]] = Real;
constexpr unsigned all = (1u << lanes) - 1;  // one bit for each lane

// harmorph::min() and max() in each lane: the result is a if one of the two is NaN.
HARMORPH_INLINE Vector lanes_min(Vector a, Vector b) noexcept { return Registers::min(b, a); }
HARMORPH_INLINE Vector lanes_max(Vector a, Vector b) noexcept { return Registers::max(b, a); }

struct Vectors {
    Vector x, y;
};
HARMORPH_INLINE Vectors operator+(Vectors a, Vectors b) noexcept { return {a.x + b.x, a.y + b.y}; }
HARMORPH_INLINE Vectors operator-(Vectors a, Vectors b) noexcept { return {a.x - b.x, a.y - b.y}; }
HARMORPH_INLINE Vector cross(Vectors a, Vectors b) noexcept { return a.x * b.y - a.y * b.x; }
HARMORPH_INLINE Vector square(Vectors a) noexcept { return a.x * a.x + a.y * a.y; }

// The counterpart of CellShape and CellCorners of `n` corners, for as many cells as a register has
// lanes; a triangle has one area.
template <Index n>
struct Shapes {
    Vectors at[n];

    HARMORPH_INLINE void move_by(Shapes const& change) noexcept {
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) at[k] = at[k] + change.at[k];
    }
    HARMORPH_INLINE Vector area() const noexcept {
        return 0.5 * (n == 3 ? cross(at[1] - at[0], at[2] - at[0])
                             : cross(at[2] - at[0], at[n - 1] - at[1]));
    }
};

template <Index n>
struct Corners {
    static constexpr Index n_areas = n == 3 ? 1 : 4;
    Vectors side[n];
    Vector twice_area[n_areas];

    // before() and after() are the sides that meet at a corner.
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
        Vector const smallest_area =
            lanes_min(lanes_min(a[0], a[n_areas / 4]), lanes_min(a[n_areas / 2], a[n_areas - 1]));
        Vector const zero = sum - sum;
        return zero == 0 ? smallest_area : zero;
    }
    HARMORPH_INLINE Vector area() const noexcept {
        return 0.5 * (n == 3 ? twice_area[0] : twice_area[0] + twice_area[n_areas / 2]);
    }
};

// The coordinates of points: `max_count` numbers for each of `n` corners of the cells of a list.
template <Index n>
struct Gathered {
    Real x[n][CellBatches::max_count], y[n][CellBatches::max_count];
};

// The coordinates of the cells of a list, and their displacements or the coordinates with which
// they are compared, `other`. The coordinates of all cells are gathered before any computation, so
// that the loads, one for each number, run at the speed of the cache. Cells in a row of a
// structured mesh need not be gathered, as the coordinates of each corner are side by side.
template <Index n>
class Places {
public:
    // Fills the last registers up with the last cell.
    Places(CellList const& cells, Points points, Points other) noexcept
        : cells_(cells), points_(points), other_(other) {
        bool const unit = points.stride == 1 && (!other.given() || other.stride == 1);
        if (n == 4 && unit) find_rows();
        if (!other.given()) gather<false>(points, other);
        else if (!unit) gather<true>(points, other);
        else
            // No index is multiplied by a stride.
            gather<true>({points.x, points.y, 1}, {other.x, other.y, 1});
    }
    // shapes() and others() return the corners of the cells that begin with cell i.
    HARMORPH_INLINE Shapes<n> shapes(Index i) const noexcept { return shapes(points_, at_, i); }
    HARMORPH_INLINE Shapes<n> others(Index i) const noexcept {
        return shapes(other_, other_at_, i);
    }

private:
    CellList const& cells_;
    Points points_, other_;
    std::uint64_t rows_ = 0;  // The bits of the cells at which a register of cells in a row begins.
    Gathered<n> at_, other_at_;

    HARMORPH_INLINE Index which(Index k) const noexcept { return cells_.reversed ? n - 1 - k : k; }
    HARMORPH_INLINE Shapes<n> shapes(Points points, Gathered<n> const& gathered,
                                     Index i) const noexcept {
        Shapes<n> shapes = {};
        bool const is_row = n == 4 && (rows_ >> i & 1) != 0;
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) {
            Index const first =
                is_row ? from_zero(cells_.point[n * i + which(k)], cells_.index_base) : 0;
            const Real* const x = is_row ? points.x + first : gathered.x[k] + i;
            const Real* const y = is_row ? points.y + first : gathered.y[k] + i;
            shapes.at[k] = {Registers::load(x), Registers::load(y)};
        }
        return shapes;
    }

    // Finds the registers in which every point is the next one after that of the preceding cell.
    // Words are two points of a cell.
    HARMORPH_INLINE void find_rows() noexcept {
        for (Index i = 0; i + lanes <= cells_.n; i += lanes) {
            const Index* const points = cells_.point + n * i;
            Words const differs = off_step(points) | off_step(points + 2 * (lanes - 2));
            Vector const zero = {};
            bool const is_row = Registers::less(zero, differs != 0 ? zero + 1 : zero) == 0;
            rows_ |= std::uint64_t{is_row} << i;
        }
    }
    static HARMORPH_INLINE Words off_step(const Index* points) noexcept {
        return (words_at(points + 4) - words_at(points)) ^ 0x0000000100000001;
    }
    static HARMORPH_INLINE Words words_at(const Index* points) noexcept {
        Words words;
        std::memcpy(&words, points, sizeof words);
        return words;
    }

    // At -O1 g++ 11 warns that the registers, which are zero here, have no value.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
    template <bool has_other>
    HARMORPH_INLINE void gather(Points points, Points other) noexcept {
        // The list is copied, as the compiler does not know that no coordinate is written over the
        // list.
        CellList const cells = cells_;
        std::uint64_t const rows = rows_;
#pragma GCC unroll 1
        for (Index k = 0; k < n; ++k) {
            const Index* const corner = cells.point + which(k);
            Index i = 0;
#pragma GCC unroll 1
            for (; i + few <= cells.n; i += few) {
                if (n == 4 && (rows >> (i & -lanes) & 1) != 0) continue;
                const Index* point = corner + n * i;
                Few x = {}, y = {}, other_x = {}, other_y = {};
#pragma GCC unroll 4
                for (Index lane = 0; lane < few; ++lane, point += n) {
                    Offset const number = from_zero(*point, cells.index_base),
                                 from = number * points.stride;
                    x[lane] = points.x[from];
                    y[lane] = points.y[from];
                    if (!has_other) continue;
                    Offset const other_from = number * other.stride;
                    other_x[lane] = other.x[other_from];
                    other_y[lane] = other.y[other_from];
                }
                std::memcpy(at_.x[k] + i, &x, sizeof x);
                std::memcpy(at_.y[k] + i, &y, sizeof y);
                if (!has_other) continue;
                std::memcpy(other_at_.x[k] + i, &other_x, sizeof x);
                std::memcpy(other_at_.y[k] + i, &other_y, sizeof y);
            }
            for (; i % eight != 0 || i < cells.n; ++i) {
                Offset const number = from_zero(corner[n * min(i, cells.n - 1)], cells.index_base);
                at_.x[k][i] = points.x[number * points.stride];
                at_.y[k][i] = points.y[number * points.stride];
                if (!has_other) continue;
                other_at_.x[k][i] = other.x[number * other.stride];
                other_at_.y[k][i] = other.y[number * other.stride];
            }
        }
    }
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
};

// Computes the same as skew_fraction() and CellMeasure::quality(). Square roots come first, as they
// run in parallel with other operations. If a cell is inverted, no number is divided by its areas,
// as that might raise a floating-point exception. Without an area of reference the result is the
// skew quality.
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
        Vector size = is_compared ? lanes_max(reference_area, -reference_area) : smallest;
        // `lowest` or `highest` is NaN if any number is.
        Vector const lowest = lanes_min(size, smallest), highest = lanes_max(sum, size);
        regular_ = (Registers::less(zero + min_factor, lowest) &
                    Registers::less(highest, zero + max_factor)) == all;
        if (!regular_) {
            auto const in_range = (lowest > min_factor) & (highest < max_factor);
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
        mean_area_ = is_compared ? Registers::sqrt(cell_area * size) : one;
        larger_area_ = is_compared ? lanes_max(cell_area, size) : one;
    }
    HARMORPH_INLINE Vector end() const noexcept {
        Vector numerator, denominator;
        if constexpr (n == 3) skew_of_triangle(area_[0], sum_, numerator, denominator);
        else skew_of_quad(area_, root_, sum_, numerator, denominator);
        Vector const quality = numerator * mean_area_ / (denominator * larger_area_), zero = {};
        if (regular_) return quality;
        return in_range_ > 0 ? quality : smallest > 0 ? zero + ListQuality::not_in_range : zero;
    }

    Vector smallest = {};  // Twice the smallest corner area.

private:
    bool regular_ = true;
    // The larger one of both areas, and their geometric mean.
    Vector in_range_ = {}, larger_area_ = {}, mean_area_ = {};
    Vector sum_ = {}, root_[3] = {}, area_[Corners<n>::n_areas] = {};
};

// Tells whether c + b s + a s^2 is positive, and far from a root, for 0 <= s <= step. The answer
// follows from the value at `step`, which must be at least a millionth of its terms, and from the
// minimum, if that comes before. The result is 1 in the lanes where this holds, and 0 in others.
// Steps are less than 1e50, or infinite, so that nothing overflows.
HARMORPH_INLINE Vector stays_positive(Vector a, Vector b, Vector c, Real step) noexcept {
    constexpr Real max_step = 1e50, margin = 1e-6;
    Vector const zero = {}, one = zero + 1;
    auto const has_minimum = (b < 0) & (a > 0) & (-b < 2 * a * (step < max_step ? step : max_step));
    Vector const at_minimum = (has_minimum ? -b : zero) / (has_minimum ? 2 * a : one);
    auto holds = c + 0.5 * b * at_minimum > margin * c;
    if (step < infinity) {
        Vector const terms = c + step * ((b < 0 ? -b : b) + step * (a < 0 ? -a : a));
        holds &= c + step * (b + step * a) > margin * terms;
    } else {
        holds &= has_minimum | ((a >= 0) & (b >= 0) & (a + b < infinity));
    }
    return holds ? one : zero;
}

// Tells for triangles whether the product of these two sides has the digits of the area. In needles
// the product may have fewer digits, so the kernel leaves needles to the caller.
template <Index n>
HARMORPH_INLINE unsigned keeps_digits(Corners<n> const& corners) noexcept {
    Vector const product = corners.side[0].x * corners.side[1].y;
    return Registers::less(1e-9 * lanes_max(product, -product), corners.twice_area[0]);
}

// First all corners are bounded at once: no area is smaller than area + slope s - |curvature| s^2
// with the smallest of each. If that does not suffice for a cell, the areas themselves are
// examined. Returns the bits of the cells that remain.
template <Index n>
HARMORPH_INLINE std::uint64_t limiting(Corners<n> const& now, Corners<n> const& change,
                                       Real step) noexcept {
    constexpr Index n_areas = Corners<n>::n_areas;
    Vector const zero = {}, *const area = now.twice_area, *const curvature = change.twice_area;
    Vector slope[n_areas], min_area, min_slope, min_curvature, sum;
#pragma GCC unroll 4
    for (Index k = 0; k < n_areas; ++k) {
        Index const before = now.before(k), after = now.after(k);
        slope[k] = cross(now.side[before], change.side[after]) +
                   cross(change.side[before], now.side[after]);
        sum = k == 0 ? area[k] + slope[k] : sum + (area[k] + slope[k]);
        min_slope = k == 0 ? slope[k] : lanes_min(min_slope, slope[k]);
        min_area = k == 0 ? area[k] : lanes_min(min_area, area[k]);
        min_curvature = k == 0 ? curvature[k] : lanes_min(min_curvature, curvature[k]);
    }
    min_slope = lanes_min(min_slope, zero);
    min_curvature = lanes_min(min_curvature, zero);
    unsigned const precise = n == 3 ? keeps_digits(now) : all;
    unsigned kept;
    if (step < infinity) {
        // Comparisons with NaN are false.
        kept = Registers::less(sum - sum, min_area + step * (min_slope + step * min_curvature));
    } else {
#pragma GCC unroll 4
        for (Index k = 0; k < n_areas; ++k) sum += curvature[k];
        kept = Registers::less(sum - sum, min_area) &
               ~Registers::less(min_slope + min_curvature, zero);
    }
    kept &= precise;
    if (kept == all || (step >= 1e50 && step < infinity)) return ~kept & all;
    Vector stays = zero + 1;
#pragma GCC unroll 4
    for (Index k = 0; k < n_areas; ++k)
        stays *= stays_positive(curvature[k], slope[k], area[k], step);
    return ~(kept | (Registers::less(zero, stays) & precise)) & all;
}

// Measures as many cells as a register has lanes, beginning with cell i of a list. Adds their
// qualities to `sums`.
template <Index n>
HARMORPH_INLINE std::uint64_t measure_group(Places<n> const& places, Index i, bool moves,
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
    Vector const smallest = qualities.smallest, value = qualities.end();
    Registers::store(quality->twice_smallest + i, smallest);
    Registers::store(quality->quality + i, value);
    sums += value > 0 ? value : zero;
    std::uint64_t const ordinary =
        Registers::less(zero, smallest) & ~Registers::less(smallest, zero + bounds.twice_area) &
        ~Registers::less(value, zero + bounds.quality) & Registers::less(value, zero + infinity);
    quality->notable |= (~ordinary & all) << i;
    return found << i;
}

template <Index n>
std::uint64_t measure(CellList const& cells, CellPlaces const& given_places,
                      CellBounds const& bounds, ListQuality* quality) noexcept {
    if (cells.n == 0) return 0;
    constexpr Index groups = eight / lanes;  // All kernels have the same number of sums.
    bool const moves = given_places.change.given(),
               is_compared = moves || given_places.reference.given();
    Places<n> const places(cells, given_places.at,
                           moves ? given_places.change : given_places.reference);
    std::uint64_t found = 0;
    Vector sums[groups] = {};
    Real sum[eight];
    for (Index i = 0; i < cells.n; i += eight) {
        if (cells.n - i < eight) {
            for (Index k = 0; k < groups; ++k) Registers::store(sum + k * lanes, sums[k]);
        }
#pragma GCC unroll 1
        for (Index k = 0; k < groups; ++k) {
            found |= measure_group<n>(places, i + lanes * k, moves, is_compared, bounds, quality,
                                      sums[k]);
        }
    }
    std::uint64_t const given =
        cells.n == CellBatches::max_count ? ~std::uint64_t{} : (std::uint64_t{1} << cells.n) - 1;
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

constexpr CellKernels kernels{measure<3>, measure<4>};

}  // namespace
}  // namespace harmorph::cell_measures::HARMORPH_SET

namespace harmorph::simd {
template <>
inline constexpr const CellKernels* table<CellKernels, Kernel::HARMORPH_SET> =
    &harmorph::cell_measures::HARMORPH_SET::kernels;
}  // namespace harmorph::simd

// The kernels of smooth values use the same corners.
#include "morph/bound_kernel.hpp"
