#include "harmorph/multifrontal.hpp"

namespace harmorph {
namespace {

// A pivot this small beside its value on assembly is rounding: a part of the mesh hangs on no known value.
constexpr Real pivot_floor = 1e-15;
constexpr Index nodes_between_reports = 512;

class Factorisation {
public:
    Factorisation(Multifrontal& engine, Matrix const& matrix, Progress const& progress, Fault& fault) noexcept
        : engine_(engine), matrix_(matrix), progress_(progress), fault_(fault) {}

    // Leaves the node's update matrix at `top` of the stack.
    Status run(Index node, Offset top) noexcept {
        auto const& its = engine_.tree.nodes[node];
        dense::Panel const panel = engine_.panel(node);
        Offset const update_end = top + panel.border() * update_row(panel.border());
        fill(engine_.factor.from(engine_.panel_start[node], dense::Panel::entries(panel.pivots, panel.front)), 0.0);
        fill(engine_.stack.from(top, update_end - top), 0.0);
        assemble(node, panel);
        for (Index child = its.child; child != none; child = engine_.tree.nodes[child].sibling) {
            HARMORPH_TRY(run(child, update_end));
            add_update(child, update_end, node, panel, top);
        }
        Index const bad = dense::factor(engine_.kernel, panel, pivot_floor, engine_.packing.data());
        if (bad != none) {
            return fault_.refuse(Status::not_positive, "the matrix is not positive definite at point #", Counts::mesh,
                                 its.begin + bad);
        }
        dense::update_border(engine_.kernel, panel, engine_.stack.data() + top, update_row(panel.border()),
                             engine_.packing.data());
        if (node % nodes_between_reports == 0) {
            Real const done = static_cast<Real>(its.end) / static_cast<Real>(matrix_.n);
            HARMORPH_TRY(progress_.report(Phase::factor, done, fault_));
        }
        return Status::ok;
    }

private:
    // The matrix's own entries in the pivots' rows.
    void assemble(Index node, dense::Panel const& panel) const noexcept {
        auto const& its = engine_.tree.nodes[node];
        Span<const Index> const border = engine_.border_of(node);
        for (Index i = its.begin; i < its.end; ++i) {
            Real* const row = panel.row(i - its.begin);
            row[i - its.begin] = matrix_.diagonal[i];
            for (Offset k = matrix_.start[i]; k < matrix_.start[i + 1]; ++k) {
                Index const j = matrix_.column[k];
                Index const local = j < its.end ? j - its.begin : panel.pivots + place_in(border, j);
                row[local] += matrix_.value[k];
            }
        }
    }

    static Index place_in(Span<const Index> border, Index position) noexcept {
        Index low = 0, high = border.count();
        while (high - low > 1) {
            Index const middle = low + (high - low) / 2;
            (border[middle] <= position ? low : high) = middle;
        }
        return low;
    }

    // Extend-add: a child's update matrix into its parent's pivot rows and update matrix.
    void add_update(Index child, Offset from, Index node, dense::Panel const& panel, Offset top) const noexcept {
        Span<const Index> const rows = engine_.border_of(child);
        find_targets(rows, node, panel.pivots);
        Offset const from_row = update_row(rows.count()), to_row = update_row(panel.border());
        for (Index r = 0; r < rows.count(); ++r) {
            const Real* const source = engine_.stack.data() + from + r * from_row;
            Index const target = engine_.target[r];
            Real* const to = target < panel.pivots ? panel.row(target)
                                                   : engine_.stack.data() + top + (target - panel.pivots) * to_row;
            Index const shift = target < panel.pivots ? 0 : panel.pivots;
            for (Index c = r; c < rows.count();) {
                Real* const run = to + (engine_.target[c] - shift);
                Index const n = engine_.run_end[c] - c;
                for (Index i = 0; i < n; ++i) run[i] += source[c + i];
                c += n;
            }
        }
    }

    // Both lists increase: one walk along the parent's border.
    void find_targets(Span<const Index> rows, Index node, Index pivots) const noexcept {
        auto const& its = engine_.tree.nodes[node];
        Span<const Index> const border = engine_.border_of(node);
        Index at = 0;
        for (Index r = 0; r < rows.count(); ++r) {
            if (rows[r] < its.end) {
                engine_.target[r] = rows[r] - its.begin;
                continue;
            }
            while (border[at] != rows[r]) ++at;
            engine_.target[r] = pivots + at;
        }
        for (Index r = rows.count() - 1; r >= 0; --r) {
            bool const ends = r + 1 == rows.count() || engine_.target[r + 1] != engine_.target[r] + 1 ||
                              engine_.target[r + 1] == pivots;
            engine_.run_end[r] = ends ? r + 1 : engine_.run_end[r + 1];
        }
    }

    Multifrontal& engine_;
    Matrix const& matrix_;
    Progress const& progress_;
    Fault& fault_;
};

}  // namespace

void Multifrontal::lay_out(Arena& arena, Index nodes, FrontSizes const& sizes, Index width) noexcept {
    arena.take(tree.nodes, nodes);
    arena.take(border_start, Offset{nodes} + 1);
    arena.take(border, sizes.border_entries);
    arena.take(panel_start, Offset{nodes} + 1);
    arena.take(factor, sizes.factor_entries + dense::overread);
    arena.take(target, sizes.largest_border);
    arena.take(run_end, sizes.largest_border);
    arena.take(packing, dense::packing_entries);
    arena.take(rows, Offset{sizes.largest_front} * dense::padded(width) + dense::overread);
}

void Multifrontal::place_panels() noexcept {
    Offset next = 0;
    for (Index node = 0; node < tree.count; ++node) {
        panel_start[node] = next;
        Index const pivots = tree.nodes[node].pivots();
        next += dense::Panel::entries(pivots, pivots + border_of(node).count());
    }
    panel_start[tree.count] = next;
}

dense::Panel Multifrontal::panel(Index node) const noexcept {
    Index const pivots = tree.nodes[node].pivots();
    return {factor.data() + panel_start[node], pivots, pivots + border_of(node).count()};
}

Status Multifrontal::factorise(Matrix const& matrix, Progress const& progress, Fault& fault) noexcept {
    Factorisation factorisation(*this, matrix, progress, fault);
    for (Index node = 0; node < tree.count; ++node) {
        if (tree.nodes[node].parent == none) HARMORPH_TRY(factorisation.run(node, 0));
    }
    return Status::ok;
}

namespace {

// The right-hand sides of one front, side by side: pivots, then border.
class FrontRows {
public:
    FrontRows(Multifrontal const& engine, Rows const& values) noexcept
        : engine_(engine), values_(values), row_(dense::padded(values.width)) {}

    Index row() const noexcept { return row_; }
    Real* data() const noexcept { return engine_.rows.data(); }

    void gather(Index node) const noexcept {
        Real* to = data();
        for_each(node, true, [&](const Real* from) {
            for (Index i = 0; i < values_.width; ++i) to[i] = from[i];
            for (Index i = values_.width; i < row_; ++i) to[i] = 0;
            to += row_;
        });
    }
    void scatter(Index node, bool border_too) const noexcept {
        const Real* from = data();
        for_each(node, border_too, [&](Real* to) {
            for (Index i = 0; i < values_.width; ++i) to[i] = from[i];
            from += row_;
        });
    }

private:
    template <class Visit>
    void for_each(Index node, bool border_too, Visit visit) const noexcept {
        auto const& its = engine_.tree.nodes[node];
        for (Index position = its.begin; position < its.end; ++position) visit(values_[position]);
        if (!border_too) return;
        for (Index const position : engine_.border_of(node)) visit(values_[position]);
    }

    Multifrontal const& engine_;
    Rows const& values_;
    Index row_;
};

}  // namespace

Status Multifrontal::solve(Rows const& values, Progress const& progress, Fault& fault) noexcept {
    FrontRows const rows_of(*this, values);
    auto const report = [&](Index done) {
        if (done == 0 || done % nodes_between_reports != 0) return Status::ok;
        return progress.report(Phase::solve, static_cast<Real>(done) / (2.0 * tree.count), fault);
    };
    for (Index node = 0; node < tree.count; ++node) {
        rows_of.gather(node);
        dense::solve_forward(kernel, panel(node), rows_of.data(), rows_of.row());
        rows_of.scatter(node, true);
        HARMORPH_TRY(report(node));
    }
    for (Index node = tree.count - 1; node >= 0; --node) {
        rows_of.gather(node);
        dense::solve_backward(kernel, panel(node), rows_of.data(), rows_of.row());
        rows_of.scatter(node, false);
        HARMORPH_TRY(report(2 * tree.count - node));
    }
    return Status::ok;
}

}  // namespace harmorph
