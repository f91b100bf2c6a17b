// The passes of the V-cycle and of conjugate gradients, with the kernels of all instruction sets,
// against dense matrices.
#include <doctest/doctest.h>

#include <fixtures/agglomerated.hpp>
#include <fixtures/executors.hpp>

#include "multigrid/cycle_table.hpp"

#include <complex>

using namespace fixtures;
using harmorph::FunctionBlock;
using harmorph::Index;
using harmorph::Offset;

namespace {

std::size_t place(Index i) { return static_cast<std::size_t>(i); }

// A level with numbers of the given precision, and an interpolation whose row i has i % 4 weights.
template <class Number>
struct Setting {
    Case setup = two_body_case(Cells::hybrid, 10, 6);
    Analysed seen{setup};
    FrontMatrix front{*seen.operator->()};
    std::size_t n = place(front.rows.n);
    DenseMatrix dense = dense_of(front.rows);
    std::vector<Number> value, diagonal, weight;
    std::vector<Offset> start = {0};
    std::vector<Index> column;
    harmorph::CycleLevel<Number> level;

    Setting() {
        value.assign(front.rows.value.begin(), front.rows.value.end());
        diagonal.assign(front.rows.diagonal.begin(), front.rows.diagonal.end());
        level.n = front.rows.n;
        level.n_coarse = level.n / 3;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = 0; k < i % 4; ++k) {
                column.push_back(static_cast<Index>((i / 3 + k) % place(level.n_coarse)));
                weight.push_back(static_cast<Number>(0.5 - 0.3 * static_cast<double>(k)));
            }
            start.push_back(static_cast<Offset>(column.size()));
        }
        front.rows.for_each([&](Index row, Index other, Offset) {
            level.reach = std::max(level.reach, other - row);
        });
        level.start = front.rows.start.data();
        level.column = front.rows.column.data();
        level.value = value.data();
        level.diagonal = diagonal.data();
        level.by_start = start.data();
        level.by_column = column.data();
        level.by_weight = weight.data();
    }
    std::vector<Number> random_block(std::size_t rows, Index width, unsigned seed) const {
        std::mt19937 random(seed);
        std::vector<Number> out(rows * place(width));
        for (Number& one : out) one = static_cast<Number>(2 * uniform(random) - 1);
        return out;
    }
};

template <class Number>
std::vector<double> column_of(std::vector<Number> const& block, Index width, Index k) {
    std::vector<double> out;
    for (std::size_t i = place(k); i < block.size(); i += place(width)) out.push_back(block[i]);
    return out;
}
template <class Takes>
std::vector<double> product(DenseMatrix const& a, std::vector<double> const& x, Takes takes) {
    std::vector<double> y(x.size(), 0.0);
    for (std::size_t i = 0; i < a.n; ++i)
        for (std::size_t j = 0; j < a.n; ++j)
            if (takes(i, j)) y[i] += a.at(i, j) * x[j];
    return y;
}
bool any(std::size_t, std::size_t) { return true; }
bool below(std::size_t i, std::size_t j) { return j < i; }
bool lower(std::size_t i, std::size_t j) { return j <= i; }
bool upper(std::size_t i, std::size_t j) { return j >= i; }

template <class Number>
constexpr double rounding = 1e3 * static_cast<double>(std::numeric_limits<Number>::epsilon());
template <class Number>
constexpr Index widths[] = {4 * sizeof(float) / sizeof(Number), 8 * sizeof(float) / sizeof(Number),
                            16 * sizeof(float) / sizeof(Number)};

// The first rows of all blocks, so that blocks of different widths can be compared.
template <class Number>
void check_same_columns(std::vector<Number> const& block, Index width,
                        std::vector<Number> const& other, Index other_width) {
    for (Index k = 0; k < std::min(width, other_width); ++k)
        CHECK(same_bits(column_of(block, width, k), column_of(other, other_width, k)));
}

// Whether x is the result of a sweep over the level with the right-hand side b.
template <class Number>
void check_sweeps(harmorph::Kernel kernel, Index width, Setting<Number> const& s,
                  std::vector<Number>& z, std::vector<Number>& defect) {
    auto const& kernels = harmorph::cycle_kernels<Number>(kernel);
    std::vector<Number> const b = s.random_block(s.n, 16, 8),
                              c = s.random_block(place(s.level.n_coarse), 16, 9);
    auto const narrowed = [&](std::vector<Number> const& wide) {
        std::vector<Number> out;
        for (std::size_t i = 0; i < wide.size(); i += 16)
            out.insert(out.end(), wide.begin() + static_cast<std::ptrdiff_t>(i),
                       wide.begin() + static_cast<std::ptrdiff_t>(i) + width);
        return out;
    };
    z = narrowed(b);
    defect.assign(place(s.level.n_coarse * width), 7);
    kernels.descend(s.level, width, z.data(), defect.data());
    std::vector<Number> corrected = narrowed(c);
    double products[FunctionBlock::max_width] = {};
    std::vector<Number> const r = narrowed(b);
    kernels.ascend(s.level, width, corrected.data(), z.data(), r.data(), products);
    for (Index k = 0; k < width; ++k) {
        std::vector<double> const right = column_of(r, width, k), x = column_of(z, width, k);
        // (L + D) first = b, and the coarse right-hand side is P^T (b - A first).
        std::vector<double> first = right;
        for (std::size_t i = 0; i < s.n; ++i) {
            for (std::size_t j = 0; j < i; ++j) first[i] -= s.dense.at(i, j) * first[j];
            first[i] /= s.dense.at(i, i);
        }
        std::vector<double> const a_first = product(s.dense, first, any);
        std::vector<double> expected(place(s.level.n_coarse), 0.0), improved = first;
        for (std::size_t i = 0; i < s.n; ++i)
            for (auto e = place(static_cast<Index>(s.start[i]));
                 e < place(static_cast<Index>(s.start[i + 1])); ++e) {
                expected[place(s.column[e])] += double(s.weight[e]) * (right[i] - a_first[i]);
                improved[i] +=
                    double(s.weight[e]) * double(corrected[place(s.column[e] * width + k)]);
            }
        CHECK(largest_difference(column_of(defect, width, k), expected) < 10 * rounding<Number>);
        // (D + L^T) x = b - L (first + P c).
        std::vector<double> left = product(s.dense, x, upper);
        std::vector<double> const lower_part = product(s.dense, improved, below);
        double sum = 0;
        for (std::size_t i = 0; i < s.n; ++i) left[i] += lower_part[i], sum += right[i] * x[i];
        CHECK(largest_difference(left, right) < 10 * rounding<Number>);
        CHECK(products[k] == doctest::Approx(sum).epsilon(rounding<Number>));
        CHECK(largest_difference(product(s.dense, x, lower), right) > 1e-3);
    }
}

template <class Number>
void check_all_sweeps() {
    Setting<Number> const s;
    std::vector<Number> z, defect, first_z, first_defect;
    for (harmorph::Kernel const kernel : usable_kernels())
        for (Index const width : widths<Number>) {
            check_sweeps(kernel, width, s, z, defect);
            if (first_z.empty()) first_z = z, first_defect = defect;
            check_same_columns(z, width, first_z, widths<Number>[0]);
            check_same_columns(defect, width, first_defect, widths<Number>[0]);
        }
}

// A matrix A + i S, with S antisymmetric but for the diagonal, which must be 0: the row sums of S
// compensate its entries.
template <class Number>
struct HermitianSetting : Setting<Number> {
    std::vector<double> entries, row_sums;
    DenseMatrixOf<std::complex<double>> whole{this->n};

    explicit HermitianSetting(double size) {
        std::mt19937 random(9);
        row_sums.assign(this->n, 0.0);
        for (std::size_t i = 0; i < this->n; ++i)
            for (std::size_t j = 0; j < this->n; ++j) whole.at(i, j) = this->dense.at(i, j);
        this->front.rows.for_each([&](Index row, Index other, Offset) {
            double const entry = size * (2 * uniform(random) - 1);
            entries.push_back(entry);
            row_sums[place(row)] += entry;
            row_sums[place(other)] -= entry;
            whole.at(place(row), place(other)) += std::complex<double>(0, entry);
            whole.at(place(other), place(row)) -= std::complex<double>(0, entry);
        });
    }
    harmorph::ImaginaryRows imaginary() const {
        return {{row_sums.data(), row_sums.size()}, {entries.data(), entries.size()}};
    }
    // A x for function k of a block.
    std::vector<std::complex<double>> times(std::vector<Number> const& x, Index width, Index planes,
                                            Index k) const {
        std::vector<std::complex<double>> out(this->n);
        for (std::size_t i = 0; i < this->n; ++i)
            for (std::size_t j = 0; j < this->n; ++j)
                out[i] += whole.at(i, j) * at(x, j, width, planes, k);
        return out;
    }
    static std::complex<double> at(std::vector<Number> const& x, std::size_t i, Index width,
                                   Index planes, Index k) {
        std::size_t const from = i * place(width) + place(k);
        return {double(x[from]), planes == 2 ? double(x[from + place(width / 2)]) : 0.0};
    }
};

template <class Number>
void check_products(Index planes) {
    HermitianSetting<Number> const s(planes == 2 ? 1 : 0);
    std::vector<Number> first;
    for (harmorph::Kernel const kernel : usable_kernels())
        for (Index const width : widths<Number>) {
            std::vector<Number> r = s.random_block(s.n, width, 3),
                                p = s.random_block(s.n, width, 4),
                                z = s.random_block(s.n, width, 5), expected_p = p;
            typename harmorph::CycleKernels<Number>::Product task{};
            task.row_sum = s.front.rows.row_sum.data();
            task.imaginary = s.imaginary();
            for (Index k = 0; k < width; ++k)
                task.beta[k] = static_cast<Number>(0.25 * (k % (width / planes)));
            for (std::size_t i = 0; i < p.size(); ++i)
                expected_p[i] = z[i] + task.beta[i % place(width)] * p[i];
            task.r = r.data();
            task.p = p.data();
            std::vector<Number> q(z.size(), 5);
            task.z = z.data();
            task.q = q.data();
            harmorph::cycle_kernels<Number>(kernel).multiply(s.level, width, planes, task);
            CHECK(same_bits(std::vector<double>(p.begin(), p.end()),
                            std::vector<double>(expected_p.begin(), expected_p.end())));
            for (Index k = 0; k < width / planes; ++k) {
                auto const expected = s.times(p, width, planes, k);
                double energy = 0, along = 0, worst = 0;
                for (std::size_t i = 0; i < s.n; ++i) {
                    auto const own = s.at(p, i, width, planes, k);
                    worst = std::max(worst, std::abs(expected[i] - s.at(q, i, width, planes, k)));
                    energy += std::real(std::conj(own) * expected[i]);
                    along += std::real(std::conj(own) * s.at(r, i, width, planes, k));
                }
                CHECK(worst < 10 * rounding<Number>);
                CHECK(task.energy[k] == doctest::Approx(energy).epsilon(rounding<Number>));
                CHECK(task.along[k] == doctest::Approx(along).epsilon(rounding<Number>));
            }
            if (width != widths<Number>[0]) continue;
            if (first.empty()) first = q;
            CHECK(same_bits(std::vector<double>(q.begin(), q.end()),
                            std::vector<double>(first.begin(), first.end())));
        }
}

template <class Number>
void check_residuals(Index planes) {
    HermitianSetting<Number> const s(planes == 2 ? 1 : 0);
    Index const width = widths<Number>[1], columns = width / planes, given = columns - 1;
    std::vector<std::vector<Number>> found;
    for (harmorph::Kernel const kernel : usable_kernels()) {
        // Solutions have gaps between rows, and one function of the block does not exist.
        Index const length = planes * given + 3;
        std::vector<double> x = Setting<double>().random_block(s.n, length, 6),
                            rest = Setting<double>().random_block(s.n, width, 7);
        std::vector<double> const b = rest;
        std::vector<Number> r(s.n * place(width), 5);
        FunctionBlock block;
        block.width = width;
        block.planes = planes;
        block.values = {x.data(), nullptr, length, length, given};
        block.functions = given;
        typename harmorph::CycleKernels<Number>::Residual task{};
        task.rows = &s.front.rows;
        task.imaginary = s.imaginary();
        task.rest = rest.data();
        task.columns = columns;
        task.r = r.data();
        for (Index k = 0; k < columns; ++k) {
            task.scale[k] = 4;
            task.takes[k] = k != 1;
        }
        harmorph::cycle_kernels<Number>(kernel).find_residual(block, task);
        for (Index k = 0; k < given; ++k) {
            double squares = 0, energy = 0, product = 0;
            for (std::size_t i = 0; i < s.n; ++i) {
                std::complex<double> expected = 0, own = 0;
                for (std::size_t j = 0; j <= s.n; ++j) {
                    std::size_t const row = j < s.n ? j : i;
                    const double* const from = &x[row * place(length)] + k;
                    std::complex<double> const value(from[0], planes == 2 ? from[given] : 0.0);
                    if (j < s.n) expected += s.whole.at(i, j) * value;
                    else own = value;
                }
                energy += std::real(std::conj(own) * expected);
                const double* const right = &b[i * place(width)] + k;
                expected =
                    std::complex<double>(right[0], planes == 2 ? right[columns] : 0.0) - expected;
                squares += std::norm(expected);
                product += std::real(std::conj(own) * expected);
                std::complex<double> const taken = s.at(r, i, width, planes, k);
                double const worst =
                    k == 1 ? std::abs(taken.real() - 5) : std::abs(taken - 4.0 * expected);
                CHECK(worst <= (k == 1 ? 0 : 10 * rounding<Number>));
            }
            CHECK(task.squares[k] == doctest::Approx(squares).epsilon(1e-11));
            CHECK(task.energy[k] == doctest::Approx(energy).epsilon(1e-11));
            CHECK(task.product[k] == doctest::Approx(product).epsilon(1e-10));
        }
        found.push_back(r);
        CHECK(same_bits(std::vector<double>(r.begin(), r.end()),
                        std::vector<double>(found[0].begin(), found[0].end())));
    }
}

// An update with the sweep has the bits of an update alone and a sweep.
template <class Number>
void check_update() {
    Setting<Number> const s;
    for (harmorph::Kernel const kernel : usable_kernels())
        for (Index const width : widths<Number>) {
            auto const& kernels = harmorph::cycle_kernels<Number>(kernel);
            Index const length = width + 1;
            std::vector<double> const start = Setting<double>().random_block(s.n, length, 6);
            std::vector<Number> const p = s.random_block(s.n, width, 1),
                                      r0 = s.random_block(s.n, width, 2),
                                      q = s.random_block(s.n, width, 3);
            std::vector<Number> all[2], coarse[2];
            double squares[2] = {};
            for (int const fused : {0, 1}) {
                std::vector<double> x = start;
                std::vector<Number> r = r0, z(r0.size(), 5);
                coarse[fused].assign(place(s.level.n_coarse * width), 3);
                FunctionBlock block;
                block.width = width;
                block.values = {x.data(), nullptr, length, length, length};
                block.functions = width - 1;
                typename harmorph::CycleKernels<Number>::Update task{};
                for (Index k = 0; k < width; ++k) {
                    task.step[k] = static_cast<Number>(0.5 + 0.25 * k);
                    task.factor[k] = 2 * k;
                }
                task.p = p.data();
                task.q = q.data();
                task.r = r.data();
                task.descends = fused == 1;
                kernels.update(s.level, block, z.data(), coarse[fused].data(), task);
                for (std::size_t i = 0; i < s.n; ++i)
                    for (std::size_t k = 0; k < place(length); ++k) {
                        double const added = k + 1 < place(width)
                                                 ? 2 * double(k) * double(p[i * place(width) + k])
                                                 : 0;
                        CHECK(x[i * place(length) + k] == start[i * place(length) + k] + added);
                    }
                for (std::size_t e = 0; e < r.size(); ++e)
                    CHECK(double(r[e]) ==
                          doctest::Approx(double(r0[e]) -
                                          double(task.step[e % place(width)]) * double(q[e]))
                              .epsilon(rounding<Number>));
                for (std::size_t e = 1; e < r.size(); e += place(width))
                    squares[fused] += double(r[e]) * double(r[e]);
                CHECK(task.squares[1] == doctest::Approx(squares[fused]).epsilon(rounding<Number>));
                if (fused == 0) {
                    CHECK(z == r);
                    kernels.descend(s.level, width, z.data(), coarse[0].data());
                }
                all[fused] = z;
            }
            CHECK(all[0] == all[1]);
            CHECK(coarse[0] == coarse[1]);
        }
}

}  // namespace

TEST_CASE("a sweep down and up is symmetric Gauss-Seidel with a coarse correction in between") {
    check_all_sweeps<float>();
    check_all_sweeps<double>();
}

TEST_CASE("products, energies and directions are those of the whole matrix, real or Hermitian") {
    for (Index const planes : {1, 2}) {
        check_products<float>(planes);
        check_products<double>(planes);
    }
}

TEST_CASE("true residuals are those of the whole matrix, for the chosen functions") {
    for (Index const planes : {1, 2}) {
        check_residuals<float>(planes);
        check_residuals<double>(planes);
    }
}

TEST_CASE("an update moves solutions and residuals, and may include the sweep down") {
    check_update<float>();
    check_update<double>();
}
