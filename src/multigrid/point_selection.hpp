// Selects the points of the next coarser level. Source: J. W. Ruge, K. Stueben, Algebraic
// multigrid, in: S. F. McCormick (ed.), Multigrid Methods, SIAM (1987), section 4.6.
#pragma once

#include "multigrid/coarse_rows.hpp"

namespace harmorph {

// First pass: the point on which most undecided points depend strongly becomes a coarse point, and
// these points become fine points. Unlike in the source, a point on which no undecided point
// depends becomes a fine point. Each coarse point thereby makes a fine point: at most half of the
// points become coarse points. Second pass, for the first coarse level: of two fine points, one of
// which depends on the other one, both depend on the same coarse point; otherwise one of them
// becomes a coarse point. Fine points are interpolated from coarse points at a distance of one or
// two couplings, so levels can do without the second pass, but converge more slowly on stretched
// triangles.
class PointSelection {
public:
    void lay_out(Arena& arena, Index n) noexcept;
    // coarse [rows.n] receives the numbers of the coarse points on the coarser level, in the order
    // of the rows, and none for fine points. The second pass ends when there are `most` coarse
    // points; 0 means no second pass. Returns the number of coarse points.
    Index select(FullRows const& rows, Index most, Span<Index> coarse) noexcept;

private:
    // Undecided points are in the list of their weight; larger weights share the last list.
    static constexpr Index lists = 64;
    static constexpr Index undecided = -2;

    void insert(Index point) noexcept;
    void remove(Index point) noexcept;
    void change_weight(Index point, Index by) noexcept;
    void choose(FullRows const& rows, Span<Index> coarse, Index point) noexcept;
    void leave(FullRows const& rows, Span<Index> coarse, Index point) noexcept;
    void add_common_points(FullRows const& rows, Index count, Span<Index> coarse) noexcept;
    Index find_lonely(FullRows const& rows, Span<const Index> coarse, Index point) noexcept;

    Span<Index> weight_, next_, previous_;  // [n]
    Index first_[lists];
    Index heaviest_ = 0;  // No list behind this one has points.
};

}  // namespace harmorph
