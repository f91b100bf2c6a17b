// The splits of a set for machine learning: designs outside a range, and the other designs divided
// at random into training and tests.
#pragma once

#include "options/arguments.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

class SampleSplits {
public:
    // names: the columns that may have a range.
    SampleSplits(const Arguments& arguments, const std::vector<std::string>& names);

    // Returns "out" if a value is not inside its range, otherwise "train" or "test", which depends
    // on the seed and the number of the design only.
    std::string split(std::int64_t design, const std::vector<double>& values) const;
    std::string description() const;


private:
    struct Range {
        std::string name;
        std::size_t column;
        double low, high;
    };

    std::vector<Range> ranges_;
    double test_;
    std::uint64_t seed_;
};

}  // namespace cli
