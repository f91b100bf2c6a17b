#include "options/window_option.hpp"

#include "basics/numbers.hpp"
#include "files/text_file.hpp"

namespace cli {

std::optional<Box> window_of(const Arguments& arguments) {
    if (!arguments.has("--window")) return std::nullopt;
    const std::string text = arguments.text("--window");
    double number[4] = {};
    std::size_t begin = 0, n = 0;
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        if (n == 4 || !parse(std::string_view(text).substr(begin, end - begin), number[n++])) {
            n = 0;
            break;
        }
        begin = end + 1;
    }
    const Box window = {{number[0], number[1]}, {number[2], number[3]}};
    if (n == 4 && window.width() > 0 && window.height() > 0) return window;
    arguments.refuse("--window expects X,Y,X,Y, the lower left and the upper right corner, not " +
                     in_quotes(text));
}

}  // namespace cli
