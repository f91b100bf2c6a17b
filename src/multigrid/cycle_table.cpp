#include "multigrid/cycle_table.hpp"

#define HARMORPH_UP_TO_AVX2
#define HARMORPH_KERNELS "multigrid/cycle_kernel.hpp"
#include "simd/for_each_set.hpp"

namespace harmorph {

template <class Number>
CycleKernels<Number> const& cycle_kernels(Kernel kernel) noexcept {
    return simd::table_of<CycleKernels<Number>>(kernel);
}

template CycleKernels<float> const& cycle_kernels(Kernel) noexcept;
template CycleKernels<double> const& cycle_kernels(Kernel) noexcept;

}  // namespace harmorph
