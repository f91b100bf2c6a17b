/* Lines of C on the pages, which tests/release/readme.sh saves as readme_*.inc, among what they
 * name: they compile. */
#include "harmorph.h"
#include "harmorph_openmp.h"

enum { WALL = 1 };

hm_status given(hm_plan* plan, int32_t n, const int32_t* points, hm_points wall, hm_points start,
                hm_points_out moved, hm_points force, hm_points_out force_on_wall, hm_memory work,
                size_t bytes);
hm_status given(hm_plan* plan, int32_t n, const int32_t* points, hm_points wall, hm_points start,
                hm_points_out moved, hm_points force, hm_points_out force_on_wall, hm_memory work,
                size_t bytes) {
    hm_error error;
#include "readme_given.inc"
    return given.kind == HM_GIVEN ? error.code : HM_OK;
}

void threads(hm_options options);
void threads(hm_options options) {
#include "readme_threads.inc"
}
