/* The smallest use of the library: a saved basis, the morph and its transpose.
 * check_link.sh counts the bytes that come along. */
#include <harmorph.h>

int small_use(const void* block, size_t bytes, const double* move, const hm_points* from,
              const hm_points_out* to, const hm_points* dj, double* gradient, hm_error* error) {
    const hm_basis* basis;
    if (hm_basis_attach(&basis, block, bytes, NULL, error) < 0) return 1;
    if (hm_morph(basis, move, from, to, NULL, error) < 0) return 1;
    return hm_adjoint(basis, dj, gradient, NULL, error) < 0;
}
