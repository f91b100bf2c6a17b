// Random movements of control points, the same for every compiler: counted by seeds.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace deform {

// xorshift64*, G. Marsaglia, J. Stat. Softw. 8 (2003) 14; S. Vigna, ACM Trans. Math. Softw. 42
// (2016) 30.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(0x9E3779B97F4A7C15u * (seed + 1)) {}
    double uniform(double low, double high) {
        state_ ^= state_ >> 12;
        state_ ^= state_ << 25;
        state_ ^= state_ >> 27;
        return low +
               (high - low) * static_cast<double>((state_ * 0x2545F4914F6CDD1Du) >> 11) * 0x1p-53;
    }

private:
    std::uint64_t state_;
};

// A share of the control points, from one to all, moves by up to an amplitude, from .01 to 1 of
// `most`, evenly in its logarithm.
inline std::vector<double> random_movement(std::size_t n_control, std::uint64_t seed,
                                           double most = 1) {
    Random random(seed);
    double const amplitude = most * std::pow(10, random.uniform(-2, 0));
    double const share = random.uniform(1.0 / static_cast<double>(n_control), 1);
    std::vector<double> moves(2 * n_control);
    for (std::size_t i = 0; i < n_control; ++i) {
        bool const moves_it = random.uniform(0, 1) < share;
        double const dx = random.uniform(-amplitude, amplitude),
                     dy = random.uniform(-amplitude, amplitude);
        if (!moves_it) continue;
        moves[2 * i] = dx;
        moves[2 * i + 1] = dy;
    }
    return moves;
}

// A piece of a wall whose two end points stay. Even seeds: as above; odd ones: four waves normal to
// the wall, and a fifth of that along it. `most`: the largest amplitude.
inline std::vector<double> random_bump(std::size_t n_control, std::uint64_t seed, double most) {
    std::vector<double> moves(2 * n_control);
    if (seed % 2 == 0) {
        moves = random_movement(n_control, seed, most);
    } else {
        Random random(seed);
        double const amplitude = most * std::pow(10, random.uniform(-2, 0));
        double largest = 0;
        for (int wave = 1; wave <= 4; ++wave) {
            double const dx = .2 * random.uniform(-1, 1) / wave, dy = random.uniform(-1, 1) / wave;
            for (std::size_t i = 0; i < n_control; ++i) {
                double const s = std::sin(std::acos(-1.0) * wave * static_cast<double>(i) /
                                          static_cast<double>(n_control - 1));
                moves[2 * i] += dx * s;
                moves[2 * i + 1] += dy * s;
            }
        }
        for (std::size_t i = 1; i < 2 * n_control; i += 2)
            largest = std::max(largest, std::fabs(moves[i]));
        for (double& move : moves) move *= amplitude / largest;
    }
    for (std::size_t i : {std::size_t{0}, n_control - 1}) moves[2 * i] = moves[2 * i + 1] = 0;
    return moves;
}

// A body that moves by up to `most` up or down and by a quarter of that along, and turns by up to
// 30 degrees about the mean of its control points; with even seeds all control points move at
// random, too, by a tenth of `most`.
inline std::vector<double> random_flight(std::vector<double> const& control, std::uint64_t seed,
                                         double most) {
    Random random(seed);
    std::size_t const n = control.size() / 2;
    double const dx = random.uniform(-.25, .25) * most, dy = random.uniform(-1, 1) * most;
    double const angle = random.uniform(-1, 1) * std::acos(-1.0) / 6, c = std::cos(angle),
                 s = std::sin(angle);
    std::vector<double> moves(2 * n);
    if (seed % 2 == 0) moves = random_movement(n, seed, .1 * most);
    double centre[2] = {0, 0};
    for (std::size_t i = 0; i < 2 * n; ++i) centre[i % 2] += control[i] / static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) {
        double const x = control[2 * i] - centre[0], y = control[2 * i + 1] - centre[1];
        moves[2 * i] += dx + (c - 1) * x - s * y;
        moves[2 * i + 1] += dy + s * x + (c - 1) * y;
    }
    return moves;
}

}  // namespace deform
