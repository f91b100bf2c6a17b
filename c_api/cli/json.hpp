// Writes JSON.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

class JsonObject {
public:
    JsonObject& add(const std::string& key, double value); // infinite and NaN: null
    JsonObject& add(const std::string& key, bool value);
    JsonObject& add(const std::string& key, std::int64_t value);
    JsonObject& add(const std::string& key, std::int32_t value) { return add(key, std::int64_t{value}); }
    JsonObject& add(const std::string& key, const std::string& value);
    JsonObject& add(const std::string& key, const std::vector<JsonObject>& values);
    std::string text() const { return "{" + members_ + "}"; }

private:
    JsonObject& add_member(const std::string& key, const std::string& value);

    std::string members_;
};

} // namespace cli
