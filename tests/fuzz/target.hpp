// Each target of the fuzzer has a file fuzz_*.cpp.
#pragma once

#include "input.hpp"

namespace fuzz {

enum class Outcome { done, refused };

// These throw a Failure if a property does not hold.
Outcome run_problem(Input& input);
Outcome run_polygons(Input& input);  // problems with meshes of polygons
Outcome run_basis(Input& input);
Outcome run_sequence(Input& input);
Outcome run_files(Input& input);
Outcome run_shape(Input& input);
Outcome run_given(Input& input);
Outcome run_parts(Input& input);
Outcome run_plane(Input& input);
Outcome run_transfer(Input& input);
Outcome run_commands(Input& input);
Outcome run_model(Input& input);
Outcome run_fields(Input& input);
Outcome run_quality(Input& input);
Outcome run_sections(Input& input);
Outcome run_tables(Input& input);

struct Target {
    const char* name;
    Outcome (*run)(Input& input);
};
inline constexpr Target targets[] = {
    {"problem", run_problem},   {"polygons", run_polygons}, {"basis", run_basis},
    {"given", run_given},       {"parts", run_parts},       {"plane", run_plane},
    {"transfer", run_transfer}, {"sequence", run_sequence}, {"files", run_files},
    {"shape", run_shape},       {"commands", run_commands}, {"model", run_model},
    {"fields", run_fields},     {"quality", run_quality},   {"sections", run_sections},
    {"tables", run_tables}};

}  // namespace fuzz
