#include "dense/dense_table.hpp"

#define HARMORPH_KERNELS "dense/dense_moves.hpp"
#include "simd/for_each_set.hpp"

namespace harmorph::dense {

template <class Number, Index planes>
FrontKernels<Number, planes> const& front_kernels(Kernel kernel) noexcept {
    return simd::table_of<FrontKernels<Number, planes>>(kernel);
}

template <class Number>
MoveKernels<Number> const& move_kernels(Kernel kernel) noexcept {
    return simd::table_of<MoveKernels<Number>>(kernel);
}

template <class Number, class Value>
CopyKernels<Number, Value> const& copy_kernels(Kernel kernel) noexcept {
    return simd::table_of<CopyKernels<Number, Value>>(kernel);
}

template FrontKernels<double, 1> const& front_kernels(Kernel) noexcept;
template FrontKernels<double, 2> const& front_kernels(Kernel) noexcept;
template FrontKernels<float, 1> const& front_kernels(Kernel) noexcept;
template FrontKernels<float, 2> const& front_kernels(Kernel) noexcept;
template MoveKernels<double> const& move_kernels(Kernel) noexcept;
template MoveKernels<float> const& move_kernels(Kernel) noexcept;
template CopyKernels<double, double> const& copy_kernels(Kernel) noexcept;
template CopyKernels<float, double> const& copy_kernels(Kernel) noexcept;
template CopyKernels<float, float> const& copy_kernels(Kernel) noexcept;

}  // namespace harmorph::dense
