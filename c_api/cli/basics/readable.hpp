// Text of unknown bytes (names of markers, paths) for terminals, pictures and pages: UTF-8 without
// control characters.
#pragma once

#include <string>
#include <string_view>

namespace cli {

// The number of bytes of the character with which the text begins; 0 if the text does not begin
// with a character of UTF-8, or begins with a control character or one that XML does not allow.
std::size_t readable_character(std::string_view text);

std::string byte_in_hexadecimal(char byte);  // "\x1B"

// The text with each byte that belongs to no such character in hexadecimal. Ends of lines are kept
// where a text of several lines is expected.
std::string readable(std::string_view text, bool of_several_lines = false);

}  // namespace cli
