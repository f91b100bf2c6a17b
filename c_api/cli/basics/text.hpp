// Small questions about text, and text as messages show it.
#pragma once

#include <cstddef>
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

// Returns the words of the text in lines of at most 80 columns; all lines but the first one have an
// indentation.
std::string wrapped(std::string_view text, std::size_t indent);
// Returns "  NAME  text" with the text, in such lines, in a column.
std::string help_line(const std::string& name, std::string_view text, std::size_t column);

// Names in quotes: "a name" or 'a name', in which a backslash or the quote itself stands before a
// quote, a backslash before a backslash, and \n and \r stand for line ends. A quote elsewhere than
// at the beginning of a name belongs to the name, as does a first one that is not closed.

// Returns the position behind the name in quotes that begins at `at`, or `at` if none begins there.
std::size_t behind_quoted(std::string_view text, std::size_t at);
// Returns the name in these quotes, which behind_quoted() has found.
std::string unquoted(std::string_view quoted);
// Returns the position of the first `=` at or behind `from` that is in no quotes of a list of
// names, or npos.
std::size_t equals_behind_names(std::string_view text, std::size_t from);
// Returns the name, in quotes always or where that is necessary, so that it is one entry of a list
// of markers and one word of a line.
std::string quoted_name(std::string_view name, bool always = false);

}  // namespace cli
