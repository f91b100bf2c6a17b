// Values of options that consist of several numbers separated by commas.
#pragma once

#include "basics/numbers.hpp"
#include "options/arguments.hpp"

#include <string>
#include <vector>

namespace cli {

inline std::vector<double> number_list(const Arguments& arguments, std::string_view option) {
    const std::string text = arguments.text(option);
    std::vector<double> numbers;
    for (std::size_t from = 0; from <= text.size();) {
        std::size_t to = text.find(',', from);
        if (to == std::string::npos) to = text.size();
        double number = 0;
        if (!parse(std::string_view(text).substr(from, to - from), number)) {
            arguments.refuse(std::string(option) +
                             " expects numbers with commas between them, not '" + text + "'");
        }
        numbers.push_back(number);
        from = to + 1;
    }
    return numbers;
}

}  // namespace cli
