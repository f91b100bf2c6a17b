#include "commands/safe_way.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"

namespace cli {

namespace {

const char* strategy_name(std::int32_t strategy) {
    static const char* const names[] = {"linear", "other", "substeps", "untangled", "improved"};
    return names[strategy];
}

}  // namespace

void add_safe(JsonObject& object, const hm_safe_report& safe, const std::string& warning,
              const std::string* reached_moves) {
    object.add("step_fraction", safe.step_fraction).add("steps", safe.steps);
    object.add("resolves", safe.resolves)
        .add("strategy", std::string(strategy_name(safe.strategy)));
    object.add("last_step_admissible", safe.admissible).add("heights", safe.heights);
    if (reached_moves != nullptr) object.add("reached_moves", *reached_moves);
    object.add("turned_offset", safe.turned_offset).add("start_quality", safe.start_quality);
    object.add("warning", warning);
    std::vector<JsonObject> worst(static_cast<std::size_t>(safe.n_worst));
    for (std::size_t i = 0; i < worst.size(); ++i) {
        const hm_worst_cell& cell = safe.worst[i];
        worst[i]
            .add("cell", cell.cell)
            .add("quality", cell.quality)
            .add("start_quality", cell.start_quality);
        worst[i].add("x", cell.x).add("y", cell.y);
    }
    object.add("worst_cells", worst);
}

void print_target(const hm_safe_report& safe) {
    print("target           %s %% of the way in %s, %s of the functions; strategy: %s\n",
          brief(100 * safe.step_fraction).c_str(), plural(safe.steps, "step").c_str(),
          plural(safe.resolves, "new solution").c_str(), strategy_name(safe.strategy));
}

void print_worst_cells(const hm_safe_report& safe) {
    for (std::int32_t i = 0; i < safe.n_worst; ++i) {
        const hm_worst_cell& cell = safe.worst[i];
        print("%-16s cell %d at (%s, %s): %s, before %s\n", i == 0 ? "worst cells" : "", cell.cell,
              brief(cell.x).c_str(), brief(cell.y).c_str(), brief(cell.quality).c_str(),
              brief(cell.start_quality).c_str());
    }
}

std::vector<Option> safe_options() {
    return {{"--safe", nullptr,
             "reach the target with good cells whatever it takes: other operators, several steps "
             "on the mesh as it\n"
             "moves, untangling. A body that turns takes along the offsets of its points from the "
             "curve"},
            {"--min-quality", "Q",
             "for --safe: smallest quality, in parts of the smallest before, 0 to 1 (default "
             "0.05); where it cannot\n"
             "be had, the best mesh is written with a warning"},
            {"--max-height-change", "F",
             "for --safe: first-layer heights may grow and shrink by this factor at most (default: "
             "any)"},
            {"--strict", nullptr,
             "for --safe: a mesh poorer than asked for is not written, exit code 1"},
            {"--heights", nullptr,
             "for --safe: bring distances from the wall back to what they were, near it, as far as "
             "the smallest\n"
             "quality is neither halved nor less than is asked for; a warning says if only a part "
             "comes back"}};
}

hm_safe_options safe_options_of(const Arguments& arguments) {
    auto options = sized<hm_safe_options>();
    options.heights = arguments.has("--heights") ? 1 : 0;
    const double quality = arguments.real("--min-quality", .05, 0, 1);
    options.min_quality = quality > 0 ? quality : -1;
    if (arguments.has("--max-height-change"))
        options.max_height_change = arguments.real("--max-height-change", 2, 1.0001, 1e9);
    return options;
}

}  // namespace cli
