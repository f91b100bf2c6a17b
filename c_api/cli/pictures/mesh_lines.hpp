// Draws the edges of a mesh.
#pragma once

#include "mesh/mesh_file.hpp"
#include "pictures/plot.hpp"

#include <optional>
#include <string>

namespace cli {

// Draws all edges that the frame shows, with the points at x, y. Edges that are too close to each
// other to be told apart are drawn faintly, so that no region has an even dark colour. If there are
// more than 80 000 edges, points in one square of some pixels are drawn as one point. Returns a
// note on that, or "".
std::string draw_mesh(Plot& plot, const Mesh& mesh, const std::vector<double>& x,
                      const std::vector<double>& y, const std::string& attributes);

// Draws the faces on a marker, or on all markers if the marker is -1.
void draw_boundary(Plot& plot, const Mesh& mesh, std::int32_t marker,
                   const std::string& attributes);

// Returns the window around the bodies, if they are small in the mesh. A body is a loop of the
// boundary other than the one of the largest extent.
std::optional<Box> window_of_bodies(const Mesh& mesh);

// Draws the boundary of the whole mesh into a corner of the frame, and where the window is.
void draw_inset(Plot& plot, const Mesh& mesh);

}  // namespace cli
