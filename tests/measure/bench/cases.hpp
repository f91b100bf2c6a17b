// The meshes of all comparisons, and the curves fitted to their airfoil.
#pragma once

#include <fixtures/mesh.hpp>

#include <memory>
#include <string>
#include <vector>

namespace bench {

using Index = std::int32_t;
inline std::size_t at(Index k) { return static_cast<std::size_t>(k); }

// A NACA 0012 in a circle of 20 chords.
struct Case {
    std::string kind;
    fixtures::Mesh mesh;
    Index wall_points = 0;  // the first points of the mesh, in order round the airfoil

    std::string name() const;
};

// iso:          O-mesh of quads, as long as they are high
// viscous:      O-mesh of quads, the first 1e-5 chords high
// thin:         the same, 1e-6 chords high
// thinnest:     the same, 1e-7 chords high
// unstructured: Delaunay triangles that grow with the distance, numbered as a generator lays them
//               down
// stretched10, stretched100, stretched1000: the triangles of unstructured with all y divided by
//               this number, turned by 30 degrees
// The mesh has about `size` points. An unknown kind: std::invalid_argument.
Case make_case(std::string const& kind, Index size);

// A fit through the airfoil's points, in its own memory.
class Fit {
public:
    Fit(Case const& mesh_case, Index n_control);
    hm_curves const& curves() const { return *curves_; }

private:
    std::unique_ptr<unsigned char[]> block_;
    hm_curves const* curves_ = nullptr;
};

// The airfoil moves with the fit's control points, the far field stays. `given` refers to the other
// members and to both arguments.
struct Problem {
    Problem(Case const& mesh_case, Fit const& fit);
    Problem(Problem const&) = delete;

    hm_condition condition{};
    hm_mesh mesh;
    hm_problem given{};
};

// Throws what an hm_error says, unless the status is HM_OK or a warning.
void require(hm_status status, hm_error const& error, const char* call);

}  // namespace bench
