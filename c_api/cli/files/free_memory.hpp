// Finds the memory that the program can still allocate.
#pragma once

namespace cli {

// Returns the smallest, in bytes, of the memory that the system can give without swapping, the
// limit of the program's control group, and the rest of the limit of the address space (`ulimit
// -v`). Returns infinity on systems that report none of these.
double free_memory();

}  // namespace cli
