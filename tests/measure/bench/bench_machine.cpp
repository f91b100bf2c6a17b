// Measures the limits of this machine: bytes read per second by the wanted number of threads.
#include "clock.hpp"
#include "settings.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace bench {
namespace {

// One loop for each width of vectors, compiled for the processors that have it: GCC's vectors are
// split where they are wider than what the function is compiled for, so that templates and inlining
// would not do.
#define BENCH_LOOPS(name, target, bytes)                                                           \
    struct name {                                                                                  \
        typedef double Vector __attribute__((vector_size(bytes)));                                 \
        target static double read(double const* data, std::size_t n, std::size_t ahead) {          \
            Vector sum[8] = {};                                                                    \
            std::size_t const step = 8 * (bytes) / sizeof(double);                                 \
            for (std::size_t i = 0; i + step <= n; i += step) {                                    \
                for (std::size_t k = 0; k < step; k += 8)                                          \
                    __builtin_prefetch(data + i + k + ahead);                                      \
                for (std::size_t k = 0; k < 8; ++k)                                                \
                    sum[k] +=                                                                      \
                        *reinterpret_cast<Vector const*>(data + i + k * (bytes) / sizeof(double)); \
            }                                                                                      \
            double all = 0;                                                                        \
            for (Vector & s : sum) all += s[0];                                                    \
            return all;                                                                            \
        }                                                                                          \
    };

#if defined(__x86_64__)
BENCH_LOOPS(Avx512, __attribute__((target("avx512f"))), 64)
BENCH_LOOPS(Avx2, __attribute__((target("avx2,fma"))), 32)
#endif
BENCH_LOOPS(Plain, , 16)
#undef BENCH_LOOPS

struct Loops {
    char const* name;
    double (*read)(double const*, std::size_t, std::size_t);
};

template <class Set>
Loops loops_of(char const* name) {
    return {name, Set::read};
}

Loops widest() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f")) return loops_of<Avx512>("AVX-512");
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return loops_of<Avx2>("AVX2");
#endif
    return loops_of<Plain>("16-byte vectors");
}

double volatile sink;

// Each thread reads its part. data: aligned, so that whole vectors may be read.
void read_all(Loops const& loops, double const* data, std::size_t n, std::size_t ahead,
              Settings const& settings) {
    struct Job {
        Loops const& loops;
        double const* data;
        std::size_t part, ahead;
    };
    auto const read_part = [](void* context, std::int32_t index) {
        Job const& job = *static_cast<Job const*>(context);
        sink = job.loops.read(job.data + static_cast<std::size_t>(index) * job.part, job.part,
                              job.ahead);
    };
    Job job{loops, data, n / static_cast<std::size_t>(settings.threads) / 64 * 64, ahead};
    if (settings.executor->run == nullptr) read_part(&job, 0);
    else settings.executor->run(settings.executor->user, settings.threads, read_part, &job);
}

std::size_t const distances[] = {0, 128, 512, 1024};  // of prefetches

// [bytes/s], and the distance of prefetches that is the best for this processor.
double measure_reading(Loops const& loops, double const* data, std::size_t n,
                       Settings const& settings, std::size_t& distance) {
    double best = 0;
    for (std::size_t const ahead : distances) {
        double const speed = 1 / time_of([&] { read_all(loops, data, n, ahead, settings); });
        if (speed <= best) continue;
        best = speed;
        distance = ahead;
    }
    return 8.0 * static_cast<double>(n) * best;
}

double const* aligned(void const* data) {
    return reinterpret_cast<double const*>((reinterpret_cast<std::uintptr_t>(data) + 63) / 64 * 64);
}

// Far more than the last cache holds, and no more than a quarter of the memory. Virtual machines
// may tell of a cache that they share with others.
std::size_t bytes_in_no_cache() {
    double const mega = 1 << 20;
    double cache = 100 * mega, memory = 1024 * mega;
#if defined(_SC_LEVEL3_CACHE_SIZE)
    cache = std::max(cache, static_cast<double>(sysconf(_SC_LEVEL3_CACHE_SIZE)));
#endif
#if defined(_SC_PHYS_PAGES)
    memory =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
#endif
    return static_cast<std::size_t>(std::min(4 * cache, memory / 4));
}

}  // namespace

Limits measure_machine(Settings const& settings, Report& report) {
    say("machine");
    Limits limits;
    Loops const loops = widest();
    Table table{"The machine", {"what", "value", "unit"}, {}, {}};
    std::size_t const n = bytes_in_no_cache() / 8 / 1024 * 1024;
    std::vector<double> memory(n + 1024, 1.0);
    double* const data = memory.data() + (aligned(memory.data()) - memory.data());
    std::size_t distance = 0;
    limits.read = measure_reading(loops, data, n, settings, distance);
    limits.read_once = [loops, distance, &settings](void const* from, std::size_t bytes) {
        read_all(loops, aligned(from), bytes / 8 - 8, distance, settings);
    };
    std::string const threads =
        settings.threads == 1 ? "one thread" : std::to_string(settings.threads) + " threads";
    table.add(
        {"reading " + std::to_string(n >> 17) + " MiB, " + threads + ", best of four prefetches",
         {1e-9 * limits.read, "%.1f"},
         "GB/s"});
    report.finish(table);
    return limits;
}

}  // namespace bench
