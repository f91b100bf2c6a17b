// What the equations know of each point: whether its value is unknown, prescribed on the wall or 0,
// and along which directions its degrees of freedom move it.
#pragma once

#include "base/arena.hpp"
#include "basis/options.hpp"
#include "boundary/periodic.hpp"
#include "ordering/graph.hpp"

namespace harmorph {

// What the unknowns are, and so what an entry of the matrix is.
//   real        one real number for a point: operators that move x and y alike
//   complex     one complex number for a point: the conformal operator
//   coupled_xy  two real numbers for a point, one where it slips: any operator where slip lines
//               couple x and y
enum class MatrixKind : std::int32_t { real, complex, coupled_xy };

inline MatrixKind matrix_kind(Method const& method, Demands const& demands) noexcept {
    if (demands.slip) return MatrixKind::coupled_xy;
    return method.operator_row().is_complex || demands.rotation ? MatrixKind::complex
                                                                : MatrixKind::real;
}

// Degrees of freedom (dofs): a point has one (a real or a complex number), or two where x and y are
// coupled: dof 2 p moves point p along its frame, dof 2 p + 1 normal to it. A point that slips has
// the first one only, along the tangent. Where sides of a passage are turned against each other,
// the frame of a point turns the complex number of its dof into the displacement of the point.
//
// After find(), points that are joined have the same rows, and frames of points that slip are unit
// vectors.
class Unknowns {
public:
    MatrixKind kind() const noexcept { return kind_; }
    Index components() const noexcept { return couples_xy() ? 2 : 1; }
    bool couples_xy() const noexcept { return kind_ == MatrixKind::coupled_xy; }
    bool is_complex() const noexcept { return kind_ == MatrixKind::complex; }
    Index planes() const noexcept { return is_complex() ? 2 : 1; }
    // Are sides of a passage turned against each other?
    bool turns_sides() const noexcept { return is_complex() && !frame_.empty(); }

    // Dofs on the wall are numbered components * slot + component. wall(wall(dof)) = dof.
    static constexpr Index wall(Index dof) noexcept { return -2 - dof; }
    static constexpr bool is_wall(Index row) noexcept { return row <= -2; }
    // The row of an unknown; wall(dof on the wall); none where the value is 0.
    Index row_of(Index dof) const noexcept { return row_of_[dof]; }
    Span<const Index> rows_of_dofs() const noexcept { return row_of_; }
    Index first_row(Index point) const noexcept { return row_of_[components() * point]; }

    bool is_unknown(Index point) const noexcept { return first_row(point) >= 0; }
    // The number of the point on the wall, or none.
    Index wall_slot(Index point) const noexcept {
        Index const row = first_row(point);
        return is_wall(row) ? wall(row) / components() : none;
    }
    bool slips(Index point) const noexcept {
        return couples_xy() && is_unknown(point) && row_of_[2 * point + 1] == none;
    }
    // The direction of the first dof; only where x and y are coupled or sides are turned.
    Vec2 frame(Index point) const noexcept { return frame_[point]; }
    // The factor from the number of a dof to the displacement of the point.
    Vec2 turn(Index point) const noexcept { return turns_sides() ? frame_[point] : Vec2{1, 0}; }
    // Has the cell a corner on a side of a passage that is turned against the other side?
    bool is_turned(Cell const& cell) const noexcept {
        bool any = false;
        for (Index k = 0; k < cell.n; ++k)
            any = any || frame_[cell.point[k]].y != 0 || frame_[cell.point[k]].x != 1;
        return any;
    }
    // May two points slip along different directions? Neither moves normal to its own slip line, so
    // for the equation of the other point it is partly fixed.
    bool differ(Index point, Index other) const noexcept {
        return frames_change_ || frame_[point].x != frame_[other].x ||
               frame_[point].y != frame_[other].y;
    }

    // Frames change with the coordinates where points slip along curves: to be said before find().
    void let_frames_change(bool they_do) noexcept { frames_change_ = they_do; }
    void set_tangent(Index point, Vec2 tangent) const noexcept { frame_[point] = tangent; }

protected:
    void lay_out_rows(Arena& arena, Index n_points, MatrixKind kind) noexcept;
    void lay_out_frames(Arena& arena, Index n_points, bool turns) noexcept;
    // representative, slot, tangent [n_points] and position [unknowns] as in Matrix::build().
    void find(Span<const Index> representative, Graph const& graph, Span<const Index> position,
              Span<const Index> slot, Span<const Vec2> tangent,
              Periodicity const& periodicity) noexcept;

private:
    MatrixKind kind_ = MatrixKind::real;
    bool frames_change_ = false;
    Span<Index> row_of_;  // [components * n_points]
    Span<Vec2> frame_;    // [n_points] where x and y are coupled or sides turned
};

}  // namespace harmorph
