// Dense kernels for whatever the compiler may assume: SSE2 on x86-64, NEON on aarch64, plain numbers elsewhere.
#if defined(__aarch64__)
#include <arm_neon.h>
#define HARMORPH_FMA(a, b, c) vfmaq_f64(c, a, b)
#else
#define HARMORPH_FMA(a, b, c) ((a) * (b) + (c))
#endif

#define HARMORPH_KERNEL baseline
#define HARMORPH_LANES 2
#define HARMORPH_TILE_ROWS 4
#include "dense_kernel.hpp"
