// Products of morphing for processors with AVX-512; the rest of the library is built for the plain architecture.
#if defined(__x86_64__) && defined(__GNUC__)

// Shared headers come first: their functions must not be compiled for a processor that may not be there.
#include <immintrin.h>

#include "harmorph/morph/product.hpp"

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,avx512vl,avx2"))), apply_to = function)
#else
#pragma GCC target("avx512f,avx512dq,avx512vl,avx2")
#endif

#define HARMORPH_KERNEL avx512
#define HARMORPH_LANES 8
#define HARMORPH_LANE_NUMBERS 0, 1, 2, 3, 4, 5, 6, 7
#define HARMORPH_ROUND(v) _mm512_cvtpd_epi64(v)
#define HARMORPH_LOAD_PART(from, n) _mm512_maskz_loadu_pd(static_cast<__mmask8>((1 << (n)) - 1), from)
#define HARMORPH_LOAD_SINGLE_PART(from, n) _mm256_maskz_loadu_ps(static_cast<__mmask8>((1 << (n)) - 1), from)
#include "product_kernel.hpp"

#if defined(__clang__)
#pragma clang attribute pop
#endif

#endif
