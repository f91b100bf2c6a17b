#include "harmorph/extract.hpp"

#include "harmorph/sort.hpp"

namespace harmorph {
namespace {

BasisCounts counts_of(Basis const& whole, Index points, Index wall) noexcept {
    BasisCounts counts = whole.header->counts;
    counts.points = points;
    counts.wall = wall;
    counts.cells = counts.boundary = counts.loops = 0;
    return counts.share(0, counts.functions());
}

}  // namespace

Status PointList::check(Index n_points, Fault& fault) const noexcept {
    for (Index k = 0; k < count(); ++k) {
        Offset const its = Offset{point[k]} - index_base;
        if (its >= 0 && its < n_points) continue;
        return fault.refuse(Status::bad_argument, "entry # (from 0) of the list is no point of the mesh: @",
                            Counts::from_zero, k, point[k]);
    }
    return Status::ok;
}

// The list may name every point of the wall, once; how often it does is known only when it is read.
void Extract::count(Arena& arena, Basis const& whole, Index n_points) noexcept {
    Extract bound;
    arena.take(bound.wall, whole.wall_point.count());
    bound.basis.lay_out(arena, counts_of(whole, n_points, smaller(n_points, whole.wall_point.count())));
}

void Extract::lay_out(Arena& arena, Basis const& whole, PointList const& list) noexcept {
    arena.take(wall, whole.wall_point.count());
    if (arena.overflown()) return;
    BasisCounts const counts = counts_of(whole, list.count(), find_wall_points(whole, list));
    basis.lay_out(arena, counts);
    if (arena.overflown()) return;
    std::memset(static_cast<void*>(basis.header), 0, Basis::bytes(counts));
    basis.header->counts = counts;
}

// Leaves `wall` in the order of the boundary, like wall_point.
Index Extract::find_wall_points(Basis const& whole, PointList const& list) const noexcept {
    for (Index slot = 0; slot < wall.count(); ++slot) wall[slot] = {whole.wall_point[slot], slot, none};
    sort(wall, [](WallPlace const& a, WallPlace const& b) { return a.point < b.point; });
    Index found = 0;
    for (Index k = 0; k < list.count(); ++k) {
        Index begin = 0, end = wall.count();
        while (begin < end) {
            Index const middle = begin + (end - begin) / 2;
            if (wall[middle].point < list[k]) begin = middle + 1;
            else end = middle;
        }
        if (begin == wall.count() || wall[begin].point != list[k] || wall[begin].position != none) continue;
        wall[begin].position = k;
        ++found;
    }
    sort(wall, [](WallPlace const& a, WallPlace const& b) { return a.slot < b.slot; });
    return found;
}

void Extract::init(Basis const& whole) const noexcept {
    BasisHeader const counted = *basis.header;
    *basis.header = *whole.header;
    basis.header->counts = counted.counts;
    basis.header->bytes = Basis::bytes(counted.counts);
    basis.header->filled = 0;
    basis.unseal();
    copy(basis.shape, Span<const Basis::CurveShape>(whole.shape));
    copy(basis.indices, Span<const Index>(whole.indices));
    copy(basis.knots, Span<const Real>(whole.knots));
    copy(basis.control, Span<const Real>(whole.control));
    copy(basis.weights, Span<const Real>(whole.weights));
    copy(basis.conditions, Span<const Condition>(whole.conditions));
    Index slot = 0;
    for (WallPlace const& its : wall) {
        if (its.position == none) continue;
        basis.wall_point[slot] = its.position;
        basis.wall_curve[slot] = whole.wall_curve[its.slot];
        basis.wall_u[slot] = whole.wall_u[its.slot];
        basis.wall_lever[slot++] = whole.wall_lever[its.slot];
    }
}

void Extract::copy_rows(Basis const& whole, PointList const& list) const noexcept {
    Size const length = static_cast<Size>(basis.row_length());
    for (Index k = 0; k < list.count(); ++k) {
        copy(Span<Real>(basis.row(k), length), Span<const Real>(whole.row(list[k]), length));
    }
    basis.header->filled = basis.n_functions();
    basis.seal(whole.header->largest);
}

}  // namespace harmorph
