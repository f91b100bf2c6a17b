/* The gradient of hm_adjoint for the functions of a basis file, by the C interface alone:
 *
 *   adjoint_bits BASIS TABLE   the table has lines "point dJ/dx dJ/dy", points from 0
 *
 * Prints lines "index dJ/dx dJ/dy", counted from 1, with 17 digits. */
#include <harmorph.h>

#include <stdio.h>
#include <stdlib.h>

static int succeeds(hm_status status, const hm_error* error) {
    if (status < 0) fprintf(stderr, "%s\n", error->text);
    return status >= 0;
}

int main(int argc, char** argv) {
    const hm_basis* basis = NULL;
    hm_basis_info info = {0};
    hm_error error = {0};
    hm_points by = {0};
    double *block, *x, *y, *gradient, dx, dy;
    FILE* file = argc == 3 ? fopen(argv[1], "rb") : NULL;
    long bytes;
    int point, rows = 0, k;
    if (file == NULL || fseek(file, 0, SEEK_END) != 0) return 2;
    bytes = ftell(file);
    rewind(file);
    block = malloc((size_t)bytes); /* at a multiple of 8 bytes */
    if (fread(block, 1, (size_t)bytes, file) != (size_t)bytes) return 2;
    fclose(file);
    info.struct_size = sizeof info;
    if (!succeeds(hm_basis_attach(&basis, block, (size_t)bytes, NULL, &error), &error) ||
        !succeeds(hm_basis_info_get(basis, &info, &error), &error))
        return 1;
    x = calloc((size_t)info.points, sizeof *x);
    y = calloc((size_t)info.points, sizeof *y);
    gradient = calloc(2 * (size_t)info.functions, sizeof *gradient);
    file = fopen(argv[2], "r");
    if (file == NULL) return 2;
    while (fscanf(file, "%d %lf %lf", &point, &dx, &dy) == 3) {
        if (point < 0 || point >= info.points) return 2;
        x[point] = dx;
        y[point] = dy;
        ++rows;
    }
    fclose(file);
    by.x = x;
    by.y = y;
    by.stride = 1;
    if (rows == 0 || !succeeds(hm_adjoint(basis, &by, gradient, NULL, &error), &error)) return 1;
    for (k = 0; k < info.functions; ++k)
        printf("%d %.17g %.17g\n", k + 1, gradient[2 * k], gradient[2 * k + 1]);
    free(gradient);
    free(y);
    free(x);
    free(block);
    return 0;
}
