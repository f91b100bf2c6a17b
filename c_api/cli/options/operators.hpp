// Names of the operators of the library. Each operator has a row, from which options, pictures and
// pages take their words.
#pragma once

#include "options/arguments.hpp"

namespace cli {

struct OperatorName {
    Choice choice;          // value of --operator; the first row is the default
    const char* functions;  // adjective of the functions, in pictures and pages
    bool has_exponent;
};

std::int32_t operator_of(const Arguments& arguments);
const OperatorName& operator_named(std::int32_t kind);

}  // namespace cli
