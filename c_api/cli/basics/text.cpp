#include "basics/text.hpp"

#include "basics/print.hpp"

#include <algorithm>

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

}  // namespace cli
