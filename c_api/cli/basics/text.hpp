// Small questions about text, and text as messages show it.
#pragma once

#include <string>
#include <string_view>

namespace cli {

constexpr std::string_view blanks = " \t\v\f\r\n";
std::string_view trimmed(std::string_view text);
bool ends_with(std::string_view text, std::string_view end);
std::string in_quotes(std::string_view text);  // for messages: 'text', shortened and readable

}  // namespace cli
