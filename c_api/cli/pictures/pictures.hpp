// The pictures of the program, as SVG documents. Without a given window, a picture shows the body,
// or the whole mesh if there is none.
#pragma once

#include "basics/geometry.hpp"
#include "work/morph.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cli {

// Draws the mesh with its boundaries in colours, or the boundaries alone, and B-splines with their
// control points if there are curves.
std::string mesh_picture(const Mesh& mesh, bool boundaries_alone, const hm_curves& curves,
                         const std::optional<Box>& window = {});

// Draws the volumes of these points: those of the median dual, for which fluxes are balanced, or
// the cells at each point, from which the gradient at the point is computed.
enum class Volume { dual, gradient };
std::string volume_picture(const Mesh& mesh, const std::vector<std::int32_t>& points, Volume kind,
                           const std::optional<Box>& window = {});

// Draws the mesh before in blue and after in red, with the curves and their numbered control
// points.
std::string morph_picture(const Mesh& mesh, const Basis& basis, const Morph& morph,
                          const std::optional<Box>& window = {});

// Draws the boundary alone: the moved B-spline, and the mesh points that the functions moved.
std::string boundary_picture(const Basis& basis, const Morph& morph);

// Draws functions in colours with contour lines, each in a panel, all with one scale.
struct FunctionPanel {
    const Basis* basis;
    std::int32_t function;       // counted from 0
    std::int32_t number;         // number of a value: real and imaginary part, or xx, xy, yx, yy
    std::vector<double> values;  // at the mesh points
};
std::string function_picture(const Mesh& mesh, std::vector<FunctionPanel> panels,
                             const std::optional<Box>& window = {});
// Returns the step between the contour lines of the picture for the same window.
double contour_step(const Mesh& mesh, const std::vector<FunctionPanel>& panels, const Box& window);
Box function_window(const Mesh& mesh, const Basis& basis);

// Draws the volumes that agglomeration has merged, each level in a panel.
struct Level {
    std::int32_t number = 0, n_cells = 0;
    std::vector<std::int32_t> cells;  // merged cell of each point, or -1 if the value is known
};
std::string level_picture(const Mesh& mesh, const hm_curves& curves,
                          const std::vector<Level>& levels, const Box& window);

}  // namespace cli
