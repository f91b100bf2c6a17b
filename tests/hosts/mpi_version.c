/* With a module that was compiled for another version than that of the library: the calls that need
 * private calls of the library are refused on all processes, with both versions in the text. */
#include <harmorph_mpi.h>

#include <stdio.h>
#include <string.h>

static int passed, failed;

static void check(hm_status status, const hm_error* error, const char* call) {
    if (status == HM_UNSUPPORTED && strstr(error->text, HM_VERSION) != NULL &&
        strstr(error->text, hm_version()) != NULL) {
        ++passed;
    } else {
        ++failed;
        printf("mpi_version.c: %s: %s: %s\n", call, hm_status_name(status), error->text);
    }
}

int main(int argc, char** argv) {
    hm_error error = {0};
    hm_memory memory = {NULL, 0};
    MPI_Init(&argc, &argv);
    check(hm_mpi_solve(NULL, &memory, NULL, NULL, 0, NULL, NULL, MPI_COMM_WORLD, &error), &error,
          "the size query of hm_mpi_solve");
    memory.bytes = 1;
    check(hm_mpi_solve(NULL, &memory, NULL, NULL, 0, NULL, NULL, MPI_COMM_WORLD, &error), &error,
          "hm_mpi_solve");
    check(hm_mpi_adjoint(NULL, NULL, NULL, NULL, MPI_COMM_WORLD, &error), &error, "hm_mpi_adjoint");
    printf("%d passed, %d failed\n", passed, failed);
    MPI_Finalize();
    return failed > 0;
}
