// The movement that the options of `harmorph morph` ask for: a file of moves or of variables, or
// another airfoil.
#pragma once

#include "curves/section_movement.hpp"
#include "options/arguments.hpp"
#include "work/basis_file.hpp"
#include "work/to_airfoil.hpp"

#include <optional>
#include <vector>

namespace cli {

struct AskedMoves {
    std::vector<double> moves;         // pairs [2*functions] for hm_morph
    std::optional<ToAirfoil> airfoil;  // the distances of --to-airfoil
    std::vector<MovementError> errors;
};
AskedMoves asked_moves(const Arguments& arguments, const Mesh& mesh, const Basis& basis);

// Warns of movements that the control points do not follow within a ten thousandth of the chord.
void warn_of_errors(const std::vector<MovementError>& errors);
// Prints the error of each movement that does not only turn, shift or scale the section.
void print_errors(const std::vector<MovementError>& errors);

}  // namespace cli
