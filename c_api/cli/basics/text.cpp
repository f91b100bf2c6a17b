#include "basics/text.hpp"

#include "basics/print.hpp"

#include <algorithm>
#include <cctype>

namespace cli {

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
    text.remove_prefix(begin);
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

bool ends_with(std::string_view text, std::string_view end) {
    return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 48;
    std::size_t bytes = 0;  // characters stay whole
    while (bytes < std::min(longest, text.size()))
        bytes += std::max<std::size_t>(readable_character(text.substr(bytes)), 1);
    return "'" + readable(text.substr(0, bytes)) + (text.size() > bytes ? "...'" : "'");
}

namespace {

// The number of letters to insert, to delete, to replace, or to exchange with the next one, that
// make one text of the other; upper and lower case are equal.
std::size_t letters_apart(std::string_view a, std::string_view b) {
    const auto is_same = [](char one, char other) {
        return std::tolower(static_cast<unsigned char>(one)) ==
               std::tolower(static_cast<unsigned char>(other));
    };
    std::vector<std::vector<std::size_t>> rows(a.size() + 1,
                                               std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t k = 0; k <= b.size(); ++k) {
            std::size_t& here = rows[i][k];
            here = i + k;
            if (i == 0 || k == 0) continue;
            const bool same = is_same(a[i - 1], b[k - 1]);
            here = std::min(
                {rows[i - 1][k] + 1, rows[i][k - 1] + 1, rows[i - 1][k - 1] + (same ? 0 : 1)});
            if (i > 1 && k > 1 && is_same(a[i - 1], b[k - 2]) && is_same(a[i - 2], b[k - 1]))
                here = std::min(here, rows[i - 2][k - 2] + 1);
        }
    }
    return rows[a.size()][b.size()];
}

}  // namespace

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
    constexpr std::size_t longest = 64;
    if (word.size() > longest) return "";
    std::size_t fewest = word.size() / 3 + 1;  // a third of the letters may be wrong
    const std::string* nearest = nullptr;
    for (const std::string& name : names) {
        if (name.size() > longest) continue;
        const std::size_t apart = letters_apart(word, name);
        if (apart > fewest || (nearest != nullptr && apart == fewest)) continue;
        if (apart >= name.size()) continue;  // nothing is equal
        fewest = apart;
        nearest = &name;
    }
    return nearest == nullptr ? "" : "; did you mean " + in_quotes(*nearest) + "?";
}

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

std::string wrapped(std::string_view text, std::size_t indent) {
    constexpr std::size_t text_width = 80;
    std::string out;
    std::size_t column = indent;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of(" \n"), text.size());
        const bool is_first = column == indent;
        if (!is_first && column + 1 + end > text_width) {
            out += '\n' + std::string(indent, ' ');
            column = indent;
        } else if (!is_first) {
            out += ' ';
            ++column;
        }
        out += text.substr(0, end);
        column += end;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out;
}

std::string help_line(const std::string& name, std::string_view text, std::size_t column) {
    std::string line = "  " + name;
    if (line.size() + 2 > column) line += '\n' + std::string(column, ' ');
    else line.resize(column, ' ');
    return line + wrapped(text, column) + '\n';
}

}  // namespace cli
