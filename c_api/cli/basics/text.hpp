// Small questions about text, and text as messages show it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cli {

constexpr std::string_view blanks = " \t\v\f\r\n";
std::string_view trimmed(std::string_view text);
bool ends_with(std::string_view text, std::string_view end);
std::string in_quotes(std::string_view text);  // for messages: 'text', shortened and readable
// Returns "; did you mean 'NAME'?" with the name that differs from the word by the fewest letters,
// or an empty text if no name is similar.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace cli
