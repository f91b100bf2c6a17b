// Balances for whatever the compiler may assume: SSE2 on x86-64, NEON on aarch64, plain numbers elsewhere.
#define HARMORPH_KERNEL baseline
#define HARMORPH_LANES 2
#define HARMORPH_LOAD_PART(from, n) Vector{(n) > 0 ? (from)[0] : 0, (n) > 1 ? (from)[1] : 0}
#include "residual_kernel.hpp"
