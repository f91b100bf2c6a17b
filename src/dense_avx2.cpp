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
#define HARMORPH_LANES 4
#define HARMORPH_TILE_ROWS 4
#define HARMORPH_FMA(a, b, c) _mm256_fmadd_pd(a, b, c)
#include "dense_kernel.hpp"

#if defined(__clang__)
#pragma clang attribute pop
#endif

#endif
