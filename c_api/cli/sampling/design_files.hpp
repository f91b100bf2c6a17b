// The mesh files of single designs: one in the format of the given mesh, one for ParaView.
#pragma once

#include "mesh/mesh_file.hpp"
#include "options/arguments.hpp"
#include "sampling/design_morph.hpp"
#include "sampling/sample_folder.hpp"

#include <cstdint>
#include <string>

namespace cli {

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
