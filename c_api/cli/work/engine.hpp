// Options of all commands that solve: the engine, the kernel, and the record of the iterations.
#pragma once

#include "basics/library.hpp"
#include "options/arguments.hpp"

#include <harmorph_study.h>

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace cli {

// The choice of the engine by the memory and the time that a problem will need.

constexpr double unlimited_memory = std::numeric_limits<double>::infinity();

struct EngineKind {
    std::string name;
    std::int32_t engine;  // hm_options.engine
};

// Engines in the order in which they are tried, and the memory that they may take. The task of a
// saved basis has no kinds: such a task keeps the engine of its options.
struct EngineChoice {
    std::vector<EngineKind> kinds;     // more than one: --engine auto
    double memory = unlimited_memory;  // [bytes]
    bool is_asked = false;             // the limit is that of --memory
};

EngineChoice engine_choice_of(const Arguments& arguments);

// The memory of analysis, plan and functions; or of the analysis alone, if that exceeds the limit.
struct MemoryNeed {
    double bytes = 0;
    bool is_of_all = true;
};

// Calls try_kind(kind, limit in bytes) for one kind after the other, until the bytes that it
// returns fit; the last call is for the kind that is taken. try_kind returns nothing if the engine
// cannot solve the problem. Returns the sentence that gives the reason. Where no kind fits, a limit
// that was asked for is refused; otherwise the smallest kind is taken, with a warning.
std::string choose_engine(
    const EngineChoice& choice,
    const std::function<std::optional<MemoryNeed>(const EngineKind&, double)>& try_kind);

// The options of a solution together with those for studies, as one value that can be copied.

struct SolveOptions : hm_options, hm_study_options {
    SolveOptions() : hm_options(sized<hm_options>()), hm_study_options(sized<hm_study_options>()) {
        study = this;
    }
    SolveOptions(const SolveOptions& other) : hm_options(other), hm_study_options(other) {
        study = this;
    }
    SolveOptions& operator=(const SolveOptions&) = delete;
};

struct Task;

void set_engine(const Arguments& arguments, Task& task);
void set_agglomeration(const Arguments& arguments, SolveOptions& options);
std::int32_t kernel_of(const Arguments& arguments);  // HM_KERNEL_..., which the processor has

// Writes lines with the columns cycle and residual, from cycle 0 to the last cycle.
void write_history(std::ostream& out, const std::vector<double>& residuals,
                   std::int32_t iterations);

}  // namespace cli
