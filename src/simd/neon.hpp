// Registers for NEON. Every 64-bit ARM processor has NEON, so neither a test of the processor nor a
// compiler option is needed. baseline.hpp documents the members.
#define HARMORPH_SET neon
#include "simd/begin.hpp"
#if !defined(HARMORPH_REGISTERS_NEON)
#define HARMORPH_REGISTERS_NEON
#include "simd/register.hpp"

namespace harmorph::simd::neon {

// The picks of all sets, expressed for bytes: 0 to 15 are bytes of the first register, 16 to 31
// bytes of the second, and 255 is a zero.
template <Index lanes>
struct BytePicks {
    uint8x16_t from;

    BytePicks() noexcept = default;
    explicit BytePicks(const Index (&picked)[lanes]) noexcept {
        constexpr Index bytes = 16 / lanes;
        std::uint8_t byte[16];
        for (Index k = 0; k < 16; ++k) {
            Index const lane = picked[k / bytes];
            byte[k] = lane == none ? 255 : static_cast<std::uint8_t>(lane * bytes + k % bytes);
        }
        from = vld1q_u8(byte);
    }
    HARMORPH_INLINE uint8x16_t pick(uint8x16_t a, uint8x16_t b) const noexcept {
        return vqtbl2q_u8({{a, b}}, from);
    }
};

template <class Of>
struct Registers;

template <>
struct Registers<double> : Register<double, 2> {
    static constexpr Index count = 32;

    using Register::load;
    static HARMORPH_INLINE Vector load(const float* from) noexcept {
        return vcvt_f64_f32(vld1_f32(from));
    }
    static HARMORPH_INLINE Vector load_part(const double* from, Index n) noexcept {
        return Vector{n > 0 ? *from : 0, 0};
    }
    static HARMORPH_INLINE Vector load_part(const float* from, Index n) noexcept {
        return Vector{n > 0 ? static_cast<double>(*from) : 0, 0};
    }

    // vmaxq and vminq return NaN if a or b is NaN, so max() and min() use comparisons.
    static HARMORPH_INLINE Vector max(Vector a, Vector b) noexcept {
        return vbslq_f64(vcgtq_f64(a, b), a, b);
    }
    static HARMORPH_INLINE Vector min(Vector a, Vector b) noexcept {
        return vbslq_f64(vcltq_f64(a, b), a, b);
    }
    static HARMORPH_INLINE unsigned less(Vector a, Vector b) noexcept {
        uint64x2_t const wanted = {1, 2};
        return static_cast<unsigned>(vaddvq_u64(vandq_u64(vcltq_f64(a, b), wanted)));
    }
    static HARMORPH_INLINE Vector sqrt(Vector v) noexcept { return vsqrtq_f64(v); }
    static constexpr bool rounds = true;
    static constexpr bool is_fused = true;
    static HARMORPH_INLINE Words round(Vector v) noexcept { return Words(vcvtnq_s64_f64(v)); }

    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept {
        return vfmaq_f64(c, a, b);
    }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept {
        return vfmsq_f64(c, a, b);
    }

    using Picks = BytePicks<lanes>;
    static HARMORPH_INLINE Picks picks_of(const Index (&picked)[lanes]) noexcept {
        return Picks(picked);
    }
    static HARMORPH_INLINE Vector pick(Vector a, Vector b, Picks const& picks) noexcept {
        return vreinterpretq_f64_u8(picks.pick(vreinterpretq_u8_f64(a), vreinterpretq_u8_f64(b)));
    }
};

template <>
struct Registers<float> : Register<float, 4> {
    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept {
        return vfmaq_f32(c, a, b);
    }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept {
        return vfmsq_f32(c, a, b);
    }

    using Picks = BytePicks<lanes>;
    static HARMORPH_INLINE Picks picks_of(const Index (&picked)[lanes]) noexcept {
        return Picks(picked);
    }
    static HARMORPH_INLINE Vector pick(Vector a, Vector b, Picks const& picks) noexcept {
        return vreinterpretq_f32_u8(picks.pick(vreinterpretq_u8_f32(a), vreinterpretq_u8_f32(b)));
    }
};

}  // namespace harmorph::simd::neon
#endif
