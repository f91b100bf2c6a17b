#include "sampling/sample_splits.hpp"

#include "basics/numbers.hpp"
#include "files/text_file.hpp"
#include "sampling/mixed_bits.hpp"

#include <algorithm>

namespace cli {

SampleSplits::SampleSplits(const Arguments& arguments, const std::vector<std::string>& names)
    : test_(arguments.real("--test", .2, 0, 1)),
      seed_(static_cast<std::uint64_t>(arguments.whole("--seed", 1, 0, 1000000000))) {
    for (const std::string& text : arguments.all("--inside")) {
        const auto [name, bound] = arguments.named_numbers("--inside", text, 2, "NAME=LOW,HIGH");
        if (bound[0] > bound[1])
            arguments.refuse("--inside expects NAME=LOW,HIGH, found " + in_quotes(text));
        Range range = {name, 0, bound[0], bound[1]};
        const auto found = std::find(names.begin(), names.end(), range.name);
        if (found == names.end())
            arguments.refuse("--inside: " + in_quotes(range.name) +
                             " is neither a parameter that varies nor a measure");
        range.column = static_cast<std::size_t>(found - names.begin());
        ranges_.push_back(range);
    }
}

std::string SampleSplits::split(std::int64_t design, const std::vector<double>& values) const {
    for (const Range& range : ranges_) {
        const double value = values[range.column];
        if (!(range.low <= value && value <= range.high)) return "out";
    }
    constexpr std::uint64_t purpose = 0x73706c6974;  // so that numbers differ from the sequence
    const double lot =
        unit_number(mixed_bits(mixed_bits(purpose, seed_), static_cast<std::uint64_t>(design)));
    return lot < test_ ? "test" : "train";
}

std::string SampleSplits::description() const {
    std::string text;
    for (const Range& range : ranges_)
        text += "Designs with " + range.name + " outside " + brief(range.low) + " .. " +
                brief(range.high) + " are in the split `out`. ";
    return text + "Each of the other designs is in the split `test` with probability " +
           brief(test_) + " (seed " + std::to_string(seed_) + "), else in `train`.";
}

}  // namespace cli
