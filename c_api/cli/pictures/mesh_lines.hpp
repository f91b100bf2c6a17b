// Draws the edges of a mesh.
#pragma once

#include "mesh/mesh_file.hpp"
#include "pictures/plot.hpp"

#include <string>

namespace cli {

// Draws all edges that the frame shows, with the points at x, y. If there are more than 80 000 of
// them, points in one square of some pixels are drawn as one point. Returns a note on that, or "".
std::string draw_mesh(Plot& plot, const Mesh& mesh, const std::vector<double>& x,
                      const std::vector<double>& y, const std::string& attributes);

// Draws the faces on a marker, or on all markers if the marker is -1.
void draw_boundary(Plot& plot, const Mesh& mesh, std::int32_t marker,
                   const std::string& attributes);

}  // namespace cli
