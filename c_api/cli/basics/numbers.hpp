// Numbers as text, both ways.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cli {

// The whole word must be a number: no sign of anything else around it. Real numbers must be
// finite; 1.5D3 is one, too.
bool parse(std::string_view word, std::int32_t& value);
bool parse(std::string_view word, std::int64_t& value);
bool parse(std::string_view word, double& value);

std::string exact(double value);  // 17 significant digits: reads back as the same bits
std::string scientific(
    double value);                // as many, always with a decimal point and an exponent: 1.5E+00
std::string brief(double value);  // 4 significant digits, for people
std::string plural(std::int64_t count, std::string_view noun);  // "1 point", "2 points"

}  // namespace cli
