// Options of all commands that solve: the engine, and the record of the iterations.
#pragma once

#include "basics/arguments.hpp"
#include "commands/solve_options.hpp"

#include <iosfwd>
#include <vector>

namespace cli {

std::vector<Option> engine_options();
extern const Option agglomeration_option;
void set_engine(const Arguments& arguments, SolveOptions& options);
void set_agglomeration(const Arguments& arguments, SolveOptions& options);

// Writes lines with the columns cycle and residual, from cycle 0 to the last cycle.
void write_history(std::ostream& out, const std::vector<double>& residuals,
                   std::int32_t iterations);

}  // namespace cli
