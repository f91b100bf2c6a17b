// The data of mesh and basis for the pages of `harmorph explore`, and of `morph` and `displace`
// with
// --report.
#pragma once

#include "basics/field.hpp"
#include "mesh/basis_file.hpp"
#include "page/page_selection.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

// What the pages show: a mesh, and the conditions and curves by which it moves.
struct PageSubject {
    std::string basis;  // the file, or empty
    hm_basis_info info;
    const hm_curves& curves;
    const std::vector<hm_condition>& conditions;
};

// What a command found about a moved mesh.
struct MovedMesh {
    const Field& displacement;
    const std::vector<double>& moves;  // of the functions, as far as they were reached
    const hm_step_report& step;
    const hm_quality_report& quality;
    double boundary_error;
    std::string boundary_error_note;  // what the number is
    bool is_safe;
    const hm_safe_report& safe;
    std::string refusal;
};

// Writes one JSON object, which page/decode.js describes. moves is the text of a file of movements
// to begin with, or empty.
void write_page_data(std::ostream& out, const Mesh& mesh, const Basis& basis,
                     const PageSelection& selection, const std::string& moves);
// Writes the report page, whose data are the same object without functions, and with the
// displacement of each point and the program's findings; page/report.js describes these. `body` are
// the mesh points beside which cells are shown.
void write_report(std::ostream& out, const Mesh& mesh, const PageSubject& subject,
                  const std::vector<std::int32_t>& body, const MovedMesh& moved);

}  // namespace cli
