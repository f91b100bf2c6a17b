// The pages of a set: an index with thumbnails and scatter plots for browsers, and a description in
// Markdown.
#pragma once

#include "sampling/design_space.hpp"
#include "sampling/sample_summary.hpp"

#include <iosfwd>
#include <string>

namespace cli {

void write_sample_index(std::ostream& out, const Basis& basis, const DesignSpace& space,
                        const SampleTable& table, const SampleSummary& summary);

struct SampleDescription {
    std::string mesh, basis, settings, splits, arrays;  // arrays: see SampleShard::description()
};

void write_sample_description(std::ostream& out, const SampleDescription& description,
                              const DesignSpace& space, const SampleTable& table,
                              const SampleSummary& summary);

}  // namespace cli
