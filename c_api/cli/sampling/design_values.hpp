// The parameters of designs and their values: from a sequence within ranges, or from a table.
#pragma once

#include "sampling/latin.hpp"
#include "sampling/sobol.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cli {

struct DesignParameter {
    std::string name;
    double low = 0, high = 0;
};

enum class Sequence { sobol, latin };

class DesignValues {
public:
    DesignValues() = default;  // designs without parameters

    // Values between `low` and `high` of each parameter. A parameter with low = high is constant
    // and takes no dimension of the sequence.
    static DesignValues of_sequence(std::vector<DesignParameter> parameters, Sequence sequence,
                                    std::int64_t n, std::uint64_t seed);

    // Reads a table: a line with names of `parameters`, then a line of numbers for each design;
    // columns are separated by commas or blanks. Parameters that the table does not have keep the
    // value 0. The ranges become those of the table.
    static DesignValues of_table(const std::string& path, std::vector<DesignParameter> parameters);

    const std::vector<DesignParameter>& parameters() const { return parameters_; }
    std::int64_t count() const { return count_; }
    std::vector<double> values(std::int64_t design) const;  // designs are counted from 0 here

private:
    std::vector<DesignParameter> parameters_;
    std::int64_t count_ = 0;
    std::optional<Sobol> sobol_;
    std::optional<LatinHypercube> latin_;
    std::vector<double> table_;
};

// Reads lines "NAME LOW HIGH" and sets the ranges of the parameters of these names.
void read_ranges(const std::string& path, std::vector<DesignParameter>& parameters);

}  // namespace cli
