// Text of unknown bytes (names of markers, paths) for terminals, pictures and pages: UTF-8 without
// control characters.
#pragma once

#include <string>
#include <string_view>

namespace cli {

// Returns the number of bytes of the first character of the text; 0 if the text does not begin with
// a character of UTF-8, or begins with a control character or one that XML does not allow.
std::size_t readable_character(std::string_view text);

std::string byte_in_hexadecimal(char byte);  // "\x1B"

// Returns the text, in which each byte that belongs to no such character is in hexadecimal. If a
// text of several lines is expected, ends of lines are kept.
std::string readable(std::string_view text, bool of_several_lines = false);

}  // namespace cli
