// The design variables that the options of `harmorph variables` ask for.
#pragma once

#include "basics/arguments.hpp"
#include "basics/json.hpp"
#include "curves/variables_file.hpp"

#include <string>
#include <vector>

namespace cli {

struct MadeVariables {
    VariableMap map;
    std::vector<JsonObject> rows;  // of the variables
    std::string table;             // the same for people
};

MadeVariables make_variables(const Arguments& arguments);

}  // namespace cli
