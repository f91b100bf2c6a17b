#include "formats/repeats.hpp"

#include "basics/numbers.hpp"

#include <cstdint>
#include <cstring>

namespace cli {

namespace {

constexpr std::size_t max_value_length = 64;  // characters of a number
constexpr std::int64_t max_per_word = 8,
                       max_of_few = 1000;  // numbers; at a pole all coordinates are repeated

std::int64_t count_words(std::string_view text) {
    std::int64_t words = 0;
    bool in_word = false;
    for (const char c : text) {
        const bool is_part = blanks.find(c) == blanks.npos && c != ',';
        words += is_part && !in_word ? 1 : 0;
        in_word = is_part;
    }
    return words;
}

bool is_part_of_number(char c) {
    return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.' || c == 'e' || c == 'E' ||
           c == 'd' || c == 'D';
}

}  // namespace

bool expand_repeats(const TextFile& file, std::string& expanded) {
    const std::string_view text = file.text();
    if (std::memchr(text.data(), '*', text.size()) == nullptr) return false;
    if (std::memchr(text.data(), '\0', text.size()) != nullptr) return false;  // binary
    expanded.clear();
    std::size_t copied = 0;
    bool any = false;
    std::int64_t left = max_per_word * count_words(text) + max_of_few;
    for (std::size_t star = text.find('*'); star != std::string::npos;
         star = text.find('*', star + 1)) {
        std::size_t begin = star, end = star + 1;
        while (begin > copied && text[begin - 1] >= '0' && text[begin - 1] <= '9') --begin;
        while (end < text.size() && is_part_of_number(text[end])) ++end;
        std::int64_t count = 0;
        const std::string_view value = std::string_view(text).substr(star + 1, end - star - 1);
        const bool is_value = !value.empty() && value.size() <= max_value_length;
        if (!is_value || !parse(std::string_view(text).substr(begin, star - begin), count) ||
            count < 1)
            continue;
        if (count > left) {
            file.fail(begin, "the repeat count " + std::to_string(count) +
                                 " is larger than any in a grid with so few numbers");
        }
        left -= count;
        expanded.append(text, copied, begin - copied);
        for (std::int64_t i = 0; i < count; ++i) expanded.append(i == 0 ? "" : " ").append(value);
        copied = end;
        any = true;
    }
    expanded.append(text, copied, std::string::npos);
    return any;
}

}  // namespace cli
