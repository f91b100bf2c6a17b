// The files of one command: no output may replace an input or another output.
#pragma once

#include "options/arguments.hpp"

namespace cli {

// Refuses a command that would overwrite what it reads or what it writes, before the command
// begins. A moved mesh may replace the mesh of the first operand.
void refuse_overwriting(const Arguments& arguments);

// Refuses an output that no word of the command names, if the output would overwrite an input.
void refuse_overwriting(const Arguments& arguments, const NamedFile& output);

}  // namespace cli
