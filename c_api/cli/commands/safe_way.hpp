// What the commands that go a safe way have in common: what is asked of it, and what is said of it.
#pragma once

#include "basics/arguments.hpp"
#include "basics/json.hpp"
#include "basics/library.hpp"

#include <string>
#include <vector>

namespace cli {

std::vector<Option> safe_options();  // without bases
hm_safe_options safe_options_of(const Arguments& arguments);

// Keys of JSON, and lines for people. reached_moves: the file of them, or null where there is none
// such.
void add_safe(JsonObject& object, const hm_safe_report& safe, const std::string& warning,
              const std::string* reached_moves);
void print_target(const hm_safe_report& safe);
void print_worst_cells(const hm_safe_report& safe);

}  // namespace cli
