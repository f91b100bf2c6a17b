// The settings of the command line, and the parts of the benchmark.
#pragma once

#include "report.hpp"

#include <harmorph.h>

#include <functional>

namespace bench {

struct Settings {
    std::vector<std::int32_t> sizes{10000, 100000, 1000000};
    std::vector<std::string> kinds{"iso", "viscous", "unstructured"};
    std::vector<std::int32_t> functions{20, 60};
    std::vector<std::string> parts{"solve", "morph"};
    int threads = 1;                        // of both sides
    hm_executor const* executor = nullptr;  // with as many
    int kernel = 0;                         // HM_KERNEL_...
    int repeats = 0;                        // of the solves; 0: by size
    int gibibytes = 0;  // into which the largest mesh is to fit (part memory); 0: not asked

    bool has(std::string const& part) const {
        for (std::string const& wanted : parts)
            if (wanted == part) return true;
        return false;
    }
};

// Bytes read per second: what the other parts are measured against.
struct Limits {
    double read = 0;  // [bytes/s] of all threads over an array that fits in no cache
    std::function<void(void const* data, std::size_t bytes)>
        read_once;  // by these threads, for other data
};

Limits measure_machine(Settings const& settings, Report& report);
void bench_solve(Settings const& settings, Report& report);
void bench_threads(Settings const& settings, Report& report);
void bench_iterative(Settings const& settings, Report& report);
void bench_iterations(Settings const& settings, Report& report);
void bench_memory(Settings const& settings, Report& report);
void bench_displace(Settings const& settings, Report& report);
void bench_safe(Settings const& settings, Report& report);
void bench_morph(Settings const& settings, Limits const& limits, Report& report);

}  // namespace bench
