// The pictures of the program, as SVG documents. A window that is not wished shows what the picture
// is about.
#pragma once

#include "basics/geometry.hpp"
#include "commands/morph.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cli {

// The mesh with its boundaries in colours; the boundaries alone; B-splines with their control
// points, where there are any.
std::string mesh_picture(const Mesh& mesh, bool boundaries_alone, const hm_curves& curves,
                         const std::optional<Box>& window = {});

// The volumes round these points: of the median dual, over which fluxes are balanced, or the cells
// round each point, over which gradients at points are formed.
enum class Volume { dual, gradient };
std::string volume_picture(const Mesh& mesh, const std::vector<std::int32_t>& points, Volume kind,
                           const std::optional<Box>& window = {});

// The mesh before in blue and after in red, with the curves and their numbered control points.
std::string morph_picture(const Mesh& mesh, const Basis& basis, const Morph& morph,
                          const std::optional<Box>& window = {});

// The boundary alone: the moved B-spline, and on it the mesh's points as the functions moved them.
std::string boundary_picture(const Basis& basis, const Morph& morph);

// Functions in colours with contour lines, a panel for each, all with one scale.
struct FunctionPanel {
    const Basis* basis;
    std::int32_t function;  // from 0
    std::int32_t number;    // of the function's value: real and imaginary part, or xx, xy, yx, yy
    std::vector<double> values;  // at the mesh's points
};
std::string function_picture(const Mesh& mesh, std::vector<FunctionPanel> panels,
                             const std::optional<Box>& window = {});
// The step between contour lines of the picture, for the same window.
double contour_step(const Mesh& mesh, const std::vector<FunctionPanel>& panels, const Box& window);
Box function_window(const Mesh& mesh, const Basis& basis);

// The volumes that agglomeration has merged, a panel for each level.
struct Level {
    std::int32_t number = 0, n_cells = 0;
    std::vector<std::int32_t> cells;  // of each point; -1: its value is known
};
std::string level_picture(const Mesh& mesh, const hm_curves& curves,
                          const std::vector<Level>& levels, const Box& window);

}  // namespace cli
