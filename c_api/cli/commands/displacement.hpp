// The given movement and the result of `harmorph displace`, and the output of the result.
#pragma once

#include "basics/geometry.hpp"
#include "files/output_file.hpp"
#include "page/judged_mesh.hpp"
#include "work/morph.hpp"
#include "work/safe_way.hpp"
#include "work/solver.hpp"
#include "work/task.hpp"
#include "work/wall_field.hpp"

#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cli {

// The given displacements of wall points, and the moves of control points and rigid bodies.
struct WallMovement {
    std::string path;
    WallField wall;
    std::vector<double> moves;  // [2*functions]
};

struct Displacement {
    Field by, moved;
    hm_step_report step = sized<hm_step_report>();
    hm_quality_report quality = sized<hm_quality_report>();
    std::string engine;                               // with the reason for the engine
    double factor_seconds = 0, displace_seconds = 0;  // displace_seconds: the median of all repeats
    std::optional<hm_safe_report> safe;
    std::string refusal, warning;       // set by the safe displacement
    std::vector<OperatorTrial> trials;  // the operators that were compared
    hm_basis_info info = sized<hm_basis_info>();
    std::vector<std::int32_t> curve_points;  // mesh points on curves
    std::vector<double> moves;  // of control points and bodies, as far as the mesh went
    // The largest distance of wall points from where the movement takes them.
    double boundary_error = 0;
    std::string torn;                          // why the movement tears two conditions apart
    std::shared_ptr<const JudgedMesh> judged;  // for the report

    explicit Displacement(const Mesh& mesh) : by(mesh.x.size()), moved(mesh.x.size()) {}
    bool valid() const {
        return quality.inverted == 0 && quality.self_crossing == 0 && torn.empty();
    }
    // Finds boundary_error, before coordinates are rounded.
    void measure_boundary(const Mesh& mesh, const Solver& solver, const WallMovement& movement);
};

// Writes the moved mesh and the file for ParaView, as far as the command line asks for them.
void write_displacement(const Arguments& arguments, const Mesh& mesh, const Displacement& found,
                        OutputFiles& files);
void write_displacement_page(std::ostream& out, const Mesh& mesh, const Task& task,
                             const WallMovement& movement, const Displacement& found);
void print_json(const Displacement& found);
void print_displacement(const Displacement& found);
// Returns the sentence that says why the moved mesh is not valid.
std::string why_invalid(const Displacement& found, const Mesh& mesh);

}  // namespace cli
