#include "options/place_options.hpp"

#include "basics/library.hpp"
#include "basics/numbers.hpp"
#include "basics/text.hpp"

#include <set>
#include <string>

namespace cli {

std::optional<Box> window_of(const Arguments& arguments) {
    if (!arguments.has("--window")) return std::nullopt;
    const std::string text = arguments.text("--window");
    std::vector<double> number;
    if (parse_list(text, number) && number.size() == 4) {
        const Box window = {{number[0], number[1]}, {number[2], number[3]}};
        if (window.width() > 0 && window.height() > 0) return window;
    }
    arguments.refuse("--window expects X,Y,X,Y, the lower left and the upper right corner, not " +
                     in_quotes(text));
}

hm_section section_of(const Arguments& arguments) {
    auto section = sized<hm_section>();
    if (!arguments.has("--chord")) return section;
    const std::vector<double> chord = arguments.number_list("--chord");
    if (chord.size() != 4) arguments.refuse("--chord expects four numbers X,Y,X,Y");
    section.leading_x = chord[0];
    section.leading_y = chord[1];
    section.trailing_x = chord[2];
    section.trailing_y = chord[3];
    return section;
}

std::vector<double> stations_of(const Arguments& arguments) {
    const std::vector<double> stations = arguments.number_list("--stations");
    std::set<std::string> names;
    for (const double station : stations) {
        if (!(station > 0 && station < 1))
            arguments.refuse("--stations: a station must lie between 0 and 1, not " +
                             brief(station));
        if (!names.insert(brief(station)).second)
            arguments.refuse("--stations: two stations have the name " + brief(station) +
                             ", as names have four digits");
    }
    return stations;
}

}  // namespace cli
