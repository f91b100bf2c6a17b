// The little of BLAS and LAPACK that is compared with, column-major.
#pragma once

#include <string>

namespace bench {

struct Blas {
    std::string (*name)();  // version and the kernels it chose for this processor
    void (*set_threads)(int threads);
    // c [m x n] = alpha op(a) op(b) + beta c; op(a) is m x k.
    void (*dgemm)(char trans_a, char trans_b, int m, int n, int k, double alpha, double const* a,
                  int lda, double const* b, int ldb, double beta, double* c, int ldc);
    // Lower triangle of c [n x n] = alpha a a^T + beta c, a [n x k].
    void (*dsyrk)(int n, int k, double alpha, double const* a, int lda, double beta, double* c,
                  int ldc);
    // b [m x n] = b op(a)^-1, a [n x n] lower.
    void (*dtrsm)(char trans_a, int m, int n, double const* a, int lda, double* b, int ldb);
    // Lower Cholesky factor of a [n x n] in place; not 0: not positive definite.
    int (*dpotrf)(int n, double* a, int lda);
};

Blas const& openblas();

}  // namespace bench
