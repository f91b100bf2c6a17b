#include "work/engine_choice.hpp"

#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "files/free_memory.hpp"

#include <harmorph_study.h>

#include <cmath>

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

const Option memory_option = {
    "--memory", "MB",
    "memory for analysis, plan and functions, in 10^6 bytes (default: what the system has left); "
    "an engine\n"
    "that needs more is not taken"};

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

}  // namespace cli
