// Dense kernels for processors with AVX-512; the rest of the library is built for the plain architecture.
#if defined(__x86_64__) && defined(__GNUC__)

// Shared headers come first: their functions must not be compiled for a processor that may not be there.
#include <immintrin.h>

#include "harmorph/dense/dense.hpp"

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,avx512vl,avx2,fma"))), apply_to = function)
#else
#pragma GCC target("avx512f,avx512dq,avx512vl,avx2,fma")
#endif

#define HARMORPH_KERNEL avx512
#define HARMORPH_TILE_ROWS 8
#define HARMORPH_INLINE inline __attribute__((always_inline))

namespace harmorph::dense::avx512 {
namespace {

template <class Number>
struct Registers;

template <>
struct Registers<double> {
    typedef double Vector __attribute__((vector_size(64), aligned(8), may_alias));

    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return _mm512_fmadd_pd(a, b, c); }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept { return _mm512_fnmadd_pd(a, b, c); }
    struct Picks {
        __m512i from;
        __mmask8 present;
    };
    static HARMORPH_INLINE Picks picks_of(const Index (&picked)[8]) noexcept {
        __m512i const all = _mm512_maskz_cvtepi32_epi64(0xff, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(picked)));
        return {all, _mm512_cmpge_epi64_mask(all, _mm512_setzero_si512())};
    }
    static HARMORPH_INLINE Vector pick(Vector a, Vector b, Picks const& its) noexcept {
        return _mm512_maskz_permutex2var_pd(its.present, a, its.from, b);
    }
    static HARMORPH_INLINE double square_root(double x) noexcept { return __builtin_sqrt(x); }
};

// A slab's row of floats is half a register: they gain from the other half of the registers' number.
template <>
struct Registers<float> {
    typedef float Vector __attribute__((vector_size(32), aligned(4), may_alias));

    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return _mm256_fmadd_ps(a, b, c); }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept { return _mm256_fnmadd_ps(a, b, c); }
    struct Picks {
        __m256i from;
        __mmask8 present;
    };
    static HARMORPH_INLINE Picks picks_of(const Index (&picked)[8]) noexcept {
        __m256i const all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(picked));
        return {all, _mm256_cmpge_epi32_mask(all, _mm256_setzero_si256())};
    }
    static HARMORPH_INLINE Vector pick(Vector a, Vector b, Picks const& its) noexcept {
        return _mm256_maskz_permutex2var_ps(its.present, a, its.from, b);
    }
    static HARMORPH_INLINE float square_root(float x) noexcept { return __builtin_sqrtf(x); }
};

}  // namespace
}  // namespace harmorph::dense::avx512

#include "dense_moves.hpp"

#if defined(__clang__)
#pragma clang attribute pop
#endif

#endif
