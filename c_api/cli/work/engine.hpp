// Options of all commands that solve: the engine, the kernel, and the record of the iterations.
#pragma once

#include "options/arguments.hpp"
#include "work/solve_options.hpp"

#include <iosfwd>
#include <vector>

namespace cli {

struct Task;

std::vector<Option> engine_options();
extern const Option agglomeration_option, history_option, kernel_option;
void set_engine(const Arguments& arguments, Task& task);
void set_agglomeration(const Arguments& arguments, SolveOptions& options);
std::int32_t kernel_of(const Arguments& arguments);  // HM_KERNEL_..., which the processor has

// Writes lines with the columns cycle and residual, from cycle 0 to the last cycle.
void write_history(std::ostream& out, const std::vector<double>& residuals,
                   std::int32_t iterations);

}  // namespace cli
