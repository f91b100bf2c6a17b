/* The equations of a part, and the check that the problem is the same on all processes. */
#ifndef HARMORPH_PETSC_PROBLEM_H
#define HARMORPH_PETSC_PROBLEM_H

#include "private.h"
#include "part.h"

static hm_status make_equations(hm_petsc* system, const hm_private_edge* edges, int32_t n,
                                const hm_problem* problem, const hm_options* options,
                                hm_error* err) {
    size_t bytes = 0;
    hm_status status = hm_private_equations_size(system->part, n, problem, options, &bytes, err),
              known;
    if (status < 0) return status;
    system->tolerance = options != NULL && options->tolerance > 0 ? options->tolerance : 1e-10;
    system->equations_block = malloc(bytes);
    if (system->equations_block == NULL) return no_memory(err);
    system->bytes += bytes;
    status = hm_private_equations_init(&system->equations, system->equations_block, bytes,
                                       system->part, n, edges, problem, options, err);
    if (status < 0) return status;
    system->info.struct_size = sizeof system->info;
    known = hm_private_equations_info_get(system->equations, &system->info, err);
    return known < 0 ? known : status;
}

/* The FNV-1a checksum of the data that were read. */
static uint64_t add_bytes(uint64_t sum, const void* data, size_t bytes) {
    const unsigned char* const byte = data;
    size_t k;
    for (k = 0; k < bytes; ++k) sum = (sum ^ byte[k]) * 0x100000001b3u;
    return sum;
}

static uint64_t add_number(uint64_t sum, int32_t number) {
    return add_bytes(sum, &number, sizeof number);
}

static uint64_t add_curves(uint64_t sum, const hm_curves* curves) {
    int32_t k, i;
    if (curves == NULL) return add_number(sum, 0);
    sum = add_number(sum, curves->n_control);
    sum = add_bytes(sum, curves->control, 2 * (size_t)curves->n_control * sizeof *curves->control);
    if (curves->weights != NULL)
        sum = add_bytes(sum, curves->weights, (size_t)curves->n_control * sizeof *curves->weights);
    for (k = 0; k < curves->n_curves; ++k) {
        const hm_curve* const curve =
            (const hm_curve*)((const char*)curves->curve + (size_t)k * curves->curve->struct_size);
        sum = add_number(add_number(sum, curve->degree), curve->n_indices);
        sum = add_bytes(sum, curve->knots,
                        (size_t)(curve->n_indices + curve->degree + 1) * sizeof *curve->knots);
        for (i = 0; i < curve->n_indices; ++i) {
            sum = add_number(sum,
                             curve->indices != NULL ? curve->indices[i] - curves->index_base : i);
        }
    }
    return sum;
}

static uint64_t add_conditions(uint64_t sum, const hm_problem* problem) {
    int32_t k;
    sum = add_number(sum, problem->n_conditions);
    for (k = 0; k < problem->n_conditions; ++k) {
        const size_t bytes = (size_t)problem->conditions->struct_size;
        const char* const condition = (const char*)problem->conditions + (size_t)k * bytes;
        sum = add_bytes(sum, condition + sizeof(uint64_t), bytes - sizeof(uint64_t));
    }
    return sum;
}

static uint64_t add_options(uint64_t sum, const hm_options* options) {
    hm_options known = {0};
    if (options != NULL) {
        memcpy(&known, options, known_bytes(options->struct_size, sizeof known));
    }
    sum = add_number(add_number(sum, known.operator_kind), (int64_t)(4 * known.exponent));
    return add_bytes(add_number(sum, known.offset_correction), &known.tolerance,
                     sizeof known.tolerance);
}

/* Called after make_equations, which has checked curves, conditions and options. */
static hm_status compare_problems(const hm_petsc* system, const hm_problem* problem,
                                  const hm_options* options, hm_error* err) {
    const uint64_t start = 0xcbf29ce484222325u;
    const uint64_t sum =
        add_options(add_conditions(add_curves(start, problem->curves), problem), options);
    const int64_t number = (int64_t)sum;
    return agree(
        differs_from_first(&number, 1, system->comm)
            ? refuse(err, HM_BAD_CONDITION, "curves, conditions or options are not those of rank 0")
            : HM_OK,
        system->comm, err);
}

#endif
