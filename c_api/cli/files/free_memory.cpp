#include "files/free_memory.hpp"

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

}  // namespace cli
