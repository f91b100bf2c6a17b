// Prints the decimal digits of doubles by exact arithmetic of 128 bits. This serves the numbers of
// mesh files, which are not far from 1 and have at most 18 digits; for other numbers the caller
// uses the C++ library, which is slower.
#pragma once

namespace cli {

// Printing writes at most this many characters, without a terminating zero byte.
constexpr int longest_decimal = 64;

// Prints with the fewest digits that are read back as the same bits, as std::to_chars does. Returns
// the end of the text, or NULL if the number is out of range.
char* print_shortest(char* to, double value);

// Prints as printf does by "%.*e", "%.*f" or "%.*g" (style e, f, g). Returns the end of the text,
// or NULL if the number is out of range.
char* print_decimal(char* to, char style, int precision, double value);

}  // namespace cli
