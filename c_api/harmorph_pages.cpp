// The C interface: huge pages. One system call, without the C library.
#include "harmorph.h"

#include <cstdint>

namespace {

constexpr std::uintptr_t huge_page = std::uintptr_t{1} << 21;

// madvise(2) with MADV_HUGEPAGE; true where the system agrees.
bool advise(std::uintptr_t start, std::uintptr_t bytes) noexcept {
    constexpr long use_huge_pages = 14;
#if defined(__linux__) && defined(__x86_64__) && defined(__LP64__) && defined(__GNUC__)
    long result = 28;
    __asm__ volatile("syscall" : "+a"(result) : "D"(start), "S"(bytes), "d"(use_huge_pages) : "rcx", "r11", "memory");
    return result == 0;
#elif defined(__linux__) && defined(__aarch64__) && defined(__LP64__) && defined(__GNUC__)
    register long call __asm__("x8") = 233;
    register long result __asm__("x0") = static_cast<long>(start);
    register long length __asm__("x1") = static_cast<long>(bytes);
    register long advice __asm__("x2") = use_huge_pages;
    __asm__ volatile("svc 0" : "+r"(result) : "r"(call), "r"(length), "r"(advice) : "memory");
    return result == 0;
#else
    return start + bytes + use_huge_pages == 0;
#endif
}

}  // namespace

extern "C" {

size_t hm_huge_pages(void* block, size_t bytes) {
    std::uintptr_t const begin = reinterpret_cast<std::uintptr_t>(block);
    if (block == nullptr || bytes < huge_page || bytes > UINTPTR_MAX - begin) return 0;
    std::uintptr_t const start = (begin + (huge_page - 1)) / huge_page * huge_page;
    std::uintptr_t const end = (begin + bytes) / huge_page * huge_page;
    if (end <= start || !advise(start, end - start)) return 0;
    return end - start;
}

}  // extern "C"
