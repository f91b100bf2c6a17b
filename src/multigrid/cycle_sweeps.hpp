// The sweeps of a cycle over the rows of a level, with the registers of one instruction set;
// cycle_kernel.hpp includes this file for each set. tests/multigrid/test_cycle.cpp covers this
// file.

#include "multigrid/cycle_lanes.hpp"

namespace harmorph::cycles::HARMORPH_SET {
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

}  // namespace
}  // namespace harmorph::cycles::HARMORPH_SET
