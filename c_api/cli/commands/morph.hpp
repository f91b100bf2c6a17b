// A mesh moved by its control points, and whether it is any good.
#pragma once

#include "mesh/basis_file.hpp"
#include "commands/safe_way.hpp"
#include "curves/curves.hpp"
#include "basics/field.hpp"
#include "basics/threads.hpp"

#include <string>
#include <vector>

namespace cli {

// The points' movement for dx,dy pairs of the control points, and how far it may go on without
// inverting a cell.
Field displacement(const Basis& basis, const Mesh& mesh, const std::vector<double>& moves,
                   const Threads& threads);
hm_step_report admissible_step(const Basis& basis, const Mesh& mesh, const Field& displacement,
                               const Threads& threads);

// The fraction of a displacement up to which the mesh is valid: no cell is inverted and the
// boundary does not touch itself.
double valid_fraction(const hm_step_report& step);

struct Morph {
    std::vector<double>
        moves;  // of control points and bodies, as far as the mesh followed: see hm_morph
    Field displacement, moved;
    hm_step_report step;
    hm_quality_report quality;  // relative to the mesh as it was
    double boundary_error =
        0;  // at most, against the B-spline that `moves` moved from where it was on the mesh
    double seconds = 0;       // of one hm_morph: the median; of hm_morph_safe
    hm_safe_report safe;      // where it went the safe way
    std::string refusal;      // of the safe way: why it did not reach the target
    bool impossible = false;  // of the safe way: no mesh can have the target's boundary
    std::string warning;  // of the safe way: it did, but the mesh is not as good as was asked for
    std::vector<OperatorTrial> trials;  // of the safe way: where operators were compared

    Morph(const Basis& basis, const Mesh& mesh, const std::vector<double>& its_moves,
          std::int32_t repeats, const Threads& threads);
    // Solves again where it must, and at the start where the operator is not that of the basis.
    Morph(const Basis& basis, const Mesh& mesh, const std::vector<double>& target,
          hm_safe_options options, std::int32_t operator_kind, const Threads& threads);
    // Puts inner points where cells are better. Walls, and so `moves`, stay.
    void improve(const Basis& basis, const Mesh& mesh, const Threads& threads);
    bool valid() const { return quality.inverted == 0 && quality.self_crossing == 0; }
    std::vector<double> moved_control(
        const Basis& basis) const;  // x, y pairs: control points after `moves`
    Curves moved_curves(
        const Basis& basis) const;  // where the basis's curves are on the moved mesh

private:
    void slide(const Basis& basis, const Mesh& mesh, const Threads& threads);
    void judge(const Basis& basis, const Mesh& mesh, const Threads& threads);
};

}  // namespace cli
