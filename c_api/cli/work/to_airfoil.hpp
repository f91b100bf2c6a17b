// The movement of control points that changes the airfoil of a mesh into another airfoil. The other
// airfoil is approximated in the least-squares sense with the knots of the curve.
#pragma once

#include "curves/section.hpp"
#include "work/basis_file.hpp"

#include <string>
#include <vector>

namespace cli {

struct ToAirfoil {
    std::vector<double> moves;  // pairs [2*functions], as hm_morph takes them
    // Distances of the section's points from the moved curve, in the mesh's unit; the section's
    // chord in that unit.
    double max_error = 0, rms_error = 0, chord = 0;
    // The extent of the points in the file in parts of that of the curve before the movement: 100
    // if the file is in per cent of the chord.
    double relative_size = 1;
    double closed_width = 0;   // width of a blunt base of the section that becomes one point, or 0
    std::string layout;        // of the section's file
    std::vector<double> x, y;  // the points of the section in their places on the curve
    // The largest distance of wall points of the moved mesh from the section, measured by
    // measure_wall(); below 0: not measured.
    double wall_error = -1;
    std::int32_t points = 0, worst_point = 0;  // worst: from 1, in the order of the section
};

// path: of the section's file, for messages. curve: the airfoil among the curves of the basis, from
// 0; the next curve is its base if it connects both ends of the airfoil. on_chord: the section is
// scaled, turned and shifted so that its chord becomes that of the curve; otherwise the section has
// the coordinates of the mesh. moves_to_airfoil() also warns of a blunt base that becomes one
// point. Several threads may call fit_to_airfoil().
ToAirfoil fit_to_airfoil(const Basis& basis, std::int32_t curve, const Section& section,
                         const std::string& path, bool on_chord);
ToAirfoil moves_to_airfoil(const Basis& basis, std::int32_t curve, const Section& section,
                           const std::string& path, bool on_chord);

// Measures the distance of the points that conditions put on the curve, or on its base, from the
// polygon of the section. x, y: the points of the moved mesh.
void measure_wall(ToAirfoil& airfoil, const Basis& basis, std::int32_t curve, const Mesh& mesh,
                  const std::vector<double>& x, const std::vector<double>& y);

}  // namespace cli
