// The passes of cycle_table.hpp with the registers of one instruction set; cycle_table.cpp compiles
// this file for each set. The arithmetic of a function is the same in all instruction sets and for
// any width of the block, and so are the bits of the result.
//
// A pass consists of stages, each of which visits all rows. A stage needs the rows up to `reach`
// rows ahead from the stage before, so it follows at this distance, and finds them in the cache.
// tests/multigrid/test_cycle.cpp covers this file.

#include "multigrid/cycle_sweeps.hpp"

namespace harmorph::cycles::HARMORPH_SET {
namespace {

// Computes sum += A x and other rows of y -= for row i, flux by flux; sign is that of A. Returns
// the part of x.A x that belongs to row i and its entries.
template <Index planes, class Number, Index n, class Entry, class At>
HARMORPH_INLINE Lanes<Number, n> add_fluxes(const Offset* start, const Index* column,
                                            const Entry* value, const Real* imaginary, Index i,
                                            Number sign, Values<Number, n, planes> const& own,
                                            At const& at, Number* y, Offset row, Offset plane,
                                            Values<Number, n, planes>& sum) noexcept {
    Lanes<Number, n> energy = Lanes<Number, n>::zero();
    for (Offset e = start[i]; e < start[i + 1]; ++e) {
        Number const re = sign * static_cast<Number>(value[e]),
                     im = planes == 2 ? sign * static_cast<Number>(imaginary[e]) : 0;
        Number* const to = y + column[e] * row;
        Values<Number, n, planes> rise = at(column[e]),
                                  other = Values<Number, n, planes>::load(to, plane);
        rise -= own;
        Values<Number, n, planes> const flux = rise.times(re, im);
        sum += flux;
        energy -= (sign * re) * rise.dot(rise);
        if constexpr (planes == 2) {
            other -= rise.times(re, -im);
            energy -= (2 * sign * im) * (own.re * rise.im - own.im * rise.re);
        } else {
            other -= flux;
        }
        other.store(to, plane);
    }
    return energy;
}

template <class Number, Index width, Index planes>
void multiply_block(CycleLevel<Number> const& level,
                    typename CycleKernels<Number>::Product& task) noexcept {
    using Row = Lanes<Number, width>;
    constexpr Index plane = width / planes;
    using Value = Values<Number, plane, planes>;
    CycleLevel<Number> const a = level;
    Row const beta = Row::load(task.beta);
    Number *const p = task.p, *const q = task.q;
    const Number *const r = task.r, *const z = task.z;
    Index head = 0;
    for (Index i = 0; i < a.n; ++i) {
        for (Index const end = min(a.n, i + 1 + a.reach); head < end; ++head) {
            Number* const own = p + Offset{head} * width;
            Row value = Row::load(z + Offset{head} * width);
            value += beta * Row::load(own);
            value.store(own);
            Row::zero().store(q + Offset{head} * width);
        }
        Real const re = task.row_sum[i], im = planes == 2 ? task.imaginary.row_sum[i] : 0;
        Offset const here = Offset{i} * width;
        Value const own = Value::load(p + here, plane);
        Value sum = Value::load(q + here, plane);
        sum += own.times(static_cast<Number>(re), static_cast<Number>(im));
        auto const at = [&](Index j) { return Value::load(p + Offset{j} * width, plane); };
        auto energy = static_cast<Number>(re) * own.dot(own);
        energy += add_fluxes<planes>(a.start, a.column, a.value, task.imaginary.value.data(), i,
                                     Number{1}, own, at, q, width, plane, sum);
        sum.store(q + here, plane);
        energy.add_to(task.energy);
        own.dot(Value::load(r + here, plane)).add_to(task.along);
    }
}

template <class Number, Index width>
void update_block(CycleLevel<Number> const& level, FunctionBlock const& block, Number* z,
                  Number* coarse, typename CycleKernels<Number>::Update& task) noexcept {
    using Row = Lanes<Number, width>;
    using Reals = simd::HARMORPH_SET::Registers<Real>;
    constexpr Index rows_ahead = 8;
    Row const step = Row::load(task.step);
    auto const add_step = [&](Index i) {
        if (i + rows_ahead < level.n) {
            const Real* const later = block.values[i + rows_ahead] + block.first;
            for (Index k = 0; k < block.functions; k += 8) __builtin_prefetch(later + k, 1);
        }
        const Number* const p = task.p + Offset{i} * width;
        for (Index plane = 0; plane < block.planes; ++plane) {
            Real* const x = block.values[i] + plane * block.values.plane + block.first;
            Index const from = plane * block.plane_width();
            Index k = 0;
            for (; k + Reals::lanes <= block.functions; k += Reals::lanes)
                Reals::store(x + k, Reals::load(x + k) + Reals::load(task.factor + from + k) *
                                                             Reals::load(p + from + k));
            for (; k < block.functions; ++k)
                x[k] += task.factor[from + k] * static_cast<Real>(p[from + k]);
        }
        Number* const own = task.r + Offset{i} * width;
        Row rest = Row::load(own);
        rest -= step * Row::load(task.q + Offset{i} * width);
        rest.store(own);
        rest.store(z + Offset{i} * width);
        (rest * rest).add_to(task.squares);
    };
    if (!task.descends) {
        for (Index i = 0; i < level.n; ++i) add_step(i);
        return;
    }
    clear_coarse(level, width, coarse);
    Stages<Number, width> stages(level, z);
    stages.run(
        add_step, [&](Index i) { stages.sweep_forward(i); },
        [&](Index i) { stages.restrict_defect(i, coarse); });
}

template <class Number, Index n, Index planes>
void find_residual_parts(FunctionBlock const& block,
                         typename CycleKernels<Number>::Residual& task) noexcept {
    using Value = Values<Real, n, planes>;
    SymmetricRows const& rows = *task.rows;
    Index const row = planes * task.columns;
    for (Index k = 0; k < task.columns; k += n) {
        Index const column = task.begin + k, count = clamp(block.functions - column, Index{0}, n);
        auto const at = [&](Index i) {
            return Value::load_first(block.values[i] + block.first + column, block.values.plane,
                                     count);
        };
        for (Index i = 0; i < rows.n; ++i) {
            Real* const here = task.rest + Offset{i} * row + k;
            Value const own = at(i);
            Value sum = Value::load(here, task.columns);
            Real const re = rows.row_sum[i], im = planes == 2 ? task.imaginary.row_sum[i] : 0;
            sum -= own.times(re, im);
            auto energy = re * own.dot(own);
            energy += add_fluxes<planes>(rows.start.data(), rows.column.data(), rows.value.data(),
                                         task.imaginary.value.data(), i, Real{-1}, own, at,
                                         task.rest + k, row, task.columns, sum);
            energy.add_to(task.energy + column);
            sum.dot(sum).add_to(task.squares + column);
            own.dot(sum).add_to(task.product + column);
            sum.store(here, task.columns);
            for (Index plane = 0; plane < planes; ++plane) {
                Number* const to =
                    task.r + Offset{i} * block.width + plane * block.plane_width() + column;
                const Real* const from = here + plane * task.columns;
                for (Index c = 0; c < n; ++c)
                    to[c] = task.takes[column + c]
                                ? static_cast<Number>(task.scale[column + c] * from[c])
                                : to[c];
            }
        }
    }
}

template <class Number>
struct Kernels {
    // Calls body(integral_constant of the width).
    template <class Body>
    static void with_width(Index width, Body const& body) noexcept {
        constexpr Index words = sizeof(Number) / sizeof(float);
        switch (width * words) {
            case 4: return body(std::integral_constant<Index, 4 / words>{});
            case 8: return body(std::integral_constant<Index, 8 / words>{});
            default: return body(std::integral_constant<Index, 16 / words>{});
        }
    }
    static void multiply(CycleLevel<Number> const& level, Index width, Index planes,
                         typename CycleKernels<Number>::Product& task) noexcept {
        with_width(width, [&](auto n) {
            constexpr Index w = decltype(n)::value;
            if (planes == 1) multiply_block<Number, w, 1>(level, task);
            else multiply_block<Number, w, 2>(level, task);
        });
    }
    static void descend(CycleLevel<Number> const& level, Index width, Number* x,
                        Number* coarse) noexcept {
        with_width(width,
                   [&](auto n) { descend_block<Number, decltype(n)::value>(level, x, coarse); });
    }
    static void update(CycleLevel<Number> const& level, FunctionBlock const& block, Number* z,
                       Number* coarse, typename CycleKernels<Number>::Update& task) noexcept {
        with_width(block.width, [&](auto n) {
            update_block<Number, decltype(n)::value>(level, block, z, coarse, task);
        });
    }
    static void ascend(CycleLevel<Number> const& level, Index width, const Number* coarse,
                       Number* x, const Number* q, Real* product) noexcept {
        with_width(width, [&](auto n) {
            ascend_block<Number, decltype(n)::value>(level, coarse, x, q, product);
        });
    }
    static void find_residual(FunctionBlock const& block,
                              typename CycleKernels<Number>::Residual& task) noexcept {
        auto const with = [&](auto n) {
            constexpr Index lanes = decltype(n)::value;
            if (block.planes == 1) find_residual_parts<Number, lanes, 1>(block, task);
            else find_residual_parts<Number, lanes / 2, 2>(block, task);
        };
        if (task.columns * block.planes < 4) with(std::integral_constant<Index, 2>{});
        else with(std::integral_constant<Index, 4>{});
    }
    static constexpr CycleKernels<Number> table{multiply, descend, update, ascend, find_residual};
};

}  // namespace
}  // namespace harmorph::cycles::HARMORPH_SET

namespace harmorph::simd {
template <>
inline constexpr const CycleKernels<float>* table<CycleKernels<float>, Kernel::HARMORPH_SET> =
    &harmorph::cycles::HARMORPH_SET::Kernels<float>::table;
template <>
inline constexpr const CycleKernels<double>* table<CycleKernels<double>, Kernel::HARMORPH_SET> =
    &harmorph::cycles::HARMORPH_SET::Kernels<double>::table;
}  // namespace harmorph::simd
