// Divides polygons into pieces. This is a source of its own, so that a program which only moves
// meshes does not link it. tests/mesh/test_pieces.cpp covers this file.
#include "mesh/pieces.hpp"

namespace harmorph {
namespace {

// The corners of one polygon. `reversed` says that the caller's order is clockwise.
struct Corners {
    const Index* number;  // in the caller's numbering
    Index n;
    Points points;
    Index index_base;
    bool reversed = false;

    Vec2 at(Index k) const noexcept { return points[from_zero(number[k], index_base)]; }
    Index next(Index k) const noexcept { return k + 1 == n ? 0 : k + 1; }
    Index previous(Index k) const noexcept { return k == 0 ? n - 1 : k - 1; }
    Real twice_area(Index a, Index b, Index c) const noexcept {
        Real const area = cross(at(b) - at(a), at(c) - at(b));
        return reversed ? -area : area;
    }
    // Returns the quality of a triangle: twice the area divided by the sum of the squared sides,
    // which is largest for equal sides. If all three points coincide, the quality is 0.
    Real shape(Index a, Index b, Index c) const noexcept {
        Real const squares = square(at(b) - at(a)) + square(at(c) - at(b)) + square(at(a) - at(c));
        return squares > 0 ? twice_area(a, b, c) / squares : 0;
    }
    CornerKind kind(Index k) const noexcept {
        Vec2 const before = at(k) - at(previous(k)), after = at(next(k)) - at(k);
        Real const sine = reversed ? -cross(before, after) : cross(before, after),
                   ahead = dot(before, after);
        if (sine > 0 && sine > Pieces::flat * ahead) return CornerKind::convex;
        return sine < 0 && -sine > Pieces::flat * ahead ? CornerKind::reflex : CornerKind::flat;
    }
    void orient() noexcept {
        Real sum = 0;
        for (Index k = 1; k + 1 < n; ++k) sum += cross(at(k) - at(0), at(k + 1) - at(0));
        reversed = sum < 0;
    }
};

}  // namespace

Mesh PolygonDivision::lay_out(Arena& arena, Mesh const& polygons) noexcept {
    if (polygons.layout != CellLayout::polygons) return polygons;
    Index max_corners = 0;
    for (Index i = 0; i < polygons.n_cells; ++i) {
        max_corners = max(max_corners, polygons.cell_start[i + 1] - polygons.cell_start[i]);
    }
    Mesh mesh = polygons;
    mesh.layout = CellLayout::quads;
    mesh.n_given = polygons.n_cells;
    mesh.n_cells = polygons.max_pieces();
    mesh.n_guards = static_cast<Index>(polygons.n_corners());
    pieces.lay_out(arena, polygons.n_cells, mesh.n_cells, mesh.n_guards);
    arena.take(worst, Offset{max_corners} * max_corners);
    arena.take(apex, Offset{max_corners} * max_corners);
    return mesh;
}

void PolygonDivision::run(Mesh const& polygons) noexcept {
    n_filled_ = 0;
    auto const corners_of = [&](Index i) {
        const Index* const first =
            polygons.cell_points + (Offset{polygons.cell_start[i]} - polygons.index_base);
        Corners corners{first, polygons.cell_start[i + 1] - polygons.cell_start[i], polygons.points,
                        polygons.index_base};
        corners.orient();
        return corners;
    };
    auto const is_whole = [](Corners const& corners) {
        if (corners.n > 4) return false;
        for (Index k = 0; corners.n == 4 && k < 4; ++k) {
            if (corners.kind(k) != CornerKind::convex) return false;
        }
        return true;
    };
    for (Index i = 0; i < polygons.n_cells; ++i) {
        pieces.start[i] = n_filled_;
        Corners const corners = corners_of(i);
        const Index* const p = corners.number;
        if (is_whole(corners)) {
            add(p[0], p[1], p[2], p[corners.n - 1]);
        } else {
            divide(corners);
        }
    }
    pieces.start[polygons.n_cells] = n_filled_;
    for (Index i = 0; i < polygons.n_cells; ++i) {
        pieces.guard_start[i] = n_filled_;
        Corners const corners = corners_of(i);
        if (pieces.start[i + 1] - pieces.start[i] == 1) continue;
        for (Index k = 0; k < corners.n; ++k) {
            Index const after = corners.number[corners.next(k)],
                        before = corners.number[corners.previous(k)];
            pieces.kind[n_filled_ - pieces.n_pieces()] = corners.kind(k);
            add(before, corners.number[k], after, after);
        }
    }
    pieces.guard_start[polygons.n_cells] = n_filled_;
    pieces.point = pieces.point.first(4 * Offset{n_filled_});
    pieces.kind = pieces.kind.first(n_filled_ - pieces.n_pieces());
}

void PolygonDivision::add(Index a, Index b, Index c, Index d) noexcept {
    Index* const to = pieces.point.data() + 4 * Offset{n_filled_++};
    to[0] = a;
    to[1] = b;
    to[2] = c;
    to[3] = d;
}

// The best division of the corners i .. j consists of a triangle with the corners i, j and an apex
// k, and of the best divisions of the corners i .. k and k .. j.
template <class Corners>
void PolygonDivision::divide(Corners const& corners) noexcept {
    Index const n = corners.n;
    auto const at = [n](Index i, Index j) { return Offset{i} * n + j; };
    for (Index i = 0; i + 1 < n; ++i) worst[at(i, i + 1)] = infinity;
    for (Index width = 2; width < n; ++width) {
        for (Index i = 0; i + width < n; ++i) {
            Index const j = i + width;
            Index best = none;
            Real best_worst = 0;
            for (Index k = i + 1; k < j; ++k) {
                Real const others = min(worst[at(i, k)], worst[at(k, j)]);
                if (best != none && !(others > best_worst)) continue;
                Real const all = min(others, corners.shape(i, k, j));
                if (best != none && !(all > best_worst)) continue;
                best = k;
                best_worst = all;
            }
            worst[at(i, j)] = best_worst;
            apex[at(i, j)] = best;
        }
    }
    // A negative apex marks the sides of triangles, beginning with the side between the first and
    // the last corner.
    auto const mark = [&](Index i, Index j) {
        if (j > i + 1) apex[at(i, j)] = ~apex[at(i, j)];
    };
    mark(0, n - 1);
    for (Index width = n - 1; width > 1; --width) {
        for (Index i = 0; i + width < n; ++i) {
            Index const j = i + width, k = ~apex[at(i, j)];
            if (k < 0) continue;
            add(corners.number[i], corners.number[k], corners.number[j], corners.number[j]);
            mark(i, k);
            mark(k, j);
        }
    }
}

}  // namespace harmorph
