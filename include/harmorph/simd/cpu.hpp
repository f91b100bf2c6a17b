// Instruction sets for which kernels exist, and which of them this processor has, asked of the processor itself.
#pragma once

#include "harmorph/base/types.hpp"

namespace harmorph {

// The numbers are those of the C header. Every kernel computes the same to rounding; one kernel, the same bits.
enum class Kernel : std::int32_t { automatic = 0, baseline = 1, avx2 = 2, avx512 = 3, neon = 4 };

// Never automatic. Asking may take microseconds on a virtual machine: once for each plan.
Kernel best_kernel() noexcept;
bool has_kernel(Kernel kernel) noexcept;

}  // namespace harmorph
