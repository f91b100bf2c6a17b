// Areas, quality and admissible steps of several cells at a time, with the registers of one instruction set;
// cell_batch.cpp compiles this file for each of them. The formulas are those of mesh/cell_shape, morph/quality and
// morph/admissible_step, in the same order of operations.

namespace harmorph::cell_looks::HARMORPH_SET {
namespace {

using Registers = simd::HARMORPH_SET::Registers<Real>;
using Vector = Registers::Vector;

constexpr Index lanes = Registers::lanes;

// harmorph::smaller() and larger() in each lane: a where one of the two is NaN.
HARMORPH_INLINE Vector least_of(Vector a, Vector b) noexcept { return Registers::smaller(b, a); }
HARMORPH_INLINE Vector most_of(Vector a, Vector b) noexcept { return Registers::larger(b, a); }

struct Vectors {
    Vector x, y;
};
HARMORPH_INLINE Vectors operator+(Vectors a, Vectors b) noexcept { return {a.x + b.x, a.y + b.y}; }
HARMORPH_INLINE Vectors operator-(Vectors a, Vectors b) noexcept { return {a.x - b.x, a.y - b.y}; }
HARMORPH_INLINE Vector cross(Vectors a, Vectors b) noexcept { return a.x * b.y - a.y * b.x; }
HARMORPH_INLINE Vector square(Vectors a) noexcept { return a.x * a.x + a.y * a.y; }

HARMORPH_INLINE Vector gathered(const Real* from, std::ptrdiff_t stride, const Index* point) noexcept {
    Vector v = {};
#pragma GCC unroll 8
    for (Index lane = 0; lane < lanes; ++lane) v[lane] = from[point[lane] * stride];
    return v;
}

// Points in a row of a structured mesh lie side by side.
HARMORPH_INLINE bool side_by_side(const Index* point) noexcept {
    bool all = true;
#pragma GCC unroll 8
    for (Index lane = 1; lane < lanes; ++lane) all &= point[lane] == point[0] + lane;
    return all;
}

HARMORPH_INLINE Vectors points_of(Points points, const Index* point) noexcept {
    if (points.stride == 1 && side_by_side(point)) {
        return {Registers::load(points.x + point[0]), Registers::load(points.y + point[0])};
    }
    return {gathered(points.x, points.stride, point), gathered(points.y, points.stride, point)};
}

// As CellShape and CellCorners of `n` corners; a triangle has one area.
template <Index n>
struct Shapes {
    Vectors at[n];

    HARMORPH_INLINE Shapes(Points points, CellBatch const& cells, Index i) noexcept {
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) at[k] = points_of(points, cells.point[k] + i);
    }
    HARMORPH_INLINE void move_by(Shapes const& change) noexcept {
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) at[k] = at[k] + change.at[k];
    }
    HARMORPH_INLINE Vector area() const noexcept {
        return 0.5 * (n == 3 ? cross(at[1] - at[0], at[2] - at[0]) : cross(at[2] - at[0], at[n - 1] - at[1]));
    }
};

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
        Vector const least = least_of(least_of(a[0], a[n_areas / 4]), least_of(a[n_areas / 2], a[n_areas - 1]));
        return sum == sum ? least : sum;
    }
    HARMORPH_INLINE Vector area() const noexcept {
        return 0.5 * (n == 3 ? twice_area[0] : twice_area[0] + twice_area[n_areas / 2]);
    }
};

// As skew_quality() and Quality::add(); reference_area 0: skew quality alone. Where a cell is inverted, nothing is divided
// by its areas: that might raise a floating-point exception.
template <Index n>
HARMORPH_INLINE void set_quality(Corners<n> const& corners, Vector reference_area, Index i,
                                 BatchQuality& to) noexcept {
    Vector const zero = {}, one = zero + 1, smallest = corners.smallest();
    Vector quality;
    if (n == 3) {
        Vector const squares = square(corners.side[0]) + square(corners.side[1]) + square(corners.side[2]);
        quality = 2 * 1.7320508075688772 * corners.twice_area[0] / (smallest > 0 ? squares : one);
    } else {
        Vector length[n], sum = zero;
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) length[k] = Registers::square_root(square(corners.side[k]));
#pragma GCC unroll 4
        for (Index k = 0; k < n; ++k) {
            Vector const area = smallest > 0 ? corners.twice_area[k % corners.n_areas] : one;
            sum += length[corners.before(k)] * length[k] / area;
        }
        quality = 4 / (smallest > 0 ? sum : one);
    }
    quality = smallest > 0 ? quality : zero;
    Vector const area = corners.area(), size = reference_area < 0 ? -reference_area : reference_area;
    auto const compared = (quality > 0) & (size != 0);
    Vector const less = compared ? least_of(area, size) : one, more = compared ? most_of(area, size) : one;
    quality *= Registers::square_root(less / more);
    Registers::store(to.twice_smallest + i, smallest);
    Registers::store(to.quality + i, quality);
}

// Of c + b s + a s^2: is it positive, and far from a root, for 0 <= s <= step? By its value at `step`, which is at least a
// millionth of its terms, and at its minimum, if that comes before. 1 in the lanes where that holds, 0 in others. Steps
// are less than 1e50, or infinite, so that nothing overflows.
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

// First the filter of AdmissibleStep::add(): a corner's area is larger than area + slope s - |curvature| s^2. Then, where
// that is not enough for a cell, the area itself. Bits of the cells that are left.
template <Index n>
HARMORPH_INLINE std::uint64_t limiting(Corners<n> const& now, Corners<n> const& change, Real step) noexcept {
    Vector const zero = {};
    Vector least = {}, sum = {}, least_change = {}, slopes[Corners<n>::n_areas];
#pragma GCC unroll 4
    for (Index k = 0; k < now.n_areas; ++k) {
        Index const before = now.before(k), after = now.after(k);
        Vector const slope = cross(now.side[before], change.side[after]) + cross(change.side[before], now.side[after]);
        slopes[k] = slope;
        Vector const area = now.twice_area[k], curvature = change.twice_area[k];
        Vector const falls = least_of(slope, zero), bends = least_of(curvature, zero);
        Vector const margin = step < infinity ? area + step * (falls + step * bends) : area;
        Vector const finite = step < infinity ? margin : area + slope + curvature;
        least = k == 0 ? margin : least_of(least, margin);
        least_change = k == 0 ? falls + bends : least_of(least_change, falls + bends);
        sum = k == 0 ? finite : sum + finite;
    }
    unsigned kept = Registers::less(zero, least) & Registers::less(sum, zero + infinity);  // NaN is less than nothing
    if (!(step < infinity)) kept &= ~Registers::less(least_change, zero);
    constexpr unsigned all = (1u << lanes) - 1;
    if (kept == all || (step >= 1e50 && step < infinity)) return ~kept & all;
    Vector stays = zero + 1;
#pragma GCC unroll 4
    for (Index k = 0; k < now.n_areas; ++k) {
        stays *= stays_positive(change.twice_area[k], slopes[k], now.twice_area[k], step);
    }
    return ~(kept | Registers::less(zero, stays)) & all;
}

template <Index n>
std::uint64_t look_at(CellBatch const& cells, CellPlaces const& places, Real step, BatchQuality* quality) noexcept {
    std::uint64_t found = 0;
    for (Index i = 0; i < cells.n; i += lanes) {
        Shapes<n> shapes(places.at, cells, i);
        Vector reference_area = {};
        if (places.change.given()) {
            Shapes<n> const change(places.change, cells, i);
            Corners<n> const now(shapes);
            found |= limiting<n>(now, Corners<n>(change), step) << i;
            reference_area = now.area();
            shapes.move_by(change);
        } else if (places.reference.given()) {
            reference_area = Shapes<n>(places.reference, cells, i).area();
        }
        if (quality != nullptr) set_quality<n>(Corners<n>(shapes), reference_area, i, *quality);
    }
    return cells.n == CellBatch::most ? found : found & ((std::uint64_t{1} << cells.n) - 1);
}

constexpr CellKernels kernels{look_at<3>, look_at<4>};

}  // namespace
}  // namespace harmorph::cell_looks::HARMORPH_SET

namespace harmorph::simd {
template <>
inline constexpr const CellKernels* table<CellKernels, Kernel::HARMORPH_SET> = &harmorph::cell_looks::HARMORPH_SET::kernels;
}  // namespace harmorph::simd
