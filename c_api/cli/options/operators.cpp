#include "options/operators.hpp"

#include <harmorph.h>

namespace cli {

namespace {

const OperatorName operator_names[] = {{{"conformal", HM_CONFORMAL}, "conformal", true},
                                       {{"laplace", HM_LAPLACE}, "harmonic", false},
                                       {{"weighted", HM_WEIGHTED}, "weighted harmonic", true}};

}  // namespace

std::int32_t operator_of(const Arguments& arguments) {
    std::vector<Choice> choices;
    for (const OperatorName& name : operator_names) choices.push_back(name.choice);
    return arguments.choice("--operator", choices);
}

const OperatorName& operator_named(std::int32_t kind) {
    for (const OperatorName& name : operator_names) {
        if (name.choice.number == kind) return name;
    }
    return operator_names[0];
}

}  // namespace cli
