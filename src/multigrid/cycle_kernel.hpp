// The passes of cycle_table.hpp with the registers of one instruction set; cycle_table.cpp compiles
// this file for each set. The arithmetic of a function is the same in all instruction sets and for
// any width of the block, and so are the bits of the result.
//
// A pass consists of stages, each of which visits all rows. A stage needs the rows up to `reach`
// rows ahead from the stage before, so it follows at this distance, and finds them in the cache.
// tests/multigrid/test_cycle.cpp covers this file.

namespace harmorph::cycles::HARMORPH_SET {

// The numbers of a block of functions at one row, with the registers of one instruction set.

namespace {

// n numbers that stand side by side, in as few registers as the set allows.
template <class Number, Index n>
struct Lanes {
    static constexpr Index most = simd::HARMORPH_SET::Registers<Number>::lanes;
    static constexpr Index lanes = n < most ? n : most, parts = n / lanes;
    using Register = simd::HARMORPH_SET::Register<Number, lanes>;

    typename Register::Vector part[parts];

    static HARMORPH_INLINE Lanes zero() noexcept {
        Lanes out;
        for (Index p = 0; p < parts; ++p) out.part[p] = typename Register::Vector{};
        return out;
    }
    static HARMORPH_INLINE Lanes load(const Number* from) noexcept {
        Lanes out;
        for (Index p = 0; p < parts; ++p) out.part[p] = Register::load(from + p * lanes);
        return out;
    }
    // Loads the first `count` numbers, and 0 for the others.
    static HARMORPH_INLINE Lanes load_first(const Number* from, Index count) noexcept {
        if (count >= n) return load(from);
        Number numbers[n] = {};
        for (Index k = 0; k < count; ++k) numbers[k] = from[k];
        return load(numbers);
    }
    HARMORPH_INLINE void store(Number* to) const noexcept {
        for (Index p = 0; p < parts; ++p) Register::store(to + p * lanes, part[p]);
    }
    // Adds the numbers to sums in double precision.
    HARMORPH_INLINE void add_to(Real* sums) const noexcept {
        Number numbers[n];
        store(numbers);
        for (Index k = 0; k < n; ++k) sums[k] += static_cast<Real>(numbers[k]);
    }
    HARMORPH_INLINE Lanes& operator+=(Lanes const& other) noexcept {
        for (Index p = 0; p < parts; ++p) part[p] += other.part[p];
        return *this;
    }
    HARMORPH_INLINE Lanes& operator-=(Lanes const& other) noexcept {
        for (Index p = 0; p < parts; ++p) part[p] -= other.part[p];
        return *this;
    }
    friend HARMORPH_INLINE Lanes operator-(Lanes a, Lanes const& b) noexcept { return a -= b; }
    friend HARMORPH_INLINE Lanes operator*(Lanes a, Lanes const& b) noexcept {
        for (Index p = 0; p < parts; ++p) a.part[p] *= b.part[p];
        return a;
    }
    friend HARMORPH_INLINE Lanes operator*(Number factor, Lanes a) noexcept {
        for (Index p = 0; p < parts; ++p) a.part[p] *= factor;
        return a;
    }
};

// A number of each function, with a real and, if planes is 2, an imaginary part.
template <class Number, Index n, Index planes>
struct Values {
    using Part = Lanes<Number, n>;
    Part re, im;

    // plane: the distance from the real to the imaginary parts.
    static HARMORPH_INLINE Values load(const Number* from, Offset plane) noexcept {
        Values out;
        out.re = Part::load(from);
        if constexpr (planes == 2) out.im = Part::load(from + plane);
        return out;
    }
    static HARMORPH_INLINE Values load_first(const Number* from, Offset plane,
                                             Index count) noexcept {
        Values out;
        out.re = Part::load_first(from, count);
        if constexpr (planes == 2) out.im = Part::load_first(from + plane, count);
        return out;
    }
    HARMORPH_INLINE void store(Number* to, Offset plane) const noexcept {
        re.store(to);
        if constexpr (planes == 2) im.store(to + plane);
    }
    HARMORPH_INLINE Values& operator+=(Values const& other) noexcept {
        re += other.re;
        if constexpr (planes == 2) im += other.im;
        return *this;
    }
    HARMORPH_INLINE Values& operator-=(Values const& other) noexcept {
        re -= other.re;
        if constexpr (planes == 2) im -= other.im;
        return *this;
    }
    // Returns the product with x + i y.
    HARMORPH_INLINE Values times(Number x, Number y) const noexcept {
        Values out;
        out.re = x * re;
        if constexpr (planes == 2) {
            out.re -= y * im;
            out.im = x * im;
            out.im += y * re;
        }
        return out;
    }
    // Returns the real part of the product of the conjugate and `other`.
    HARMORPH_INLINE Part dot(Values const& other) const noexcept {
        Part out = re * other.re;
        if constexpr (planes == 2) out += im * other.im;
        return out;
    }
};

}  // namespace

// The sweeps of a cycle over the rows of a level, with the registers of one instruction set.

namespace {

// The stages of one level, for the rows of a block.
template <class Number, Index width>
class Stages {
    using Row = Lanes<Number, width>;

public:
    Stages(CycleLevel<Number> const& level, Number* x) noexcept : a_(level), x_(x) {}

    // Calls first(i) for all rows i, and `second` and `third` for rows that are up to `reach` and
    // 2 `reach` rows behind.
    template <class First, class Second, class Third>
    HARMORPH_INLINE void run(First const& first, Second const& second,
                             Third const& third) noexcept {
        Offset const rows = a_.n, reach = a_.reach;
        for (Offset i = 0; i < rows + 2 * reach; ++i) {
            if (i < rows) first(static_cast<Index>(i));
            if (i >= reach && i < rows + reach) second(static_cast<Index>(i - reach));
            if (i >= 2 * reach) third(static_cast<Index>(i - 2 * reach));
        }
    }

    HARMORPH_INLINE void sweep_forward(Index i) const noexcept {
        Number const inverse = 1 / a_.diagonal[i];
        Number* const own = at(i);
        Row const value = inverse * Row::load(own);
        value.store(own);
        for (Offset e = a_.start[i]; e < a_.start[i + 1]; ++e)
            subtract(a_.value[e], value, at(a_.column[e]));
    }
    HARMORPH_INLINE void restrict_defect(Index i, Number* coarse) const noexcept {
        Number* const own = at(i);
        (a_.diagonal[i] * Row::load(own)).store(own);
        if (a_.by_start == nullptr) return;
        Row sum = Row::zero();
        for (Offset e = a_.start[i]; e < a_.start[i + 1]; ++e)
            sum += a_.value[e] * Row::load(at(a_.column[e]));
        for (Offset e = a_.by_start[i]; e < a_.by_start[i + 1]; ++e)
            subtract(a_.by_weight[e], sum, coarse + Offset{a_.by_column[e]} * width);
    }
    HARMORPH_INLINE void correct(Index i, const Number* coarse) const noexcept {
        Row change = Row::zero();
        for (Offset e = a_.by_start[i]; e < a_.by_start[i + 1]; ++e)
            change += a_.by_weight[e] * Row::load(coarse + Offset{a_.by_column[e]} * width);
        for (Offset e = a_.start[i]; e < a_.start[i + 1]; ++e)
            subtract(a_.value[e], change, at(a_.column[e]));
    }
    HARMORPH_INLINE void sweep_backward(Index i, const Number* q, Real* product) const noexcept {
        Number const inverse = 1 / a_.diagonal[i];
        Number* const own = at(i);
        Row sum = Row::load(own);
        for (Offset e = a_.start[i]; e < a_.start[i + 1]; ++e)
            sum -= a_.value[e] * Row::load(at(a_.column[e]));
        sum = inverse * sum;
        sum.store(own);
        if (q != nullptr) (sum * Row::load(q + Offset{i} * width)).add_to(product);
    }

private:
    Number* at(Index i) const noexcept { return x_ + Offset{i} * width; }
    static HARMORPH_INLINE void subtract(Number factor, Row const& x, Number* from) noexcept {
        Row value = Row::load(from);
        value -= factor * x;
        value.store(from);
    }

    // A copy, as the compiler would read a reference's numbers anew after each store.
    CycleLevel<Number> const a_;
    Number* const x_;
};

template <class Number>
void clear_coarse(CycleLevel<Number> const& level, Index width, Number* coarse) noexcept {
    if (level.by_start == nullptr) return;
    std::memset(coarse, 0,
                static_cast<Size>(level.n_coarse) * static_cast<Size>(width) * sizeof(Number));
}

template <class Number, Index width>
void descend_block(CycleLevel<Number> const& level, Number* x, Number* coarse) noexcept {
    clear_coarse(level, width, coarse);
    Stages<Number, width> stages(level, x);
    stages.run([](Index) {}, [&](Index i) { stages.sweep_forward(i); },
               [&](Index i) { stages.restrict_defect(i, coarse); });
}

template <class Number, Index width>
void ascend_block(CycleLevel<Number> const& level, const Number* coarse, Number* x, const Number* q,
                  Real* product) noexcept {
    Stages<Number, width> const stages(level, x);
    bool const corrects = level.by_start != nullptr;
    Offset const reach = level.reach;
    for (Offset i = level.n - 1; i >= -reach; --i) {
        if (corrects && i >= 0) stages.correct(static_cast<Index>(i), coarse);
        if (i + reach < level.n) stages.sweep_backward(static_cast<Index>(i + reach), q, product);
    }
}

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
