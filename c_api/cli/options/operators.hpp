// Names of the operators of the library. Each operator has a row, from which options, help,
// pictures and pages take their words.
#pragma once

#include "options/arguments.hpp"

namespace cli {

struct OperatorName {
    Choice choice;             // value of --operator; the first row is the default
    const char* functions;     // adjective of the functions, in pictures and pages
    const char* help;          // ends without a full stop
    const char* usual_weight;  // default of --exponent, or NULL: the operator has no exponent
};

std::int32_t operator_of(const Arguments& arguments);
const OperatorName& operator_named(std::int32_t kind);
std::vector<Option> operator_options();  // --operator and --exponent

}  // namespace cli
