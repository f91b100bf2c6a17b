// Gradient and Hessian of a cell by its points, against the sums over corners and modes that they
// stand for.
#include <doctest/doctest.h>

#include "safe/corner_map.hpp"

#include <cmath>
#include <random>

using harmorph::Block;
using harmorph::CellForm;
using harmorph::CornerForm;
using harmorph::Index;
using harmorph::Vec2;

namespace {

double random_number(std::mt19937& random) { return double(random()) / 2147483648.0 - 1; }
Vec2 random_vector(std::mt19937& random) { return {random_number(random), random_number(random)}; }

// Derivatives do not change when all points move together: their sum over the points is 0.
void make_derivative(std::mt19937& random, Vec2 (&at)[3]) {
    at[0] = random_vector(random);
    at[2] = random_vector(random);
    at[1] = -1 * (at[0] + at[2]);
}

// One direction of a Hessian by the three points of a corner, whose term is curvature * (at at^T).
struct Mode {
    double curvature;
    Vec2 at[3];
};

// The gradient and the Hessian of one energy of a corner.
struct Term {
    Vec2 gradient[3];
    Mode mode[4];

    explicit Term(std::mt19937& random) {
        make_derivative(random, gradient);
        for (Mode& one : mode) {
            make_derivative(random, one.at);
            one.curvature = 1 + random_number(random);
        }
    }
    void add_to(CornerForm& form) const {
        form.by_side = form.by_side - gradient[0];
        form.by_next = form.by_next + gradient[2];
        for (Mode const& one : mode) {
            Vec2 const side = -1 * one.at[0], next = one.at[2];
            form.side_side.add(one.curvature, side, side);
            form.side_next.add(one.curvature, side, next);
            form.next_next.add(one.curvature, next, next);
        }
    }
};

// Derivatives by points of a triangle whose first side is seen turned become those by the points
// themselves.
void turn_back(Vec2 turn, Vec2 (&by)[3]) {
    Vec2 const by_start = product(turn, by[0]);
    by[1] = by[1] + by[0] - by_start;
    by[0] = by_start;
}

double difference(Block const& p, Block const& q) {
    return std::fabs(p.a - q.a) + std::fabs(p.b - q.b) + std::fabs(p.c - q.c) +
           std::fabs(p.d - q.d);
}

template <Index n>
void check(Vec2 turn, bool is_passage, unsigned seed) {
    std::mt19937 random(seed);
    Vec2 by[n];
    Block hessian[n][n];
    Vec2 turn_of_point[n];
    for (Vec2& point_turn : turn_of_point) {
        double const angle = random_number(random);
        point_turn = {std::cos(angle), std::sin(angle)};
    }
    harmorph::Cell cell{n, {}};
    for (Index k = 0; k < n; ++k) cell.point[k] = n - 1 - k;
    CellForm<n> form;
    for (Index own = 0; own < n; ++own) {
        Index const point[3] = {(own + n - 1) % n, own, (own + 1) % n};
        CornerForm corner;
        auto const add = [&](double curvature, const Vec2(&at)[3], bool is_gradient) {
            Vec2 turned[3] = {at[0], at[1], at[2]};
            turn_back(turn, turned);
            for (int k = 0; k < 3 && is_passage; ++k) {
                turned[k] = product(conjugate(turn_of_point[cell.point[point[k]]]), turned[k]);
            }
            for (int k = 0; k < 3; ++k) {
                if (is_gradient) by[point[k]] = by[point[k]] + turned[k];
                for (int other = 0; other < 3 && !is_gradient; ++other) {
                    hessian[point[k]][point[other]].add(curvature, turned[k], turned[other]);
                }
            }
        };
        for (int terms = 0; terms < 2; ++terms) {
            Term const term(random);
            add(0, term.gradient, true);
            for (Mode const& one : term.mode) add(one.curvature, one.at, false);
            term.add_to(corner);
        }
        corner.rotate_side_back(turn);
        form.add(point[0], own, point[2], corner);
    }
    if (is_passage) form.rotate_back({turn_of_point, n}, cell);
    for (Index k = 0; k < n; ++k) {
        CHECK(length(form.by[k] - by[k]) < 1e-13);
        for (Index other = 0; other < n; ++other) {
            CHECK(difference(form.hessian[k][other], hessian[k][other]) < 1e-12);
            CHECK(difference(form.hessian[k][other], transpose(form.hessian[other][k])) < 1e-12);
        }
    }
}

}  // namespace

TEST_CASE("the cell form is the sum over all corners, with turned sides and turned points") {
    double const half = std::sqrt(0.5);
    for (unsigned seed = 1; seed < 20; ++seed)
        for (bool const is_passage : {false, true})
            for (Vec2 const turn : {Vec2{1, 0}, Vec2{half, half}, Vec2{-half, half}}) {
                check<3>(turn, is_passage, seed);
                check<4>(turn, is_passage, seed);
            }
}
