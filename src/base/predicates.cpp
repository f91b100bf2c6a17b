#include "base/predicates.hpp"

#include <cfloat>
#include <climits>

// The error bounds hold for numbers that are rounded once, to 53 bits. The registers of the 8087
// hold 64 bits.
static_assert(FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 1,
              "on 32-bit x86 compile with -msse2 -mfpmath=sse");

namespace harmorph {
namespace {

// `large` is the largest coordinate for which products of four differences cannot overflow.
// `underflow` bounds the error by underflow: a few times 2^-1074 times the square of `large`.
constexpr Real large = 0x1p200, underflow = 0x1p-600;

constexpr Real size_of(Vec2 p) noexcept { return max(abs(p.x), abs(p.y)); }
constexpr Real size_of(Vec2 a, Vec2 b, Vec2 c) noexcept {
    return max(max(size_of(a), size_of(b)), size_of(c));
}
constexpr int sign_of(Real x) noexcept { return x > 0 ? 1 : x < 0 ? -1 : 0; }

// A finite number is represented as whole * 2^shift, where whole is odd or 0.
struct Scaled {
    std::uint64_t whole = 0;
    Index shift = 0;
    bool negative = false;

    explicit Scaled(Real x) noexcept {
        constexpr Index mantissa_bits = 52, lowest = -1074;
        std::uint64_t const bits = bits_of(x), hidden = std::uint64_t{1} << mantissa_bits;
        Index const exponent = static_cast<Index>(bits >> mantissa_bits & 0x7FF);
        whole = bits & (hidden - 1);
        if (exponent > 0) whole |= hidden;
        if (whole == 0) return;
        Index const zeros = __builtin_ctzll(whole);
        whole >>= zeros;
        shift = lowest + (exponent > 0 ? exponent - 1 : 0) + zeros;
        negative = bits >> 63 != 0;
    }
    Index bits() const noexcept { return 64 - __builtin_clzll(whole); }
};

constexpr Index limb_bits = 32;
// The bits of doubles have the exponents -1074 to 1023. One more bit is needed for the sign, and
// two for carries: at every degree, numbers are added in pairs.
constexpr Index max_limbs = (1024 + 1074 + 3 + limb_bits - 1) / limb_bits;

// An integer in two's complement, which has `degree` times as many limbs as a coordinate, the
// lowest limb first.
template <Index degree>
struct Whole {
    Index n;
    std::uint32_t limb[degree * max_limbs];

    bool is_negative() const noexcept { return limb[n - 1] >> (limb_bits - 1) != 0; }
    int sign() const noexcept {
        if (is_negative()) return -1;
        for (Index i = 0; i < n; ++i) {
            if (limb[i] != 0) return 1;
        }
        return 0;
    }
    void negate() noexcept {
        std::uint64_t carry = 1;
        for (Index i = 0; i < n; ++i) {
            carry += static_cast<std::uint32_t>(~limb[i]);
            limb[i] = static_cast<std::uint32_t>(carry);
            carry >>= limb_bits;
        }
    }
    // Subtracts other * 2^(limb_bits * first_limb), modulo 2^(limb_bits * n).
    template <Index other_degree>
    void subtract(Whole<other_degree> const& other, Index first_limb) noexcept {
        std::uint64_t borrow = 0;
        for (Index i = first_limb; i < n; ++i) {
            std::uint64_t const subtrahend =
                i - first_limb < other.n ? other.limb[i - first_limb] : 0;
            std::uint64_t const difference = std::uint64_t{limb[i]} - subtrahend - borrow;
            limb[i] = static_cast<std::uint32_t>(difference);
            borrow = difference >> 63;
        }
    }
};

template <Index degree>
Whole<degree> operator+(Whole<degree> const& a, Whole<degree> const& b) noexcept {
    Whole<degree> out;
    out.n = a.n;
    std::uint64_t carry = 0;
    for (Index i = 0; i < a.n; ++i) {
        carry += std::uint64_t{a.limb[i]} + b.limb[i];
        out.limb[i] = static_cast<std::uint32_t>(carry);
        carry >>= limb_bits;
    }
    return out;
}

template <Index degree>
Whole<degree> operator-(Whole<degree> const& a, Whole<degree> const& b) noexcept {
    Whole<degree> out;
    out.n = a.n;
    for (Index i = 0; i < a.n; ++i) out.limb[i] = a.limb[i];
    out.subtract(b, 0);
    return out;
}

// The limbs are multiplied as unsigned numbers. A negative factor in two's complement is 2^bits too
// large as an unsigned number, so the other factor times 2^bits is subtracted.
template <Index p, Index q>
Whole<p + q> operator*(Whole<p> const& a, Whole<q> const& b) noexcept {
    Whole<p + q> out;
    out.n = a.n + b.n;
    for (Index i = 0; i < out.n; ++i) out.limb[i] = 0;
    for (Index i = 0; i < a.n; ++i) {
        std::uint64_t carry = 0;
        for (Index k = 0; k < b.n; ++k) {
            carry += std::uint64_t{a.limb[i]} * b.limb[k] + out.limb[i + k];
            out.limb[i + k] = static_cast<std::uint32_t>(carry);
            carry >>= limb_bits;
        }
        out.limb[i + b.n] = static_cast<std::uint32_t>(carry);
    }
    if (a.is_negative()) out.subtract(b, a.n);
    if (b.is_negative()) out.subtract(a, b.n);
    return out;
}

// A grid is a power of two of which all coordinates are integer multiples. The multiples need few
// limbs, unless the coordinates differ widely in size.
struct Grid {
    Index shift = INT_MAX, end = INT_MIN;

    void include(Vec2 p) noexcept {
        Real const coordinates[] = {p.x, p.y};
        for (Real const x : coordinates) {
            Scaled const scaled(x);
            if (scaled.whole == 0) continue;
            shift = min(shift, scaled.shift);
            end = max(end, scaled.shift + scaled.bits());
        }
    }
    Index limbs() const noexcept {
        return end < shift ? 1 : (end - shift + 3 + limb_bits - 1) / limb_bits;
    }

    Whole<1> operator()(Real x) const noexcept {
        Whole<1> out;
        out.n = limbs();
        for (Index i = 0; i < out.n; ++i) out.limb[i] = 0;
        Scaled const scaled(x);
        if (scaled.whole == 0) return out;
        Index const first = (scaled.shift - shift) / limb_bits,
                    within = (scaled.shift - shift) % limb_bits;
        std::uint64_t const low = scaled.whole << within,
                            high = within > 0 ? scaled.whole >> (64 - within) : 0;
        std::uint64_t const words[] = {low & 0xFFFFFFFFu, low >> limb_bits, high};
        for (Index i = 0; i < 3 && first + i < out.n; ++i)
            out.limb[first + i] = static_cast<std::uint32_t>(words[i]);
        if (scaled.negative) out.negate();
        return out;
    }
};

struct WholeVec2 {
    Whole<1> x, y;
    WholeVec2(Vec2 p, Vec2 origin, Grid const& grid) noexcept
        : x(grid(p.x) - grid(origin.x)), y(grid(p.y) - grid(origin.y)) {}
};

Whole<2> cross(WholeVec2 const& a, WholeVec2 const& b) noexcept { return a.x * b.y - a.y * b.x; }
Whole<2> square(WholeVec2 const& a) noexcept { return a.x * a.x + a.y * a.y; }

int exact_orientation_sign(Vec2 a, Vec2 b, Vec2 c) noexcept {
    Grid grid;
    grid.include(a);
    grid.include(b);
    grid.include(c);
    return cross(WholeVec2(a, c, grid), WholeVec2(b, c, grid)).sign();
}

int exact_in_circle_sign(Vec2 a, Vec2 b, Vec2 c, Vec2 d) noexcept {
    Grid grid;
    grid.include(a);
    grid.include(b);
    grid.include(c);
    grid.include(d);
    WholeVec2 const from_a(a, d, grid), from_b(b, d, grid), from_c(c, d, grid);
    Whole<4> const sum =
        square(from_a) * cross(from_b, from_c) + square(from_b) * cross(from_c, from_a);
    return (sum + square(from_c) * cross(from_a, from_b)).sign();
}

}  // namespace

// Each product has 4 rounding errors of epsilon / 2: two of the differences, one of the product and
// one of the sum. The bound takes 5, which covers terms of second order.
int orientation_sign(Vec2 a, Vec2 b, Vec2 c) noexcept {
    if (!(size_of(a, b, c) < large)) return exact_orientation_sign(a, b, c);
    Vec2 const p = a - c, q = b - c;
    // A computed difference is 0 only if the numbers are equal. The sign of the other product then
    // is exact; this is frequent for common points and for lines along the axes.
    if (p.x == 0 || q.y == 0) return -sign_of(p.y) * sign_of(q.x);
    if (p.y == 0 || q.x == 0) return sign_of(p.x) * sign_of(q.y);
    Real const left = p.x * q.y, right = p.y * q.x;
    Real const bound = 2.5 * epsilon * (abs(left) + abs(right)) + underflow;
    return abs(left - right) > bound ? sign_of(left - right) : exact_orientation_sign(a, b, c);
}

// The sign is that of the determinant with the rows (x, y, x^2 + y^2) of a - d, b - d and c - d.
// Each product has 11 rounding errors of epsilon / 2: 4 in each of the two factors, one of the
// product and two of the sums. The bound takes 12, which covers terms of second order.
int in_circle_sign(Vec2 a, Vec2 b, Vec2 c, Vec2 d) noexcept {
    if (!(size_of(a, b, c) < large) || !(size_of(d) < large))
        return exact_in_circle_sign(a, b, c, d);
    Vec2 const from[] = {a - d, b - d, c - d};
    Real sum = 0, magnitude = 0;
    for (Index k = 0; k < 3; ++k) {
        Vec2 const p = from[(k + 1) % 3], q = from[(k + 2) % 3];
        Real const left = p.x * q.y, right = p.y * q.x, squared = square(from[k]);
        sum += squared * (left - right);
        magnitude += squared * (abs(left) + abs(right));
    }
    if (abs(sum) > 6 * epsilon * magnitude + underflow) return sign_of(sum);
    return exact_in_circle_sign(a, b, c, d);
}

}  // namespace harmorph
