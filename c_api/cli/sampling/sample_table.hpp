// The table of designs: a line of names, then a line for each design. The tables of the shards and
// of the whole set have the same lines.
#pragma once

#include "options/arguments.hpp"
#include "sampling/design_measures.hpp"
#include "sampling/design_morph.hpp"
#include "sampling/sample_folder.hpp"

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

struct SampleRow {
    std::int64_t design = 0;  // from 0
    std::string split;        // train, test, out; empty: the design is rejected
    std::int64_t shard = 0, row = -1;
    std::string way, section, reason;
    std::vector<double> numbers;  // see SampleTable::numbers()

    bool is_accepted() const { return reason.empty(); }
};

class SampleTable {
public:
    SampleTable(const DesignSpace& space, const std::vector<std::string>& measures, bool has_step);

    // Names of the numbers of each row: results, measures and the parameters that vary. Limits and
    // splits use these names.
    const std::vector<std::string>& numbers() const { return numbers_; }
    const std::vector<std::size_t>& shown_parameters() const { return shown_; }
    // The results of the morph come first, then the measures of the section.
    std::size_t first_measure() const { return 2u + (has_step_ ? 1 : 0) + (has_fit_ ? 1 : 0); }
    std::size_t first_parameter() const { return numbers_.size() - shown_.size(); }
    std::vector<double> numbers_of(const MorphedDesign& result) const;

    void write_names(std::ostream& out) const;
    void write(std::ostream& out, const SampleRow& row) const;

    // Calls take(row) for each line of the tables of the first n shards, in order.
    void read(const SampleFolder& folder, std::int64_t shards,
              const std::function<void(const SampleRow&)>& take) const;

private:
    bool has_fit_, has_step_;
    std::vector<std::string> numbers_;
    std::vector<std::size_t> shown_;
};

// The splits of a set for machine learning: designs outside a range, and the other designs divided
// at random into training and tests.

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
