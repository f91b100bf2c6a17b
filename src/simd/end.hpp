// Ends the code of one instruction set, which begin.hpp began.
#if defined(HARMORPH_TARGET)
#if defined(__clang__)
HARMORPH_PRAGMA(clang attribute pop)
#else
HARMORPH_PRAGMA(GCC pop_options)
#endif
#undef HARMORPH_PRAGMA
#undef HARMORPH_PRAGMA_TEXT
#undef HARMORPH_TARGET
#endif
#undef HARMORPH_INLINE
#undef HARMORPH_SET
