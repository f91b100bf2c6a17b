// Swept areas of several cells of one shape at a time, one cell in each lane, with the registers of
// one instruction set; swept_areas.cpp compiles this file for each set. Sums and products of
// doubles in twice the precision are those of base/double_double, in the same order of operations
// and without fused operations, so that all sets give the same bits.
// tests/fields/test_swept_areas.cpp covers this file.

namespace harmorph::swept::HARMORPH_SET {
namespace {

using Registers = simd::HARMORPH_SET::Registers<Real>;
using Vector = Registers::Vector;

// See DoubleDoubleOf.
struct Exact {
    Vector high, low;

    HARMORPH_INLINE Vector rounded() const noexcept { return high + low + 0.0; }
};
HARMORPH_INLINE Exact exact_sum(Vector a, Vector b) noexcept {
    Vector const s = a + b, part_of_b = s - a;
    return {s, (a - (s - part_of_b)) + (b - part_of_b)};
}
HARMORPH_INLINE Vector upper_half(Vector x) noexcept {
    Vector const shifted = 0x1.0000002p+27 * x;  // 2^27 + 1
    return shifted - (shifted - x);
}
HARMORPH_INLINE Exact exact_product(Vector a, Vector b) noexcept {
    Vector const a_high = upper_half(a), a_low = a - a_high, p = a * b, b_high = upper_half(b),
                 b_low = b - b_high;
    return {p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low};
}
HARMORPH_INLINE Exact lanes_normalised(Vector large, Vector small) noexcept {
    Vector const sum = large + small;
    return {sum, small - (sum - large)};
}
HARMORPH_INLINE Exact add(Exact a, Exact b) noexcept {
    Exact const high = exact_sum(a.high, b.high), low = exact_sum(a.low, b.low),
                leading = lanes_normalised(high.high, high.low + low.high);
    return lanes_normalised(leading.high, leading.low + low.low);
}

// A plane vector.
struct ExactPair {
    Exact x, y;
};
HARMORPH_INLINE ExactPair operator+(ExactPair const& a, ExactPair const& b) noexcept {
    return {add(a.x, b.x), add(a.y, b.y)};
}
HARMORPH_INLINE ExactPair operator-(ExactPair const& a, ExactPair const& b) noexcept {
    return {add(a.x, {-b.x.high, -b.x.low}), add(a.y, {-b.y.high, -b.y.low})};
}
HARMORPH_INLINE ExactPair twice(ExactPair const& a) noexcept {
    return {{2.0 * a.x.high, 2.0 * a.x.low}, {2.0 * a.y.high, 2.0 * a.y.low}};
}
HARMORPH_INLINE ExactPair exact_rise(Vector x, Vector y, Vector from_x, Vector from_y) noexcept {
    return {exact_sum(x, -from_x), exact_sum(y, -from_y)};
}
// Returns the cross product, rounded; its error is a few times 2^-104 of the sum of both terms
// before the rounding.
HARMORPH_INLINE Vector cross(ExactPair const& a, ExactPair const& b) noexcept {
    Exact const left = exact_product(a.x.high, b.y.high), right = exact_product(a.y.high, b.x.high),
                leading = exact_sum(left.high, -right.high);
    Vector const mixed_left = left.low + (a.x.high * b.y.low + a.x.low * b.y.high),
                 mixed_right = right.low + (a.y.high * b.x.low + a.y.low * b.x.high);
    return lanes_normalised(leading.high, leading.low + (mixed_left - mixed_right)).rounded();
}

// clang unrolls loops of a constant length without being asked, and warns where it is asked.
#ifdef __clang__
#define HARMORPH_SWEPT_UNROLL
#else
#define HARMORPH_SWEPT_UNROLL _Pragma("GCC unroll 4")
#endif

// The formulas are those of sweep_polygon() in swept_areas.cpp.
template <Index n>
void sweep_lanes(SweptBatch& cells, Index lane) noexcept {
    auto const at = [&](Real(&numbers)[4][SweptBatch::size], Index k) {
        return Registers::load(numbers[k] + lane);
    };
    ExactPair velocity[n], line[n], sum[n];
    HARMORPH_SWEPT_UNROLL
    for (Index k = 0; k < n; ++k) {
        velocity[k] = exact_rise(at(cells.to_x, k), at(cells.to_y, k), at(cells.from_x, k),
                                 at(cells.from_y, k));
    }
    HARMORPH_SWEPT_UNROLL
    for (Index k = 0; k < n; ++k) {
        Index const next = (k + 1) % n;
        line[k] = exact_rise(at(cells.from_x, next), at(cells.from_y, next), at(cells.from_x, k),
                             at(cells.from_y, k)) +
                  exact_rise(at(cells.to_x, next), at(cells.to_y, next), at(cells.to_x, k),
                             at(cells.to_y, k));
        sum[k] = velocity[k] + velocity[next];
        if (cells.wants_sides)
            Registers::store(cells.sides[k] + lane, 0.25 * cross(sum[k], line[k]));
        if (!cells.wants_halves) continue;
        Registers::store(cells.halves[2 * k] + lane,
                         0.0625 * cross(twice(velocity[k]) + sum[k], line[k]));
        Registers::store(cells.halves[2 * k + 1] + lane,
                         0.0625 * cross(twice(velocity[next]) + sum[k], line[k]));
    }
    if (!cells.wants_duals) return;
    ExactPair const total = n == 4 ? sum[0] + sum[n - 2] : sum[0] + velocity[2];
    HARMORPH_SWEPT_UNROLL
    for (Index k = 0; k < n; ++k) {
        ExactPair const across = line[(k + 1) % n] - line[(k + n - 1) % n];
        // 4 or 6 times the sum of the velocities of both ends of the line
        ExactPair const ends =
            n == 4 ? twice(sum[k]) + total : twice(sum[k]) + sum[k] + twice(total);
        Registers::store(cells.duals[k] + lane, cross(ends, across) / (n == 4 ? 64.0 : 144.0));
    }
}

#undef HARMORPH_SWEPT_UNROLL

void sweep(SweptBatch& cells, Index n) noexcept {
    for (Index lane = 0; lane < SweptBatch::size; lane += Registers::lanes) {
        if (n == 4) sweep_lanes<4>(cells, lane);
        else sweep_lanes<3>(cells, lane);
    }
}

constexpr SweptKernels kernels{sweep};

}  // namespace
}  // namespace harmorph::swept::HARMORPH_SET

namespace harmorph::simd {
template <>
inline constexpr const SweptKernels* table<SweptKernels, Kernel::HARMORPH_SET> =
    &swept::HARMORPH_SET::kernels;
}  // namespace harmorph::simd
