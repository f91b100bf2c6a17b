// Compares the functions, morphs, derived bases and safe morphs of a solved problem with the
// statements of the header.
#pragma once

#include "exceptions.hpp"
#include "reference.hpp"
#include "solution.hpp"

namespace fuzz {

// All checks of one solution, with one random movement of its control points and bodies.
class SolutionCheck {
public:
    // judged: the mesh at which the problem was analysed, where polygons are divided for good.
    SolutionCheck(Solution& solution, Judged judged, Input& input);
    void all();
    // The points after a part of the movement that leaves a mesh valid; none if there is no such
    // mesh.
    std::vector<Point> next_mesh();
    // That the movement of the points from `origin`, where the basis was made, is found.
    void recovered_from(std::vector<Point> const& origin);

private:
    using Numbers = std::vector<double>;

    // check_functions.cpp
    void values();
    void wall();
    void derived_bases();

    // check_movement.cpp
    void displacement();
    void is_sum(double found, std::size_t point, std::size_t component) const;
    void pairs_move_alike(Numbers const& dx, Numbers const& dy, double rounding) const;
    void step(hm_points const& by, std::vector<Point> const& displacement);
    void quality(hm_points const& to, std::vector<Point> const& at);
    void adjoint();

    // check_safe_morph.cpp
    void improvement();
    void slide(Numbers& x, Numbers& y);
    void safe_morph();
    hm_basis* another_basis();
    void walls_follow(hm_basis* derivative, double fraction);
    void field_follows(hm_basis* derivative, hm_safe_options const& given,
                       hm_safe_report const& first);
    Numbers some_movement();
    void displace_by(hm_basis* basis, Numbers const& by, Numbers& dx, Numbers& dy);
    void wall_is_at(std::vector<Point> const& at, Numbers const& reached, double rotated_offset);

    double extent() const;
    std::vector<Point> moved(Numbers const& x, Numbers const& y) const;
    bool marker_slides(std::int32_t marker) const;
    bool is_real() const { return info_.numbers_per_value == 1; }

    Solution& its_;
    Problem const& problem_;
    Input& input_;
    Judged judged_;
    hm_basis_info info_{};
    hm_error error_{};
    std::size_t n_ = 0;
    Numbers move_;
    double largest_ = 0;                       // of the functions' values
    std::vector<std::vector<Numbers>> value_;  // of each function, its numbers at each point
};

}  // namespace fuzz
