// The commands of the program.
#pragma once

#include "options/arguments.hpp"

#include <string>
#include <vector>

namespace cli {

// The files of one command: no output may replace an input or another output.

// Refuses a command that would overwrite what it reads or what it writes, before the command
// begins. A moved mesh may replace the mesh of the first operand.
void refuse_overwriting(const Arguments& arguments);

// Refuses an output that no word of the command names, if the output would overwrite an input.
void refuse_overwriting(const Arguments& arguments, const NamedFile& output);

// Each command of the program, which NAME.txt beside this file describes. They throw a Failure if
// the result is not usable.
void run_demo(const Arguments& arguments);
void run_fit(const Arguments& arguments);
void run_solve(const Arguments& arguments);
void run_morph(const Arguments& arguments);
void run_displace(const Arguments& arguments);
void run_adjoint(const Arguments& arguments);
void run_export(const Arguments& arguments);
void run_check(const Arguments& arguments);
void run_transfer(const Arguments& arguments);
void run_explore(const Arguments& arguments);
void run_convert(const Arguments& arguments);
void run_curve(const Arguments& arguments);
void run_variables(const Arguments& arguments);
void run_sample(const Arguments& arguments);
void run_interpolate(const Arguments& arguments);
void run_align(const Arguments& arguments);

// words: all words after the name of the program. Throws a Failure that says what went wrong.
void run_command(const std::vector<std::string>& words);

}  // namespace cli
