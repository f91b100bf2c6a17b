// The movements of control points by which bases are compared, for an airfoil of chord 1 from x = 0
// to 1.
#pragma once

#include <cmath>
#include <vector>

namespace deform {

struct Movements {
    std::vector<double> control;  // x,y pairs

    std::size_t points() const { return control.size() / 2; }

    // by(x, y, dx, dy) for every control point.
    template <class By>
    std::vector<double> of_each(By by) const {
        std::vector<double> moves(control.size());
        for (std::size_t i = 0; i < control.size(); i += 2)
            by(control[i], control[i + 1], moves[i], moves[i + 1]);
        return moves;
    }
    // A parabolic arc of this height, in chords.
    std::vector<double> camber(double height) const {
        return of_each(
            [&](double x, double, double&, double& dy) { dy = 4 * height * x * (1 - x); });
    }
    // About (x0, y0), counter-clockwise, and then on by (dx, dy).
    std::vector<double> rotation(double degrees, double x0 = .25, double y0 = 0, double shift_x = 0,
                                 double shift_y = 0) const {
        double const angle = degrees * 3.14159265358979323846 / 180, c = std::cos(angle),
                     s = std::sin(angle);
        return of_each([&](double x, double y, double& dx, double& dy) {
            dx = (c - 1) * (x - x0) - s * (y - y0) + shift_x;
            dy = s * (x - x0) + (c - 1) * (y - y0) + shift_y;
        });
    }
    // y grows by so many times itself.
    std::vector<double> thickening(double by) const {
        return of_each([&](double, double y, double&, double& dy) { dy = by * y; });
    }
    std::vector<double> translation(double by) const {
        return of_each(
            [&](double, double, double& dx, double& dy) { dx = dy = by * std::sqrt(.5); });
    }
    // The last quarter of the chord, downwards about its hinge on the chord line.
    std::vector<double> flap(double degrees) const {
        double const angle = -degrees * 3.14159265358979323846 / 180, c = std::cos(angle),
                     s = std::sin(angle);
        return of_each([&](double x, double y, double& dx, double& dy) {
            if (x <= .75) return;
            dx = (c - 1) * (x - .75) - s * y;
            dy = s * (x - .75) + (c - 1) * y;
        });
    }
    // The upper control point nearest to x = 0.4, upwards.
    std::vector<double> bump(double height) const {
        std::vector<double> moves(control.size());
        std::size_t best = control.size();
        for (std::size_t i = 0; i < control.size(); i += 2) {
            bool const nearer = best == control.size() ||
                                std::fabs(control[i] - .4) < std::fabs(control[best] - .4);
            if (control[i + 1] > 0 && nearer) best = i;
        }
        if (best < control.size()) moves[best + 1] = height;
        return moves;
    }
};

}  // namespace deform
