// Dense kernels for processors with AVX-512; the rest of the library is built for the plain architecture.
#if defined(__x86_64__) && defined(__GNUC__)

// Shared headers come first: their functions must not be compiled for a processor that may not be there.
#include <immintrin.h>

#include "harmorph/dense.hpp"

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
    static HARMORPH_INLINE Vector load_first(const double* from, Index n) noexcept {
        return _mm512_maskz_loadu_pd(static_cast<__mmask8>((1u << n) - 1), from);
    }
    static HARMORPH_INLINE void store_first(double* to, Vector v, Index n) noexcept {
        _mm512_mask_storeu_pd(to, static_cast<__mmask8>((1u << n) - 1), v);
    }
    static HARMORPH_INLINE double square_root(double x) noexcept { return __builtin_sqrt(x); }
};

template <>
struct Registers<float> {
    typedef float Vector __attribute__((vector_size(64), aligned(4), may_alias));

    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return _mm512_fmadd_ps(a, b, c); }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept { return _mm512_fnmadd_ps(a, b, c); }
    static HARMORPH_INLINE Vector load_first(const float* from, Index n) noexcept {
        return _mm512_maskz_loadu_ps(static_cast<__mmask16>((1u << n) - 1), from);
    }
    static HARMORPH_INLINE void store_first(float* to, Vector v, Index n) noexcept {
        _mm512_mask_storeu_ps(to, static_cast<__mmask16>((1u << n) - 1), v);
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
