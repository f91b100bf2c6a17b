// Registers for the instructions that the compiler may use without further options: SSE2 on x86-64,
// simd128 in a module for WebAssembly that has it, plain vectors elsewhere. This file documents
// Registers for all sets, and tests/simd/test_registers.cpp covers them.
#define HARMORPH_SET baseline
#include "simd/begin.hpp"
#if !defined(HARMORPH_REGISTERS_BASELINE)
#define HARMORPH_REGISTERS_BASELINE
#include "simd/register.hpp"

namespace harmorph::simd::baseline {

// Registers defines a register of numbers and the operations of the instruction set; the operations
// that all sets have in common are in Register (register.hpp). The operators + - * / are the
// compiler's vector operators, which are never contracted to fused operations.
#if defined(__wasm_simd128__)
// The picks of all sets, expressed for the bytes of each register; 255 picks a zero.
template <Index lanes>
struct BytePicks {
    v128_t first, second;

    BytePicks() noexcept = default;
    explicit BytePicks(const Index (&picked)[lanes]) noexcept {
        constexpr Index bytes = 16 / lanes;
        std::uint8_t of_first[16], of_second[16];
        for (Index k = 0; k < 16; ++k) {
            Index const lane = picked[k / bytes], other = lane - lanes;
            bool const in_first = lane != none && lane < lanes, in_second = lane >= lanes;
            of_first[k] = static_cast<std::uint8_t>(in_first ? lane * bytes + k % bytes : 255);
            of_second[k] = static_cast<std::uint8_t>(in_second ? other * bytes + k % bytes : 255);
        }
        first = wasm_v128_load(of_first);
        second = wasm_v128_load(of_second);
    }
    HARMORPH_INLINE v128_t pick(v128_t a, v128_t b) const noexcept {
        return wasm_v128_or(wasm_i8x16_swizzle(a, first), wasm_i8x16_swizzle(b, second));
    }
};
#endif

template <class Of>
struct Registers;

template <>
struct Registers<double> : Register<double, 2> {
    static constexpr Index count = 16;  // the number of registers of the processor

    // load() reads numbers in double or in single precision. load_part() reads only the first n
    // numbers, 0 <= n < lanes, and sets the other lanes to 0.
    using Register::load;
    static HARMORPH_INLINE Vector load(const float* from) noexcept {
#if defined(__SSE2__)
        return Vector(_mm_cvtps_pd(
            _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)))));
#elif defined(__wasm_simd128__)
        return Vector(wasm_f64x2_promote_low_f32x4(wasm_v128_load64_zero(from)));
#else
        return Vector{static_cast<double>(from[0]), static_cast<double>(from[1])};
#endif
    }
    static HARMORPH_INLINE Vector load_part(const double* from, Index n) noexcept {
        return Vector{n > 0 ? *from : 0, 0};
    }
    static HARMORPH_INLINE Vector load_part(const float* from, Index n) noexcept {
        return Vector{n > 0 ? static_cast<double>(*from) : 0, 0};
    }

    // max() and min() work lane by lane and return b if a or b is NaN.
    static HARMORPH_INLINE Vector max(Vector a, Vector b) noexcept {
#if defined(__SSE2__)
        return Vector(_mm_max_pd(a, b));
#elif defined(__wasm_simd128__)
        return Vector(wasm_f64x2_pmax(b, a));  // b < a ? a : b
#else
        return Vector{a[0] > b[0] ? a[0] : b[0], a[1] > b[1] ? a[1] : b[1]};
#endif
    }
    static HARMORPH_INLINE Vector min(Vector a, Vector b) noexcept {
#if defined(__SSE2__)
        return Vector(_mm_min_pd(a, b));
#elif defined(__wasm_simd128__)
        return Vector(wasm_f64x2_pmin(b, a));  // a < b ? a : b
#else
        return Vector{a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1]};
#endif
    }
    // Returns one bit for each lane, which is 1 if a < b there; the lowest bit is the first lane's.
    static HARMORPH_INLINE unsigned less(Vector a, Vector b) noexcept {
#if defined(__SSE2__)
        return static_cast<unsigned>(_mm_movemask_pd(_mm_cmplt_pd(a, b)));
#elif defined(__wasm_simd128__)
        return wasm_i64x2_bitmask(wasm_f64x2_lt(a, b));
#else
        return (a[0] < b[0] ? 1u : 0u) | (a[1] < b[1] ? 2u : 0u);
#endif
    }
    static HARMORPH_INLINE Vector sqrt(Vector v) noexcept {
#if defined(__SSE2__)
        return Vector(_mm_sqrt_pd(v));
#elif defined(__wasm_simd128__)
        return Vector(wasm_f64x2_sqrt(v));
#else
        return Vector{harmorph::sqrt(v[0]), harmorph::sqrt(v[1])};
#endif
    }

    // If true, the set has round(v), which returns the nearest integers in two's complement.
    static constexpr bool rounds = false;
    static constexpr bool is_fused = false;  // whether multiply_add() rounds once

    // These functions return c + a b and c - a b, with one rounding if the set has fused
    // instructions.
    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept {
        return c + a * b;
    }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept {
        return c - a * b;
    }

    // pick() takes numbers from two registers: lane k of the result is lane picked[k] of the first
    // register, lane picked[k] - lanes of the second register, or 0 if picked[k] is none.
#if defined(__wasm_simd128__)
    using Picks = BytePicks<lanes>;
    static HARMORPH_INLINE Picks picks_of(const Index (&picked)[lanes]) noexcept {
        return Picks(picked);
    }
    static HARMORPH_INLINE Vector pick(Vector a, Vector b, Picks const& picks) noexcept {
        return Vector(picks.pick(v128_t(a), v128_t(b)));
    }
#else
    struct Picks {
        Index from[lanes];
    };
    static HARMORPH_INLINE Picks picks_of(const Index (&picked)[lanes]) noexcept {
        return {{ picked[0], picked[1] }};
    }
    static HARMORPH_INLINE Vector pick(Vector a, Vector b, Picks const& picks) noexcept {
        Vector v = {};
        for (Index lane = 0; lane < lanes; ++lane) {
            Index const from = picks.from[lane];
            if (from != none) v[lane] = from < lanes ? a[from] : b[from - lanes];
        }
        return v;
    }
#endif
};

template <>
struct Registers<float> : Register<float, 4> {
    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept {
        return c + a * b;
    }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept {
        return c - a * b;
    }

#if defined(__wasm_simd128__)
    using Picks = BytePicks<lanes>;
    static HARMORPH_INLINE Picks picks_of(const Index (&picked)[lanes]) noexcept {
        return Picks(picked);
    }
    static HARMORPH_INLINE Vector pick(Vector a, Vector b, Picks const& picks) noexcept {
        return Vector(picks.pick(v128_t(a), v128_t(b)));
    }
#else
    struct Picks {
        Index from[lanes];
    };
    static HARMORPH_INLINE Picks picks_of(const Index (&picked)[lanes]) noexcept {
        return {{ picked[0], picked[1], picked[2], picked[3] }};
    }
    static HARMORPH_INLINE Vector pick(Vector a, Vector b, Picks const& picks) noexcept {
        Vector v = {};
        for (Index lane = 0; lane < lanes; ++lane) {
            Index const from = picks.from[lane];
            if (from != none) v[lane] = from < lanes ? a[from] : b[from - lanes];
        }
        return v;
    }
#endif
};

}  // namespace harmorph::simd::baseline
#endif
