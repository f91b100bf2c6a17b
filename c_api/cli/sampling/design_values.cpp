#include "sampling/design_values.hpp"

#include "basics/numbers.hpp"
#include "files/text_file.hpp"

#include <algorithm>

namespace cli {

namespace {

// A polynomial over the field of two elements; bit k is the coefficient of x^k.
using Polynomial = std::uint32_t;

int degree_of(Polynomial p) {
    int degree = -1;
    for (; p != 0; p >>= 1) ++degree;
    return degree;
}

// Returns whether the powers of x modulo p are all polynomials of a lower degree except 0.
bool is_primitive(Polynomial p) {
    const int degree = degree_of(p);
    const std::uint32_t order = (std::uint32_t{1} << degree) - 1;
    Polynomial power = 1;
    for (std::uint32_t k = 1; k <= order; ++k) {
        power <<= 1;
        if ((power >> degree) & 1) power ^= p;
        if (power == 1) return k == order;
    }
    return false;
}

}  // namespace

Sobol::Sobol(std::size_t dimensions, std::uint64_t seed) {
    Polynomial next = 3;  // x + 1
    for (std::size_t dimension = 0; dimension < dimensions; ++dimension) {
        std::array<std::uint32_t, bits> v = {};
        shift_.push_back(static_cast<std::uint32_t>(mixed_bits(seed, dimension) >> 32));
        if (dimension == 0) {
            for (std::size_t k = 0; k < bits; ++k) v[k] = std::uint32_t{1} << (bits - 1 - k);
            directions_.push_back(v);
            continue;
        }
        while (!is_primitive(next)) next += 2;
        const auto degree = static_cast<std::size_t>(degree_of(next));
        for (std::size_t k = 0; k < bits; ++k) {
            if (k < degree) {  // any odd number below 2^(k+1)
                const auto below = (std::uint32_t{1} << (k + 1)) - 1;
                const auto odd = static_cast<std::uint32_t>(mixed_bits(dimension, k)) & below;
                v[k] = (odd | 1) << (bits - 1 - k);
                continue;
            }
            v[k] = v[k - degree] ^ (v[k - degree] >> degree);
            for (std::size_t j = 1; j < degree; ++j)
                if ((next >> (degree - j)) & 1) v[k] ^= v[k - j];
        }
        directions_.push_back(v);
        next += 2;
    }
}

double Sobol::at(std::uint64_t index, std::size_t dimension) const {
    std::uint32_t value = shift_[dimension];
    for (std::size_t k = 0; k < bits; ++k)
        if ((index >> k) & 1) value ^= directions_[dimension][k];
    return (value + .5) / 4294967296.0;
}

LatinHypercube::LatinHypercube(std::uint64_t n, std::uint64_t seed) : n_(n), seed_(seed) {
    while ((std::uint64_t{1} << (2 * half_bits_)) < n) ++half_bits_;
}

// A Feistel network permutes the numbers of 2 half_bits bits. It is applied until the number is
// below n, which makes a permutation of these numbers.
std::uint64_t LatinHypercube::permuted(std::uint64_t index, std::uint64_t key) const {
    constexpr std::uint64_t rounds = 6;
    const std::uint64_t mask = (std::uint64_t{1} << half_bits_) - 1;
    do {
        std::uint64_t left = index >> half_bits_, right = index & mask;
        for (std::uint64_t round = 0; round < rounds; ++round) {
            const std::uint64_t next = left ^ (mixed_bits(key + round, right) & mask);
            left = right;
            right = next;
        }
        index = (left << half_bits_) | right;
    } while (index >= n_);
    return index;
}

double LatinHypercube::at(std::uint64_t index, std::size_t dimension) const {
    const std::uint64_t key = mixed_bits(seed_, dimension);
    const auto interval = static_cast<double>(permuted(index, key));
    return (interval + unit_number(mixed_bits(key, ~index))) / static_cast<double>(n_);
}

namespace {

std::size_t place_of(const std::vector<DesignParameter>& parameters, std::string_view name,
                     const LineReader& lines) {
    for (std::size_t k = 0; k < parameters.size(); ++k)
        if (parameters[k].name == name) return k;
    const std::string names =
        parameters.empty() ? "none" : parameters.front().name + " .. " + parameters.back().name;
    lines.expected("a parameter of the designs (" + names + ")", name);
}

double number_of(const LineReader& lines, std::string_view word) {
    double number = 0;
    if (!parse(word, number)) lines.expected("a finite number", word);
    return number;
}

// Names may be in quotation marks, as many programs write them; they have no commas.
std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> cells;
    while (!line.empty()) {
        const std::size_t end = std::min(line.find_first_of(", \t"), line.size());
        std::string_view cell = line.substr(0, end);
        if (cell.size() > 2 && cell.front() == '"' && cell.back() == '"')
            cell = cell.substr(1, cell.size() - 2);
        if (!cell.empty()) cells.push_back(cell);
        line.remove_prefix(std::min(end + 1, line.size()));
    }
    return cells;
}

}  // namespace

DesignValues DesignValues::of_sequence(std::vector<DesignParameter> parameters, Sequence sequence,
                                       std::int64_t n, std::uint64_t seed) {
    DesignValues out;
    const auto varies = [](const DesignParameter& one) { return one.low < one.high; };
    const auto dimensions =
        static_cast<std::size_t>(std::count_if(parameters.begin(), parameters.end(), varies));
    out.parameters_ = std::move(parameters);
    out.count_ = n;
    if (sequence == Sequence::sobol) out.sobol_.emplace(dimensions, seed);
    else out.latin_.emplace(static_cast<std::uint64_t>(n), seed);
    return out;
}

DesignValues DesignValues::of_table(const std::string& path,
                                    std::vector<DesignParameter> parameters) {
    const TextFile file(path);
    LineReader lines(file, '#');
    DesignValues out;
    if (!lines.next()) lines.expected("a line with the names of parameters");
    std::vector<std::size_t> columns;
    for (const std::string_view name : words_of(lines.line())) {
        columns.push_back(place_of(parameters, name, lines));
        if (std::count(columns.begin(), columns.end(), columns.back()) > 1)
            lines.fail("the parameter " + std::string(name) + " has two columns");
    }
    for (DesignParameter& one : parameters) one.low = one.high = 0;
    while (lines.next()) {
        const std::vector<std::string_view> cells = words_of(lines.line());
        if (cells.size() != columns.size())
            lines.expected(plural(std::int64_t(columns.size()), "number"));
        std::vector<double> row(parameters.size());
        for (std::size_t k = 0; k < cells.size(); ++k) row[columns[k]] = number_of(lines, cells[k]);
        for (std::size_t k = 0; k < row.size(); ++k) {
            DesignParameter& one = parameters[k];
            one.low = out.count_ == 0 ? row[k] : std::min(one.low, row[k]);
            one.high = out.count_ == 0 ? row[k] : std::max(one.high, row[k]);
        }
        out.table_.insert(out.table_.end(), row.begin(), row.end());
        ++out.count_;
    }
    out.parameters_ = std::move(parameters);
    return out;
}

std::vector<double> DesignValues::values(std::int64_t design) const {
    const std::size_t n = parameters_.size();
    if (!sobol_ && !latin_) {
        const auto row = table_.begin() + static_cast<std::ptrdiff_t>(n) * design;
        return {row, row + static_cast<std::ptrdiff_t>(n)};
    }
    const auto index = static_cast<std::uint64_t>(design);
    std::vector<double> out;
    std::size_t dimension = 0;
    for (const DesignParameter& one : parameters_) {
        double share = 0;
        if (one.low < one.high) {
            share = sobol_ ? sobol_->at(index, dimension) : latin_->at(index, dimension);
            ++dimension;
        }
        out.push_back(one.low + share * (one.high - one.low));
    }
    return out;
}

void read_ranges(const std::string& path, std::vector<DesignParameter>& parameters) {
    const TextFile file(path);
    LineReader lines(file, '#');
    std::vector<bool> named(parameters.size());
    while (lines.next()) {
        if (lines.words().size() != 3) lines.expected("the name of a parameter, low, high");
        const std::size_t k = place_of(parameters, lines.words()[0], lines);
        const double low = number_of(lines, lines.words()[1]),
                     high = number_of(lines, lines.words()[2]);
        if (named[k]) lines.fail("the parameter " + parameters[k].name + " has a range already");
        if (low > high) lines.fail("the lower end of the range is above the upper end");
        named[k] = true;
        parameters[k].low = low;
        parameters[k].high = high;
    }
}

}  // namespace cli
