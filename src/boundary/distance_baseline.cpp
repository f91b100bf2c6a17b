// Searches for whatever the compiler may assume: SSE2 on x86-64, NEON on aarch64, plain numbers elsewhere.
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#define HARMORPH_KERNEL baseline
#define HARMORPH_LANES 2
#if defined(__SSE2__)
#define HARMORPH_LESS(a, b) _mm_movemask_pd(_mm_cmplt_pd(a, b))
#define HARMORPH_LARGER(a, b) _mm_max_pd(a, b)
#define HARMORPH_SMALLER(a, b) _mm_min_pd(a, b)
#define HARMORPH_ROOT(v) _mm_sqrt_pd(v)
#else
#define HARMORPH_LESS(a, b) (((a)[0] < (b)[0] ? 1 : 0) | ((a)[1] < (b)[1] ? 2 : 0))
#define HARMORPH_LARGER(a, b) ((a) > (b) ? (a) : (b))
#define HARMORPH_SMALLER(a, b) ((a) < (b) ? (a) : (b))
#define HARMORPH_ROOT(v) (Vector{square_root((v)[0]), square_root((v)[1])})
#endif
#include "distance_kernel.hpp"
