/* The calls of harmorph_mpi.h. This file includes the other files of this folder: compile this file
 * alone. */
#include "harmorph_mpi.h"
#include "private.h"

#include "mpi/agreement.h"
#include "mpi/lengths.h"
#include "mpi/gathering.h"
#include "mpi/rows.h"
#include "mpi/whole_fields.h"

/* ---- Functions ---- */

/* Says how many bytes the rows of each process take. */
static hm_status count_rows(hm_memory* memory, const hm_analysis* analysis, int32_t n,
                            MPI_Comm comm, hm_error* err) {
    hm_basis* none = NULL;
    void* block = NULL;
    size_t bytes = 0;
    hm_status status = refuse_other_version(err);
    if (status >= 0) status = make_share(&none, &block, analysis, 0, 0, err);
    if (status >= 0) status = hm_private_extract_size(none, n, &bytes, err);
    free(block);
    status = agree(status, comm, err);
    if (status >= 0) memory->bytes = bytes;
    return status;
}

hm_status hm_mpi_solve(hm_basis** rows, hm_memory* memory, hm_plan* plan,
                       const hm_analysis* analysis, int32_t n, const int32_t* points,
                       hm_solve_report* report, MPI_Comm comm, hm_error* err) {
    row_exchange exchange;
    hm_error warning;
    hm_status status, solved;
    BEGIN_CALL(comm, err);
    status = agree_on_query(memory, comm, err);
    if (status < 0) return status;
    if (asks(memory)) return count_rows(memory, analysis, n, comm, err);
    status = begin(&exchange, comm, err);
    if (status >= 0) status = refuse_other_version(err);
    if (status >= 0 && (rows == NULL || memory == NULL || memory->block == NULL || plan == NULL ||
                        analysis == NULL || n < 0 || (n > 0 && points == NULL))) {
        status = refuse_argument(err,
                                 "rows, the block, plan, analysis or points is NULL, as where an "
                                 "earlier call has failed, or n is negative");
    }
    if (status >= 0) status = solve_share(&exchange, plan, analysis, report, err);
    solved = status;
    warning = *err;
    if (status >= 0) {
        status = hm_private_extract_init(&exchange.rows, memory->block, memory->bytes,
                                         exchange.share, n, points, err);
    }
    if (status >= 0) {
        status = solved;
        *err = warning;
    }
    status = solved = agree(status, comm, err);
    warning = *err;
    if (status >= 0) status = exchange_rows(&exchange, n, points, err);
    end(&exchange);
    if (status < 0) return status;
    *rows = exchange.rows;
    *err = warning;
    return solved;
}

/* ---- Adjoint ---- */

/* Takes memory for the sums [*n] of the rows of this process, and finds the scale. */
static hm_status begin_sums(const hm_basis* rows, const hm_points* dj, const double* gradient,
                            const hm_executor* executor, int64_t** sums, int32_t* n, int32_t* scale,
                            hm_error* err) {
    hm_basis_info info = {sizeof info};
    hm_status status = refuse_other_version(err);
    if (status >= 0) status = hm_basis_info_get(rows, &info, err);
    if (status < 0) return status;
    if (gradient == NULL) return refuse_argument(err, "gradient is NULL");
    *n = 4 * info.numbers_per_value * info.functions;
    *sums = room_for((size_t)*n, sizeof **sums);
    if (*sums == NULL)
        return refuse_argument(err, "there is no memory for the sums of the adjoint");
    return hm_private_adjoint_scale(rows, dj, scale, executor, err);
}

hm_status hm_mpi_adjoint(const hm_basis* rows, const hm_points* dj, double* gradient,
                         const hm_executor* executor, MPI_Comm comm, hm_error* err) {
    int64_t *sums = NULL, length;
    int32_t n = 0, own[4], of_all[4]; /* scale, minus status, n and -n, for MPI_MAX */
    hm_status status;
    BEGIN_CALL(comm, err);
    own[0] = 0;
    status = begin_sums(rows, dj, gradient, executor, &sums, &n, &own[0], err);
    if (status < 0) own[0] = INT32_MIN;
    own[1] = -status;
    own[2] = n;
    own[3] = -n;
    MPI_Allreduce(own, of_all, 4, MPI_INT32_T, MPI_MAX, comm);
    if (of_all[1] > 0) { /* only now are there messages for the reason */
        status = agree(status, comm, err);
    } else if (of_all[2] != -of_all[3]) {
        length = n;
        if (differs_from_first(&length, 1, comm))
            status =
                refuse(err, HM_BAD_BASIS, "the rows have other functions than those of rank 0");
        status = agree(status, comm, err);
    }
    if (status >= 0) {
        status = hm_private_adjoint_sums(rows, dj, of_all[0], sums, executor, err);
        MPI_Allreduce(MPI_IN_PLACE, sums, n, MPI_INT64_T, MPI_SUM, comm);
        if (status >= 0) status = hm_private_adjoint_finish(rows, of_all[0], sums, gradient, err);
    }
    free(sums);
    return status;
}

/* ---- Given displacements ---- */

hm_status hm_mpi_displace(hm_plan* plan, int32_t n_wall, const int32_t* wall_points,
                          int32_t n_fields, const hm_points* wall, int32_t n, const int32_t* points,
                          const hm_points* from, const hm_points_out* to, int32_t root,
                          MPI_Comm comm, hm_error* err) {
    whole_fields whole;
    const char* wrong = NULL;
    int32_t field;
    int64_t k;
    hm_status status;
    memset(&whole, 0, sizeof whole);
    BEGIN_CALL(comm, err);
    if (lacks_arrays(wall, n_fields, n_wall) || lacks_arrays_out(to, n_fields, n) ||
        (from != NULL && lacks_arrays(from, 1, n))) {
        wrong = no_array;
    } else if (has_infinite(wall, n_fields, n_wall) || (from != NULL && has_infinite(from, 1, n))) {
        wrong = "a displacement or a coordinate is not finite";
    }
    status = begin_whole(&whole, plan, n_wall, wall_points, n_fields, wrong, n, points,
                         from != NULL, root, comm, err);
    if (status < 0) {
        free_whole(&whole);
        return status;
    }
    for (field = 0; field < n_fields; ++field) {
        gather_field(&whole.wall, &wall[field]);
        if (!is_root(&whole)) continue;
        memcpy(field_of(whole.at_wall, whole.wall.lists.total, field), whole.wall.all,
               2 * (size_t)whole.wall.lists.total * sizeof(double));
    }
    if (from != NULL) gather_field(&whole.mesh, from);
    if (is_root(&whole)) {
        hm_points start = {whole.from, whole.from + 1, 2};
        for (k = 0; from != NULL && k < whole.mesh.lists.total; ++k) {
            memcpy(whole.from + 2 * (whole.mesh.points[k] - whole.index_base),
                   whole.mesh.all + 2 * k, 2 * sizeof(double));
        }
        for (field = 0; field < n_fields; ++field) {
            double* const given_here = field_of(whole.at_wall, whole.wall.lists.total, field);
            double* const result = field_of(whole.at_points, whole.n_points, field);
            whole.in[field] = (hm_points){given_here, given_here + 1, 2};
            whole.out[field] = (hm_points_out){result, result + 1, 2};
        }
        status =
            hm_displace(plan, (int32_t)whole.wall.lists.total, whole.wall.points, n_fields,
                        whole.in, from != NULL ? &start : NULL, whole.out, &whole.work, NULL, err);
    }
    status = agree(status, comm, err);
    for (field = 0; status >= 0 && field < n_fields; ++field) {
        for (k = 0; is_root(&whole) && k < whole.mesh.lists.total; ++k) {
            memcpy(whole.mesh.all + 2 * k,
                   field_of(whole.at_points, whole.n_points, field) +
                       2 * (whole.mesh.points[k] - whole.index_base),
                   2 * sizeof(double));
        }
        scatter_field(&whole.mesh, &to[field]);
    }
    free_whole(&whole);
    return status;
}

hm_status hm_mpi_displace_adjoint(hm_plan* plan, int32_t n_wall, const int32_t* wall_points,
                                  int32_t n_fields, const hm_points* dj, int32_t n,
                                  const int32_t* points, const hm_points_out* gradient,
                                  int32_t root, MPI_Comm comm, hm_error* err) {
    whole_fields whole;
    const int lacks = lacks_arrays(dj, n_fields, n) || lacks_arrays_out(gradient, n_fields, n_wall);
    int32_t field;
    int64_t k;
    hm_status status;
    memset(&whole, 0, sizeof whole);
    BEGIN_CALL(comm, err);
    status = begin_whole(&whole, plan, n_wall, wall_points, n_fields, lacks ? no_array : NULL, n,
                         points, 0, root, comm, err);
    if (status < 0) {
        free_whole(&whole);
        return status;
    }
    for (field = 0; field < n_fields; ++field) {
        gather_field(&whole.mesh, &dj[field]);
        for (k = 0; is_root(&whole) && k < whole.mesh.lists.total; ++k) {
            double* const at = field_of(whole.at_points, whole.n_points, field) +
                               2 * (whole.mesh.points[k] - whole.index_base);
            at[0] += whole.mesh.all[2 * k];
            at[1] += whole.mesh.all[2 * k + 1];
        }
    }
    if (is_root(&whole)) {
        for (field = 0; field < n_fields; ++field) {
            double* const by_points = field_of(whole.at_points, whole.n_points, field);
            double* const result = field_of(whole.at_wall, whole.wall.lists.total, field);
            whole.in[field] = (hm_points){by_points, by_points + 1, 2};
            whole.out[field] = (hm_points_out){result, result + 1, 2};
        }
        status = hm_displace_adjoint(plan, (int32_t)whole.wall.lists.total, whole.wall.points,
                                     n_fields, whole.in, whole.out, &whole.work, NULL, err);
    }
    status = agree(status, comm, err);
    for (field = 0; status >= 0 && field < n_fields; ++field) {
        if (is_root(&whole)) {
            memcpy(whole.wall.all, field_of(whole.at_wall, whole.wall.lists.total, field),
                   2 * (size_t)whole.wall.lists.total * sizeof(double));
        }
        scatter_field(&whole.wall, &gradient[field]);
    }
    free_whole(&whole);
    return status;
}

/* ---- Fortran ---- */

hm_status hm_mpi_solve_f(hm_basis** rows, hm_memory* memory, hm_plan* plan,
                         const hm_analysis* analysis, int32_t n, const int32_t* points,
                         hm_solve_report* report, MPI_Fint comm, hm_error* err) {
    return hm_mpi_solve(rows, memory, plan, analysis, n, points, report, MPI_Comm_f2c(comm), err);
}

hm_status hm_mpi_adjoint_f(const hm_basis* rows, const hm_points* dj, double* gradient,
                           const hm_executor* executor, MPI_Fint comm, hm_error* err) {
    return hm_mpi_adjoint(rows, dj, gradient, executor, MPI_Comm_f2c(comm), err);
}

hm_status hm_mpi_displace_f(hm_plan* plan, int32_t n_wall, const int32_t* wall_points,
                            int32_t n_fields, const hm_points* wall, int32_t n,
                            const int32_t* points, const hm_points* from, const hm_points_out* to,
                            int32_t root, MPI_Fint comm, hm_error* err) {
    return hm_mpi_displace(plan, n_wall, wall_points, n_fields, wall, n, points, from, to, root,
                           MPI_Comm_f2c(comm), err);
}

hm_status hm_mpi_displace_adjoint_f(hm_plan* plan, int32_t n_wall, const int32_t* wall_points,
                                    int32_t n_fields, const hm_points* dj, int32_t n,
                                    const int32_t* points, const hm_points_out* gradient,
                                    int32_t root, MPI_Fint comm, hm_error* err) {
    return hm_mpi_displace_adjoint(plan, n_wall, wall_points, n_fields, dj, n, points, gradient,
                                   root, MPI_Comm_f2c(comm), err);
}
