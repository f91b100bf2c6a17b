// What the WebAssembly module contains besides the library: the four functions of memory that the
// library calls, and a table of the constants and structs of the headers, by which JavaScript finds
// the members of structs. BUILD/web/headers.inc includes the headers, and BUILD/web/layout.inc is
// made from them by layout.awk.
#include <stddef.h>

#include "headers.inc"

// The option -mbulk-memory makes each of the first three one instruction. Addresses that may be
// null are copied from and to with a size of 0 only.
extern "C" {

void* memcpy(void* to, const void* from, size_t n) { return __builtin_memcpy(to, from, n); }

void* memmove(void* to, const void* from, size_t n) { return __builtin_memmove(to, from, n); }

void* memset(void* to, int value, size_t n) { return __builtin_memset(to, value, n); }

int memcmp(const void* a, const void* b, size_t n) {
    const unsigned char* left = static_cast<const unsigned char*>(a);
    const unsigned char* right = static_cast<const unsigned char*>(b);
    for (size_t k = 0; k < n; ++k)
        if (left[k] != right[k]) return left[k] < right[k] ? -1 : 1;
    return 0;
}

// A constant has the type "constant" and its value; a struct the type "struct" and its size in
// bytes. The members of a struct follow it: the type is a word of table.awk or the name of another
// struct, `value` the offset in bytes, `count` the length of an array. A null name ends the table.
typedef struct hm_web_entry {
    const char *name, *type;
    int32_t value, count;
} hm_web_entry;

static const hm_web_entry layout[] = {
#include "layout.inc"
    {nullptr, nullptr, 0, 0}};

HM_API const hm_web_entry* hm_web_layout(void);
const hm_web_entry* hm_web_layout(void) { return layout; }
}
