// Searches for processors with AVX2; the rest of the library is built for the plain architecture.
#if defined(__x86_64__) && defined(__GNUC__)

// Shared headers come first: their functions must not be compiled for a processor that may not be there.
#include <immintrin.h>

#include "harmorph/boundary/distance.hpp"

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC target("avx2")
#endif

#define HARMORPH_KERNEL avx2
#define HARMORPH_LANES 4
#define HARMORPH_LESS(a, b) _mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LT_OQ))
#define HARMORPH_LARGER(a, b) _mm256_max_pd(a, b)
#define HARMORPH_SMALLER(a, b) _mm256_min_pd(a, b)
#define HARMORPH_ROOT(v) _mm256_sqrt_pd(v)
#include "distance_kernel.hpp"

#if defined(__clang__)
#pragma clang attribute pop
#endif

#endif
