#include "options/operators.hpp"

#include <harmorph.h>

namespace cli {

namespace {

const OperatorName operator_names[] = {
    {{"conformal", HM_CONFORMAL},
     "conformal",
     "keeps angles near the wall, takes large movements",
     "1.5"},
    {{"laplace", HM_LAPLACE}, "harmonic", "the harmonic functions of the paper", nullptr},
    {{"weighted", HM_WEIGHTED}, "weighted harmonic", "harmonic with a conductivity 1/d^Q", "1"},
};

std::string operator_help() {
    std::string text;
    for (const OperatorName& name : operator_names) {
        text += text.empty() ? "" : ";\n";
        text += name.choice.name;
        text += &name == operator_names ? " (default): " : ": ";
        text += name.help;
    }
    return text;
}

std::string exponent_help() {
    std::string usual;
    for (const OperatorName& name : operator_names) {
        if (name.usual_weight == nullptr) continue;
        usual += usual.empty() ? "(default " : ", ";
        usual += std::string(name.usual_weight) + " for " + name.choice.name;
    }
    return "of the distance d to what moves, 0 to 4 in steps of 1/4\n" + usual + ")";
}

}  // namespace

std::vector<Option> operator_options() {
    static const std::string of_operator = operator_help(), of_exponent = exponent_help();
    return {{"--operator", "OPERATOR", of_operator.c_str()},
            {"--exponent", "Q", of_exponent.c_str()}};
}

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
