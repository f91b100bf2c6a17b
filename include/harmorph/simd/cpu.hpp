// simd: code written once for several instruction sets, and the choice of the set when the program runs.
//
// In: a file of kernels in terms of Registers (see baseline.hpp, the manual). for_each_set.hpp compiles the file once
// for each set of the architecture; kernel_table.hpp finds the table of function pointers for the set chosen. Out:
// kernels that agree to rounding for all sets. One header for each set: baseline, avx2, avx512, neon. Source of the
// form: foreach_target of the library Highway.
//
// This file: the instruction sets, and which of them this processor has, by its own answer (CPUID).
#pragma once

#include "harmorph/base/types.hpp"

namespace harmorph {

// The numbers are those of the C header. Every kernel computes the same to rounding; one kernel, the same bits.
enum class Kernel : std::int32_t { automatic = 0, baseline = 1, avx2 = 2, avx512 = 3, neon = 4 };

// Never automatic. CPUID may take microseconds on a virtual machine: call once for each plan.
Kernel best_kernel() noexcept;
bool has_kernel(Kernel kernel) noexcept;

}  // namespace harmorph
