// Registers for AVX2 and FMA. baseline.hpp documents the members.
#define HARMORPH_SET avx2
#define HARMORPH_TARGET "avx2,fma"
#include "simd/begin.hpp"
#if !defined(HARMORPH_REGISTERS_AVX2)
#define HARMORPH_REGISTERS_AVX2
#include "simd/register.hpp"

namespace harmorph::simd::avx2 {

// The picks of all sets, expressed for words of 32 bits: the number of each word, and masks that
// say whether the word comes from the second vector, and whether any word is picked.
template <Index words>
struct LanePicks {
    __m256i from, second, present;

    LanePicks() noexcept = default;
    explicit LanePicks(const Index (&picked)[8 / words]) noexcept {
        alignas(32) std::int32_t word[8], of_second[8], of_any[8];
        for (Index k = 0; k < 8; ++k) {
            Index const lane = picked[k / words];
            word[k] = lane * words + k % words;  // modulo 8
            of_second[k] = -(lane >= 8 / words);
            of_any[k] = -(lane >= 0);
        }
        from = _mm256_load_si256(reinterpret_cast<const __m256i*>(word));
        second = _mm256_load_si256(reinterpret_cast<const __m256i*>(of_second));
        present = _mm256_load_si256(reinterpret_cast<const __m256i*>(of_any));
    }
    HARMORPH_INLINE __m256 pick(__m256 a, __m256 b) const noexcept {
        __m256 const of_a = _mm256_permutevar8x32_ps(a, from),
                     of_b = _mm256_permutevar8x32_ps(b, from);
        __m256 const either = _mm256_blendv_ps(of_a, of_b, _mm256_castsi256_ps(second));
        return _mm256_and_ps(either, _mm256_castsi256_ps(present));
    }
};

template <class Of>
struct Registers;

template <>
struct Registers<double> : Register<double, 4> {
    static constexpr Index count = 16;

    using Register::load;
    static HARMORPH_INLINE Vector load(const float* from) noexcept {
        return _mm256_cvtps_pd(_mm_loadu_ps(from));
    }
    static HARMORPH_INLINE Vector load_part(const double* from, Index n) noexcept {
        return _mm256_maskload_pd(
            from, _mm256_cmpgt_epi64(_mm256_set1_epi64x(n), _mm256_set_epi64x(3, 2, 1, 0)));
    }
    static HARMORPH_INLINE Vector load_part(const float* from, Index n) noexcept {
        return _mm256_cvtps_pd(
            _mm_maskload_ps(from, _mm_cmpgt_epi32(_mm_set1_epi32(n), _mm_set_epi32(3, 2, 1, 0))));
    }

    static HARMORPH_INLINE Vector max(Vector a, Vector b) noexcept { return _mm256_max_pd(a, b); }
    static HARMORPH_INLINE Vector min(Vector a, Vector b) noexcept { return _mm256_min_pd(a, b); }
    static HARMORPH_INLINE unsigned less(Vector a, Vector b) noexcept {
        return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LT_OQ)));
    }
    static HARMORPH_INLINE Vector sqrt(Vector v) noexcept { return _mm256_sqrt_pd(v); }
    static constexpr bool rounds = false;
    static constexpr bool is_fused = true;

    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept {
        return _mm256_fmadd_pd(a, b, c);
    }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept {
        return _mm256_fnmadd_pd(a, b, c);
    }

    using Picks = LanePicks<2>;
    static HARMORPH_INLINE Picks picks_of(const Index (&picked)[lanes]) noexcept {
        return Picks(picked);
    }
    static HARMORPH_INLINE Vector pick(Vector a, Vector b, Picks const& picks) noexcept {
        return _mm256_castps_pd(picks.pick(_mm256_castpd_ps(a), _mm256_castpd_ps(b)));
    }
};

template <>
struct Registers<float> : Register<float, 8> {
    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept {
        return _mm256_fmadd_ps(a, b, c);
    }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept {
        return _mm256_fnmadd_ps(a, b, c);
    }

    using Picks = LanePicks<1>;
    static HARMORPH_INLINE Picks picks_of(const Index (&picked)[lanes]) noexcept {
        return Picks(picked);
    }
    static HARMORPH_INLINE Vector pick(Vector a, Vector b, Picks const& picks) noexcept {
        return picks.pick(a, b);
    }
};

}  // namespace harmorph::simd::avx2
#endif
