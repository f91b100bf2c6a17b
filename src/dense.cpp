#include "harmorph/dense.hpp"

namespace harmorph::dense {

// One set of kernels for each kind of processor; see dense_kernel.hpp.
#define HARMORPH_DECLARE(kernel)                                                          \
    namespace kernel {                                                                    \
    Index factor(Panel const& panel, Real floor, Real* packing) noexcept;                 \
    void update_border(Panel const& panel, Real* c, Offset row, Real* packing) noexcept;  \
    void solve_forward(Panel const& panel, Real* y, Index row) noexcept;                  \
    void solve_backward(Panel const& panel, Real* y, Index row) noexcept;                 \
    }
HARMORPH_DECLARE(baseline)

#if defined(__x86_64__) && defined(__GNUC__)
HARMORPH_DECLARE(avx2)
HARMORPH_DECLARE(avx512)
#define HARMORPH_CALL(kernel, call)              \
    switch (kernel) {                            \
        case Kernel::avx512: return avx512::call; \
        case Kernel::avx2: return avx2::call;     \
        default: return baseline::call;           \
    }
#else
#define HARMORPH_CALL(kernel, call)  \
    static_cast<void>(kernel);       \
    return baseline::call;
#endif

Index factor(Kernel kernel, Panel const& panel, Real floor, Real* packing) noexcept {
    HARMORPH_CALL(kernel, factor(panel, floor, packing))
}

void update_border(Kernel kernel, Panel const& panel, Real* c, Offset row, Real* packing) noexcept {
    HARMORPH_CALL(kernel, update_border(panel, c, row, packing))
}

void solve_forward(Kernel kernel, Panel const& panel, Real* y, Index row) noexcept {
    HARMORPH_CALL(kernel, solve_forward(panel, y, row))
}

void solve_backward(Kernel kernel, Panel const& panel, Real* y, Index row) noexcept {
    HARMORPH_CALL(kernel, solve_backward(panel, y, row))
}

}  // namespace harmorph::dense
