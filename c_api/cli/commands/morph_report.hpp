// The report of `harmorph morph` about a morphed mesh, for people and as JSON.
#pragma once

#include "work/moves_file.hpp"
#include "work/morph.hpp"
#include "work/safe_way.hpp"
#include "work/to_airfoil.hpp"

#include <string>

namespace cli {

// Files that go with the morphed mesh. They lie beside the mesh unless the user names them; an
// empty name means that the file is not written.
struct Companions {
    std::string curve, reached;
};

// safe: the mesh was moved by hm_move_safe, whose report is morph.safe.
void print_json(const Morph& morph, bool safe, const Companions& written, const AskedMoves& asked);
void print_for_people(const Morph& morph, bool safe, const Companions& written);
void print_airfoil(const std::string& path, const ToAirfoil& airfoil);

// Says why the mesh does not reach the target: inverted cells and crossings, with their numbers and
// their places in the mesh file, or the refusal of the safe morph; and that the airfoil of the file
// has another size than that of the mesh, which is a likely reason.
std::string why_not_reached(const Morph& morph, const Mesh& mesh, const AskedMoves& asked);

// Tells what leads farther than a linear movement that inverted a cell: nothing, if `moved` has a
// body where no mesh can have one.
std::string what_goes_farther(const Mesh& mesh, const Field& moved, const hm_step_report& step,
                              const hm_quality_report& quality);

}  // namespace cli
