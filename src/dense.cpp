#include "harmorph/dense.hpp"

#if defined(__AVX512F__)
#define HARMORPH_LANES 8
#define HARMORPH_TILE_ROWS 8
#elif defined(__AVX2__)
#define HARMORPH_LANES 4
#define HARMORPH_TILE_ROWS 4
#else
#define HARMORPH_LANES 2
#define HARMORPH_TILE_ROWS 4
#endif
#define HARMORPH_TILE_VECTORS 3
#include "dense_kernel.hpp"

namespace harmorph::dense {

Index factor(Panel const& panel, Real floor) noexcept { return factor_panel(panel, floor); }
void update_border(Panel const& panel, Real* c, Offset row) noexcept { subtract_border_square(panel, c, row); }
void solve_forward(Panel const& panel, Real* y, Index row) noexcept { forward(panel, y, row); }
void solve_backward(Panel const& panel, Real* y, Index row) noexcept { backward(panel, y, row); }

}  // namespace harmorph::dense
