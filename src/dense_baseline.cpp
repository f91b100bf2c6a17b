// Dense kernels for whatever the compiler may assume: SSE2 on x86-64, NEON on aarch64, plain numbers elsewhere.
#define HARMORPH_KERNEL baseline
#define HARMORPH_LANES 2
#define HARMORPH_TILE_ROWS 4
#include "dense_kernel.hpp"
