#include "multigrid/cycle_table.hpp"

#define HARMORPH_UP_TO_AVX2
#define HARMORPH_KERNELS "multigrid/cycle_kernel.hpp"
#include "simd/for_each_set.hpp"

namespace harmorph {

void FunctionBlock::clear(Index n, Choice const& chosen) const noexcept {
    for (Index i = 0; i < n; ++i) {
        for (Index plane = 0; plane < planes; ++plane) {
            Real* const x = at(i, plane);
            for (Index k = 0; k < functions; ++k) x[k] = chosen.column[k] ? 0 : x[k];
        }
    }
}

void FunctionBlock::take_right_hand_sides(Matrix const& matrix, DofValues const& dofs, Index from,
                                          Index columns, Real* rest) const noexcept {
    Index const row = columns * planes, count = clamp(functions - from, Index{0}, columns);
    std::memset(rest, 0, sizeof(Real) * static_cast<Size>(Offset{matrix.n} * row));
    auto const plane_of = [&](const Real* numbers, Index plane) {
        return numbers + plane * values.plane + first + from;
    };
    for (Index i = 0; i < matrix.n && dofs.source != nullptr; ++i) {
        if (dofs.source_at(i) == nullptr) continue;
        for (Index plane = 0; plane < planes; ++plane) {
            const Real* const source = plane_of(dofs.source_at(i), plane);
            for (Index k = 0; k < count; ++k)
                rest[Offset{i} * row + plane * columns + k] = source[k];
        }
    }
    for (Index wall = 0; wall + 1 < matrix.coupling_start.count(); ++wall) {
        const Real *const known = plane_of(dofs.wall(wall), 0), *const known_imaginary = plane_of(
                                                                    dofs.wall(wall), planes - 1);
        for (Index c = matrix.coupling_start[wall]; c < matrix.coupling_start[wall + 1]; ++c) {
            Real* const to = rest + Offset{matrix.coupling_row[c]} * row;
            Real const re = matrix.coupling_value[c],
                       im = planes == 2 ? matrix.coupling_imaginary[c] : 0;
            for (Index k = 0; k < count; ++k) {
                to[k] -= re * known[k];
                if (planes == 1) continue;
                to[k] += im * known_imaginary[k];
                to[k + columns] -= re * known_imaginary[k] + im * known[k];
            }
        }
    }
}

template <class Number>
CycleKernels<Number> const& cycle_kernels(Kernel kernel) noexcept {
    return simd::table_of<CycleKernels<Number>>(kernel);
}

template CycleKernels<float> const& cycle_kernels(Kernel) noexcept;
template CycleKernels<double> const& cycle_kernels(Kernel) noexcept;

}  // namespace harmorph
