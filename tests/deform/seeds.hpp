// Random movements of control points, the same for every compiler: counted by seeds.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace deform {

// xorshift64*, G. Marsaglia, J. Stat. Softw. 8 (2003) 14; S. Vigna, ACM Trans. Math. Softw. 42 (2016) 30.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(0x9E3779B97F4A7C15u * (seed + 1)) {}
    double uniform(double low, double high) {
        state_ ^= state_ >> 12;
        state_ ^= state_ << 25;
        state_ ^= state_ >> 27;
        return low + (high - low) * static_cast<double>((state_ * 0x2545F4914F6CDD1Du) >> 11) * 0x1p-53;
    }

private:
    std::uint64_t state_;
};

// A share of the control points, from one to all, moves by up to an amplitude, from .01 to 1 chord, evenly in its logarithm.
inline std::vector<double> random_movement(std::size_t n_control, std::uint64_t seed) {
    Random random(seed);
    double const amplitude = std::pow(10, random.uniform(-2, 0)), share = random.uniform(1.0 / static_cast<double>(n_control), 1);
    std::vector<double> moves(2 * n_control);
    for (std::size_t i = 0; i < n_control; ++i) {
        bool const moves_it = random.uniform(0, 1) < share;
        double const dx = random.uniform(-amplitude, amplitude), dy = random.uniform(-amplitude, amplitude);
        if (!moves_it) continue;
        moves[2 * i] = dx;
        moves[2 * i + 1] = dy;
    }
    return moves;
}

}  // namespace deform
