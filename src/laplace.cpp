#include "harmorph/laplace.hpp"

namespace harmorph {
namespace {

// Cotangent of the angle at `apex` between the directions to a and b, whatever the sense of the triangle.
Real cotangent(Vec2 apex, Vec2 a, Vec2 b) noexcept {
    return dot(a - apex, b - apex) / absolute(cross(a - apex, b - apex));
}

}  // namespace

void assemble_laplace(Mesh const& mesh, Points points, Matrix const& matrix) noexcept {
    matrix.clear();
    for (Index i = 0; i < mesh.n_cells; ++i) {
        Cell const cell = mesh.cell(i);
        Vec2 p[4];
        for (Index k = 0; k < cell.n; ++k) p[k] = points[cell.point[k]];
        if (cell.n == 3) {
            for (Index k = 0; k < 3; ++k) {
                Index const a = (k + 1) % 3, b = (k + 2) % 3;
                matrix.add(cell.point[a], cell.point[b], 0.5 * cotangent(p[k], p[a], p[b]));
            }
            continue;
        }
        for (Index k = 0; k < 4; ++k) {  // a side sees its two opposite points, one in each split
            Index const a = k, b = (k + 1) % 4, c = (k + 2) % 4, d = (k + 3) % 4;
            matrix.add(cell.point[a], cell.point[b], 0.25 * (cotangent(p[c], p[a], p[b]) + cotangent(p[d], p[a], p[b])));
        }
        for (Index k = 0; k < 2; ++k) {  // a diagonal belongs to one split only, and sees the other two points
            Index const a = k, b = k + 1, c = k + 2, d = (k + 3) % 4;
            matrix.add(cell.point[a], cell.point[c], 0.25 * (cotangent(p[b], p[a], p[c]) + cotangent(p[d], p[a], p[c])));
        }
    }
}

}  // namespace harmorph
