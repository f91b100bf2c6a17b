// Messages of the program are readable on any terminal, whatever bytes names have.
#pragma once

#include <string>

namespace cli {

#ifdef __GNUC__
__attribute__((format(printf, 1, 2)))
#endif
void print(const char* format, ...);  // prints to standard output, with the format of printf

void print_error(const std::string& message);  // prints "harmorph: MESSAGE" to standard error

}  // namespace cli
