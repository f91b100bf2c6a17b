/* Memory for the blocks of harmorph in huge pages, where the system has them (hm_huge_pages):
 *
 *     void *block = hm_pages_alloc(bytes);
 *     hm_basis_init(&basis, block, bytes, analysis, &error);
 *     ...
 *     hm_pages_free(block);
 *
 * The blocks of large meshes begin at a multiple of 2 MiB, so that all of their pages but the last one are huge. */
#ifndef HARMORPH_PAGES_H
#define HARMORPH_PAGES_H

#include "harmorph.h"

#include <stdlib.h>

/* NULL where malloc gives NULL, or bytes are close to SIZE_MAX. Not filled: pages that are not touched take no
 * memory. */
static inline void *hm_pages_alloc(size_t bytes) {
    const size_t huge = (size_t)1 << 21, alignment = bytes < huge ? 64 : huge, more = alignment + sizeof(void *);
    char *memory = bytes > (size_t)-1 - more ? NULL : (char *)malloc(bytes + more);
    char *block = NULL;
    if (memory == NULL) return NULL;
    block = memory + sizeof(void *);
    block += (alignment - (uintptr_t)block % alignment) % alignment;
    ((void **)(void *)block)[-1] = memory;
    hm_huge_pages(block, bytes);
    return block;
}

static inline void hm_pages_free(void *block) {
    if (block != NULL) free(((void **)block)[-1]);
}

#endif
