// simd: code written once for several instruction sets, and the choice of the set when the program
// runs.
//
// In: a file of kernels in terms of Registers (see baseline.hpp, the manual). for_each_set.hpp
// compiles the file once for each set of the architecture; kernel_table.hpp finds the table of
// function pointers for the set chosen. Out: kernels that agree to rounding for all sets. One
// header for each set: baseline, avx2, avx512, neon. Source of the form: foreach_target of the
// library Highway.
//
// This file: the instruction sets, and which of them this processor has, by its own answer (CPUID).
#pragma once

#include "base/kernel.hpp"

namespace harmorph {

// Never automatic. CPUID may take microseconds on a virtual machine: call once for each plan.
Kernel best_kernel() noexcept;
bool has_kernel(Kernel kernel) noexcept;

// The first that is not automatic of a kernel chosen, a kernel found out before, and this
// processor's best.
inline Kernel resolved(Kernel chosen, Kernel known) noexcept {
    Kernel const kernel = chosen == Kernel::automatic ? known : chosen;
    return kernel == Kernel::automatic ? best_kernel() : kernel;
}

}  // namespace harmorph
