// Swept areas of several cells of one shape at a time, one cell in each lane, with the registers of
// one instruction set; swept_areas.cpp compiles this file for each set. Numbers of twice the
// precision are those of base/double_double, but sums take fewer operations: their error is a few
// times 2^-104 of both terms. Only the low part of a product may be fused, which is then the same
// number, so that all sets give the same bits. tests/fields/test_swept_areas.cpp covers this file.

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
    Vector const p = a * b;
    if constexpr (Registers::is_fused) return {p, Registers::multiply_add(a, b, -p)};
    Vector const a_high = upper_half(a), a_low = a - a_high, b_high = upper_half(b),
                 b_low = b - b_high;
    return {p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low};
}
HARMORPH_INLINE Exact lanes_normalised(Vector large, Vector small) noexcept {
    Vector const sum = large + small;
    return {sum, small - (sum - large)};
}
HARMORPH_INLINE Exact operator+(Exact a, Exact b) noexcept {
    Exact const high = exact_sum(a.high, b.high);
    return lanes_normalised(high.high, high.low + (a.low + b.low));
}

// A plane vector.
struct ExactPair {
    Exact x, y;
};
HARMORPH_INLINE ExactPair operator+(ExactPair const& a, ExactPair const& b) noexcept {
    return {a.x + b.x, a.y + b.y};
}
HARMORPH_INLINE ExactPair operator-(ExactPair const& a, ExactPair const& b) noexcept {
    return {a.x + Exact{-b.x.high, -b.x.low}, a.y + Exact{-b.y.high, -b.y.low}};
}
HARMORPH_INLINE ExactPair twice(ExactPair const& a) noexcept {
    return {{2.0 * a.x.high, 2.0 * a.x.low}, {2.0 * a.y.high, 2.0 * a.y.low}};
}
// Returns the cross product. Exchanged arguments give the opposite bits.
HARMORPH_INLINE Exact cross(ExactPair const& a, ExactPair const& b) noexcept {
    Exact const left = exact_product(a.x.high, b.y.high), right = exact_product(a.y.high, b.x.high),
                leading = exact_sum(left.high, -right.high);
    Vector const mixed_left = left.low + (a.x.high * b.y.low + a.x.low * b.y.high),
                 mixed_right = right.low + (a.y.high * b.x.low + a.y.low * b.x.high);
    return lanes_normalised(leading.high, leading.low + (mixed_left - mixed_right));
}

// Positions of a corner of the cells in all lanes, before and after the movement.
struct Corner {
    Vector from_x, from_y, to_x, to_y;

    HARMORPH_INLINE ExactPair velocity() const noexcept {
        return {exact_sum(to_x, -from_x), exact_sum(to_y, -from_y)};
    }
};
// The diagonals of the quadrilateral that a side sweeps.
struct Diagonals {
    ExactPair first, second;

    HARMORPH_INLINE Diagonals() noexcept = default;
    HARMORPH_INLINE Diagonals(Corner const& a, Corner const& b) noexcept
        : first{exact_sum(b.to_x, -a.from_x), exact_sum(b.to_y, -a.from_y)},
          second{exact_sum(b.from_x, -a.to_x), exact_sum(b.from_y, -a.to_y)} {}
};

// clang unrolls loops of a constant length without being asked, and warns where it is asked.
#ifdef __clang__
#define HARMORPH_SWEPT_UNROLL
#else
#define HARMORPH_SWEPT_UNROLL _Pragma("GCC unroll 4")
#endif

// The formulas are those of MovingSide and sweep_polygon() in swept_areas.cpp.
template <Index n>
void sweep_lanes(SweptBatch& cells, Index lane) noexcept {
    auto const load = [&](const Real(&numbers)[4][SweptBatch::size], Index k) {
        return Registers::load(numbers[k] + lane);
    };
    Corner corner[n];
    Diagonals side[n];
    ExactPair line[n], sum[n];
    HARMORPH_SWEPT_UNROLL
    for (Index k = 0; k < n; ++k)
        corner[k] = {load(cells.from_x, k), load(cells.from_y, k), load(cells.to_x, k),
                     load(cells.to_y, k)};
    HARMORPH_SWEPT_UNROLL
    for (Index k = 0; k < n; ++k) {
        side[k] = {corner[k], corner[(k + 1) % n]};
        if (!cells.wants_sides && !cells.wants_halves) continue;
        Exact const area = cross(side[k].first, side[k].second);
        if (cells.wants_sides) Registers::store(cells.sides[k] + lane, 0.5 * area.rounded());
        if (!cells.wants_halves) continue;
        ExactPair const both = side[k].first + side[k].second;
        for (Index end = 0; end < 2; ++end) {
            Exact const more = cross(corner[(k + end) % n].velocity(), both);
            Registers::store(cells.halves[2 * k + end] + lane, 0.125 * (area + more).rounded());
        }
    }
    if (!cells.wants_duals) return;
    HARMORPH_SWEPT_UNROLL
    for (Index k = 0; k < n; ++k) {
        line[k] = side[k].first + side[k].second;
        sum[k] = side[k].first - side[k].second;
    }
    ExactPair const total = n == 4 ? sum[0] + sum[n - 2] : sum[0] + corner[2].velocity();
    HARMORPH_SWEPT_UNROLL
    for (Index k = 0; k < n; ++k) {
        ExactPair const across = line[(k + 1) % n] - line[(k + n - 1) % n];
        // 4 or 6 times the sum of the velocities of both ends of the line
        ExactPair const ends =
            n == 4 ? twice(sum[k]) + total : twice(sum[k]) + sum[k] + twice(total);
        Registers::store(cells.duals[k] + lane,
                         cross(ends, across).rounded() / (n == 4 ? 64.0 : 144.0));
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
