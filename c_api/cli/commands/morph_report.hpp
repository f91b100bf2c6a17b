// What `harmorph morph` says of a morphed mesh: for people, and as JSON.
#pragma once

#include "commands/morph.hpp"
#include "commands/safe_way.hpp"
#include "curves/to_airfoil.hpp"

#include <optional>
#include <string>

namespace cli {

// Files that go with the morphed mesh; beside it unless the user says where. Empty: not written.
struct Companions {
    std::string curve, reached;
};

// safe: by hm_morph_safe, so that morph.safe is the report of that call.
void print_json(const Morph& morph, bool safe, const Companions& written,
                const std::optional<ToAirfoil>& airfoil);
void print_for_people(const Morph& morph, bool safe, const Companions& written);
void print_airfoil(const std::string& path, const ToAirfoil& airfoil);

// Inverted cells and crossings, with numbers and places in the mesh file.
std::string why_not_valid(const Morph& morph, const Mesh& mesh);

}  // namespace cli
