// The eigenvalues and eigenvectors of a small symmetric matrix, by Jacobi's rotations.
#pragma once

#include "base/scalar.hpp"

namespace harmorph {

// Converts `a` into a diagonal matrix and sets the columns of `vector` to the eigenvectors. The
// diagonal has the eigenvalues in no particular order. Only the upper triangle of `a` is read.
template <Index n>
void diagonalise(Real (&a)[n][n], Real (&vector)[n][n]) noexcept {
    constexpr Index max_sweeps = 12;
    constexpr Real negligible = 1e-13;  // off the diagonal, in parts of the largest eigenvalue
    for (Index i = 0; i < n; ++i) {
        for (Index j = 0; j < n; ++j) vector[i][j] = i == j ? 1 : 0;
    }
    for (Index sweep = 0; sweep < max_sweeps; ++sweep) {
        Real largest = 0, off = 0;
        for (Index i = 0; i < n; ++i) {
            largest = max(largest, abs(a[i][i]));
            for (Index j = i + 1; j < n; ++j) off = max(off, abs(a[i][j]));
        }
        if (!(off > negligible * max(largest, off))) return;
        for (Index p = 0; p < n; ++p) {
            for (Index q = p + 1; q < n; ++q) {
                if (a[p][q] == 0) continue;
                Real const half = 0.5 * (a[q][q] - a[p][p]), size = abs(half),
                           root = sqrt(half * half + a[p][q] * a[p][q]);
                Real const tangent = (half < 0 ? -1 : 1) * a[p][q] / (size + root),
                           cosine = 1 / sqrt(1 + tangent * tangent), sine = tangent * cosine;
                a[p][p] -= tangent * a[p][q];
                a[q][q] += tangent * a[p][q];
                a[p][q] = 0;
                auto const rotate = [&](Real& x, Real& y) {
                    Real const old = x;
                    x = cosine * old - sine * y;
                    y = sine * old + cosine * y;
                };
                for (Index k = 0; k < p; ++k) rotate(a[k][p], a[k][q]);
                for (Index k = p + 1; k < q; ++k) rotate(a[p][k], a[k][q]);
                for (Index k = q + 1; k < n; ++k) rotate(a[p][k], a[q][k]);
                for (Index k = 0; k < n; ++k) rotate(vector[k][p], vector[k][q]);
            }
        }
    }
}

}  // namespace harmorph
