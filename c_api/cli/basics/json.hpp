// Writes JSON.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

class JsonObject {
public:
    JsonObject& add(std::string_view key, double value);  // infinities and NaN become null
    JsonObject& add(std::string_view key, bool value);
    JsonObject& add(std::string_view key, std::int64_t value);
    JsonObject& add(std::string_view key, std::int32_t value) {
        return add(key, std::int64_t{value});
    }
    JsonObject& add(std::string_view key, const std::string& value);
    JsonObject& add(std::string_view key, const std::vector<JsonObject>& values);
    std::string text() const { return "{" + members_ + "}"; }

private:
    JsonObject& add_member(std::string_view key, const std::string& value);

    std::string members_;
};

}  // namespace cli
