// The memory that the program can still take.
#pragma once

namespace cli {

// Bytes: the least of the memory that the system can give without swapping, the limit of the
// program's control group, and the rest of the limit of its address space (`ulimit -v`). Infinite
// on systems that tell none of these.
double free_memory();

}  // namespace cli
