// Options and reports that all commands with --safe have in common.
#pragma once

#include "basics/arguments.hpp"
#include "basics/json.hpp"
#include "basics/library.hpp"

#include <string>
#include <vector>

namespace cli {

std::vector<Option> safe_options();  // all but --other
hm_safe_options safe_options_of(const Arguments& arguments);

// Adds the keys of JSON, and prints lines for people. reached_moves: the file of moves, or NULL
// where the command has no such file.
void add_safe(JsonObject& object, const hm_safe_report& safe, const std::string& warning,
              const std::string* reached_moves);
void print_target(const hm_safe_report& safe);
void print_worst_cells(const hm_safe_report& safe);

}  // namespace cli
