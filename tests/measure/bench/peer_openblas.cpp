#include "blas.hpp"

// By their Fortran names, so that no header of a certain BLAS decides.
extern "C" {
void dgemm_(char const*, char const*, int const*, int const*, int const*, double const*,
            double const*, int const*, double const*, int const*, double const*, double*,
            int const*);
void dsyrk_(char const*, char const*, int const*, int const*, double const*, double const*,
            int const*, double const*, double*, int const*);
void dtrsm_(char const*, char const*, char const*, char const*, int const*, int const*,
            double const*, double const*, int const*, double*, int const*);
void dpotrf_(char const*, int const*, double*, int const*, int*);
char* openblas_get_config(void);
char* openblas_get_corename(void);
void openblas_set_num_threads(int);
}

namespace bench {
namespace {

std::string name() {
    std::string const config = openblas_get_config();  // "OpenBLAS 0.3.21 ..."
    return config.substr(0, config.find(' ', config.find(' ') + 1)) + ", kernels for " +
           openblas_get_corename();
}

void dgemm(char trans_a, char trans_b, int m, int n, int k, double alpha, double const* a, int lda,
           double const* b, int ldb, double beta, double* c, int ldc) {
    dgemm_(&trans_a, &trans_b, &m, &n, &k, &alpha, a, &lda, b, &ldb, &beta, c, &ldc);
}

void dsyrk(int n, int k, double alpha, double const* a, int lda, double beta, double* c, int ldc) {
    dsyrk_("L", "N", &n, &k, &alpha, a, &lda, &beta, c, &ldc);
}

void dtrsm(char trans_a, int m, int n, double const* a, int lda, double* b, int ldb) {
    double const one = 1;
    dtrsm_("R", "L", &trans_a, "N", &m, &n, &one, a, &lda, b, &ldb);
}

int dpotrf(int n, double* a, int lda) {
    int info = 0;
    dpotrf_("L", &n, a, &lda, &info);
    return info;
}

}  // namespace

Blas const& openblas() {
    static Blas const table = {name, openblas_set_num_threads, dgemm, dsyrk, dtrsm, dpotrf};
    return table;
}

}  // namespace bench
