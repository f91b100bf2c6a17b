/* Huge pages (2 MiB) for the blocks of harmorph. Where a basis does not fit into the caches of the
 * processor, reading the basis takes .55 to .9 of the time in huge pages that it takes in pages of
 * 4 KiB.
 * The memory is the caller's:
 *
 *     hm_memory need = {NULL, 0};
 *     hm_basis_init(&basis, &need, analysis, &error);
 *     void* room = malloc(hm_pages_room(need.bytes));
 *     need.block = hm_pages_place(room, need.bytes);
 *     hm_basis_init(&basis, &need, analysis, &error);
 *     ...
 *     free(room);
 *
 * Only whole multiples of 2 MiB inside a block can be huge pages, and only in memory that has not
 * been written yet. The library itself makes no system calls; hm_pages_ask does, on Linux. */
#ifndef HARMORPH_PAGES_H
#define HARMORPH_PAGES_H

#include <stddef.h>
#include <stdint.h>

#if defined(__linux__)
#include <sys/mman.h>
#if !defined(MADV_HUGEPAGE) && !defined(__cplusplus)
/* <sys/mman.h> hides the call where the language is strict C. */
extern int madvise(void* address, size_t bytes, int advice);
#endif
#endif

/* The alignment of a block of so many bytes: 2 MiB if the block can contain a huge page, otherwise
 * 64. */
static inline size_t hm_pages_alignment(size_t bytes) {
    return bytes < (size_t)1 << 21 ? 64 : (size_t)1 << 21;
}

/* The size of memory that has room for an aligned block of `bytes`, wherever the memory begins;
 * SIZE_MAX, which no allocator gives, if the sum exceeds the range of size_t. */
static inline size_t hm_pages_room(size_t bytes) {
    const size_t more = hm_pages_alignment(bytes) - 1;
    return bytes > SIZE_MAX - more ? SIZE_MAX : bytes + more;
}

/* Asks the system for huge pages in block [bytes]; the contents of the block do not change. Returns
 * the number of bytes in huge pages inside the block; 0 if there is none, if the system refuses,
 * and on systems other than Linux. */
static inline size_t hm_pages_ask(void* block, size_t bytes) {
    const size_t huge = (size_t)1 << 21, before = (huge - (size_t)((uintptr_t)block % huge)) % huge;
    const size_t pages = block == NULL || bytes < before ? 0 : (bytes - before) / huge;
    if (pages == 0 || bytes > SIZE_MAX - (uintptr_t)block) return 0;
#if defined(__linux__)
    return madvise((char*)block + before, pages * huge, 14 /* MADV_HUGEPAGE */) == 0 ? pages * huge
                                                                                     : 0;
#else
    return 0;
#endif
}

/* The aligned block of `bytes` inside memory [hm_pages_room(bytes)], in huge pages where the system
 * gives them. NULL if memory is NULL. */
static inline void* hm_pages_place(void* memory, size_t bytes) {
    const size_t alignment = hm_pages_alignment(bytes);
    char* block = (char*)memory;
    if (memory == NULL) return NULL;
    block += (alignment - (size_t)((uintptr_t)memory % alignment)) % alignment;
    hm_pages_ask(block, bytes);
    return block;
}

#endif
