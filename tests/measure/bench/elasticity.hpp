// Mesh deformation as flow solvers have it: linear elasticity with stiff small cells, solved by
// conjugate gradients.
#pragma once

#include "cases.hpp"

namespace bench {

// Not numbers where the peer is not installed.
struct ElasticTimes {
    double set_up;  // assembly and incomplete factorisation
    double solve;   // conjugate gradients to 1e-6
    double iterations;
};

constexpr int max_elastic_iterations = 5000;

// Linear elements (a quad is split), Young's modulus 1/area of each cell, Poisson's ratio 0.3;
// displacements x,y of the points of the body, 0 on the far field.
ElasticTimes solve_elasticity(Case const& mesh_case, std::vector<Index> const& points,
                              std::vector<double> const& displacement);
std::string elasticity_note();

}  // namespace bench
