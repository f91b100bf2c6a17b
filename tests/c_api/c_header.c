/* The headers as strict C89 to C11 and C++11 to C++20 see them: one of them included twice, every
 * struct with a struct_size begun by HM_INIT, every kind of constant used, and the sizes and places
 * that other languages rely on. */
#include <harmorph.h>
#include <harmorph_bases.h>
#include <harmorph_design.h>
#include <harmorph_fields.h>
#include <harmorph_quality.h>
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
/* Bytes that HM_INIT has left as they were count as a failure. */
static int is_zero(const void* bytes, size_t n) {
    const unsigned char* byte = (const unsigned char*)bytes;
    for (; n > 0; ++byte, --n)
        if (*byte != 0) return 0;
    return 1;
}
#define BEGINS(type)                                                                    \
    do {                                                                                \
        type object;                                                                    \
        memset(&object, 0xa5, sizeof object);                                           \
        HM_INIT(object);                                                                \
        PLACE(type, struct_size, 0);                                                    \
        check(sizeof object % sizeof(void*) == 0 && object.struct_size == sizeof(type), \
              "struct_size of " #type);                                                 \
        check(is_zero((const char*)&object + sizeof object.struct_size,                 \
                      sizeof object - sizeof object.struct_size),                       \
              "HM_INIT of " #type);                                                     \
    } while (0)

static int32_t never_cancel(void* user, int32_t phase, double fraction) {
    (void)user;
    return phase < HM_PHASE_STRUCTURE || phase > HM_PHASE_RESIDUAL || fraction < 0 || fraction > 1;
}

int main(void) {
    char version[64];
    hm_error error;
    hm_options options;
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

    BEGINS(hm_executor);
    BEGINS(hm_mesh);
    BEGINS(hm_modes);
    BEGINS(hm_movement);
    BEGINS(hm_curve);
    BEGINS(hm_curves);
    BEGINS(hm_fit_options);
    BEGINS(hm_fit_report);
    BEGINS(hm_fit_details);
    BEGINS(hm_condition);
    BEGINS(hm_problem);
    BEGINS(hm_options);
    BEGINS(hm_setup);
    BEGINS(hm_solve_report);
    BEGINS(hm_basis_info);
    BEGINS(hm_step_report);
    BEGINS(hm_quality_report);
    BEGINS(hm_safe_options);
    BEGINS(hm_safe_report);
    BEGINS(hm_safe_target);
    BEGINS(hm_improve_options);
    BEGINS(hm_improve_report);
    BEGINS(hm_recover_report);
    BEGINS(hm_refit_report);
    BEGINS(hm_section);
    BEGINS(hm_section_move);
    BEGINS(hm_quantity);
    BEGINS(hm_variables);
    BEGINS(hm_transfer_report);
    BEGINS(hm_space_mesh);
    BEGINS(hm_plane_info);
    BEGINS(hm_edge_mesh);
    BEGINS(hm_study_options);
    BEGINS(hm_mesh_report);
    BEGINS(hm_walls_info);
    BEGINS(hm_interpolation_report);
    BEGINS(hm_bound);
    BEGINS(hm_bound_value);
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
        PLACE(hm_options, exponent, 56);
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
              HM_GIVEN < HM_ROTATION_PAIR && HM_ROTATION_PAIR < HM_INTERFACE,
          "order of conditions");
    check(HM_STRATEGY_LINEAR < HM_STRATEGY_OTHER && HM_STRATEGY_OTHER < HM_STRATEGY_SUBSTEPS &&
              HM_STRATEGY_SUBSTEPS < HM_STRATEGY_UNTANGLED,
          "order of strategies");
    check(HM_ABI >= 1, "number of the binary interface");
    sprintf(version, "%d.%d.%d", HM_VERSION_MAJOR, HM_VERSION_MINOR, HM_VERSION_PATCH);
    check(strcmp(version, HM_VERSION) == 0, "version in words and in numbers");

    HM_INIT(options);
    options.progress = never_cancel;
    check(options.progress(options.progress_user, HM_PHASE_SOLVE, 0.5) == 0, "progress callback");
    memset(&error, 0, sizeof error);
    check(error.code == status && analysis == NULL && plan == NULL && basis == NULL,
          "opaque types");

    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
