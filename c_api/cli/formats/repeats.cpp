#include "formats/repeats.hpp"

#include "basics/numbers.hpp"

#include <cstdint>
#include <cstring>

namespace cli {

namespace {

constexpr std::int64_t most_repeats = INT32_MAX;
constexpr std::size_t most_bytes = SIZE_MAX >> (sizeof(std::size_t) > 4 ? 28 : 2);

bool is_part_of_number(char c) {
    return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.' || c == 'e' || c == 'E' ||
           c == 'd' || c == 'D';
}

}  // namespace

bool expand_repeats(const std::string& text, std::string& expanded) {
    if (std::memchr(text.data(), '*', text.size()) == nullptr) return false;
    if (std::memchr(text.data(), '\0', text.size()) != nullptr) return false;  // binary
    expanded.clear();
    std::size_t copied = 0;
    bool any = false;
    for (std::size_t star = text.find('*'); star != std::string::npos;
         star = text.find('*', star + 1)) {
        std::size_t begin = star, end = star + 1;
        while (begin > copied && text[begin - 1] >= '0' && text[begin - 1] <= '9') --begin;
        while (end < text.size() && is_part_of_number(text[end])) ++end;
        std::int64_t count = 0;
        const std::string value = text.substr(star + 1, end - star - 1);
        if (value.empty() || !parse(std::string_view(text).substr(begin, star - begin), count))
            continue;
        const bool fits =
            static_cast<std::size_t>(count) < (most_bytes - expanded.size()) / (value.size() + 1);
        if (count < 1 || count > most_repeats || !fits) continue;
        expanded.append(text, copied, begin - copied);
        for (std::int64_t i = 0; i < count; ++i) expanded.append(i == 0 ? "" : " ").append(value);
        copied = end;
        any = true;
    }
    expanded.append(text, copied, std::string::npos);
    return any;
}

}  // namespace cli
