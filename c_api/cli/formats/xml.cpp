#include "formats/xml.hpp"

#include <algorithm>

namespace cli {

std::string_view XmlTag::attribute(std::string_view key) const {
    const auto lower = [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    };
    for (const auto& [name_of_one, value] : attributes) {
        if (std::equal(name_of_one.begin(), name_of_one.end(), key.begin(), key.end(),
                       [&](char a, char b) { return lower(a) == lower(b); }))
            return value;
    }
    return {};
}

std::size_t XmlReader::text_end() const {
    return std::min(file_.text().find('<', tag_.end), file_.text().size());
}

bool XmlReader::next() {
    const std::string_view text = file_.text();
    for (;;) {
        const std::size_t begin = text_end();
        if (begin == text.size()) return false;
        const bool is_comment = text.substr(begin, 4) == "<!--";
        const bool is_declaration =
            !is_comment && (text.substr(begin, 2) == "<?" || text.substr(begin, 2) == "<!");
        tag_ = {};
        tag_.begin = begin;
        if (!is_comment && !is_declaration) {
            read_attributes(begin + 1);
            return true;
        }
        const std::string_view closing = is_comment ? "-->" : ">";
        const std::size_t end = text.find(closing, begin);
        if (end == text.npos)
            file_.fail(begin, is_comment ? "the comment has no end" : "the declaration has no end");
        tag_.end = end + closing.size();
    }
}

// Reads NAME KEY="VALUE" KEY='VALUE' ... after the character <, up to > or />.
void XmlReader::read_attributes(std::size_t at) {
    const std::string_view text = file_.text();
    const auto over_blanks = [&] {
        at = std::min(text.find_first_not_of(blanks, at), text.size());
    };
    const auto no_end = [&] {
        file_.fail(tag_.begin, "the tag <" + std::string(tag_.name) + " has no end");
    };
    const std::size_t name_end = std::min(text.find_first_of(" \t\r\n>/", at + 1), text.size());
    tag_.name = text.substr(at, std::min<std::size_t>(name_end - at, 64));
    at = name_end;
    for (over_blanks(); at < text.size() && text[at] != '>'; over_blanks()) {
        if (text[at] == '/') {
            tag_.is_empty = true;
            ++at;
            continue;
        }
        const std::size_t equals = text.find_first_of("=<>", at);
        if (equals == text.npos) no_end();
        if (text[equals] != '=')
            file_.fail(at, "the tag <" + std::string(tag_.name) +
                               " needs an attribute KEY=\"VALUE\" here");
        const std::string_view key = trimmed(text.substr(at, equals - at));
        at = equals + 1;
        over_blanks();
        if (at == text.size()) no_end();
        if (text[at] != '"' && text[at] != '\'')
            file_.fail(at, "the file needs quotation marks after " + in_quotes(key) + "=");
        const std::size_t end = text.find(text[at], at + 1);
        if (end == text.npos) file_.fail(at, "the value of " + in_quotes(key) + " has no end");
        tag_.attributes.emplace_back(key, text.substr(at + 1, end - at - 1));
        at = end + 1;
    }
    if (at == text.size()) no_end();
    tag_.end = at + 1;
}

}  // namespace cli
