/* The C side of layout.f90. layout_c.inc, which run.sh makes from the headers, has a case for
 * each struct with the size of the struct and the offsets of all members, and case 0 with the
 * values of the constants. */
#include <harmorph.h>
#include <harmorph_bases.h>
#include <harmorph_design.h>
#include <harmorph_fields.h>
#include <harmorph_space.h>
#include <harmorph_study.h>
#include <harmorph_quality.h>

int32_t layout_of(int32_t number, int64_t* numbers);

#define PUT(value) numbers[n++] = (int64_t)(value)

int32_t layout_of(int32_t number, int64_t* numbers) {
    int32_t n = 0;
    switch (number) {
#include "layout_c.inc"
    }
    return n;
}
