#include "safe/quality_energy.hpp"

#define HARMORPH_KERNELS "safe/quality_kernel.hpp"
#include "simd/for_each_set.hpp"

namespace harmorph {

QualityKernels const& quality_kernels(Kernel kernel) noexcept {
    return simd::table_of<QualityKernels>(kernel);
}

}  // namespace harmorph
