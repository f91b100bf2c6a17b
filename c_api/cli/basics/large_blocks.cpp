// Large arrays of the program lie in pages of two megabytes where Linux has such pages: a million
// points otherwise cost tens of thousands of page faults, a quarter of the time of reading and
// writing a mesh. Smaller blocks come from malloc, as without this file.
#ifdef __linux__
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <sys/mman.h>

#ifdef MADV_HUGEPAGE
namespace cli {

namespace {

void* large_block(std::size_t bytes) {
    constexpr std::size_t page = std::size_t{1} << 21, few_pages = 2 * page;
    if (bytes < few_pages || bytes > SIZE_MAX - page) return std::malloc(bytes > 0 ? bytes : 1);
    void* const block = std::aligned_alloc(page, (bytes + page - 1) / page * page);
    if (block) madvise(block, bytes, MADV_HUGEPAGE);  // a wish only
    return block;
}

}  // namespace

}  // namespace cli

void* operator new(std::size_t bytes) {
    if (void* const block = cli::large_block(bytes)) return block;
    throw std::bad_alloc();
}
// Compilers that put these in line take free() for a mistake.
[[gnu::noinline]] void operator delete(void* block) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { std::free(block); }
#endif
#endif
