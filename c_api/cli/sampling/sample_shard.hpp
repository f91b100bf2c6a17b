// Writes one shard of a set: the table of its designs, and the arrays of the accepted designs.
#pragma once

#include "files/output_file.hpp"
#include "sampling/npz.hpp"
#include "sampling/sample_table.hpp"
#include "sampling/wall_chains.hpp"
#include "sampling/wall_distances.hpp"

#include <memory>
#include <vector>

namespace cli {

class SampleShard {
public:
    // walls, distances: NULL if the set has no arrays of walls, or no distances to them.
    SampleShard(const SampleFolder& folder, std::int64_t number, const Mesh& mesh,
                const SampleTable& table, const WallChains* walls, WallDistances* distances);
    SampleShard(const SampleShard&) = delete;

    std::int64_t accepted() const { return accepted_; }
    void add(SampleRow row, const MorphedDesign& result);
    void commit();  // completes the files

    // Returns the names and meanings of the arrays, as lines of a table in Markdown.
    static std::string description(const SampleTable& table, const Mesh& mesh,
                                   const WallChains* walls);

private:
    void append(std::vector<double>& to, const std::vector<double>& from) const;

    std::int64_t number_, accepted_ = 0;
    const Mesh& mesh_;
    const SampleTable& table_;
    const WallChains* walls_;
    OutputFiles files_;
    std::ostream& csv_;
    WallDistances* distances_;
    std::ostream* distance_out_;  // NULL: there are no distances
    std::ostream& out_;           // the last file, which makes the shard complete
    NpzWriter npz_;
    std::unique_ptr<NpzWriter> distance_npz_;
    std::vector<double> numbers_, control_, normals_, arcs_;
    std::vector<std::int32_t> designs_;
    std::vector<std::uint8_t> splits_;
};

}  // namespace cli
