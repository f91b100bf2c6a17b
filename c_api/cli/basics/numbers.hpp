// Conversions between numbers and text. No other file of the program has any.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// Prints the decimal digits of doubles by exact arithmetic of 128 bits. This serves the numbers of
// mesh files, which are not far from 1 and have at most 18 digits; for other numbers the caller
// uses the C++ library, which is slower.

// Printing writes at most this many characters, without a terminating zero byte.
constexpr int longest_decimal = 64;

// Prints with the fewest digits that are read back as the same bits, as std::to_chars does. Returns
// the end of the text, or NULL if the number is out of range.
char* print_shortest(char* to, double value);

// Prints as printf does by "%.*e", "%.*f" or "%.*g" (style e, f, g). Returns the end of the text,
// or NULL if the number is out of range.
char* print_decimal(char* to, char style, int precision, double value);

// The whole word must be a number. Real numbers must be finite; the notation 1.5D3 of Fortran is
// allowed.
bool parse(std::string_view word, std::int32_t& value);
bool parse(std::string_view word, std::int64_t& value);
bool parse(std::string_view word, double& value);

// The text must be a list of numbers, "1,2.5".
bool parse_list(std::string_view text, std::vector<double>& values, char separator = ',');
bool parse_list(std::string_view text, std::vector<std::int32_t>& values);

// Reads the number with which the text begins, in the notation of C. Returns the number of its
// characters; 0 if the text begins with no number.
std::size_t parse_front(std::string_view text, std::int64_t& value, int base = 10);
std::size_t parse_front(std::string_view text, double& value);

// Appends a number as printf does by "%.*e", "%.*f" or "%.*g" (style e, f, g) with this precision.
// For the numbers of a mesh this is several times as fast.
void append_number(std::string& text, char style, int precision, double value);

std::string exact(double value);  // 17 significant digits, which are read back as the same bits
std::string scientific(double value);  // 17 digits with a decimal point and an exponent: 1.5E+00
std::string brief(double value);       // 4 significant digits, for people
std::string padded(std::int64_t number, std::size_t width, char fill = ' ');  // on the left
std::string hexadecimal(std::uint32_t number, std::size_t digits);
std::string plural(std::int64_t count, std::string_view noun);  // "1 point", "2 points"

}  // namespace cli
