#include "work/engine.hpp"

#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "files/memory.hpp"
#include "work/task.hpp"

#include <harmorph_study.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace cli {

namespace {

// In the order of the predicted time: the first one that fits is the fastest one. The order was
// measured for 10 000 to a million points and 4, 20 and 60 functions (tests/measure/bench). For
// each point the direct engine takes about 1.4 times as long on a mesh of ten times as many points,
// and multigrid takes the same time; but at a million points multigrid takes 4 times as long as the
// direct engine. So the order holds up to the 2^30 points that a mesh may have.
const std::vector<EngineKind> by_time = {{"direct", HM_DIRECT}, {"multigrid", HM_MULTIGRID}};

std::string megabytes(double bytes) { return brief(1e-6 * bytes) + " MB"; }

std::string named_limit(const EngineChoice& choice) {
    return "the " + megabytes(choice.memory) +
           (choice.is_asked ? " of --memory" : " that the system has left");
}

}  // namespace

EngineChoice engine_choice_of(const Arguments& arguments) {
    EngineChoice choice;
    constexpr std::int32_t automatic = -1;
    const std::int32_t engine = arguments.choice(
        "--engine",
        {{"auto", automatic}, {"direct", HM_DIRECT}, {"multigrid", HM_MULTIGRID}, {"fas", HM_FAS}});
    if (engine != automatic) {
        choice.kinds = {{arguments.text("--engine"), engine}};
    } else {
        choice.kinds = by_time;
    }
    choice.is_asked = arguments.has("--memory");
    if (choice.is_asked) choice.memory = 1e6 * arguments.positive("--memory", 0);
    else if (engine == automatic) choice.memory = free_memory();
    return choice;
}

std::string choose_engine(
    const EngineChoice& choice,
    const std::function<std::optional<MemoryNeed>(const EngineKind&, double)>& try_kind) {
    const bool is_automatic = choice.kinds.size() > 1;
    const EngineKind* smallest = nullptr;
    double min_bytes = 0;
    std::string too_large;  // "direct needs 412 MB, multigrid 380 MB"
    for (const EngineKind& kind : choice.kinds) {
        const std::optional<MemoryNeed> need = try_kind(kind, choice.memory);
        if (!need) continue;
        const std::string bytes = megabytes(need->bytes);
        if (need->bytes <= choice.memory) {
            const bool is_first = too_large.empty();
            std::string reason = kind.name + ": ";
            if (is_automatic && is_first) reason += "the fastest engine, and its ";
            reason += bytes;
            if (choice.is_asked || !is_first) reason += " fit into " + named_limit(choice);
            else if (is_automatic) reason += " fit into the memory";
            return reason + (is_first ? "" : "; " + too_large);
        }
        too_large += (too_large.empty() ? "" : ", ") + kind.name +
                     (too_large.empty() ? " needs " : " ") + (need->is_of_all ? "" : "more than ") +
                     bytes;
        if (smallest != nullptr && need->bytes >= min_bytes) continue;
        smallest = &kind;
        min_bytes = need->bytes;
    }
    const std::string reason = "no engine fits into " + named_limit(choice) + ": " + too_large;
    if (choice.is_asked) throw Failure(exit_unusable, reason);
    warn(reason);
    try_kind(*smallest, unlimited_memory);
    return smallest->name + ": the engine that needs the smallest memory; " + reason;
}

namespace {

// An option that only some engines have. With other engines the option is refused.
struct EngineOption {
    const char* name;
    std::vector<std::int32_t> engines;
    const char* engine_names;
};
const EngineOption engine_option_list[] = {
    {"--levels", {HM_MULTIGRID, HM_FAS}, "multigrid or fas"},
    {"--block-width", {HM_MULTIGRID, HM_FAS}, "multigrid or fas"},
    {"--max-iterations", {HM_MULTIGRID, HM_FAS}, "multigrid or fas"},
    {"--history", {HM_MULTIGRID, HM_FAS}, "multigrid or fas"},
    {"--agglomeration", {HM_FAS}, "fas"},
    {"--start", {HM_FAS}, "fas"},
    {"--cycle", {HM_FAS}, "fas"},
};

}  // namespace

std::int32_t kernel_of(const Arguments& arguments) {
    const std::int32_t best = hm_best_kernel();
    if (!arguments.has("--kernel")) return best;
    const std::int32_t kernel = arguments.choice("--kernel", {{"baseline", HM_KERNEL_BASELINE},
                                                              {"avx2", HM_KERNEL_AVX2},
                                                              {"avx512", HM_KERNEL_AVX512},
                                                              {"neon", HM_KERNEL_NEON}});
    const bool has_kernel = kernel == HM_KERNEL_BASELINE || kernel == best ||
                            (kernel == HM_KERNEL_AVX2 && best == HM_KERNEL_AVX512);
    if (!has_kernel)
        arguments.refuse("--kernel " + arguments.text("--kernel") +
                         ": this processor does not have these instructions");
    return kernel;
}

void set_agglomeration(const Arguments& arguments, SolveOptions& options) {
    options.agglomeration =
        arguments.choice("--agglomeration", {{"auto", HM_AGGLOMERATE_AUTO},
                                             {"isotropic", HM_AGGLOMERATE_ISOTROPIC},
                                             {"directional", HM_AGGLOMERATE_DIRECTIONAL}});
}

void set_engine(const Arguments& arguments, Task& task) {
    SolveOptions& options = task.options;
    task.choice = engine_choice_of(arguments);
    options.engine = task.choice.kinds[0].engine;
    for (const EngineOption& option : engine_option_list) {
        const auto& engines = option.engines;
        if (arguments.has(option.name) &&
            std::find(engines.begin(), engines.end(), options.engine) == engines.end())
            arguments.refuse(std::string(option.name) + " needs --engine " + option.engine_names);
    }
    set_agglomeration(arguments, options);
    options.start =
        arguments.choice("--start", {{"fmg", HM_START_COARSEST}, {"zero", HM_START_ZERO}});
    options.cycle =
        arguments.choice("--cycle", {{"paper", HM_CYCLE_PAPER}, {"improved", HM_CYCLE_IMPROVED}});
    options.levels = arguments.whole("--levels", 0, 1, 20);
    options.max_iterations = arguments.whole("--max-iterations", 0, 1, INT32_MAX);
    if (arguments.has("--block-width"))
        options.block_width = arguments.choice("--block-width", {{"4", 4}, {"8", 8}, {"16", 16}});
}

void write_history(std::ostream& out, const std::vector<double>& residuals,
                   std::int32_t iterations) {
    const std::size_t n = std::min(residuals.size(), static_cast<std::size_t>(iterations) + 1);
    out << "cycle,residual\n";
    for (std::size_t cycle = 0; cycle < n; ++cycle)
        out << cycle << ',' << exact(residuals[cycle]) << '\n';
}

}  // namespace cli
