// The instruction sets that the processor reports.
#include <doctest/doctest.h>

#include "simd/cpu.hpp"

using harmorph::Kernel;

TEST_CASE("there is always a best kernel, and it can be used") {
    CHECK(harmorph::best_kernel() != Kernel::automatic);
    CHECK(harmorph::has_kernel(harmorph::best_kernel()));
    CHECK(harmorph::has_kernel(Kernel::automatic));
    CHECK(harmorph::has_kernel(Kernel::baseline));
}

TEST_CASE("no processor has instructions of two architectures; the best ones imply the others") {
    bool const x86 = harmorph::has_kernel(Kernel::avx2), arm = harmorph::has_kernel(Kernel::neon);
    if (x86) CHECK_FALSE(arm);
    if (harmorph::has_kernel(Kernel::avx512)) CHECK(x86);
    CHECK_FALSE(harmorph::has_kernel(static_cast<Kernel>(5)));
    CHECK_FALSE(harmorph::has_kernel(static_cast<Kernel>(-1)));
}
