// Registers for AVX-512 with the extensions F, DQ and VL. baseline.hpp documents the members. The
// zero-masked forms of intrinsics are used, because gcc warns that the plain forms read an
// uninitialised register.
#define HARMORPH_SET avx512
#define HARMORPH_TARGET "avx512f,avx512dq,avx512vl,avx2,fma"
#include "simd/begin.hpp"
#if !defined(HARMORPH_REGISTERS_AVX512)
#define HARMORPH_REGISTERS_AVX512
#include "simd/register.hpp"

namespace harmorph::simd::avx512 {

template <class Of>
struct Registers;

template <>
struct Registers<double> : Register<double, 8> {
    static constexpr Index count = 32;

    using Register::load;
    static HARMORPH_INLINE Vector load(const float* from) noexcept {
        return _mm512_maskz_cvtps_pd(every, _mm256_loadu_ps(from));
    }
    static HARMORPH_INLINE Vector load_part(const double* from, Index n) noexcept {
        return _mm512_maskz_loadu_pd(first(n), from);
    }
    static HARMORPH_INLINE Vector load_part(const float* from, Index n) noexcept {
        return _mm512_maskz_cvtps_pd(every, _mm256_maskz_loadu_ps(first(n), from));
    }

    static HARMORPH_INLINE Vector max(Vector a, Vector b) noexcept {
        return _mm512_maskz_max_pd(every, a, b);
    }
    static HARMORPH_INLINE Vector min(Vector a, Vector b) noexcept {
        return _mm512_maskz_min_pd(every, a, b);
    }
    static HARMORPH_INLINE unsigned less(Vector a, Vector b) noexcept {
        return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ);
    }
    static HARMORPH_INLINE Vector sqrt(Vector v) noexcept { return _mm512_maskz_sqrt_pd(every, v); }
    static constexpr bool rounds = true;
    static constexpr bool is_fused = true;
    static HARMORPH_INLINE Words round(Vector v) noexcept {
        return Words(_mm512_maskz_cvtpd_epi64(every, v));
    }

    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept {
        return _mm512_fmadd_pd(a, b, c);
    }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept {
        return _mm512_fnmadd_pd(a, b, c);
    }

    struct Picks {
        __m512i from;
        __mmask8 present;
    };
    static HARMORPH_INLINE Picks picks_of(const Index (&picked)[lanes]) noexcept {
        __m256i const narrow = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(picked));
        __m512i const all = _mm512_maskz_cvtepi32_epi64(every, narrow);
        return {all, _mm512_cmpge_epi64_mask(all, _mm512_setzero_si512())};
    }
    static HARMORPH_INLINE Vector pick(Vector a, Vector b, Picks const& picks) noexcept {
        return _mm512_maskz_permutex2var_pd(picks.present, a, picks.from, b);
    }

private:
    static constexpr __mmask8 every = 0xff;
    static HARMORPH_INLINE __mmask8 first(Index n) noexcept {
        return static_cast<__mmask8>((1 << n) - 1);
    }
};

// A register holds 8 numbers, the width of a slab of the dense kernels: half of an AVX-512
// register, but there are 32 registers, where AVX2 has 16.
template <>
struct Registers<float> : Register<float, 8> {
    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept {
        return _mm256_fmadd_ps(a, b, c);
    }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept {
        return _mm256_fnmadd_ps(a, b, c);
    }

    struct Picks {
        __m256i from;
        __mmask8 present;
    };
    static HARMORPH_INLINE Picks picks_of(const Index (&picked)[lanes]) noexcept {
        __m256i const all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(picked));
        return {all, _mm256_cmpge_epi32_mask(all, _mm256_setzero_si256())};
    }
    static HARMORPH_INLINE Vector pick(Vector a, Vector b, Picks const& picks) noexcept {
        return _mm256_maskz_permutex2var_ps(picks.present, a, picks.from, b);
    }
};

}  // namespace harmorph::simd::avx512
#endif
