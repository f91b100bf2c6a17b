// The commands of the program, and what they all begin with.
#pragma once

#include "arguments.hpp"
#include "mesh.hpp"

#include <string>
#include <vector>

namespace cli {

extern const Command fit_command, solve_command, morph_command, export_command, check_command, transfer_command, explore_command,
    demo_command;

// words: all after the program's name. A Failure says what went wrong.
void run_command(const std::vector<std::string>& words);

// Reads an SU2 file and tells the user on standard error what was passed over.
Mesh read_mesh(const std::string& path);

void warn(const std::string& message); // to standard error

} // namespace cli
