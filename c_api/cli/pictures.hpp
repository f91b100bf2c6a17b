// The pictures of the program, as SVG documents.
#pragma once

#include "csv.hpp"
#include "geometry.hpp"
#include "morph.hpp"

#include <string>

namespace cli {

// The mesh before in blue and after in red, with the curves and their numbered control points, zoomed to the body.
std::string morph_picture(const Mesh& mesh, const Basis& basis, const Morph& morph);
// The same, of what lies in the window.
std::string morph_picture(const Mesh& mesh, const Basis& basis, const Morph& morph, const Box& window);

// The boundary alone: the moved B-spline, and on it the mesh's points as the functions moved them.
std::string boundary_picture(const Basis& basis, const Morph& morph);

// One function (from 0) as filled cells, with a colour bar. values: at the mesh's points.
std::string function_picture(const Mesh& mesh, const Basis& basis, std::int32_t function, const Column& column);
std::string function_picture(const Mesh& mesh, const Basis& basis, std::int32_t function, const Column& column,
                             const Box& window);

// The cells that agglomeration has merged on one level, round the curves.
struct Level {
    std::int32_t number = 0, n_cells = 0;
    std::vector<std::int32_t> cells; // of each point; -1: its value is known
};
std::string level_picture(const Mesh& mesh, const hm_curves& curves, const Level& level, const Box& window);

} // namespace cli
