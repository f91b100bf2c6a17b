// Conversions between numbers and text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cli {

// The whole word must be a number. Real numbers must be finite; the notation 1.5D3 of Fortran is
// allowed.
bool parse(std::string_view word, std::int32_t& value);
bool parse(std::string_view word, std::int64_t& value);
bool parse(std::string_view word, double& value);

// Appends a number as printf does by "%.*e", "%.*f" or "%.*g" (style e, f, g) with this precision.
// For the numbers of a mesh this is several times as fast.
void append_number(std::string& text, char style, int precision, double value);

std::string exact(double value);  // 17 significant digits, which are read back as the same bits
std::string scientific(double value);  // 17 digits with a decimal point and an exponent: 1.5E+00
std::string brief(double value);       // 4 significant digits, for people
std::string plural(std::int64_t count, std::string_view noun);  // "1 point", "2 points"

}  // namespace cli
