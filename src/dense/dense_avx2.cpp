// Dense kernels for processors with AVX2 and FMA; the rest of the library is built for the plain architecture.
#if defined(__x86_64__) && defined(__GNUC__)

// Shared headers come first: their functions must not be compiled for a processor that may not be there.
#include <immintrin.h>

#include "harmorph/dense/dense.hpp"

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)
#else
#pragma GCC target("avx2,fma")
#endif

#define HARMORPH_KERNEL avx2
#define HARMORPH_TILE_ROWS 4
#define HARMORPH_INLINE inline __attribute__((always_inline))

namespace harmorph::dense::avx2 {
namespace {

// Lanes of two vectors, in words of 32 bits: which word, whether of the second vector, whether of any.
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
};

template <class Number>
struct Registers;

template <>
struct Registers<double> {
    typedef double Vector __attribute__((vector_size(32), aligned(8), may_alias));

    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return _mm256_fmadd_pd(a, b, c); }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept { return _mm256_fnmadd_pd(a, b, c); }
    using Picks = LanePicks<2>;
    static HARMORPH_INLINE Picks picks_of(const Index (&picked)[4]) noexcept { return Picks(picked); }
    static HARMORPH_INLINE Vector pick(Vector a, Vector b, Picks const& its) noexcept {
        __m256 const of_a = _mm256_permutevar8x32_ps(_mm256_castpd_ps(a), its.from);
        __m256 const of_b = _mm256_permutevar8x32_ps(_mm256_castpd_ps(b), its.from);
        __m256 const either = _mm256_blendv_ps(of_a, of_b, _mm256_castsi256_ps(its.second));
        return _mm256_castps_pd(_mm256_and_ps(either, _mm256_castsi256_ps(its.present)));
    }
    static HARMORPH_INLINE double square_root(double x) noexcept { return __builtin_sqrt(x); }
};

template <>
struct Registers<float> {
    typedef float Vector __attribute__((vector_size(32), aligned(4), may_alias));

    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return _mm256_fmadd_ps(a, b, c); }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept { return _mm256_fnmadd_ps(a, b, c); }
    using Picks = LanePicks<1>;
    static HARMORPH_INLINE Picks picks_of(const Index (&picked)[8]) noexcept { return Picks(picked); }
    static HARMORPH_INLINE Vector pick(Vector a, Vector b, Picks const& its) noexcept {
        Vector const of_a = _mm256_permutevar8x32_ps(a, its.from), of_b = _mm256_permutevar8x32_ps(b, its.from);
        return _mm256_and_ps(_mm256_blendv_ps(of_a, of_b, _mm256_castsi256_ps(its.second)), _mm256_castsi256_ps(its.present));
    }
    static HARMORPH_INLINE float square_root(float x) noexcept { return __builtin_sqrtf(x); }
};

}  // namespace
}  // namespace harmorph::dense::avx2

#include "dense_moves.hpp"

#if defined(__clang__)
#pragma clang attribute pop
#endif

#endif
