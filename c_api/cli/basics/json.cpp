#include "basics/json.hpp"

#include "basics/numbers.hpp"
#include "basics/print.hpp"

#include <cmath>

namespace cli {

namespace {

std::string json_string(std::string_view text) {
    std::string result = "\"";
    while (!text.empty()) {
        const char c = text[0];
        const std::size_t bytes = readable_character(text);
        if (c == '"' || c == '\\') result += '\\';
        if (static_cast<unsigned char>(c) < ' ') {
            result += "\\u" + hexadecimal(static_cast<unsigned char>(c), 4);
        } else if (bytes == 0) {
            result += '\\' + byte_in_hexadecimal(c);
        }
        result += text.substr(0, bytes);
        text.remove_prefix(bytes > 0 ? bytes : 1);
    }
    return result + "\"";
}

}  // namespace

JsonObject& JsonObject::add(std::string_view key, double value) {
    return add_member(key, std::isfinite(value) ? exact(value) : "null");
}

JsonObject& JsonObject::add(std::string_view key, bool value) {
    return add_member(key, value ? "true" : "false");
}

JsonObject& JsonObject::add(std::string_view key, std::int64_t value) {
    return add_member(key, std::to_string(value));
}

JsonObject& JsonObject::add(std::string_view key, const std::string& value) {
    return add_member(key, json_string(value));
}

JsonObject& JsonObject::add(std::string_view key, const std::vector<JsonObject>& values) {
    std::string list;
    for (const JsonObject& value : values) list += (list.empty() ? "" : ", ") + value.text();
    return add_member(key, "[" + list + "]");
}

JsonObject& JsonObject::add_member(std::string_view key, const std::string& value) {
    members_ += (members_.empty() ? "" : ", ") + json_string(key) + ": " + value;
    return *this;
}

}  // namespace cli
