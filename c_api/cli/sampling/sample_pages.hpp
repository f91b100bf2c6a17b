// The pages of a set: an index with thumbnails and scatter plots for browsers, and a description in
// Markdown.
#pragma once

#include "sampling/design_space.hpp"
#include "sampling/sample_table.hpp"

#include <cstdint>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace cli {

// Counts and extremes of a set, collected row by row. The memory does not depend on the number of
// rows.

struct SampleSummary {
    std::int64_t designs = 0, accepted = 0;
    std::map<std::string, std::int64_t> ways, splits, reasons;  // numbers in reasons become #
    std::vector<double> min, max;  // of the numbers of accepted designs
    // Accepted rows, evenly spread over the set; at most twice max_rows.
    std::vector<SampleRow> rows;

    void add(const SampleRow& row);

private:
    static constexpr std::size_t max_rows = 500, max_reasons = 20;
    std::int64_t stride_ = 1;  // one of so many accepted rows is kept
};

// One call of the program, which may continue an earlier one.
struct SampleRun {
    std::int64_t shards, first, designs;  // shards of the whole set, designs of this call
    double seconds;
};

void print_summary(const SampleSummary& summary, const SampleRun& run);
void print_json(const SampleSummary& summary, const SampleRun& run);

void write_sample_index(std::ostream& out, const Basis& basis, const DesignSpace& space,
                        const SampleTable& table, const SampleSummary& summary);

struct SampleDescription {
    std::string mesh, basis, settings, splits, arrays;  // arrays: see SampleShard::description()
};

void write_sample_description(std::ostream& out, const SampleDescription& description,
                              const DesignSpace& space, const SampleTable& table,
                              const SampleSummary& summary);

}  // namespace cli
