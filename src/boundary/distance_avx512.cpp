// Searches for processors with AVX-512; the rest of the library is built for the plain architecture.
#if defined(__x86_64__) && defined(__GNUC__)

// Shared headers come first: their functions must not be compiled for a processor that may not be there.
#include <immintrin.h>

#include "harmorph/boundary/distance.hpp"

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,avx512vl,avx2"))), apply_to = function)
#else
#pragma GCC target("avx512f,avx512dq,avx512vl,avx2")
#endif

#define HARMORPH_KERNEL avx512
#define HARMORPH_LANES 8
#define HARMORPH_LESS(a, b) _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ)
// Those without masks read registers that nobody has set.
#define HARMORPH_LARGER(a, b) _mm512_maskz_max_pd(0xff, a, b)
#define HARMORPH_SMALLER(a, b) _mm512_maskz_min_pd(0xff, a, b)
#define HARMORPH_ROOT(v) _mm512_maskz_sqrt_pd(0xff, v)
#include "distance_kernel.hpp"

#if defined(__clang__)
#pragma clang attribute pop
#endif

#endif
