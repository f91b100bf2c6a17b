// The folder that `harmorph sample` fills:
//
//     set.txt              the options and the check sums of the files that the set was made from
//     shards/00001.csv     the designs of a shard, rejected ones too
//     shards/00001.npz     the accepted designs of the shard
//     shards/00001.distance.npz   the distances to the walls
//     meshes/, vtk/        files of single meshes
//     designs.csv, index.html, README.md   when all designs are done
//
// A shard is complete when its .npz exists, which is the last of its files.
#pragma once

#include "files/own_folder.hpp"
#include "mesh/mesh_file.hpp"
#include "options/arguments.hpp"
#include "sampling/design_morph.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cli {

// Returns the text of set.txt: two calls with the same text make the same files.
std::string settings_of_set(const Arguments& arguments);

class SampleFolder {
public:
    explicit SampleFolder(const std::string& path) : path_(path) {}

    std::string file(const std::string& name) const { return path_ + "/" + name; }
    std::string table_of(std::int64_t shard) const { return shard_file(shard, ".csv"); }
    std::string arrays_of(std::int64_t shard) const { return shard_file(shard, ".npz"); }
    std::string distances_of(std::int64_t shard) const {
        return shard_file(shard, ".distance.npz");
    }
    // Returns the file of one mesh; designs are counted from 0 here and from 1 in names.
    std::string mesh_of(std::int64_t design, const std::string& ending) const;
    std::string vtk_of(std::int64_t design) const;

    // Makes the folders. Refuses a folder that is not empty and has no set.txt, one whose set.txt
    // has another text, and one that another run fills. Removes incomplete files of a run that was
    // killed. The folder is locked as long as this object exists.
    void open(const std::string& settings, bool has_meshes, bool has_vtk);
    std::int64_t complete_shards() const;  // the shards 1 .. n have all files

private:
    std::string shard_file(std::int64_t shard, const char* ending) const;

    std::string path_;
    std::optional<OwnFolder> owned_;
};

// The mesh files of single designs: one in the format of the given mesh, one for ParaView.

class DesignFiles {
public:
    // Refuses --meshes for a mesh that is a folder. The mesh must outlive this object.
    DesignFiles(const Arguments& arguments, const Mesh& mesh);

    bool has_meshes() const { return has_meshes_; }
    bool has_vtk() const { return has_vtk_; }
    // Writes the files of one accepted design, counted from 0.
    void write(const SampleFolder& folder, const MorphedDesign& design, std::int64_t number) const;

private:
    const Mesh& mesh_;
    std::string ending_;  // the extension of the given mesh
    bool has_meshes_, has_vtk_;
};

}  // namespace cli
