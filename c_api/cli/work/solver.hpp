// Solves the harmonic functions of a mesh by all calls of the library in turn, in memory.
#pragma once

#include "basics/geometry.hpp"
#include "basics/library.hpp"
#include "basics/progress.hpp"
#include "files/threads.hpp"
#include "mesh/mesh_file.hpp"
#include "work/task.hpp"

#include <harmorph.h>

#include <optional>
#include <string>
#include <vector>

namespace cli {

struct SolveTimes {     // seconds
    double setup = 0;   // structure of the mesh, operator
    double factor = 0;  // ordering, symbolic and numeric factorisation
    double solve = 0;   // all functions
};

class Solver {
public:
    Solver(const Mesh& mesh, const Task& task,
           const Threads& threads);  // all must outlive the solver
    Solver(const Solver&) = delete;

    hm_status run();  // from the mesh to the basis; a second run uses the same memory

    void prepare();  // the choice of the engine, analysis and plan, without the factor

    // Puts the points of a moved mesh that slip along curves onto these curves, and changes the
    // displacement accordingly.
    void put_on_curves(Field& moved, Field& displacement);
    // The transpose at the points of the mesh: `by` has the derivatives by points on the curves,
    // and receives those by the points before they are put there.
    void take_off_curves(Field& by);

    // Puts inner points of a moved mesh where cells are better.
    void improve(Field& moved, Field& displacement, const hm_improve_options& options);

    hm_plan* plan() { return plan_; }
    const hm_basis* basis() const { return basis_; }
    hm_basis* unsolved() { return basis_; }  // after prepare()
    const hm_solve_report& report() const { return report_; }
    // hm_error.value of the last solution, if that has not converged.
    double found() const { return found_; }
    const SolveTimes& times() const { return times_; }
    std::size_t plan_bytes() const { return plan_block_.size(); }
    // The reason for the engine; empty if the task leaves no choice.
    const std::string& engine_reason() const { return engine_reason_; }

private:
    void analyse();
    std::optional<MemoryNeed> memory_with(const EngineKind& kind, double limit);
    void lay_out();

    const Mesh& mesh_;
    hm_mesh mesh_view_;
    CurvesView curves_view_;
    hm_problem problem_;
    SolveOptions options_;
    EngineChoice choice_;
    std::string engine_reason_;
    Progress progress_;
    Block analysis_block_, plan_block_, basis_block_;
    hm_analysis* analysis_ = nullptr;
    hm_plan* plan_ = nullptr;
    hm_basis* basis_ = nullptr;
    hm_solve_report report_;
    double found_ = 0;
    SolveTimes times_;
};

// What the program says of points that belong to two moving conditions, see
// hm_basis_info.shared_point.

void warn_of_shared_points(const hm_basis_info& info, const std::vector<hm_condition>& conditions,
                           const Mesh& mesh);
// Returns the reason for which a movement is refused that takes the two conditions of the point
// apart by a distance. `second` is the condition that does not move the point.
std::string why_torn(const hm_basis_info& info, const std::vector<hm_condition>& conditions,
                     const Mesh& mesh, std::int32_t point, std::int32_t second, double distance);

}  // namespace cli
