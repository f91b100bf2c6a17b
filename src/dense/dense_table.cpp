#include "dense/dense_table.hpp"

#define HARMORPH_KERNELS "dense/dense_moves.hpp"
#include "simd/for_each_set.hpp"

namespace harmorph::dense {

template <Index planes>
FrontKernels<planes> const& front_kernels(Kernel kernel) noexcept {
    return simd::table_of<FrontKernels<planes>>(kernel);
}

MoveKernels const& move_kernels(Kernel kernel) noexcept {
    return simd::table_of<MoveKernels>(kernel);
}

template FrontKernels<1> const& front_kernels(Kernel) noexcept;
template FrontKernels<2> const& front_kernels(Kernel) noexcept;

}  // namespace harmorph::dense
