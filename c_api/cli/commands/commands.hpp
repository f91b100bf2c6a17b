// The commands of the program, and how all of them read a mesh and warn.
#pragma once

#include "basics/arguments.hpp"
#include "formats/format.hpp"

#include <string>
#include <vector>

namespace cli {

extern const Command fit_command, solve_command, morph_command, export_command, check_command,
    transfer_command, displace_command, adjoint_command, explore_command, convert_command,
    curve_command, variables_command, sample_command, interpolate_command, align_command,
    demo_command;

// words: all words after the name of the program. Throws a Failure that says what went wrong.
void run_command(const std::vector<std::string>& words);

// Reads a mesh, and warns of all parts of the file that were ignored. Commands that read meshes
// have both options.
extern const Option format_option, zone_option;
Mesh read_mesh(const Arguments& arguments, std::size_t operand);
Mesh read_mesh(const std::string& path, const ReadOptions& options = {});

void warn(const std::string& message);  // to standard error
// Warns of each of these sentences about a file.
void warn_of(const std::string& path, const std::vector<std::string>& sentences);

}  // namespace cli
