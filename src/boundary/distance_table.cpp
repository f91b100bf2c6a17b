#include "boundary/distance_table.hpp"

#define HARMORPH_KERNELS "boundary/distance_kernel.hpp"
#include "simd/for_each_set.hpp"

namespace harmorph {

DistanceKernels const& distance_kernels(Kernel kernel) noexcept {
    return simd::table_of<DistanceKernels>(kernel);
}

}  // namespace harmorph
