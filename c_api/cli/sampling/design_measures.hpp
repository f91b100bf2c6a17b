// The measures of the section of each design, and the limits that reject designs.
#pragma once

#include "options/arguments.hpp"

#include <harmorph_design.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace cli {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// The measures of the section, see hm_measure.
class SectionMeasures {
public:
    // curve: counted from 0. A following curve that has both ends in common with this one is its
    // base.
    SectionMeasures(const Arguments& arguments, const hm_curves& curves, std::int32_t curve);

    const std::vector<std::string>& names() const { return names_; }
    // Returns the values in the order of the names, or `unknown` for a measure that does not exist.
    // Any number of threads may call this at once.
    std::vector<double> values(const hm_curves& curves, const std::vector<double>& control) const;

private:
    void add(const std::string& name, std::int32_t kind, double station = 0);

    hm_section section_;
    std::vector<std::string> names_;
    std::vector<hm_quantity> quantities_;
};

// Limits of --min and --max by the names of columns.
class Limits {
public:
    Limits(const Arguments& arguments, const std::vector<std::string>& names);

    // Returns the reason of rejection; empty: the values are within all limits. values: in the
    // order of the names.
    std::string refusal(const std::vector<double>& values) const { return refusal_from(values, 0); }
    // Looks only at the columns from the given one on.
    std::string refusal_from(const std::vector<double>& values, std::size_t first) const;

private:
    struct Limit {
        std::size_t column;
        bool is_min;
        double value;
    };
    void take(const Arguments& arguments, const char* option, bool is_min);

    std::vector<std::string> names_;
    std::vector<Limit> limits_;
};

}  // namespace cli
