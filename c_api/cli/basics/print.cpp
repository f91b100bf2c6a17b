#include "basics/print.hpp"

#include "basics/readable.hpp"

#include <cstdarg>
#include <cstdio>
#include <vector>

namespace cli {

void print(const char* format, ...) {
    std::va_list values, again;
    va_start(values, format);
    va_copy(again, values);
    const int length = std::vsnprintf(nullptr, 0, format, values);
    va_end(values);
    std::vector<char> text(static_cast<std::size_t>(length < 0 ? 0 : length) + 1);
    std::vsnprintf(text.data(), text.size(), format, again);
    va_end(again);
    std::fputs(readable({text.data(), text.size() - 1}, true).c_str(), stdout);
}

void print_error(const std::string& message) {
    std::fprintf(stderr, "harmorph: %s\n", readable(message, true).c_str());
}

void warn(const std::string& message) { print_error("warning: " + message); }

void warn_of(const std::string& path, const std::vector<std::string>& sentences) {
    for (const std::string& sentence : sentences) warn(path + ": " + sentence);
}

}  // namespace cli
