// Names the sets of vector instructions for which kernels are compiled.
#pragma once

#include "base/types.hpp"

namespace harmorph {

// The numbers are those of the C header. Different kernels agree to rounding; one kernel always
// gives the same bits.
enum class Kernel : std::int32_t { automatic = 0, baseline = 1, avx2 = 2, avx512 = 3, neon = 4 };

}  // namespace harmorph
