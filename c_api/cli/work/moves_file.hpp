// Files of movements: lines "index dx dy", the control point counted from 1, lines that move a
// section (section_movement.hpp), "rigid MARKER dx dy degrees [scale]", and "mode K amplitude
// [amplitude-y]" for functions whose values are a table. MARKER is a list as in options, with
// quotes and places (Mesh::find_pieces). Lines are applied in their order: a line moves a section
// or a body from the place that the lines above, of other texts for a body, have given it. A body
// turns about its centre, which moves with the body. Control points, bodies and modes without a
// line do not move. What write_moves() writes, read_moves() reads back.
#pragma once

#include "curves/section_movement.hpp"
#include "options/arguments.hpp"
#include "work/basis_file.hpp"
#include "work/to_airfoil.hpp"

#include <complex>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace cli {

// What a file of moves may name: control points, the bodies of these conditions, and modes.
struct Movable {
    std::int32_t n_control = 0, n_bodies = 0, n_modes = 0;
    std::vector<hm_condition> conditions;
    std::function<const hm_curves&()> curves;  // throws a Failure if their places are unknown
    // Basis::body_rotation(); empty: no body has turned.
    std::function<std::complex<double>(std::int32_t)> body_rotation = {};
    std::vector<std::int32_t> mover = {};  // these two: see ConditionsOfMesh
    std::int32_t n_curves = 0;

    std::int32_t functions() const { return n_control + 2 * n_bodies + n_modes; }
};

// The option `--by LINE`, and the texts of `--move` and of all options `--by`, in this order.
std::vector<TextFile> texts_of_moves(const Arguments& arguments);
TextFile text_of_moves(const std::string& path);  // refuses an empty file

Movable movable_of(const Basis& basis);
// Returns pairs [2 * functions]. `errors` receives what movements of sections leave.
std::vector<double> read_moves(const std::vector<TextFile>& texts, const Movable& movable,
                               const Mesh& mesh, std::vector<MovementError>* errors = nullptr);
bool has_section_movements(const TextFile& text);
// Writes the line of the body of this condition. function: its two pairs; before: its rotation
// before the movement.
void write_body(std::ostream& out, const Mesh& mesh, const hm_condition& condition,
                const double* function, std::complex<double> before = 1);
void write_moves(std::ostream& out, const std::vector<double>& moves, const Basis& basis,
                 const Mesh& mesh);

// The movement that the options of `harmorph morph` ask for: a file of moves or of variables, or
// another airfoil.

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
