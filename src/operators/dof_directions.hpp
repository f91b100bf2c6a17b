// Turns numbers of dofs into displacements of points, and back. Only this file and the matrix
// distinguish slipping points and turned sides from others. tests/boundary/test_slip.cpp and
// tests/boundary/test_rotation.cpp cover this file.
#pragma once

#include "operators/residual.hpp"

namespace harmorph {

class DofDirections {
public:
    explicit DofDirections(Matrix const& matrix) noexcept : matrix_(matrix) {}

    // The dof of a slipping point is a movement along the tangent, which becomes movements along x
    // and y. This must be called before points that are joined to slipping ones get the same
    // numbers.
    void turn_slipping(DofValues const& values, Index n_points) const noexcept;
    void turn_slipping_back(DofValues const& values, Index n_points) const noexcept;
    // The number of a dof on a side of a passage becomes the displacement of the point. This must
    // be called after joined points have got the numbers of the points to which they are joined.
    void turn_sides(DofValues const& values, Index n_points) const noexcept;
    void turn_sides_back(DofValues const& values, Index n_points) const noexcept;

private:
    template <class Turn>
    void for_each_slipping(DofValues const& values, Index n_points,
                           Turn const& turn) const noexcept;
    template <class Turn>
    void for_each_turned(DofValues const& values, Index n_points, Turn const& turn) const noexcept;

    Matrix const& matrix_;
};

}  // namespace harmorph
