/* make_plot3d N M TEXT BINARY: an O-grid of N by M cells round a circle, as PLOT3D in text and as
 * Fortran's unformatted records of 4 bytes, for tests/bench/files.sh. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

static int round_points, outwards;

static double coordinate(int d, int i, int j) {
    double const r = exp(log(20) * j / outwards),
                 t = 8 * atan(1) * (i % round_points) / round_points;
    return d == 0 ? r * cos(t) : d == 1 ? r * sin(t) : 0;
}

static void record(FILE* file, const void* data, uint32_t bytes) {
    fwrite(&bytes, sizeof bytes, 1, file);
    fwrite(data, 1, bytes, file);
    fwrite(&bytes, sizeof bytes, 1, file);
}

int main(int argc, char** argv) {
    if (argc != 5) return 2;
    round_points = atoi(argv[1]);
    outwards = atoi(argv[2]);
    FILE *const text = fopen(argv[3], "w"), *const binary = fopen(argv[4], "wb");
    int32_t const blocks = 1, size[2] = {round_points + 1, outwards + 1};
    size_t const n = (size_t)size[0] * (size_t)size[1];
    double* const all = malloc(2 * n * sizeof *all);
    if (text == NULL || binary == NULL || all == NULL) return 1;
    fprintf(text, "1\n%d %d 1\n", (int)size[0], (int)size[1]);
    for (int d = 0; d < 3; ++d) {
        for (int j = 0; j <= outwards; ++j) {
            for (int i = 0; i <= round_points; ++i) {
                double const value = coordinate(d, i, j);
                fprintf(text, "%.16e\n", value);
                if (d < 2) all[(size_t)d * n + (size_t)j * (size_t)size[0] + (size_t)i] = value;
            }
        }
    }
    record(binary, &blocks, sizeof blocks);
    record(binary, size, sizeof size);
    record(binary, all, (uint32_t)(2 * n * sizeof *all));
    return fclose(text) != 0 || fclose(binary) != 0;
}
