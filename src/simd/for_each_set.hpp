// Compiles the kernels in the file HARMORPH_KERNELS once for each instruction set of the
// architecture, as foreach_target of the library Highway does. The file puts its code into
// namespaces called HARMORPH_SET, uses simd::HARMORPH_SET::Registers, which baseline.hpp documents,
// and specialises simd::table. Headers that all sets share are included before this file.
//
// If HARMORPH_UP_TO_AVX2 is defined, AVX-512 takes the code for AVX2: for kernels that would gain
// nothing from wider registers.
//
// A new instruction set needs a header in this room that defines Registers, three lines below, a
// number in enum Kernel, a case in table_of(), and a test of the processor in cpu.cpp.
// tests/simd/test_registers.cpp covers the registers of all sets that the processor has.
#if !defined(HARMORPH_KERNELS)
#error "HARMORPH_KERNELS must name the file of the kernels"
#endif

#include <type_traits>
#if defined(__SSE2__)
#include <immintrin.h>
#elif defined(__AARCH64EL__)
#include <arm_neon.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#include "base/scalar.hpp"
#include "simd/kernel_table.hpp"

#include "simd/baseline.hpp"
#include HARMORPH_KERNELS
#include "simd/end.hpp"

#if defined(__x86_64__) && defined(__GNUC__)
#include "simd/avx2.hpp"
#include HARMORPH_KERNELS
#include "simd/end.hpp"

#if !defined(HARMORPH_UP_TO_AVX2)
#include "simd/avx512.hpp"
#include HARMORPH_KERNELS
#include "simd/end.hpp"
#endif
#endif

#if defined(__AARCH64EL__)
#include "simd/neon.hpp"
#include HARMORPH_KERNELS
#include "simd/end.hpp"
#endif

#undef HARMORPH_KERNELS
#undef HARMORPH_UP_TO_AVX2
