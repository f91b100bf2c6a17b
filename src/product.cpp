#include "harmorph/product.hpp"

#include "kernel_call.hpp"

namespace harmorph {

#define HARMORPH_DECLARE(kernel)                                                                            \
    namespace kernel {                                                                                      \
    void multiply_rows(ValueRows<Real> const& rows, Movements const& by, Vec2* sum) noexcept;               \
    void multiply_rows(ValueRows<float> const& rows, Movements const& by, Vec2* sum) noexcept;              \
    void multiply_rows_transposed(ValueRows<Real> const& rows, const Vec2* by, FixedSums& total) noexcept;  \
    void multiply_rows_transposed(ValueRows<float> const& rows, const Vec2* by, FixedSums& total) noexcept; \
    }
HARMORPH_FOR_EACH_KERNEL(HARMORPH_DECLARE)

Kernel product_kernel(Offset values) noexcept {
    constexpr Offset worth_asking = Offset{1} << 16;
    return values < worth_asking ? Kernel::baseline : best_kernel();
}

void multiply_rows(Kernel kernel, ValueRows<Real> const& rows, Movements const& by, Vec2* sum) noexcept {
    HARMORPH_CALL(kernel, multiply_rows(rows, by, sum))
}

void multiply_rows(Kernel kernel, ValueRows<float> const& rows, Movements const& by, Vec2* sum) noexcept {
    HARMORPH_CALL(kernel, multiply_rows(rows, by, sum))
}

void multiply_rows_transposed(Kernel kernel, ValueRows<Real> const& rows, const Vec2* by, FixedSums& total) noexcept {
    HARMORPH_CALL(kernel, multiply_rows_transposed(rows, by, total))
}

void multiply_rows_transposed(Kernel kernel, ValueRows<float> const& rows, const Vec2* by, FixedSums& total) noexcept {
    HARMORPH_CALL(kernel, multiply_rows_transposed(rows, by, total))
}

}  // namespace harmorph
