// Dense kernels for whatever the compiler may assume: SSE2 on x86-64, NEON on aarch64, plain numbers elsewhere. Products
// are rounded before they are added, also where one instruction could do both: so all processors agree on the bits.
#include "harmorph/dense/dense.hpp"

#define HARMORPH_KERNEL baseline
#define HARMORPH_TILE_ROWS 4
#define HARMORPH_INLINE inline __attribute__((always_inline))

namespace harmorph::dense::baseline {
namespace {

// What one register holds, numbers that may begin anywhere: c + a b, c - a b, and numbers picked from two registers: lane
// `picked` of the first, or, counted on, of the second, or 0 where that is none.
template <class Number>
struct Registers {
    typedef Number Vector __attribute__((vector_size(16), aligned(sizeof(Number)), may_alias));

    static HARMORPH_INLINE Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return c + a * b; }
    static HARMORPH_INLINE Vector multiply_subtract(Vector a, Vector b, Vector c) noexcept { return c - a * b; }
    struct Picks {
        Index from[16 / sizeof(Number)];
    };
    static HARMORPH_INLINE Picks picks_of(const Index (&picked)[16 / sizeof(Number)]) noexcept {
        Picks its;
        for (Size lane = 0; lane < 16 / sizeof(Number); ++lane) its.from[lane] = picked[lane];
        return its;
    }
    static HARMORPH_INLINE Vector pick(Vector a, Vector b, Picks const& its) noexcept {
        constexpr Index lanes = 16 / sizeof(Number);
        Vector v = {};
        for (Index lane = 0; lane < lanes; ++lane) {
            Index const from = its.from[lane];
            if (from != none) v[lane] = from < lanes ? a[from] : b[from - lanes];
        }
        return v;
    }
    static HARMORPH_INLINE Number square_root(Number x) noexcept { return static_cast<Number>(__builtin_sqrt(x)); }
};

}  // namespace
}  // namespace harmorph::dense::baseline

#include "dense_moves.hpp"
