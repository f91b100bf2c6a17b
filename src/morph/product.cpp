#include "morph/product.hpp"

#define HARMORPH_KERNELS "morph/product_kernel.hpp"
#include "simd/for_each_set.hpp"

namespace harmorph {

ProductKernels const& product_kernels(Kernel kernel) noexcept {
    return simd::table_of<ProductKernels>(kernel);
}

ProductKernels const& product_kernels_for(Kernel known, Offset values,
                                          Offset detection_threshold) noexcept {
    return product_kernels(
        resolved(known, values < detection_threshold ? Kernel::baseline : Kernel::automatic));
}

}  // namespace harmorph
