/* Size queries of the C interface: hm_plan_init(NULL, emptied(&memory), analysis, &error). */
#ifndef HARMORPH_TESTS_MEMORY_H
#define HARMORPH_TESTS_MEMORY_H

#include <harmorph.h>

static hm_memory* emptied(hm_memory* memory) {
    memory->block = NULL;
    memory->bytes = 0;
    return memory;
}

#endif
