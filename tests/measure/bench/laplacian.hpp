// The matrix both sides solve with, assembled here on its own, and the one routine that checks all
// solutions.
#pragma once

#include "cases.hpp"

namespace bench {

// Columns of numbers, one for each function; column k begins at data[k * rows].
struct Columns {
    std::size_t rows = 0;
    std::vector<double> data;

    std::size_t count() const { return rows == 0 ? 0 : data.size() / rows; }
    double* operator[](std::size_t k) { return data.data() + k * rows; }
    double const* operator[](std::size_t k) const { return data.data() + k * rows; }
};

// Linear finite elements; a quad is the mean of both splits. Points on the boundary are known and
// eliminated.
struct Laplacian {
    Index n = 0;
    // Row i: entries with column <= i, columns increasing; so also the upper triangle in compressed
    // columns.
    std::vector<Index> start, column;
    std::vector<double> value;
    std::vector<Index> unknown_of;  // [points] -1: known
    std::vector<Index> point_of;    // [n]
    struct Coupling {
        Index unknown, point;
        double value;
    };
    std::vector<Coupling> couplings;  // of unknowns with points on the body

    explicit Laplacian(fixtures::Mesh const& mesh);
    // b for all functions: minus the couplings times N_k(u) of the body's points, at the parameters
    // the basis gives, evaluated anew. Unknowns in the mesh's order.
    Columns right_hand_sides(hm_basis const* basis, hm_curves const& curves, Index n_points) const;
    // max over k of |b_k - A x_k| / |b_k|.
    double worst_residual(Columns const& b, Columns const& x) const;
    // A basis's functions at the unknowns.
    Columns values_of(hm_basis const* basis, Index functions, Index n_points) const;
};

}  // namespace bench
