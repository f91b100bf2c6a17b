// Solves a few linear equations with several right-hand sides.
#pragma once

#include "base/scalar.hpp"

namespace harmorph {

// Solves matrix [n * n] times x = right [n * width] by Gaussian elimination with the largest pivot
// of each column; x replaces `right`, and the matrix is destroyed. Returns false if a pivot is 0.
inline bool solve_small(Index n, Real* matrix, Index width, Real* right) noexcept {
    auto const swap_rows = [](Real* a, Real* b, Index count) {
        for (Index k = 0; k < count; ++k) {
            Real const kept = a[k];
            a[k] = b[k];
            b[k] = kept;
        }
    };
    for (Index j = 0; j < n; ++j) {
        Index pivot = j;
        for (Index i = j + 1; i < n; ++i)
            if (abs(matrix[i * n + j]) > abs(matrix[pivot * n + j])) pivot = i;
        if (!(abs(matrix[pivot * n + j]) > 0)) return false;
        swap_rows(matrix + j * n, matrix + pivot * n, pivot == j ? 0 : n);
        swap_rows(right + j * width, right + pivot * width, pivot == j ? 0 : width);
        for (Index i = 0; i < n; ++i) {
            if (i == j) continue;
            Real const factor = matrix[i * n + j] / matrix[j * n + j];
            for (Index k = j; k < n; ++k) matrix[i * n + k] -= factor * matrix[j * n + k];
            for (Index k = 0; k < width; ++k) right[i * width + k] -= factor * right[j * width + k];
        }
    }
    for (Index i = 0; i < n; ++i)
        for (Index k = 0; k < width; ++k) right[i * width + k] /= matrix[i * n + i];
    return true;
}

}  // namespace harmorph
