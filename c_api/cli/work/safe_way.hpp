// Options and reports that all commands with --safe have in common.
#pragma once

#include "basics/failure.hpp"
#include "basics/json.hpp"
#include "basics/library.hpp"
#include "basics/progress.hpp"
#include "options/arguments.hpp"

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
    std::string refusal;    // empty: there is a result
    bool is_short = false;  // a valid mesh, but not all of the way

    // A larger part of the way is better; then a larger smallest quality.
    bool is_better_than(const OperatorTrial& other) const;
};

// --operator auto: conformal and Laplace functions are both tried, and the better mesh is taken.
bool compares_operators(const Arguments& arguments);
// Returns the given operator, and the operator to compare with it: conformal, or Laplace if the
// given operator is conformal.
std::vector<std::int32_t> operators_to_compare(std::int32_t own);
void add_trials(JsonObject& object, const std::vector<OperatorTrial>& trials);
void print_trials(const std::vector<OperatorTrial>& trials);

// Calls run(operator_kind, trial), which fills in the trial, for the first operator, and for the
// other operators if `all` are to be compared or no result so far reaches the target. Returns the
// best result. `trials` gets the trials, the best first; none if there was only one. The Failure of
// an operator becomes the refusal of its trial. It is thrown if no operator has a result, and for
// the first operator if not `all` are to be compared.
template <class Run>
auto best_of_operators(const std::vector<std::int32_t>& kinds, bool all,
                       std::vector<OperatorTrial>& trials, const Run& run) {
    std::optional<decltype(run(0, trials.front()))> best;
    std::exception_ptr reason;
    for (const std::int32_t kind : kinds) {
        if (!all && best && !trials.front().is_short) break;
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
            if (!all && !best) throw;
            trial.seconds = watch.seconds();
            trial.refusal = failure.what();
            if (!reason) reason = std::current_exception();
            trials.push_back(trial);
        }
    }
    if (!best) std::rethrow_exception(reason);
    if (trials.size() == 1) trials.clear();
    return std::move(*best);
}

const char* strategy_name(std::int32_t strategy);  // HM_STRATEGY_...; the name in --skip
hm_safe_options safe_options_of(const Arguments& arguments);
// Refuses options of --safe and --improve without these.
void check_safe_options(const Arguments& arguments);
// Returns hm_improve_options with the value of --improve-iterations.
hm_improve_options improve_options_of(const Arguments& arguments);
// Warns if --heights could not restore the distances from the wall as far as was asked.
void warn_of_heights(const Arguments& arguments, const hm_safe_report& safe, bool is_valid);

// Adds the keys of JSON, and prints lines for people. reached_moves: the file of moves, or NULL
// where the command has no such file.
void add_safe(JsonObject& object, const hm_safe_report& safe, const std::string& warning,
              const std::string* reached_moves);
void print_target(const hm_safe_report& safe);
void print_worst_cells(const hm_safe_report& safe);

}  // namespace cli
