// The design variables that the options of `harmorph variables` ask for.
#pragma once

#include "basics/json.hpp"
#include "curves/variables_file.hpp"
#include "options/arguments.hpp"

#include <string>
#include <vector>

namespace cli {

struct MadeVariables {
    VariableMap map;
    std::vector<JsonObject> rows;  // one for each variable or mode
    std::string table;             // the text to print without --json, with the same numbers
};

MadeVariables make_variables(const Arguments& arguments);

}  // namespace cli
