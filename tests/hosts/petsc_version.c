/* With a module that was compiled for another version than that of the library: hm_petsc_create is
 * refused on all processes, with both versions in the text, and makes no system. */
#include <harmorph_petsc.h>
#include <petscsys.h>

#include <stdio.h>
#include <string.h>

int main(int argc, char** argv) {
    hm_part_mesh part = {sizeof part};
    hm_problem problem = {sizeof problem};
    hm_error error = {0};
    hm_petsc* system = NULL;
    hm_status status;
    int refused;
    PetscInitialize(&argc, &argv, NULL, NULL);
    status = hm_petsc_create(&system, &part, &problem, NULL, PETSC_COMM_WORLD, &error);
    refused = status == HM_UNSUPPORTED && system == NULL &&
              strstr(error.text, HM_VERSION) != NULL && strstr(error.text, hm_version()) != NULL;
    if (!refused) printf("petsc_version.c: %s: %s\n", hm_status_name(status), error.text);
    printf("%d passed, %d failed\n", refused, !refused);
    PetscFinalize();
    return !refused;
}
