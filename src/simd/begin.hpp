// Begins the code of one instruction set. The header of the set has defined HARMORPH_SET, the name
// in enum Kernel, and HARMORPH_TARGET, the compiler's target options, if the set needs any. All
// functions between this file and end.hpp are compiled for the set, in a namespace of the same
// name, because the linker keeps one copy of an inline function: if it kept a copy compiled for
// this set, a processor without the set might run it. For the same reason all shared headers are
// included before this file.
#define HARMORPH_INLINE inline __attribute__((always_inline))

#if defined(HARMORPH_TARGET)
#define HARMORPH_PRAGMA_TEXT(text) _Pragma(#text)
#define HARMORPH_PRAGMA(text) HARMORPH_PRAGMA_TEXT(text)
#if defined(__clang__)
HARMORPH_PRAGMA(clang attribute push(__attribute__((target(HARMORPH_TARGET))), apply_to = function))
#else
HARMORPH_PRAGMA(GCC push_options)
HARMORPH_PRAGMA(GCC target(HARMORPH_TARGET))
#endif
#endif
