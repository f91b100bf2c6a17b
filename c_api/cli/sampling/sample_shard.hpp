// Writes one shard of a set: the table of its designs, and the arrays of the accepted designs.
#pragma once

#include "files/output_file.hpp"
#include "files/threads.hpp"
#include "mesh/mesh_analysis.hpp"
#include "mesh/mesh_file.hpp"
#include "sampling/npz.hpp"
#include "sampling/sample_table.hpp"

#include <harmorph_fields.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace cli {

// The points of walls in order, with normals and arc lengths on moved meshes.

class WallChains {
public:
    // markers: those of the walls. A closed piece begins at the point of the largest x.
    WallChains(const Mesh& mesh, const std::vector<std::int32_t>& markers);

    const std::vector<std::int32_t>& points() const { return points_; }
    // Piece k has the points start[k] .. start[k+1] - 1. The first point of a closed piece is not
    // repeated.
    const std::vector<std::int32_t>& start() const { return start_; }

    // Appends the unit normals, as pairs, and the arc lengths. coordinates: pairs of all mesh
    // points. The normal is that of the line between both neighbours, into the mesh.
    void measure(const std::vector<double>& coordinates, std::vector<double>& normals,
                 std::vector<double>& arcs) const;

private:
    std::vector<std::int32_t> points_, start_ = {0};
    std::vector<bool> is_loop_;
};

// Distances of all mesh points to the moving walls, on one moved mesh after the other.

class WallDistances {
public:
    // markers: those of the walls.
    WallDistances(const Mesh& mesh, const std::vector<std::int32_t>& markers,
                  const Threads& threads);
    WallDistances(const WallDistances&) = delete;

    // coordinates: pairs of all mesh points. The array stays valid until the next call.
    const std::vector<double>& values(const std::vector<double>& coordinates);

private:
    const Mesh& mesh_;
    const Threads& threads_;
    Block block_;
    hm_walls* walls_ = nullptr;
    std::vector<std::int32_t> faces_;  // the nearest faces on the preceding mesh, as hints
    std::vector<double> distances_;
};

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
