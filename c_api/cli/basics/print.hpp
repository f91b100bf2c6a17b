// Messages of the program are readable on any terminal, whatever bytes names have.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cli {

// Text of unknown bytes (names of markers, paths) for terminals, pictures and pages: UTF-8 without
// control characters.

// Returns the number of bytes of the first character of the text; 0 if the text does not begin with
// a character of UTF-8, or begins with a control character or one that XML does not allow.
std::size_t readable_character(std::string_view text);

std::string byte_in_hexadecimal(char byte);  // "\x1B"

// Returns the text, in which each byte that belongs to no such character is in hexadecimal. If a
// text of several lines is expected, ends of lines are kept.
std::string readable(std::string_view text, bool of_several_lines = false);

#ifdef __GNUC__
__attribute__((format(printf, 1, 2)))
#endif
void print(const char* format, ...);  // prints to standard output, with the format of printf

void print_error(const std::string& message);  // prints "harmorph: MESSAGE" to standard error

void warn(const std::string& message);  // prints "harmorph: warning: MESSAGE" to standard error
// Warns of each of these sentences about a file.
void warn_of(const std::string& path, const std::vector<std::string>& sentences);

}  // namespace cli
