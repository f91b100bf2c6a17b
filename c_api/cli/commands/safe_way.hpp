// What the commands that go a safe way have in common: what is asked of it, and what is said of it.
#pragma once

#include "basics/arguments.hpp"
#include "basics/json.hpp"
#include "basics/library.hpp"

#include "basics/failure.hpp"
#include "basics/stopwatch.hpp"

#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cli {

// A safe morph by one of the operators that are compared.
struct OperatorTrial {
    std::int32_t operator_kind = 0;
    double step_fraction = 0, min_quality = 0, seconds = 0;
    std::string refusal;  // empty: there is a result

    // A larger part of the way is better; then a larger smallest quality.
    bool is_better_than(const OperatorTrial& other) const;
};

// --operator auto: conformal and Laplace functions are both tried, and the better mesh is taken.
bool compares_operators(const Arguments& arguments);
// The operator of the basis or of the options, and the one to be compared.
std::vector<std::int32_t> operators_to_compare(std::int32_t own);
void add_trials(JsonObject& object, const std::vector<OperatorTrial>& trials);
void print_trials(const std::vector<OperatorTrial>& trials);

// One result for each operator, by run(operator_kind, trial), which fills in the trial. The best
// one is returned, and all trials in `trials`, the best first. An operator that refuses the problem
// does not count if another one takes it.
template <class Run>
auto best_of_operators(const std::vector<std::int32_t>& kinds, std::vector<OperatorTrial>& trials,
                       const Run& run) {
    std::optional<decltype(run(0, trials.front()))> best;
    std::exception_ptr reason;
    for (const std::int32_t kind : kinds) {
        OperatorTrial trial;
        trial.operator_kind = kind;
        const Stopwatch watch;
        try {
            auto result = run(kind, trial);
            trial.seconds = watch.seconds();
            const bool is_best = !best || trial.is_better_than(trials.front());
            if (is_best) best.emplace(std::move(result));
            trials.insert(is_best ? trials.begin() : trials.end(), trial);
        } catch (const Failure& failure) {
            trial.seconds = watch.seconds();
            trial.refusal = failure.what();
            if (!reason) reason = std::current_exception();
            trials.push_back(trial);
        }
    }
    if (!best) std::rethrow_exception(reason);
    return std::move(*best);
}

std::vector<Option> safe_options();  // without bases
hm_safe_options safe_options_of(const Arguments& arguments);
// A warning where --heights could not bring all of the distances back.
void warn_of_heights(const Arguments& arguments, const hm_safe_report& safe, bool is_valid);

// Keys of JSON, and lines for people. reached_moves: the file of them, or null where there is none
// such.
void add_safe(JsonObject& object, const hm_safe_report& safe, const std::string& warning,
              const std::string* reached_moves);
void print_target(const hm_safe_report& safe);
void print_worst_cells(const hm_safe_report& safe);

}  // namespace cli
