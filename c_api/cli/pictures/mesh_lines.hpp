// The edges of a mesh in pictures.
#pragma once

#include "mesh/mesh_file.hpp"
#include "pictures/plot.hpp"

#include <string>

namespace cli {

// All edges that the frame shows, with the points at x, y. Above 80 000 of them, points in one
// square of some pixels are drawn as one. Returns what to say of that, or "".
std::string draw_mesh(Plot& plot, const Mesh& mesh, const std::vector<double>& x,
                      const std::vector<double>& y, const std::string& attributes);

// The faces on a marker, or, with -1, on all of them.
void draw_boundary(Plot& plot, const Mesh& mesh, std::int32_t marker,
                   const std::string& attributes);

}  // namespace cli
