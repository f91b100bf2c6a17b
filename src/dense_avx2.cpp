// Dense kernels for processors with AVX2 and FMA; the rest of the library is built for the plain architecture.
#if defined(__x86_64__) && defined(__GNUC__)

// Shared headers come first: their functions must not be compiled for a processor that may not be there.
#include <immintrin.h>

#include "harmorph/dense.hpp"

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

template <class Number>
struct Registers;

template <>
struct Registers<double> {
    typedef double Vector __attribute__((vector_size(32), aligned(8), may_alias));

    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return _mm256_fmadd_pd(a, b, c); }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept { return _mm256_fnmadd_pd(a, b, c); }
    static HARMORPH_INLINE Vector load_first(const double* from, Index n) noexcept {
        Vector v = {};
        for (Index lane = 0; lane < n; ++lane) v[lane] = from[lane];
        return v;
    }
    static HARMORPH_INLINE void store_first(double* to, Vector v, Index n) noexcept {
        for (Index lane = 0; lane < n; ++lane) to[lane] = v[lane];
    }
    static HARMORPH_INLINE double square_root(double x) noexcept { return __builtin_sqrt(x); }
};

template <>
struct Registers<float> {
    typedef float Vector __attribute__((vector_size(32), aligned(4), may_alias));

    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return _mm256_fmadd_ps(a, b, c); }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept { return _mm256_fnmadd_ps(a, b, c); }
    static HARMORPH_INLINE Vector load_first(const float* from, Index n) noexcept {
        Vector v = {};
        for (Index lane = 0; lane < n; ++lane) v[lane] = from[lane];
        return v;
    }
    static HARMORPH_INLINE void store_first(float* to, Vector v, Index n) noexcept {
        for (Index lane = 0; lane < n; ++lane) to[lane] = v[lane];
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
