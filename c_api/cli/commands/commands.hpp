// The commands of the program.
#pragma once

#include "options/arguments.hpp"

#include <string>
#include <vector>

namespace cli {

extern const Command fit_command, solve_command, morph_command, export_command, check_command,
    transfer_command, displace_command, adjoint_command, explore_command, convert_command,
    curve_command, variables_command, sample_command, interpolate_command, align_command,
    demo_command;

// words: all words after the name of the program. Throws a Failure that says what went wrong.
void run_command(const std::vector<std::string>& words);

}  // namespace cli
