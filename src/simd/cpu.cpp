#include "simd/cpu.hpp"

#if defined(__x86_64__) && defined(__GNUC__)
#include <cpuid.h>
#endif

namespace harmorph {

#if defined(__x86_64__) && defined(__GNUC__)

namespace {

constexpr bool has_bit(unsigned word, int bit) noexcept { return (word >> bit & 1) != 0; }

// Returns which registers the operating system saves: bits 1 and 2 stand for SSE and AVX, bits 5, 6
// and 7 for AVX-512.
unsigned saved_registers() noexcept {
    unsigned low, high;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
}

}  // namespace

// The bit numbers are those of Intel 64 and IA-32 Architectures Software Developer's Manual, volume
// 2A, CPUID. Each CPUID instruction is slow on a virtual machine, so there are only two. All x86-64
// processors have leaf 1, and all processors with AVX have leaf 7.
Kernel best_kernel() noexcept {
    unsigned a = 0, b = 0, c = 0, d = 0;
    __cpuid(1, a, b, c, d);
    bool const has_fma = has_bit(c, 12), has_xgetbv = has_bit(c, 27), has_avx = has_bit(c, 28);
    if (!has_fma || !has_xgetbv || !has_avx) return Kernel::baseline;
    unsigned const saved = saved_registers();
    if ((saved & 0x06) != 0x06) return Kernel::baseline;
    __cpuid_count(7, 0, a, b, c, d);
    bool const has_avx2 = has_bit(b, 5);
    bool const has_avx512 =
        has_bit(b, 16) && has_bit(b, 17) && has_bit(b, 31) && (saved & 0xE0) == 0xE0;  // F, DQ, VL
    return has_avx512 && has_avx2 ? Kernel::avx512 : has_avx2 ? Kernel::avx2 : Kernel::baseline;
}

// A processor whose best kernel is AVX-512 can run AVX2 kernels, too.
bool has_kernel(Kernel kernel) noexcept {
    if (kernel == Kernel::automatic || kernel == Kernel::baseline) return true;
    return (kernel == Kernel::avx2 || kernel == Kernel::avx512) && kernel <= best_kernel();
}

#elif defined(__AARCH64EL__)

Kernel best_kernel() noexcept { return Kernel::neon; }

bool has_kernel(Kernel kernel) noexcept {
    return kernel == Kernel::automatic || kernel == Kernel::baseline || kernel == Kernel::neon;
}

#else

Kernel best_kernel() noexcept { return Kernel::baseline; }

bool has_kernel(Kernel kernel) noexcept {
    return kernel == Kernel::automatic || kernel == Kernel::baseline;
}

#endif

}  // namespace harmorph
