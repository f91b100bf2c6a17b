// The data of each point for the equations: whether its value is unknown, prescribed on the wall or
// 0, and the directions along which its degrees of freedom move it. tests/operators/test_matrix.cpp
// covers this file.
#pragma once

#include "base/arena.hpp"
#include "basis/options.hpp"
#include "boundary/periodic.hpp"
#include "ordering/graph.hpp"

namespace harmorph {

// The kind of the unknowns, and so of the entries of the matrix:
//   real        one real number for a point: operators that move x and y alike
//   complex     one complex number for a point: the conformal operator
//   coupled_xy  two real numbers for a point, one if it slips: any operator if slip lines couple
//               x and y
enum class MatrixKind : std::int32_t { real, complex, coupled_xy };

inline MatrixKind matrix_kind(Method const& method, Demands const& demands) noexcept {
    if (demands.slip) return MatrixKind::coupled_xy;
    return method.operator_row().is_complex || demands.rotation ? MatrixKind::complex
                                                                : MatrixKind::real;
}

// Degrees of freedom (dofs): a point has one (a real or a complex number), or two if x and y are
// coupled: dof 2 p moves point p along its direction, dof 2 p + 1 normal to it. A point that slips
// has the first one only, along the tangent or against it: the larger component of the direction is
// positive, so that the entry between a slipping point and a neighbour inside is negative, as
// between two points inside. The coarse levels of multigrid depend on that sign. If sides of a
// passage are rotated against each other, the direction of a point is the factor that rotates the
// complex number of its dof into the displacement of the point.
//
// After find(), points that are joined have the same rows, and directions of points that slip are
// unit vectors.
class Unknowns {
public:
    MatrixKind kind() const noexcept { return kind_; }
    Index components() const noexcept { return couples_xy() ? 2 : 1; }
    bool couples_xy() const noexcept { return kind_ == MatrixKind::coupled_xy; }
    bool is_complex() const noexcept { return kind_ == MatrixKind::complex; }
    Index planes() const noexcept { return is_complex() ? 2 : 1; }
    // Tells whether sides of a passage are rotated against each other.
    bool has_rotated_sides() const noexcept { return is_complex() && !direction_.empty(); }

    // Dofs on the wall are numbered components * slot + component. wall(wall(dof)) is dof.
    static constexpr Index wall(Index dof) noexcept { return -2 - dof; }
    static constexpr bool is_wall(Index row) noexcept { return row <= -2; }
    // Returns the row of an unknown, wall(dof on the wall), or none if the value is 0.
    Index row_of(Index dof) const noexcept { return row_of_[dof]; }
    Span<const Index> rows_of_dofs() const noexcept { return row_of_; }
    Index first_row(Index point) const noexcept { return row_of_[components() * point]; }

    bool is_unknown(Index point) const noexcept { return first_row(point) >= 0; }
    // Returns the number of the point on the wall, or none.
    Index wall_slot(Index point) const noexcept {
        Index const row = first_row(point);
        return is_wall(row) ? wall(row) / components() : none;
    }
    bool slips(Index point) const noexcept {
        return couples_xy() && is_unknown(point) && row_of_[2 * point + 1] == none;
    }
    // Returns the direction of the first dof; valid only if x and y are coupled or sides are
    // rotated.
    Vec2 direction(Index point) const noexcept { return direction_[point]; }
    // Returns the factor from the number of a dof to the displacement of the point.
    Vec2 rotation(Index point) const noexcept {
        return has_rotated_sides() ? direction_[point] : Vec2{1, 0};
    }
    // Tells whether the cell has a corner on a side of a passage that is rotated against the other
    // side.
    bool is_rotated(Cell const& cell) const noexcept {
        bool any = false;
        for (Index k = 0; k < cell.n; ++k)
            any = any || direction_[cell.point[k]].y != 0 || direction_[cell.point[k]].x != 1;
        return any;
    }
    // Tells whether two points may slip along different directions. Neither moves normal to its own
    // slip line, so for the equation of the other point it is partly fixed.
    bool may_differ(Index point, Index other) const noexcept {
        return directions_change_ || direction_[point].x != direction_[other].x ||
               direction_[point].y != direction_[other].y;
    }

    // Directions change with the coordinates if points slip along curves; to be set before
    // find().
    void set_directions_change(bool change) noexcept { directions_change_ = change; }
    void set_tangent(Index point, Vec2 tangent) const noexcept {
        bool const is_against = abs(tangent.x) < abs(tangent.y) ? tangent.y < 0 : tangent.x < 0;
        direction_[point] = is_against ? -1 * tangent : tangent;
    }

protected:
    void lay_out_rows(Arena& arena, Index n_points, MatrixKind kind) noexcept;
    void lay_out_directions(Arena& arena, Index n_points, bool rotates) noexcept;
    // representative, slot, tangent [n_points] and position [unknowns] are those of
    // Matrix::build().
    void find(Span<const Index> representative, Graph const& graph, Span<const Index> position,
              Span<const Index> slot, Span<const Vec2> tangent,
              Periodicity const& periodicity) noexcept;

private:
    MatrixKind kind_ = MatrixKind::real;
    bool directions_change_ = false;
    Span<Index> row_of_;  // [components * n_points]
    Span<Vec2>
        direction_;  // [n_points] This array exists if x and y are coupled or sides are rotated.
};

}  // namespace harmorph
