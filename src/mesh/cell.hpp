// Defines the cells, boundary faces and structured blocks of a mesh.
// tests/mesh/test_mesh.cpp and tests/mesh/test_blocks.cpp cover this file.
#pragma once

#include "base/span.hpp"
#include "base/vec2.hpp"

namespace harmorph {

// The kind of a polygon's corner before any movement.
enum class CornerKind : std::uint8_t { convex = 0, flat = 1, reflex = 2 };

// The n points of one cell in order round the cell, counted from 0; n is 3 or 4.
struct Cell {
    Index n = 0;
    Index point[4] = {};

    Index next(Index corner) const noexcept { return point[corner + 1 == n ? 0 : corner + 1]; }
    Index previous(Index corner) const noexcept { return point[corner == 0 ? n - 1 : corner - 1]; }
    void reverse() noexcept {
        for (Index k = 0; k < n / 2; ++k) {
            Index const first = point[k];
            point[k] = point[n - 1 - k];
            point[n - 1 - k] = first;
        }
    }
};

// Returns the caller's number counted from 0. Unsigned arithmetic cannot overflow: the smallest
// Index becomes the largest, which is not a valid number either.
constexpr Index from_zero(Index number, Index index_base) noexcept {
    return static_cast<Index>(static_cast<std::uint32_t>(number) -
                              static_cast<std::uint32_t>(index_base));
}

struct BoundaryFace {
    Index begin = none, end = none;  // points, counted from 0
    Index marker = 0;
};

// One structured block, whose points and cells are numbered row by row.
struct GridBlock {
    Index ni = 0, nj = 0;
    Index first_point = 0, first_cell = 0;

    Index n_points() const noexcept { return ni * nj; }
    Index n_cells() const noexcept { return (ni - 1) * (nj - 1); }
    // Returns cell i, counted from the first cell of the block. A row has one cell less than
    // points.
    Cell cell(Index i) const noexcept {
        Index const corner = first_point + i + i / (ni - 1);
        return {4, {corner, corner + 1, corner + 1 + ni, corner + ni}};
    }
    // The sides 0 to 3 are i = 0, i = ni-1, j = 0 and j = nj-1.
    Index edges_along(Index side) const noexcept { return (side < 2 ? nj : ni) - 1; }
    Index point_along(Index side, Index k) const noexcept {
        Index const i = side == 0   ? 0
                        : side == 1 ? ni - 1
                                    : k,
                    j = side == 2   ? 0
                        : side == 3 ? nj - 1
                                    : k;
        return first_point + i + ni * j;
    }
};

}  // namespace harmorph
