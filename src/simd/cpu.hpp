// The room simd compiles code that is written once for several instruction sets, and chooses the
// set when the program runs.
//
// A file of kernels uses Registers, which baseline.hpp documents. for_each_set.hpp compiles the
// file once for each set of the architecture; kernel_table.hpp finds the table of function pointers
// for the chosen set. The kernels of all sets agree to rounding. Each set has one header: baseline,
// avx2, avx512 or neon. The structure follows foreach_target of the library Highway.
//
// This file asks the processor (by CPUID) which instruction sets it has.
#pragma once

#include "base/types.hpp"

namespace harmorph {

// best_kernel() never returns automatic. CPUID may take microseconds on a virtual machine, so each
// plan calls best_kernel() only once.
Kernel best_kernel() noexcept;
bool has_kernel(Kernel kernel) noexcept;

// Returns the chosen kernel; if that is automatic, the kernel that is known to be best; if that is
// automatic, too, the best kernel of this processor.
inline Kernel resolved(Kernel chosen, Kernel known) noexcept {
    Kernel const kernel = chosen == Kernel::automatic ? known : chosen;
    return kernel == Kernel::automatic ? best_kernel() : kernel;
}

}  // namespace harmorph
