// Products of morphing for whatever the compiler may assume: SSE2 on x86-64, NEON on aarch64, plain numbers elsewhere.
#define HARMORPH_KERNEL baseline
#define HARMORPH_LANES 2
#define HARMORPH_LANE_NUMBERS 0, 1
#define HARMORPH_LOAD_PART(from, n) (static_cast<void>(n), Vector{*(from), 0})
#define HARMORPH_LOAD_SINGLE_PART(from, n) (static_cast<void>(n), Singles{*(from), 0})
#include "product_kernel.hpp"
