#include "files/memory.hpp"

#include "basics/numbers.hpp"
#include "basics/text.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

#include "files/threads.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace cli {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

// Returns the number that follows a name in a file, or the first number of the file if the name is
// empty; infinity if there is no such number.
double number_in(const char* path, const std::string& name) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (line.compare(0, name.size(), name) != 0) continue;
        double number = 0;
        const std::string_view rest = trimmed(std::string_view(line).substr(name.size()));
        return parse_front(rest, number) > 0 ? number : unlimited;
    }
    return unlimited;
}

double rest_of_address_space() {
#ifdef __linux__
    rlimit limit = {};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
    const double pages = number_in("/proc/self/statm", "");
    const double taken = pages * static_cast<double>(sysconf(_SC_PAGESIZE));
    return std::max(0.0, static_cast<double>(limit.rlim_cur) - taken);
#else
    return unlimited;
#endif
}

}  // namespace

double free_memory() {
    return std::min({1024 * number_in("/proc/meminfo", "MemAvailable:"),
                     number_in("/sys/fs/cgroup/memory.max", ""), rest_of_address_space()});
}

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
