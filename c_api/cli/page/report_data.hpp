// The report of `morph` and `displace` with the option --report.
#pragma once

#include "basics/geometry.hpp"
#include "page/judged_mesh.hpp"
#include "page/report_selection.hpp"
#include "work/basis_file.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

// The basis, the curves and the conditions of the mesh in a report.
struct ReportSubject {
    hm_basis_info info;
    const hm_curves& curves;
    const std::vector<hm_condition>& conditions;
};

// The movement of a mesh and the results of its assessment.
struct MovedMesh {
    const Field& displacement;
    const JudgedMesh& judged;
    const std::vector<double>& moves;  // of the functions, as far as they were reached
    const hm_step_report& step;
    const hm_quality_report& quality;
    double boundary_error;
    std::string boundary_error_note;  // the meaning of boundary_error
    bool is_safe;
    const hm_safe_report& safe;
    std::string refusal;
};

// Writes the report, whose data page/report.js describes. body: the mesh points near which cells
// are shown.
void write_report(std::ostream& out, const Mesh& mesh, const ReportSubject& subject,
                  const std::vector<std::int32_t>& body, const MovedMesh& moved);

}  // namespace cli
