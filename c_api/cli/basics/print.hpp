// Messages of the program are readable on any terminal, whatever bytes names have.
#pragma once

#include <string>
#include <vector>

namespace cli {

#ifdef __GNUC__
__attribute__((format(printf, 1, 2)))
#endif
void print(const char* format, ...);  // prints to standard output, with the format of printf

void print_error(const std::string& message);  // prints "harmorph: MESSAGE" to standard error

void warn(const std::string& message);  // prints "harmorph: warning: MESSAGE" to standard error
// Warns of each of these sentences about a file.
void warn_of(const std::string& path, const std::vector<std::string>& sentences);

}  // namespace cli
