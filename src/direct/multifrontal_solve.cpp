#include "direct/multifrontal.hpp"

namespace harmorph {
namespace {

constexpr Index nodes_between_solve_reports = 512;

// Right-hand sides go up the tree like update matrices, and solutions come down; a row has the
// numbers of all functions.
class Substitution {
public:
    using Worker = Multifrontal::Worker;
    using Panel = dense::Panel;

    Substitution(Multifrontal const& engine, Rows const& values) noexcept
        : engine_(engine),
          values_(values),
          width_(dense::padded(values.width)),
          row_(engine.planes * width_) {}

    // Returns the number of numbers in the right-hand sides of a front.
    Offset entries(Index node) const noexcept { return Offset{engine_.front_of(node)} * row_; }

    // Forward substitution U^H y = b in place. `front` receives the right-hand sides of the node:
    // first the rows of the pivots, then the updates for the rows of the border. Most nodes are far
    // from all known values. If all right-hand sides of a subtree are 0, nothing is computed,
    // is_zero of the node is set, and the content of `front` is undefined.
    template <class Report>
    Status forward(Index node, Real* front, Real* free, Worker const& worker,
                   Report const& report) const noexcept {
        auto const& own = engine_.tree.nodes[node];
        Panel const panel = engine_.panel(node);
        Index const behind = engine_.tree.nodes[engine_.tree.count - 1].end - own.end;
        dense::gather(engine_.kernel, values_, own.begin, panel.pivots, behind, front, width_,
                      engine_.planes);
        Span<Real> const pivots(front, static_cast<Size>(Offset{panel.pivots} * row_));
        Span<Real> const border(front + pivots.size(),
                                static_cast<Size>(Offset{panel.border} * row_));
        bool is_zero = all_zero(pivots);
        if (!is_zero) fill(border, Real{0});
        for (Index child = own.child; child != none; child = engine_.tree.nodes[child].sibling) {
            Index const done = engine_.subtrees.find(child);
            Real* const from = done != none ? engine_.kept_rows(done) : free;
            if (done == none)
                HARMORPH_TRY(forward(child, free, free + entries(child), worker, report));
            if (engine_.is_zero[child]) continue;
            if (is_zero) fill(border, Real{0});
            is_zero = false;
            dense::add_rows(engine_.kernel, engine_.border_of(child).count(),
                            border_rows(child, from), engine_.targets_of(child), front, row_);
        }
        engine_.is_zero[node] = is_zero;
        if (is_zero) return report(node);
        dense::solve_forward(engine_.kernel, panel, front, width_, worker.executor);
        dense::scatter(engine_.kernel, front, width_, engine_.planes, values_, own.begin,
                       panel.pivots);
        return report(node);
    }

    // Back substitution U x = y in place, for the node and its descendants except those in
    // subtrees, whose fronts are left ready for back substitution. `front` has the rows of the
    // node; those of the border are known.
    template <class Report>
    Status backward(Index node, Real* front, Real* free, Worker const& worker,
                    Report const& report) const noexcept {
        auto const& own = engine_.tree.nodes[node];
        Panel const panel = engine_.panel(node);
        if (engine_.is_zero[node]) {
            fill(Span<Real>(front, static_cast<Size>(Offset{panel.pivots} * row_)), Real{0});
        } else {
            dense::gather(engine_.kernel, values_, own.begin, panel.pivots, 0, front, width_,
                          engine_.planes);
        }
        dense::solve_backward(engine_.kernel, panel, front, width_, worker.executor);
        dense::scatter(engine_.kernel, front, width_, engine_.planes, values_, own.begin,
                       panel.pivots);
        HARMORPH_TRY(report(node));
        return backward_below(own.child, front, free, worker, report);
    }

private:
    // Children are visited from the last to the first, so that panels are read from the end of the
    // factor to the beginning.
    template <class Report>
    Status backward_below(Index child, const Real* front, Real* free, Worker const& worker,
                          Report const& report) const noexcept {
        if (child == none) return Status::ok;
        HARMORPH_TRY(
            backward_below(engine_.tree.nodes[child].sibling, front, free, worker, report));
        Index const done = engine_.subtrees.find(child);
        Real* const to = done != none ? engine_.kept_rows(done) : free;
        dense::copy_rows(engine_.kernel, engine_.border_of(child).count(), front,
                         engine_.targets_of(child), border_rows(child, to), row_);
        return done != none ? Status::ok
                            : backward(child, to, free + entries(child), worker, report);
    }

    template <class AnyNumber>
    AnyNumber* border_rows(Index node, AnyNumber* front) const noexcept {
        return front + Offset{engine_.pivots_of(node)} * row_;
    }

    static bool all_zero(Span<const Real> numbers) noexcept {
        constexpr Size at_once = 64;  // So many numbers are tested without a branch in between.
        for (Size begin = 0; begin < numbers.size(); begin += at_once) {
            bool any = false;
            for (Real const number : numbers.from(begin, min(at_once, numbers.size() - begin))) {
                any |= number != 0;
            }
            if (any) return false;
        }
        return true;
    }

    Multifrontal const& engine_;
    Rows const& values_;
    Index width_, row_;  // The numbers in a row of one plane, and of all planes.
};

}  // namespace

Status Multifrontal::solve(Rows const& values, Progress const& progress, Fault& fault) noexcept {
    Substitution const substitution(*this, values);
    Index done = 0;
    auto const report = [&](Index) {
        if (++done % nodes_between_solve_reports != 0) return Status::ok;
        return progress.report(Phase::solve, static_cast<Real>(done) / (2.0 * tree.count + 1),
                               fault);
    };
    Worker const worker = top_worker();
    for_each_subtree([&](Index subtree, Worker const& own) {
        substitution.forward(subtrees.all[subtree].root, kept_rows(subtree), own.rows, own,
                             [](Index) { return Status::ok; });
    });
    for (Index node = 0; node < tree.count; ++node) {
        if (tree.nodes[node].parent != none || subtrees.find(node) != none) continue;
        HARMORPH_TRY(substitution.forward(
            node, worker.rows, worker.rows + substitution.entries(node), worker, report));
    }
    for (Index node = tree.count - 1; node >= 0; --node) {
        if (tree.nodes[node].parent != none || subtrees.find(node) != none) continue;
        HARMORPH_TRY(substitution.backward(
            node, worker.rows, worker.rows + substitution.entries(node), worker, report));
    }
    for_each_subtree([&](Index subtree, Worker const& own) {
        substitution.backward(subtrees.all[subtree].root, kept_rows(subtree), own.rows, own,
                              [](Index) { return Status::ok; });
    });
    return Status::ok;
}

}  // namespace harmorph
