// How all commands read a mesh.
#pragma once

#include "formats/format.hpp"
#include "options/arguments.hpp"

#include <string>

namespace cli {

// Reads a mesh, and warns of all parts of the file that were ignored. Commands that read meshes
// have both options.
Mesh read_mesh(const Arguments& arguments, std::size_t operand);
Mesh read_mesh(const std::string& path, const ReadOptions& options = {});

}  // namespace cli
