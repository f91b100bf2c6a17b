// The parameters of designs and their values: from a sequence within ranges, or from a table.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cli {

// Random numbers that depend on a seed and on counters only, so that any of them can be computed
// alone. The function is the finaliser of SplitMix64 (G. Steele, D. Lea, C. Flood, 2014).

constexpr std::uint64_t mixed_bits(std::uint64_t bits) {
    bits += 0x9e3779b97f4a7c15u;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return bits ^ (bits >> 31);
}

constexpr std::uint64_t mixed_bits(std::uint64_t a, std::uint64_t b) {
    return mixed_bits(mixed_bits(a) ^ b);
}

// Returns a number in [0, 1), a multiple of 2^-53.
constexpr double unit_number(std::uint64_t bits) {
    return static_cast<double>(bits >> 11) * (1.0 / 9007199254740992.0);
}

// Sobol's sequence: points that fill the unit cube evenly. The first 2^k points have one coordinate
// in each of the 2^k equal intervals, in every dimension. (I. M. Sobol, USSR Comput. Math. Math.
// Phys. 7 (1967) 86; P. Bratley, B. L. Fox, ACM Trans. Math. Softw. 14 (1988) 88.)

class Sobol {
public:
    static constexpr std::size_t max_dimensions = 1000;

    // The seed shifts all points by exclusive or, which keeps the property above. The direction
    // numbers do not depend on the seed.
    Sobol(std::size_t dimensions, std::uint64_t seed);

    // Returns a number in (0, 1). index: 0 .. 2^32 - 1.
    double at(std::uint64_t index, std::size_t dimension) const;

private:
    static constexpr std::size_t bits = 32;

    std::vector<std::array<std::uint32_t, bits>> directions_;
    std::vector<std::uint32_t> shift_;
};

// Latin hypercube: of n points, one is in each of n equal intervals in every dimension. Any point
// is computed alone, so the memory does not depend on n. (M. McKay, R. Beckman, W. Conover,
// Technometrics 21 (1979) 239.)

class LatinHypercube {
public:
    LatinHypercube(std::uint64_t n, std::uint64_t seed);

    // Returns a number in [0, 1). index: 0 .. n - 1.
    double at(std::uint64_t index, std::size_t dimension) const;

private:
    std::uint64_t permuted(std::uint64_t index, std::uint64_t key) const;

    std::uint64_t n_, seed_;
    int half_bits_ = 1;  // 2^(2 half_bits) >= n
};

struct DesignParameter {
    std::string name;
    double low = 0, high = 0;
};

enum class Sequence { sobol, latin };

class DesignValues {
public:
    DesignValues() = default;  // designs without parameters

    // Values between `low` and `high` of each parameter. A parameter with low = high is constant
    // and takes no dimension of the sequence.
    static DesignValues of_sequence(std::vector<DesignParameter> parameters, Sequence sequence,
                                    std::int64_t n, std::uint64_t seed);

    // Reads a table: a line with names of `parameters`, then a line of numbers for each design;
    // columns are separated by commas or blanks. Parameters that the table does not have keep the
    // value 0. The ranges become those of the table.
    static DesignValues of_table(const std::string& path, std::vector<DesignParameter> parameters);

    const std::vector<DesignParameter>& parameters() const { return parameters_; }
    std::int64_t count() const { return count_; }
    std::vector<double> values(std::int64_t design) const;  // designs are counted from 0 here

private:
    std::vector<DesignParameter> parameters_;
    std::int64_t count_ = 0;
    std::optional<Sobol> sobol_;
    std::optional<LatinHypercube> latin_;
    std::vector<double> table_;
};

// Reads lines "NAME LOW HIGH" and sets the ranges of the parameters of these names.
void read_ranges(const std::string& path, std::vector<DesignParameter>& parameters);

}  // namespace cli
