#include "mesh/locate.hpp"

#include "base/sort.hpp"

namespace harmorph {
namespace {

constexpr Index leaf_items = 4;

Real along(BoxTree::Entry const& entry, bool vertical) noexcept {
    return vertical ? entry.centre.y : entry.centre.x;
}

void exchange(BoxTree::Entry& a, BoxTree::Entry& b) noexcept {
    BoxTree::Entry const old_a = a;
    a = b;
    b = old_a;
}

// Reorders the entries by Hoare's selection, so that no entry before entry k is greater and no
// entry after it is smaller. After 64 pivots the entries are sorted instead, because bad pivots
// would make the selection quadratic.
void select(Span<BoxTree::Entry> entries, Index k, bool vertical) noexcept {
    Index low = 0, high = entries.count() - 1;
    for (Index pivots = 0; low < high; ++pivots) {
        if (pivots > 64) {
            return sort(entries.from(low, high - low + 1),
                        [&](BoxTree::Entry const& a, BoxTree::Entry const& b) {
                            return along(a, vertical) < along(b, vertical);
                        });
        }
        Real const a = along(entries[low], vertical),
                   b = along(entries[low + (high - low) / 2], vertical),
                   c = along(entries[high], vertical);
        Real const pivot = max(min(a, b), min(max(a, b), c));
        Index i = low, j = high;
        while (i <= j) {
            while (along(entries[i], vertical) < pivot) ++i;
            while (pivot < along(entries[j], vertical)) --j;
            if (i <= j) exchange(entries[i++], entries[j--]);
        }
        if (k <= j) {
            high = j;
        } else if (k >= i) {
            low = i;
        } else {
            return;
        }
    }
}

}  // namespace

void BoxTree::lay_out(Arena& arena, Index n_items) noexcept {
    set_count(n_items);
    arena.take(entry, n);
    arena.take(box, Size{2} << levels);
}

void BoxTree::set_count(Index n_items) noexcept {
    n = n_items;
    for (levels = 0; (n >> levels) > leaf_items; ++levels) {}
}

void BoxTree::halve() noexcept {
    for (Index level = 0; level < levels; ++level) {
        for (Index node = 0; node < Index{1} << level; ++node) {
            Index const first = begin(level, node), middle = begin(level + 1, 2 * node + 1);
            Span<Entry> const node_entries = entry.from(first, begin(level, node + 1) - first);
            Box centres;
            for (Entry const& e : node_entries) centres.include(e.centre);
            Vec2 const extent = centres.high - centres.low;
            select(node_entries, middle - first, extent.y > extent.x);
        }
    }
}

void BoxTree::unite() noexcept {
    for (Index node = (Index{1} << levels) - 1; node > 0; --node) {
        box[node] = box[2 * node];
        box[node].include(box[2 * node + 1]);
    }
}

namespace {

// Points closer to a side than this fraction of the side's length are inside the cell.
constexpr Real rounding = 1e-12;

// Returns the squared distance from a convex cell, which is 0 inside the cell. The nearest side is
// among those that have the point on their outer side.
Real squared_distance(CellShape const& shape, Vec2 point) noexcept {
    Real nearest = infinity;
    bool inside = true;
    for (Index k = 0; k < shape.n; ++k) {
        Vec2 const side = shape.at[k + 1 == shape.n ? 0 : k + 1] - shape.at[k],
                   to_point = point - shape.at[k];
        if (!(cross(side, to_point) < -rounding * square(side))) continue;
        inside = false;
        Real const t = clamp(dot(to_point, side) / square(side), 0.0, 1.0);
        nearest = min(nearest, square(to_point - t * side));
    }
    return inside ? 0 : nearest;
}

Real longest_side(CellShape const& shape) noexcept {
    Real longest = 0;
    for (Index k = 0; k < shape.n; ++k) {
        longest = max(longest, square(shape.at[k + 1 == shape.n ? 0 : k + 1] - shape.at[k]));
    }
    return sqrt(longest);
}

// Adds share times the barycentric coordinates in the triangle of the corners a, b, c to the
// weights of these corners.
void add_barycentric(CellShape const& shape, Vec2 point, Index a, Index b, Index c, Real share,
                     Real* weight) noexcept {
    Vec2 const ab = shape.at[b] - shape.at[a], ac = shape.at[c] - shape.at[a],
               ap = point - shape.at[a];
    Real const twice_area = cross(ab, ac);
    // The area of a valid triangle is not 0, but its rounded product may be.
    if (twice_area == 0) return void(weight[a] += share);
    Real const at_b = cross(ap, ac) / twice_area, at_c = cross(ab, ap) / twice_area;
    weight[a] += share * (1 - at_b - at_c);
    weight[b] += share * at_b;
    weight[c] += share * at_c;
}

bool is_right_of(Vec2 from, Vec2 to, Vec2 point) noexcept {
    return cross(to - from, point - from) < 0;
}

}  // namespace

void weigh_corners(CellShape const& shape, Vec2 point, Real* weight) noexcept {
    if (shape.n == 3) return add_barycentric(shape, point, 0, 1, 2, 1, weight);
    bool const beside_1 = is_right_of(shape.at[0], shape.at[2], point);
    bool const beside_2 = is_right_of(shape.at[1], shape.at[3], point);
    add_barycentric(shape, point, 0, beside_1 ? 1 : 2, beside_1 ? 2 : 3, 0.5, weight);
    add_barycentric(shape, point, 1, beside_2 ? 2 : 3, beside_2 ? 3 : 0, 0.5, weight);
}

void Locator::build(OrientedMesh const& mesh) noexcept {
    cells = mesh;
    tree.set_count(mesh.mesh.n_cells);
    tree.build([&](Index cell) {
        CellShape const corners = shape(cell);
        Box box;
        for (Index k = 0; k < corners.n; ++k) box.include(corners.at[k]);
        return box;
    });
}

Location Locator::locate(Vec2 point, Index hint) const noexcept {
    auto const squared = [&](Index cell) { return squared_distance(shape(cell), point); };
    Nearest start;
    if (hint != none) start = {hint, squared(hint)};
    Nearest const found = tree.nearest(point, start, squared);
    Location out;
    out.cell = found.item;
    out.distance = sqrt(found.squared);
    if (out.cell == none) return out;
    CellShape const corners = shape(out.cell);
    Cell const cell = cells.cell(out.cell);
    out.longest_side = longest_side(corners);
    out.weights.n = cell.n;
    for (Index k = 0; k < cell.n; ++k) out.weights.point[k] = cell.point[k];
    weigh_corners(corners, point, out.weights.weight);
    return out;
}

}  // namespace harmorph
