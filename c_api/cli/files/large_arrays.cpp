#include "files/large_arrays.hpp"

#include "files/threads.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace cli {

void touch_pages(void* memory, std::size_t bytes, std::int32_t threads) {
    constexpr std::size_t page = 4096, large_page = std::size_t{1} << 21;
    const auto place = reinterpret_cast<std::uintptr_t>(memory);
    const std::size_t before = (large_page - place % large_page) % large_page;
    if (bytes < before + large_page) return;
    auto* const first = static_cast<char*>(memory) + before;
#ifdef MADV_HUGEPAGE
    // This is advice to the system: without such pages the program is slower, but works.
    madvise(first, (bytes - before) / large_page * large_page, MADV_HUGEPAGE);
#endif
    run_ranges((bytes - before) / page, threads,
               [first](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t k = begin; k < end; ++k)
                       *static_cast<volatile char*>(first + k * page) = 0;
               });
}

}  // namespace cli
