#include "basics/quoted_name.hpp"

#include "basics/text.hpp"

namespace cli {

namespace {

bool is_quote(char c) { return c == '"' || c == '\''; }

// Tells whether the character at `at` and the next one stand for one character of the name.
bool is_pair(std::string_view text, std::size_t at, char quote) {
    if (at + 1 >= text.size()) return false;
    return text[at] == '\\' || (text[at] == quote && text[at + 1] == quote);
}

}  // namespace

std::size_t behind_quoted(std::string_view text, std::size_t at) {
    if (at >= text.size() || !is_quote(text[at])) return at;
    const char quote = text[at];
    for (std::size_t k = at + 1; k < text.size(); ++k) {
        if (text[k] == '\n' || text[k] == '\r') return at;
        if (is_pair(text, k, quote)) ++k;
        else if (text[k] == quote) return k + 1;
    }
    return at;
}

std::string unquoted(std::string_view quoted) {
    std::string name;
    const char quote = quoted.front();
    for (std::size_t k = 1; k + 1 < quoted.size(); ++k) {
        const bool follows_backslash = quoted[k] == '\\';
        if (is_pair(quoted, k, quote)) ++k;
        const char c = quoted[k];
        name += follows_backslash && c == 'n' ? '\n' : follows_backslash && c == 'r' ? '\r' : c;
    }
    return name;
}

std::size_t equals_behind_names(std::string_view text, std::size_t from) {
    bool is_start = true;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t behind = is_start ? behind_quoted(text, at) : at;
        is_start = behind == at && (text[at] == ',' || (is_start && text[at] == ' '));
        if (behind == at && at >= from && text[at] == '=') return at;
        at = behind == at ? at + 1 : behind;
    }
    return text.npos;
}

std::string quoted_name(std::string_view name, bool always) {
    const bool is_word = !name.empty() && name.find_first_of(blanks) == name.npos &&
                         name.find_first_of("\"',=@#*?:\\") == name.npos;
    if (is_word && !always) return std::string(name);
    std::string text = "\"";
    for (const char c : name) {
        if (c == '"' || c == '\\') text += '\\';
        if (c == '\n') text += "\\n";
        else if (c == '\r') text += "\\r";
        else text += c;
    }
    return text + '"';
}

}  // namespace cli
