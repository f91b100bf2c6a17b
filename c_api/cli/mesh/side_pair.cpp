#include "mesh/side_pair.hpp"

#include "basics/failure.hpp"
#include "basics/numbers.hpp"
#include "mesh/mesh_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

namespace cli {

namespace {

using Complex = std::complex<double>;

constexpr double max_relative_misfit = 1e-6;  // of the extent, as in the library

struct Sides {
    std::vector<Complex> from, to;  // points that are images of each other, in order

    double misfit(Complex turn, Complex shift) const {
        double worst = 0;
        for (std::size_t k = 0; k < from.size(); ++k)
            worst = std::max(worst, std::abs(to[k] - turn * from[k] - shift));
        return worst;
    }
    bool fit(Complex turn, Complex shift) const {
        double extent = 0;
        for (std::size_t k = 0; k < from.size(); ++k) {
            extent = std::max({extent, std::abs(from[k] - from[0]), std::abs(to[k] - from[k])});
        }
        return misfit(turn, shift) <= max_relative_misfit * extent;
    }
    Complex mean(const std::vector<Complex>& side) const {
        Complex sum = 0;
        for (const Complex z : side) sum += z;
        return sum / static_cast<double>(side.size());
    }
    // Returns the rotation that maps `from` - a to `to` - b best in the least-squares sense.
    Complex turn_about(Complex a, Complex b) const {
        Complex sum = 0;
        for (std::size_t k = 0; k < from.size(); ++k) sum += std::conj(from[k] - a) * (to[k] - b);
        return std::abs(sum) > 0 ? sum / std::abs(sum) : Complex(1);
    }
};

// Returns nothing if one of the markers is not one open piece, or if their numbers of points
// differ.
std::optional<Sides> sides_of(const Mesh& mesh, std::int32_t marker, std::int32_t partner) {
    try {
        const MeshAnalysis analysis(mesh);
        const BoundaryPiece a = analysis.boundary({marker}), b = analysis.boundary({partner});
        if (a.is_loop || b.is_loop || a.points.size() != b.points.size()) return {};
        Sides sides;
        const auto place = [&mesh](std::int32_t point) {
            return Complex(mesh.x[static_cast<std::size_t>(point)],
                           mesh.y[static_cast<std::size_t>(point)]);
        };
        // Both pieces have the mesh on their left, so they run in opposite directions.
        for (std::size_t k = 0; k < a.points.size(); ++k) {
            sides.from.push_back(place(a.points[k]));
            sides.to.push_back(place(b.points[b.points.size() - 1 - k]));
        }
        return sides;
    } catch (const Failure&) {  // the library refuses the markers when the problem is solved
        return {};
    }
}

}  // namespace

SidePair side_pair(const Mesh& mesh, std::int32_t marker, std::int32_t partner) {
    SidePair out{sized<hm_condition>(), {}};
    hm_condition& pair = out.condition;
    pair.marker = marker;
    pair.partner = partner;
    pair.kind = HM_PERIODIC_PAIR;
    const std::optional<Sides> sides = sides_of(mesh, marker, partner);
    if (!sides) return out;
    const Complex from = sides->mean(sides->from), to = sides->mean(sides->to);
    if (sides->fit(1, to - from)) return out;
    Complex turn = sides->turn_about(0, 0), centre = 0;
    if (!sides->fit(turn, 0)) {
        turn = sides->turn_about(from, to);
        centre = (to - turn * from) / (1.0 - turn);
        if (!sides->fit(turn, centre - turn * centre)) return out;
    }
    pair.kind = HM_ROTATION_PAIR;
    pair.x = centre.real();
    pair.y = centre.imag();
    out.passage = "'" + mesh.markers[static_cast<std::size_t>(marker)] + "' to '" +
                  mesh.markers[static_cast<std::size_t>(partner)] + "' turned by " +
                  brief(180 / pi * std::arg(turn)) + " degrees about (" + brief(pair.x) + ", " +
                  brief(pair.y) + ")";
    return out;
}

}  // namespace cli
