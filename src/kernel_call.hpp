// Calls the function of the kernel that was chosen: the same name in one namespace for each kind of processor.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__)
#define HARMORPH_FOR_EACH_KERNEL(declare) declare(baseline) declare(avx2) declare(avx512)
#define HARMORPH_CALL(kernel, call)               \
    switch (kernel) {                             \
        case Kernel::avx512: return avx512::call; \
        case Kernel::avx2: return avx2::call;     \
        default: return baseline::call;           \
    }
#else
#define HARMORPH_FOR_EACH_KERNEL(declare) declare(baseline)
#define HARMORPH_CALL(kernel, call) \
    static_cast<void>(kernel);      \
    return baseline::call;
#endif
