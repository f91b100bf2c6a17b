#include "harmorph/morph/product.hpp"

#include "harmorph/base/kernel_call.hpp"

namespace harmorph {

#define HARMORPH_DECLARE(kernel)                                                                            \
    namespace kernel {                                                                                      \
    void multiply_rows(ValueRows<Real> const& rows, Movements const& by, Sums const& to) noexcept;          \
    void multiply_rows(ValueRows<float> const& rows, Movements const& by, Sums const& to) noexcept;         \
    void multiply_rows_transposed(ValueRows<Real> const& rows, const Vec2* by, FixedSums& total) noexcept;  \
    void multiply_rows_transposed(ValueRows<float> const& rows, const Vec2* by, FixedSums& total) noexcept; \
    void add_sums(const Real* from, Real* to, const Real* sum, Index n) noexcept;                           \
    }
HARMORPH_FOR_EACH_KERNEL(HARMORPH_DECLARE)

Kernel product_kernel(Offset values) noexcept {
    constexpr Offset worth_asking = Offset{1} << 16;
    return values < worth_asking ? Kernel::baseline : best_kernel();
}

void multiply_rows(Kernel kernel, ValueRows<Real> const& rows, Movements const& by, Sums const& to) noexcept {
    HARMORPH_CALL(kernel, multiply_rows(rows, by, to))
}

void multiply_rows(Kernel kernel, ValueRows<float> const& rows, Movements const& by, Sums const& to) noexcept {
    HARMORPH_CALL(kernel, multiply_rows(rows, by, to))
}

void multiply_rows_transposed(Kernel kernel, ValueRows<Real> const& rows, const Vec2* by, FixedSums& total) noexcept {
    HARMORPH_CALL(kernel, multiply_rows_transposed(rows, by, total))
}

void multiply_rows_transposed(Kernel kernel, ValueRows<float> const& rows, const Vec2* by, FixedSums& total) noexcept {
    HARMORPH_CALL(kernel, multiply_rows_transposed(rows, by, total))
}

void add_sums(Kernel kernel, const Real* from, Real* to, const Real* sum, Index n) noexcept {
    HARMORPH_CALL(kernel, add_sums(from, to, sum, n))
}

}  // namespace harmorph
