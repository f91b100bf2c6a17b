// Calls the function of the kernel that was chosen: the same name in one namespace for each kind of processor.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__)
#define HARMORPH_FOR_EACH_KERNEL(declare) declare(baseline) declare(avx2) declare(avx512)
#define HARMORPH_CALL(kernel, ...)                       \
    switch (kernel) {                                    \
        case Kernel::avx512: return avx512::__VA_ARGS__; \
        case Kernel::avx2: return avx2::__VA_ARGS__;     \
        default: return baseline::__VA_ARGS__;           \
    }
#else
#define HARMORPH_FOR_EACH_KERNEL(declare) declare(baseline)
#define HARMORPH_CALL(kernel, ...) \
    static_cast<void>(kernel);     \
    return baseline::__VA_ARGS__;
#endif
