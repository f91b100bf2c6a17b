#include "operators/residual_table.hpp"

#define HARMORPH_KERNELS "operators/residual_kernel.hpp"
#include "simd/for_each_set.hpp"

namespace harmorph {

ResidualKernels const& residual_kernels(Kernel kernel) noexcept {
    return simd::table_of<ResidualKernels>(kernel);
}

}  // namespace harmorph
