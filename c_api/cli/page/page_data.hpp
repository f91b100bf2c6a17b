// The data of mesh and basis for the pages of `harmorph explore`, and of `morph` and `displace`
// with the option --report.
#pragma once

#include "basics/geometry.hpp"
#include "mesh/loops.hpp"
#include "work/basis_file.hpp"

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

// The part of a mesh that the page of `harmorph explore` shows. The page is small enough for any
// browser: it has all cells near the moving body, and a selection of the other points and edges,
// which is only drawn.

struct PageSelection {
    std::vector<std::int32_t> points;  // places in the mesh; points of whole cells come first
    std::int32_t in_cells = 0;        // number of points of cells, or of faces between these points
    std::vector<std::int32_t> cells;  // all cells with no other points
    std::vector<Edge> edges;          // lines beyond the cells: places in `points`
    std::vector<std::int32_t> faces;  // faces of the boundary between two of the points
};

// Selects the cells all of whose points are among the max_points points nearest to the body. body:
// its mesh points.
PageSelection select_for_page(const Mesh& mesh, const std::vector<std::int32_t>& body,
                              std::int32_t max_points);

// The basis, the curves and the conditions of the mesh on a page.
struct PageSubject {
    std::string basis;  // the file, or empty
    hm_basis_info info;
    const hm_curves& curves;
    const std::vector<hm_condition>& conditions;
};

// The movement of a mesh and the results of its assessment.
struct MovedMesh {
    const Field& displacement;
    const std::vector<double>& moves;  // of the functions, as far as they were reached
    const hm_step_report& step;
    const hm_quality_report& quality;
    double boundary_error;
    std::string boundary_error_note;  // the meaning of boundary_error
    bool is_safe;
    const hm_safe_report& safe;
    std::string refusal;
};

// Writes one JSON object, which page/decode.js describes. moves: the text of the file of movements
// that the page begins with, or empty.
void write_page_data(std::ostream& out, const Mesh& mesh, const Basis& basis,
                     const PageSelection& selection, const std::string& moves);
// Writes the report page. Its data are the same object without functions, but with the displacement
// of each point and with `moved`; page/report.js describes these data. body: the mesh points near
// which cells are shown.
void write_report(std::ostream& out, const Mesh& mesh, const PageSubject& subject,
                  const std::vector<std::int32_t>& body, const MovedMesh& moved);

}  // namespace cli
