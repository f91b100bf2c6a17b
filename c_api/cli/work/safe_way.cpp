#include "work/safe_way.hpp"

#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "options/operators.hpp"

namespace cli {

namespace {

const std::vector<Choice> strategies = {{"linear", HM_STRATEGY_LINEAR},
                                        {"other", HM_STRATEGY_OTHER},
                                        {"substeps", HM_STRATEGY_SUBSTEPS},
                                        {"untangled", HM_STRATEGY_UNTANGLED},
                                        {"improved", HM_STRATEGY_IMPROVED}};

// Returns the part of the change of the distances from the wall that --heights is to undo.
double asked_heights(const Arguments& arguments) {
    return arguments.real("--heights-part", arguments.has("--heights") ? 1 : 0, 0, 1);
}

}  // namespace

const char* strategy_name(std::int32_t strategy) {
    return strategies[static_cast<std::size_t>(strategy)].name;
}

void add_safe(JsonObject& object, const hm_safe_report& safe, const std::string& warning,
              const std::string* reached_moves) {
    object.add("step_fraction", safe.step_fraction).add("steps", safe.steps);
    object.add("resolves", safe.resolves)
        .add("strategy", std::string(strategy_name(safe.strategy)));
    object.add("last_step_admissible", safe.admissible).add("heights", safe.heights);
    if (reached_moves != nullptr) object.add("reached_moves", *reached_moves);
    object.add("rotated_offset", safe.rotated_offset).add("start_quality", safe.start_quality);
    object.add("max_angle_change", safe.max_angle_change)
        .add("mean_angle_change", safe.mean_angle_change)
        .add("min_height_ratio", safe.min_height_ratio)
        .add("max_height_ratio", safe.max_height_ratio);
    object.add("end_point", safe.end_point).add("end_distance", safe.end_distance);
    object.add("solutions", safe.solutions).add("may_improve", safe.may_improve != 0);
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

bool OperatorTrial::is_better_than(const OperatorTrial& other) const {
    if (refusal.empty() != other.refusal.empty()) return refusal.empty();
    if (step_fraction != other.step_fraction) return step_fraction > other.step_fraction;
    return min_quality > other.min_quality;
}

bool compares_operators(const Arguments& arguments) {
    return arguments.has("--operator") && arguments.text("--operator") == "auto";
}

std::vector<std::int32_t> operators_to_compare(std::int32_t own) {
    return {own, own == HM_CONFORMAL ? HM_LAPLACE : HM_CONFORMAL};
}

void add_trials(JsonObject& object, const std::vector<OperatorTrial>& trials) {
    if (trials.empty()) return;
    std::vector<JsonObject> list(trials.size());
    for (std::size_t i = 0; i < trials.size(); ++i) {
        list[i]
            .add("operator", std::string(operator_named(trials[i].operator_kind).choice.name))
            .add("step_fraction", trials[i].step_fraction)
            .add("min_quality", trials[i].min_quality)
            .add("seconds", trials[i].seconds)
            .add("refusal", trials[i].refusal);
    }
    object.add("operators", list);
}

void print_trials(const std::vector<OperatorTrial>& trials) {
    for (std::size_t i = 0; i < trials.size(); ++i) {
        const OperatorTrial& trial = trials[i];
        print("%-16s %s: ", i == 0 ? "operator" : "not",
              operator_named(trial.operator_kind).choice.name);
        if (trial.refusal.empty()) {
            print("%s %% of the way, quality %s at least, %s seconds\n",
                  brief(100 * trial.step_fraction).c_str(), brief(trial.min_quality).c_str(),
                  brief(trial.seconds).c_str());
        } else {
            print("%s\n", trial.refusal.c_str());
        }
    }
}

void print_target(const hm_safe_report& safe) {
    print("target           %s %% of the way in %s, %s of the functions; strategy: %s\n",
          brief(100 * safe.step_fraction).c_str(), plural(safe.steps, "step").c_str(),
          plural(safe.resolves, "new solution").c_str(), strategy_name(safe.strategy));
    print("spent            %s%s\n", plural(safe.solutions, "solution").c_str(),
          safe.may_improve != 0 ? "; a larger --improve-work may give better cells" : "");
    if (safe.end_point >= 0) {
        print("end of a wall    point %d leaves the line of the boundary beside it by %s\n",
              safe.end_point, brief(safe.end_distance).c_str());
    }
}

void print_worst_cells(const hm_safe_report& safe) {
    for (std::int32_t i = 0; i < safe.n_worst; ++i) {
        const hm_worst_cell& cell = safe.worst[i];
        print("%-16s cell %d at (%s, %s): %s, before %s\n", i == 0 ? "worst cells" : "", cell.cell,
              brief(cell.x).c_str(), brief(cell.y).c_str(), brief(cell.quality).c_str(),
              brief(cell.start_quality).c_str());
    }
}

void check_safe_options(const Arguments& arguments) {
    for (const char* const option : {"--min-quality", "--max-height-change", "--strict",
                                     "--heights", "--heights-part", "--max-resolves", "--skip"}) {
        if (!arguments.has("--safe") && arguments.has(option))
            arguments.refuse(std::string(option) + " needs --safe");
    }
    if (arguments.has("--improve-work") && !arguments.has("--safe") && !arguments.has("--improve"))
        arguments.refuse("--improve-work needs --improve or --safe");
}

void warn_of_heights(const Arguments& arguments, const hm_safe_report& safe, bool is_valid) {
    if (safe.heights >= asked_heights(arguments) || !is_valid) return;
    warn(brief(100 * safe.heights) +
         " % of the change of the distances from the wall was undone by --heights, because more "
         "would "
         "reduce the smallest quality too much");
}

hm_safe_options safe_options_of(const Arguments& arguments) {
    auto options = sized<hm_safe_options>();
    options.improve = arguments.has("--improve") ? 1 : 0;
    options.heights = asked_heights(arguments);
    options.improve_work = arguments.whole("--improve-work", 0, 1, 10000);
    const double quality = arguments.real("--min-quality", .05, 0, 1);
    options.min_quality = quality > 0 ? quality : -1;
    if (arguments.has("--max-height-change"))
        options.max_height_change = arguments.real("--max-height-change", 2, 1.0001, 1e9);
    if (arguments.has("--max-resolves")) {
        const std::int32_t resolves = arguments.whole("--max-resolves", 10, 0, 1000000);
        options.max_resolves = resolves > 0 ? resolves : -1;
    }
    for (const std::string& name : arguments.all("--skip"))
        options.skipped_strategies |= 1 << arguments.choice("--skip", name, strategies);
    return options;
}

hm_improve_options improve_options_of(const Arguments& arguments) {
    auto options = sized<hm_improve_options>();
    options.max_solutions = arguments.whole("--improve-work", 0, 1, 10000);
    return options;
}

}  // namespace cli
