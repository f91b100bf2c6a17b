#include "formats/xml.hpp"

#include "basics/numbers.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace cli {

namespace {

struct Entity {
    char character;
    std::string_view name;
};
constexpr Entity entities[] = {
    {'<', "lt"}, {'>', "gt"}, {'&', "amp"}, {'"', "quot"}, {'\'', "apos"}};

// Appends the character of an entity, named without & and ;. Returns false if there is no such one.
bool append_entity(std::string_view name, std::string& to) {
    for (const Entity& entity : entities) {
        if (entity.name != name) continue;
        to += entity.character;
        return true;
    }
    if (name.substr(0, 1) != "#") return false;
    const bool is_hexadecimal = name.size() > 1 && (name[1] == 'x' || name[1] == 'X');
    const std::string_view digits = name.substr(is_hexadecimal ? 2 : 1);
    std::int64_t number = 0;
    const std::size_t n = parse_front(digits, number, is_hexadecimal ? 16 : 10);
    if (n == 0 || n < digits.size() || number <= 0 || number > 0x10ffff) return false;
    const auto code = static_cast<std::uint32_t>(number);
    if (code >= 0xd800 && code < 0xe000) return false;  // half of a pair of UTF-16
    const auto add = [&to](std::uint32_t byte) { to += static_cast<char>(byte); };
    const auto tail = [&](int shift) { add(0x80 | (code >> shift & 0x3f)); };
    if (code < 0x80) {
        add(code);
    } else if (code < 0x800) {
        add(0xc0 | code >> 6), tail(0);
    } else if (code < 0x10000) {
        add(0xe0 | code >> 12), tail(6), tail(0);
    } else {
        add(0xf0 | code >> 18), tail(12), tail(6), tail(0);
    }
    return true;
}

}  // namespace

std::string xml_decoded(std::string_view value) {
    std::string text;
    while (!value.empty()) {
        const std::size_t begin = std::min(value.find('&'), value.size());
        text += value.substr(0, begin);
        value.remove_prefix(begin);
        const std::size_t end = value.find(';');
        if (end != value.npos && append_entity(value.substr(1, end - 1), text)) {
            value.remove_prefix(end + 1);
        } else if (!value.empty()) {
            text += value[0];
            value.remove_prefix(1);
        }
    }
    return text;
}

std::string xml_encoded(std::string_view text) {
    std::string value;
    for (const char c : text) {
        const auto* const entity =
            std::find_if(std::begin(entities), std::end(entities),
                         [c](const Entity& one) { return one.character == c; });
        const bool is_space = c == '\t' || c == '\n' || c == '\r';
        if (entity != std::end(entities)) value += '&' + std::string(entity->name) + ';';
        else if (is_space) value += "&#" + std::to_string(static_cast<int>(c)) + ';';
        else value += static_cast<unsigned char>(c) < 32 ? '_' : c;
    }
    return value;
}

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
