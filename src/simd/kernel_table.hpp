// A family of kernels is a struct of function pointers; each instruction set has one such struct,
// the table of the set. tests/simd/test_registers.cpp covers this file.
#pragma once

#include "simd/cpu.hpp"

namespace harmorph::simd {

// The file of the kernels specialises this pointer for each set; it is null for an instruction set
// that this architecture does not have.
template <class Kernels, Kernel set>
inline constexpr const Kernels* table = nullptr;

// Must be called in the source that specialises the tables, for a kernel for which has_kernel()
// holds; for automatic, the function returns the baseline's table.
template <class Kernels>
Kernels const& table_of(Kernel kernel) noexcept {
    constexpr const Kernels* baseline = table<Kernels, Kernel::baseline>;
    static_assert(baseline != nullptr, "every family has kernels for the plain architecture");
    const Kernels* found = nullptr;
    switch (kernel) {
        case Kernel::avx2: found = table<Kernels, Kernel::avx2>; break;
        case Kernel::avx512:
            found = table<Kernels, Kernel::avx512>;
            if (found == nullptr) found = table<Kernels, Kernel::avx2>;
            break;
        case Kernel::neon: found = table<Kernels, Kernel::neon>; break;
        case Kernel::automatic:
        case Kernel::baseline: break;
    }
    return found != nullptr ? *found : *baseline;
}

}  // namespace harmorph::simd
