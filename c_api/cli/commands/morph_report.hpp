// The report of `harmorph morph` about a morphed mesh, for people and as JSON.
#pragma once

#include "commands/asked_moves.hpp"
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

// Describes inverted cells and crossings, with their numbers and their places in the mesh file.
std::string why_not_valid(const Morph& morph, const Mesh& mesh);

}  // namespace cli
