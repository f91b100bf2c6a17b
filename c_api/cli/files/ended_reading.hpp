// Files that are mapped into memory. If another program shortens such a file, the next access
// behind the new end is a signal (SIGBUS): the program then removes its temporary files, names the
// file on standard error, and ends with exit code 3.
#pragma once

#include <cstddef>
#include <string>

namespace cli {

void watch_mapping(const void* begin, std::size_t size, const std::string& path);
void forget_mapping(const void* begin);

}  // namespace cli
