/* The header as strict C99 and as C++ see it: included twice, every struct and every kind of
 * constant used, and the sizes and places that other languages rely on. */
#include <harmorph.h>
#include <harmorph_design.h>
#include <harmorph_space.h>
#include <harmorph_study.h>
#include <harmorph.h>

#include <stdio.h>
#include <string.h>

static int passed, failed;

static void check(int holds, const char* what) {
    if (holds) {
        ++passed;
    } else {
        ++failed;
        printf("c_header: %s\n", what);
    }
}

#define SIZE(type, bytes) check(sizeof(type) == (bytes), "size of " #type)
#define PLACE(type, field, bytes) \
    check(offsetof(type, field) == (bytes), "place of " #type "." #field)
#define HAS_SIZE_FIRST(type)                                                            \
    do {                                                                                \
        type object = {sizeof object};                                                  \
        PLACE(type, struct_size, 0);                                                    \
        check(sizeof object % sizeof(void*) == 0 && object.struct_size == sizeof(type), \
              "struct_size of " #type);                                                 \
    } while (0)

static int32_t never_cancel(void* user, int32_t phase, double fraction) {
    (void)user;
    return phase < HM_PHASE_STRUCTURE || phase > HM_PHASE_RESIDUAL || fraction < 0 || fraction > 1;
}

int main(void) {
    char version[64];
    hm_error error;
    hm_options options = {sizeof options};
    hm_status status = HM_OK;
    /* A pointer of each opaque type, and one function's address, are all a caller ever needs to
     * name. */
    hm_analysis* analysis = NULL;
    hm_plan* plan = NULL;
    hm_basis* basis = NULL;

    SIZE(hm_status, 4);
    SIZE(hm_error, 256);
    PLACE(hm_error, item_kind, 4);
    PLACE(hm_error, other_kind, 16);
    PLACE(hm_error, value, 32);
    PLACE(hm_error, x, 40);
    PLACE(hm_error, text, 56);
    check(sizeof error.text == 200, "size of hm_error.text");

    HAS_SIZE_FIRST(hm_mesh);
    HAS_SIZE_FIRST(hm_curve);
    HAS_SIZE_FIRST(hm_curves);
    HAS_SIZE_FIRST(hm_fit_options);
    HAS_SIZE_FIRST(hm_fit_report);
    HAS_SIZE_FIRST(hm_section);
    HAS_SIZE_FIRST(hm_quantity);
    HAS_SIZE_FIRST(hm_variables);
    HAS_SIZE_FIRST(hm_condition);
    HAS_SIZE_FIRST(hm_problem);
    HAS_SIZE_FIRST(hm_options);
    HAS_SIZE_FIRST(hm_mesh_report);
    HAS_SIZE_FIRST(hm_solve_report);
    HAS_SIZE_FIRST(hm_basis_info);
    HAS_SIZE_FIRST(hm_transfer_report);
    HAS_SIZE_FIRST(hm_step_report);
    HAS_SIZE_FIRST(hm_quality_report);
    HAS_SIZE_FIRST(hm_safe_options);
    HAS_SIZE_FIRST(hm_safe_report);
    HAS_SIZE_FIRST(hm_space_mesh);
    HAS_SIZE_FIRST(hm_plane_info);
    HAS_SIZE_FIRST(hm_improve_options);
    HAS_SIZE_FIRST(hm_improve_report);
    if (sizeof(void*) == 8) {
        SIZE(hm_points, 24);
        SIZE(hm_points_out, 24);
        SIZE(hm_space_points, 32);
        SIZE(hm_space_points_out, 32);
        PLACE(hm_points, stride, 16);
        PLACE(hm_points_out, stride, 16);
        PLACE(hm_mesh, points, 16);
        SIZE(hm_mesh, 168);
        PLACE(hm_mesh, quad_points, 136);
        PLACE(hm_curve, indices, 16);
        PLACE(hm_options, tolerance, 24);
        PLACE(hm_options, progress, 32);
        PLACE(hm_options, exponent_quarters, 56);
        PLACE(hm_condition, x, 32);
    }

    /* Zero is the default everywhere. */
    check(HM_CELLS_ROWS == 0 && HM_CLOSED_AUTO == 0, "defaults are 0");
    check(HM_CONFORMAL == 0 && HM_COMPACT == 0 && HM_DIRECT == 0, "defaults of the options are 0");
    check(HM_AGGLOMERATE_AUTO == 0 && HM_KERNEL_AUTO == 0 && HM_DOUBLE == 0,
          "more defaults of the options");
    check(HM_OK == 0 && HM_NOT_CONVERGED > 0 && HM_MOVED > 0 && HM_SHORT > 0,
          "warnings are positive");
    check(HM_CANCELLED < 0 && HM_UNSUPPORTED < 0 && HM_CROSSING < 0, "what is refused is negative");
    check(HM_ON_CURVE < HM_RIGID && HM_RIGID < HM_FIXED && HM_FIXED < HM_SLIP &&
              HM_SLIP < HM_FREE && HM_FREE < HM_PERIODIC_PAIR && HM_PERIODIC_PAIR < HM_GIVEN &&
              HM_GIVEN < HM_ROTATION_PAIR,
          "order of conditions");
    check(HM_STRATEGY_LINEAR < HM_STRATEGY_OTHER && HM_STRATEGY_OTHER < HM_STRATEGY_SUBSTEPS &&
              HM_STRATEGY_SUBSTEPS < HM_STRATEGY_UNTANGLED,
          "order of strategies");
    check(HM_ABI >= 1, "number of the binary interface");
    sprintf(version, "%d.%d.%d", HM_VERSION_MAJOR, HM_VERSION_MINOR, HM_VERSION_PATCH);
    check(strcmp(version, HM_VERSION) == 0, "version in words and in numbers");

    options.progress = never_cancel;
    check(options.progress(options.progress_user, HM_PHASE_SOLVE, 0.5) == 0, "progress callback");
    memset(&error, 0, sizeof error);
    check(error.code == status && analysis == NULL && plan == NULL && basis == NULL,
          "opaque types");

    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
