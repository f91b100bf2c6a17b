#include "safe/point_factor.hpp"

namespace harmorph {
namespace {

constexpr Index right_hand_sides = 2;

struct Sizes {
    FrontSizes fronts;
    Subtrees subtrees;
};

// The sizes of fronts with `per` times as many pivots and borders. `all` receives the subtrees; it
// may be empty when memory is only counted.
Sizes sizes_of(Multifrontal const& plain, Index per, Span<Subtree> all) noexcept {
    Sizes sizes;
    auto const border = [&](Index node) { return per * plain.border_of(node).count(); };
    auto const pivots = [&](Index node) { return per * plain.pivots_of(node); };
    for (Index node = 0; node < plain.tree.count; ++node) {
        sizes.fronts.border_entries += border(node);
        sizes.fronts.factor_entries += dense::panel_entries(pivots(node), border(node));
        sizes.fronts.max_sums =
            max(sizes.fronts.max_sums, dense::sum_entries(pivots(node), border(node)));
    }
    Subtrees& subtrees = sizes.subtrees;
    subtrees = plain.subtrees;
    subtrees.all = all;
    subtrees.measure(plain.tree, plain.subtrees.all, border,
                     [&](Index node) { return pivots(node) + border(node); });
    return sizes;
}

}  // namespace

void PointFactor::lay_out(Arena& arena, Plan const& plan) noexcept {
    if (!exists(plan)) return;
    Multifrontal const& plain = of_plan(plan);
    per_position = plan.unknowns().couples_xy() ? 1 : 2;
    Sizes const sizes = sizes_of(plain, per_position, {});
    engine.lay_out(arena, plain.tree.count, sizes.fronts, sizes.subtrees, right_hand_sides);
    engine.lay_out_stack(arena);
    Index const n = per_position * plan.equations().matrix().n;
    arena.take(node, n);
    arena.take(scale, n);
    arena.take(values, right_hand_sides * Offset{n});
    arena.take(matrix.diagonal, n);
    arena.take(matrix.row_sum, n);
    arena.take(matrix.start, Offset{n} + 1);
    Offset const entries = 4 * plan.region_counts().pairs + plan.region_counts().points;
    arena.take(matrix.column, entries);
    arena.take(matrix.value, entries);
}

void PointFactor::init(Plan const& plan) noexcept {
    Multifrontal const& plain = of_plan(plan);
    matrix.n = node.count();
    engine.executor = plan.executor();
    engine.kernel = plan.equations().method().kernel;
    engine.tree.count = plain.tree.count;
    Offset filled = 0;
    for (Index t = 0; t < plain.tree.count; ++t) {
        AssemblyTree::Node own = plain.tree.nodes[t];
        own.begin *= per_position;
        own.end *= per_position;
        engine.tree.nodes[t] = own;
        for (Index i = own.begin; i < own.end; ++i) node[i] = t;
        engine.border_start[t] = filled;
        for (Index const position : plain.border_of(t)) {
            for (Index k = 0; k < per_position; ++k)
                engine.border[filled++] = per_position * position + k;
        }
    }
    engine.border_start[plain.tree.count] = filled;
    copy(engine.subtrees.all, Span<const Subtree>(plain.subtrees.all));
    sizes_of(plain, per_position, engine.subtrees.all);
    engine.complete();
}

Index PointFactor::position(Plan const& plan, Index point, Index component) const noexcept {
    Unknowns const& unknowns = plan.unknowns();
    return per_position == 2 ? 2 * unknowns.first_row(point) + component
                             : unknowns.row_of(2 * point + component);
}

// Calls visit(position, position, entry) for the entries of the Hessian above the diagonal and on
// it, once each.
template <class Visit>
void PointFactor::for_each_entry(Plan const& plan, Tangle const& tangle, Region const& region,
                                 NewtonSystem const& system, Visit const& visit) const noexcept {
    auto const put = [&](Index u, Index v, Block const& block) {
        Index const p = region.point[u], q = region.point[v];
        Index const rows = tangle.slips(p) ? 1 : 2, columns = tangle.slips(q) ? 1 : 2;
        auto const part = [&](Index point, Index component) {
            if (tangle.slips(point)) return tangle.line[point];
            return component == 0 ? Vec2{1, 0} : Vec2{0, 1};
        };
        for (Index row = 0; row < rows; ++row) {
            for (Index column = u == v ? row : 0; column < columns; ++column) {
                Real const entry = dot(part(p, row), block * part(q, column));
                Index const i = position(plan, p, row), j = position(plan, q, column);
                visit(min(i, j), max(i, j), entry);
            }
        }
    };
    for (Index u = 0; u < region.n; ++u) {
        for (Offset k = region.start[u]; k < region.start[u + 1]; ++k) {
            Index const v = region.neighbour[k];
            // Blocks of unknowns in different ranges are stored in both rows.
            if (k < region.outer_start[u] || u < v) put(u, v, system.hessian[k]);
        }
    }
}

void PointFactor::fill_matrix(Plan const& plan, Tangle const& tangle, Region const& region,
                              NewtonSystem const& system) noexcept {
    fill(matrix.diagonal, 0.0);
    fill(matrix.start, Offset{0});
    for_each_entry(plan, tangle, region, system, [&](Index i, Index j, Real entry) {
        if (i == j) matrix.diagonal[i] = entry;
        else ++matrix.start[i];
    });
    for (Real& entry : matrix.diagonal) entry = entry > 0 ? entry : 1;
    Offset filled = 0;
    for (Index i = 0; i <= matrix.n; ++i) {
        Offset const here = i < matrix.n ? matrix.start[i] : 0;
        matrix.start[i] = filled;
        filled += here;
    }
    for_each_entry(plan, tangle, region, system, [&](Index i, Index j, Real entry) {
        if (i == j) return;
        matrix.column[matrix.start[i]] = j;
        matrix.value[matrix.start[i]++] = entry;
    });
    for (Index i = matrix.n; i > 0; --i) matrix.start[i] = matrix.start[i - 1];
    matrix.start[0] = 0;
}

// Corners of polygons couple points that share no piece. Where the front of the first point does
// not contain the second, the entry is replaced by its size on both diagonals, so that the matrix
// stays above the Hessian.
void PointFactor::drop_entries_beyond_fronts() noexcept {
    Offset kept = 0, next = 0;
    for (Index i = 0; i < matrix.n; ++i) {
        Span<const Index> const border = engine.border_of(node[i]);
        Index const behind = engine.tree.nodes[node[i]].end;
        Offset const end = matrix.start[i + 1];
        matrix.start[i] = kept;
        for (; next < end; ++next) {
            Index const j = matrix.column[next];
            Real const entry = matrix.value[next];
            Size low = 0, high = border.size();
            while (low < high) {
                Size const middle = (low + high) / 2;
                if (border[middle] < j) low = middle + 1;
                else high = middle;
            }
            if (j < behind || (low < border.size() && border[low] == j)) {
                matrix.column[kept] = j;
                matrix.value[kept++] = entry;
            } else {
                matrix.diagonal[i] += abs(entry);
                matrix.diagonal[j] += abs(entry);
            }
        }
    }
    matrix.start[matrix.n] = kept;
}

void PointFactor::scale_matrix() const noexcept {
    for (Index i = 0; i < matrix.n; ++i) {
        scale[i] = 1 / power_of_two_at(sqrt(matrix.diagonal[i]));
        matrix.row_sum[i] = matrix.diagonal[i] *= scale[i] * scale[i];
    }
    for (Index i = 0; i < matrix.n; ++i) {
        for (Offset k = matrix.start[i]; k < matrix.start[i + 1]; ++k) {
            Index const j = matrix.column[k];
            Real const entry = matrix.value[k] *= scale[i] * scale[j];
            matrix.row_sum[i] += entry;
            matrix.row_sum[j] += entry;
        }
    }
}

Status PointFactor::factorise(Plan const& plan, Tangle const& tangle, Region const& region,
                              NewtonSystem const& system) noexcept {
    Fault why;
    fill_matrix(plan, tangle, region, system);
    drop_entries_beyond_fronts();
    scale_matrix();
    return engine.factorise(matrix, {}, why);
}

void PointFactor::solve(Plan const& plan, Tangle const& tangle, Region const& region,
                        Span<Vec2> first, Span<Vec2> second) noexcept {
    Fault why;
    Span<Vec2> const both[] = {first, second};
    auto const for_numbers = [&](auto const& visit) {
        for (Index u = 0; u < region.n; ++u) {
            Index const point = region.point[u];
            for (Index side = 0; side < right_hand_sides; ++side) {
                Vec2& v = both[side][u];
                if (tangle.slips(point)) {
                    Vec2 const line = tangle.line[point];
                    Real along = dot(line, v);
                    visit(position(plan, point, 0), side, along);
                    v = along * line;
                } else {
                    visit(position(plan, point, 0), side, v.x);
                    visit(position(plan, point, 1), side, v.y);
                }
            }
        }
    };
    fill(values, 0.0);
    for_numbers([&](Index i, Index side, Real& number) {
        values[right_hand_sides * i + side] = scale[i] * number;
    });
    engine.solve(Rows{values.data(), nullptr, right_hand_sides, right_hand_sides, 1}, Progress{},
                 why);
    for_numbers([&](Index i, Index side, Real& number) {
        number = scale[i] * values[right_hand_sides * i + side];
    });
}

}  // namespace harmorph
