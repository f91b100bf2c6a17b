#include "operators/residual_table.hpp"

#define HARMORPH_KERNELS "operators/residual_kernel.hpp"
#include "simd/for_each_set.hpp"

namespace harmorph {

template <class To>
ResidualKernels<To> const& residual_kernels(Kernel kernel) noexcept {
    return simd::table_of<ResidualKernels<To>>(kernel);
}

template ResidualKernels<double> const& residual_kernels(Kernel) noexcept;
template ResidualKernels<float> const& residual_kernels(Kernel) noexcept;

}  // namespace harmorph
