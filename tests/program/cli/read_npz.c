/* Reads a .npz file by the description of both formats, without the program that wrote it.
 *   read_npz FILE          checks all sums, and prints a line "NAME TYPE SIZE SIZE .." for each
 * array read_npz FILE NAME     prints the numbers of the array, one row a line */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static unsigned char* bytes;
static size_t size;

static void stop(const char* reason) {
    fprintf(stderr, "read_npz: %s\n", reason);
    exit(1);
}

static uint64_t number(size_t at, int n) {
    uint64_t value = 0;
    int k;
    if (at + (size_t)n > size) stop("the file is too short");
    for (k = 0; k < n; ++k) value |= (uint64_t)bytes[at + (size_t)k] << (8 * k);
    return value;
}

static uint32_t check_sum(size_t at, size_t n) { /* bit by bit */
    uint32_t sum = 0xffffffffu;
    size_t k;
    int bit;
    for (k = 0; k < n; ++k) {
        sum ^= bytes[at + k];
        for (bit = 0; bit < 8; ++bit) sum = (sum & 1) != 0 ? (sum >> 1) ^ 0xedb88320u : sum >> 1;
    }
    return ~sum;
}

static void print_values(const char* type, size_t at, uint64_t rows, uint64_t columns) {
    uint64_t row, column;
    for (row = 0; row < rows; ++row) {
        for (column = 0; column < columns; ++column) {
            uint64_t k = row * columns + column;
            if (strcmp(type, "<f8") == 0) {
                double value;
                memcpy(&value, bytes + at + 8 * k, 8);
                printf(" %.17g", value);
            } else {
                printf(" %ld",
                       type[1] == 'u' ? (long)bytes[at + k] : (long)(int32_t)number(at + 4 * k, 4));
            }
        }
        printf("\n");
    }
}

static void read_array(const char* name, size_t at, uint64_t n, const char* wanted) {
    char head[512], type[4] = "", *sizes, *rest;
    const uint64_t head_size = number(at + 8, 2) + 10;
    uint64_t shape[8], count = 1, width;
    int n_sizes = 0, k;
    if (memcmp(bytes + at, "\x93NUMPY\x01", 8) != 0 && bytes[at + 6] != 1) stop("no array");
    if (head_size >= sizeof head || head_size > n) stop("a long header");
    memcpy(head, bytes + at, head_size);
    head[head_size] = '\0';
    sizes = strstr(head + 10, "'shape': (");
    rest = strstr(head + 10, "'descr': '");
    if (sizes == NULL || rest == NULL || head[head_size - 1] != '\n') stop("no header");
    memcpy(type, rest + 10, 3);
    for (sizes += 10; *sizes != ')' && n_sizes < 8; ++sizes, ++n_sizes)
        shape[n_sizes] = strtoull(sizes, &sizes, 10);
    for (k = 0; k < n_sizes; ++k) count *= shape[k];
    width = type[2] == '8' ? 8 : type[2] == '4' ? 4 : 1;
    if (head_size + count * width != n) stop("the size is not that of the shape");
    if (wanted == NULL) {
        printf("%s %s", name, type);
        for (k = 0; k < n_sizes; ++k) printf(" %lu", (unsigned long)shape[k]);
        printf("\n");
    } else if (strcmp(name, wanted) == 0) {
        print_values(type, at + head_size, shape[0], shape[0] > 0 ? count / shape[0] : 0);
    }
}

int main(int argc, char** argv) {
    FILE* file = argc > 1 ? fopen(argv[1], "rb") : NULL;
    size_t place, end;
    uint64_t entries;
    if (file == NULL) stop("no file");
    fseek(file, 0, SEEK_END);
    size = (size_t)ftell(file);
    rewind(file);
    bytes = malloc(size + 1);
    if (bytes == NULL || fread(bytes, 1, size, file) != size) stop("cannot be read");
    if (size < 98 || number(size - 22, 4) != 0x06054b50u || number(size - 42, 4) != 0x07064b50u)
        stop("no end of a directory");
    end = (size_t)number(size - 34, 8);
    if (number(end, 4) != 0x06064b50u) stop("no end of a directory of 64 bits");
    entries = number(end + 24, 8);
    place = (size_t)number(end + 48, 8);
    if (place + number(end + 40, 8) != end) stop("the directory has another size");
    for (; entries > 0; --entries) {
        const size_t name_size = (size_t)number(place + 28, 2), extra = place + 46 + name_size,
                     at = (size_t)number(extra + 20, 8);
        const uint64_t n = number(extra + 4, 8);
        char name[256];
        size_t data = at + 30 + (size_t)number(at + 26, 2) + (size_t)number(at + 28, 2);
        if (number(place, 4) != 0x02014b50u || number(at, 4) != 0x04034b50u) stop("no entry");
        if (number(at + 14, 4) != number(place + 16, 4)) stop("two sums");
        if (number(at + 30 + name_size + 4, 8) != n) stop("two sizes");
        if (name_size < 5 || name_size > 255 || data + n > size) stop("no name, or no data");
        memcpy(name, bytes + place + 46, name_size);
        name[name_size - 4] = '\0'; /* without .npy */
        if (check_sum(data, (size_t)n) != number(place + 16, 4)) stop("another sum");
        read_array(name, data, n, argc > 2 ? argv[2] : NULL);
        place = extra + (size_t)number(place + 30, 2);
    }
    if (place != end) stop("the directory has another size");
    return 0;
}
