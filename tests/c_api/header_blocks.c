/* Compiles one block of code from a comment of the headers, which headers.sh writes to the file
 * BLOCK. The names that such blocks use without a declaration are those of this page. */
#include <harmorph.h>
#include <harmorph_openmp.h>
#include <harmorph_pages.h>
#include <harmorph_pthreads.h>
#include <stdlib.h>

void block(const hm_mesh mesh, const double* move, double* x, double* y, double* dx, double* dy);
void block(const hm_mesh mesh, const double* move, double* x, double* y, double* dx, double* dy) {
    const int32_t wall = 1;
    const hm_curves* curves = NULL;
    const hm_points dj = {dx, dy, 1};
    const hm_points_out to = {x, y, 1};
    hm_analysis* analysis = NULL;
    hm_plan* plan = NULL;
    hm_basis* basis = NULL;
    hm_setup setup;
    hm_options options;
    double gradient[40];
    hm_error error;
    HM_INIT(setup);
    HM_INIT(options);
    {
#include BLOCK
    }
}
