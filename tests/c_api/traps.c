/* Linked into a test program: the processor traps floating-point exceptions from the program's
 * beginning on. */
#define _GNU_SOURCE
#include <fenv.h>

#ifdef __GLIBC__
__attribute__((constructor)) static void trap(void) {
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
}
#endif
