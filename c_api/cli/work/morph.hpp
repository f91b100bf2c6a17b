// A mesh that was moved by control points, and the quality of the moved mesh.
#pragma once

#include "basics/geometry.hpp"
#include "curves/curves.hpp"
#include "files/threads.hpp"
#include "work/basis_file.hpp"
#include "work/wall_field.hpp"
#include "work/safe_way.hpp"

#include <string>
#include <vector>

namespace cli {

// The displacements of all points for pairs dx, dy of the control points, and the largest multiple
// of displacements that inverts no cell.
Field displacement(const Basis& basis, const Mesh& mesh, const std::vector<double>& moves,
                   const Threads& threads);
hm_step_report admissible_step(const Basis& basis, const Mesh& mesh, const Field& displacement,
                               const Threads& threads);

// The fraction of a displacement up to which the mesh is valid: no cell is inverted and the
// boundary does not touch itself.
double valid_fraction(const hm_step_report& step);

struct Morph {
    std::vector<double>
        moves;  // movement of control points and bodies as far as the mesh followed: see hm_morph
    Field displacement, moved;
    hm_step_report step;
    hm_quality_report quality;  // relative to the mesh before the morph
    // The largest distance of wall points from the B-spline that `moves` moved.
    double boundary_error = 0;
    std::string torn;         // why the movement tears two conditions apart
    double seconds = 0;       // of hm_morph: the median of all repeats; or of hm_move_safe
    hm_safe_report safe;      // set by the safe morph, as are all members below
    std::string refusal;      // why the mesh does not reach the target
    bool impossible = false;  // no mesh can have the boundary of the target
    std::string warning;      // the target is reached, but the mesh is poorer than was asked for
    std::vector<OperatorTrial> trials;  // the operators that were compared

    Morph(const Basis& basis, const Mesh& mesh, const std::vector<double>& moves_of_functions,
          std::int32_t repeats, const Threads& threads);
    // The safe morph. If the operator is not that of the basis, the functions are solved first.
    // fluxes: those with which the basis was solved.
    Morph(const Basis& basis, const Mesh& mesh, const std::vector<double>& target,
          hm_safe_options options, std::int32_t operator_kind, const Threads& threads,
          const FluxList& fluxes = {});
    // Moves inner points to where cells are better. Walls, and therefore `moves`, stay.
    void improve(const Basis& basis, const Mesh& mesh, const Threads& threads,
                 const hm_improve_options& options);
    bool valid() const {
        return quality.inverted == 0 && quality.self_crossing == 0 && torn.empty();
    }
    std::vector<double> moved_control(
        const Basis& basis) const;  // pairs x, y of the control points after `moves`
    Curves moved_curves(const Basis& basis) const;  // the curves of the basis on the moved mesh

private:
    void put_on_curves(const Basis& basis, const Mesh& mesh, const Threads& threads);
    void judge(const Basis& basis, const Mesh& mesh, const Threads& threads);
};

}  // namespace cli
