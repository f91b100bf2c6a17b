// The decimal digits of doubles by exact arithmetic of 128 bits, for the numbers that mesh files
// have: not far from 1, and of at most 18 digits. Other numbers are left to the C++ library, which
// is slower.
#pragma once

namespace cli {

// Printing takes at most this many characters; no zero byte is put behind them.
constexpr int longest_decimal = 64;

// Prints with the fewest digits that are read back as the same bits, as std::to_chars does. Returns
// the end of the text; NULL: out of range.
char* print_shortest(char* to, double value);

// Prints as printf does by "%.*e", "%.*f" or "%.*g" (style e, f, g). NULL: out of range.
char* print_decimal(char* to, char style, int precision, double value);

}  // namespace cli
