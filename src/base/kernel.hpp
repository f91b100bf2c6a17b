// The vector instructions that kernels are compiled for.
#pragma once

#include "base/types.hpp"

namespace harmorph {

// The numbers are those of the C header. Every kernel computes the same to rounding; one kernel,
// the same bits.
enum class Kernel : std::int32_t { automatic = 0, baseline = 1, avx2 = 2, avx512 = 3, neon = 4 };

}  // namespace harmorph
