// The C interface: names the best kernel of this processor.
#include "harmorph.h"
#include "simd/cpu.hpp"

extern "C" int32_t hm_best_kernel(void) { return static_cast<int32_t>(harmorph::best_kernel()); }
