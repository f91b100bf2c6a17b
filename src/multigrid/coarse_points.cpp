#include "multigrid/coarse_points.hpp"

namespace harmorph {

void CoarsePoints::lay_out(Arena& arena, Index n, Offset entries) noexcept {
    arena.take(pool_.diagonal, coarse_points(n));
    arena.take(pool_.start, coarse_points(n) + max_levels);
    arena.take(pool_.column, entry_room(n));
    // In single precision, the entries of all levels take no more memory than this.
    arena.take(pool_.value, max(entry_room(n), (entry_room(n) + entries + 1) / 2));
    arena.take(weight_pool_.start, n + coarse_points(n) + max_levels);
    arena.take(weight_pool_.column, weight_room(n));
    arena.take(weight_pool_.weight, weight_room(n));
}

void CoarsePoints::lay_out_work(Arena& arena, Index n, Offset entries) noexcept {
    contraction_.lay_out(arena, n, max(entries, 2 * entry_room(n) / 3));
    // A level is made in three steps, whose working spaces share their memory.
    auto const shared = arena.mark();
    selection_.lay_out(arena, n);
    arena.release(shared);
    contraction_.lay_out_interpolation(arena, n);
    arena.release(shared);
    contraction_.lay_out_product(arena, n);
}

void CoarsePoints::build(SymmetricRows const& rows, Index levels) noexcept {
    count = 1;
    finest = rows;
    points_used_ = entries_used_ = starts_used_ = weights_used_ = 0;
    Index const max_count = levels == 0 ? max_levels : min(levels, max_levels);
    copy(contraction_.rows.row_sum, Span<const Real>(rows.row_sum));
    contraction_.rows.strong = FullRows::strong_on_finest_level;
    contraction_.rows.take(rows);
    while (count < max_count && n(count - 1) > coarsest && add_level()) {}
}

bool CoarsePoints::add_level() noexcept {
    Index const n_fine = n(count - 1);
    Offset const room = 2 * (entry_room(finest.n) - entries_used_) / 3;
    CoarseRows& made = coarse[count];
    Index const most = count == 1 ? most_first(finest.n) : 0;
    made.n = selection_.select(contraction_.rows, most, contraction_.coarse);
    if (made.n == 0) return false;
    made.diagonal = pool_.diagonal.from(points_used_, made.n);
    made.start = pool_.start.from(points_used_ + count - 1, made.n + 1);
    made.column = pool_.column.from(entries_used_, room);
    made.value = pool_.value.from(entries_used_, room);
    Prolongation& by = finer[count - 1];
    by.start = weight_pool_.start.from(starts_used_, n_fine + 1);
    Offset const weights_left = weight_room(finest.n) - weights_used_;
    by.column = weight_pool_.column.from(weights_used_, weights_left);
    by.weight = weight_pool_.weight.from(weights_used_, weights_left);
    Index width = Prolongation::most_weights;
    Offset weights = contraction_.interpolate(width, by);
    while (!contraction_.contract(by, room, made)) {
        if (--width == 0) return false;
        weights = contraction_.interpolate(width, by);
    }
    contraction_.descend(made);
    points_used_ += made.n;
    entries_used_ += made.entries();
    starts_used_ += n_fine + 1;
    weights_used_ += weights;
    ++count;
    return true;
}

}  // namespace harmorph
