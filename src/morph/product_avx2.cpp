// Products of morphing for processors with AVX2; the rest of the library is built for the plain architecture.
#if defined(__x86_64__) && defined(__GNUC__)

// Shared headers come first: their functions must not be compiled for a processor that may not be there.
#include <immintrin.h>

#include "harmorph/morph/product.hpp"

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC target("avx2")
#endif

#define HARMORPH_KERNEL avx2
#define HARMORPH_LANES 4
#define HARMORPH_LANE_NUMBERS 0, 1, 2, 3
#define HARMORPH_LOAD_PART(from, n) \
    _mm256_maskload_pd(from, _mm256_cmpgt_epi64(_mm256_set1_epi64x(n), _mm256_set_epi64x(3, 2, 1, 0)))
#define HARMORPH_LOAD_SINGLE_PART(from, n) \
    _mm_maskload_ps(from, _mm_cmpgt_epi32(_mm_set1_epi32(n), _mm_set_epi32(3, 2, 1, 0)))
#include "product_kernel.hpp"

#if defined(__clang__)
#pragma clang attribute pop
#endif

#endif
