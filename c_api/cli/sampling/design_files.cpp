#include "sampling/design_files.hpp"

#include "files/output_file.hpp"
#include "formats/format.hpp"
#include "formats/vtu.hpp"

namespace cli {

namespace {

std::string all_endings_of(const std::string& path) {
    const std::size_t name = path.find_last_of('/') + 1, dot = path.find('.', name);
    return dot == std::string::npos ? "" : path.substr(dot);
}

}  // namespace

DesignFiles::DesignFiles(const Arguments& arguments, const Mesh& mesh)
    : mesh_(mesh),
      ending_(all_endings_of(arguments.operand(0))),
      has_meshes_(arguments.has("--meshes")),
      has_vtk_(arguments.has("--vtk")) {
    const bool is_folder = mesh_file(arguments.operand(0)) != arguments.operand(0);
    if (has_meshes_ && is_folder)
        arguments.refuse("--meshes: a mesh in a folder cannot be written many times");
}

void DesignFiles::write(const SampleFolder& folder, const MorphedDesign& design,
                        std::int64_t number) const {
    if (!has_meshes_ && !has_vtk_) return;
    Field moved(mesh_.x.size());
    for (std::size_t k = 0; k < mesh_.x.size(); ++k) {
        moved.x[k] = design.coordinates[2 * k];
        moved.y[k] = design.coordinates[2 * k + 1];
    }
    OutputFiles files;
    if (has_meshes_)
        write_moved(files.add(folder.mesh_of(number, ending_)), mesh_, moved.x.data(),
                    moved.y.data());
    if (has_vtk_) {
        Field displacement(mesh_.x.size());
        for (std::size_t k = 0; k < mesh_.x.size(); ++k) {
            displacement.x[k] = moved.x[k] - mesh_.x[k];
            displacement.y[k] = moved.y[k] - mesh_.y[k];
        }
        write_vtu(files.add(folder.vtk_of(number)), mesh_, moved.x, moved.y,
                  {displacement_data(displacement)});
    }
    files.commit();
}

}  // namespace cli
