// Lays out and builds the tree of FaceDistance. tests/boundary/test_distance.cpp covers this file.
#include "base/box.hpp"
#include "boundary/distance.hpp"

namespace harmorph {
namespace {

Index in_eights(Size n) noexcept {
    return static_cast<Index>((n + FaceDistance::lanes - 1) / FaceDistance::lanes);
}

// Returns 0 if the inverse would not be finite, so that no floating-point exception is raised.
Real inverse_of(Real square) noexcept { return square >= 0x1p-1000 ? 1 / square : 0; }

Real distance_from_segment(Vec2 from, Vec2 to, Vec2 point) noexcept {
    Vec2 const along = to - from;
    Real const t = inverse_of(square(along)) * dot(point - from, along);
    return length(point - from - clamp(t, 0.0, 1.0) * along);
}

}  // namespace

void FaceDistance::Segments::set(Index lane, Vec2 from, Vec2 to) noexcept {
    Vec2 const along = to - from;
    x[lane] = from.x;
    y[lane] = from.y;
    along_x[lane] = along.x;
    along_y[lane] = along.y;
    inverse[lane] = inverse_of(square(along));
}

void FaceDistance::Chords::clear(Index lane) noexcept {
    axis.set(lane, {far_away, far_away}, {far_away, far_away});
    radius[lane] = 0;
}

void FaceDistance::Chords::copy(Index lane, Chords const& other, Index other_lane) noexcept {
    axis.x[lane] = other.axis.x[other_lane];
    axis.y[lane] = other.axis.y[other_lane];
    axis.along_x[lane] = other.axis.along_x[other_lane];
    axis.along_y[lane] = other.axis.along_y[other_lane];
    axis.inverse[lane] = other.axis.inverse[other_lane];
    radius[lane] = other.radius[other_lane];
}

void FaceDistance::Boxes::clear(Index lane) noexcept {
    low_x[lane] = low_y[lane] = far_away;
    high_x[lane] = high_y[lane] = -far_away;
}

void FaceDistance::Boxes::copy(Index lane, Boxes const& other, Index other_lane) noexcept {
    low_x[lane] = other.low_x[other_lane];
    low_y[lane] = other.low_y[other_lane];
    high_x[lane] = other.high_x[other_lane];
    high_y[lane] = other.high_y[other_lane];
}

void FaceDistance::lay_out(Arena& arena, Size max_faces) noexcept {
    Index const n_groups = in_eights(max_faces), n_chords = in_eights(static_cast<Size>(n_groups));
    Index n_boxes = 0;
    for (Index n = n_chords; n > 1; n_boxes += n) n = in_eights(static_cast<Size>(n));
    arena.take(faces, max_faces);
    arena.take(groups, n_groups);
    arena.take(chords, n_chords);
    arena.take(boxes, n_boxes);
}

void FaceDistance::build(Points points) noexcept {
    find_unit(points);
    find_images(points);
    root_height = 0;
    if (count == 0) return;
    auto const at = [&](Index point) { return inverse_unit * points[point]; };
    Index const n_groups = in_eights(static_cast<Size>(count));
    for (Index lane = 0; lane < lanes * n_groups; ++lane) {
        Face const& face = faces[min(lane, count - 1)];  // repeats the last face in the last lanes
        groups[lane / lanes].set(lane % lanes, at(face.point[0]), at(face.point[1]));
    }
    Index n_nodes = in_eights(static_cast<Size>(n_groups)), n_boxes = 0;
    for (Index lane = 0; lane < lanes * n_nodes; ++lane)
        set_chord(chords[lane / lanes], lane % lanes, points, lane);
    Offset faces_below = lanes * lanes;  // the number of faces below one lane of a node
    for (root_height = 1; n_nodes > 1; faces_below *= lanes) {
        height_start[++root_height] = n_boxes;
        n_nodes = in_eights(static_cast<Size>(n_nodes));
        for (Index lane = 0; lane < lanes * n_nodes; ++lane) {
            set_box(boxes[n_boxes + lane / lanes], lane % lanes, points, lane * faces_below,
                    (lane + 1) * faces_below);
        }
        n_boxes += n_nodes;
    }
}

void FaceDistance::find_images(Points points) noexcept {
    Vec2 shift[Translations::max_shifts];
    n_images = translations.shifts(points, shift);
    for (Index k = 0; k < n_images; ++k) image[k] = {{1, 0}, inverse_unit * shift[k]};
    if (!rotation.any) return;
    constexpr Index passages = 2;  // blades may overlap two passages on either side
    for (Index times = -passages; times <= passages; ++times) {
        if (times != 0)
            image[n_images++] = {rotation.power(times),
                                 inverse_unit * rotation.image({0, 0}, times)};
    }
}

void FaceDistance::find_unit(Points points) noexcept {
    extent = unit = 0;
    inverse_unit = 1;
    range = infinity;
    middle = half_size = {};
    if (count == 0) return;
    Box all;
    for (Face const& face : faces.first(count)) {
        for (Index const point : face.point) all.include(points[point]);
    }
    extent = all.extent();
    unit = power_of_two_at(extent);  // is 0 for a denormal extent
    if (unit > 0) {
        inverse_unit = 1 / unit;
        if (unit < 1e300 / farthest) range = farthest * unit;
    }
    constexpr Real margin = 1.0 / 32;
    middle = 0.5 * (inverse_unit * all.low + inverse_unit * all.high);
    half_size = 0.5 * (inverse_unit * all.size()) + Vec2{margin, margin};
}

// The chord runs from the beginning of the group's first face to the end of its last face.
void FaceDistance::set_chord(Chords& node, Index lane, Points points, Index group) const noexcept {
    node.clear(lane);
    Index const first = lanes * group, n = min(lanes, count - first);
    if (n <= 0) return;
    Vec2 const from = inverse_unit * points[faces[first].point[0]];
    Vec2 const to = inverse_unit * points[faces[first + n - 1].point[1]];
    // The distance from a chord is convex, so an end of each face is farthest.
    Real radius = 0;
    for (Face const& face : faces.from(first, n)) {
        for (Index const point : face.point) {
            radius = max(radius, distance_from_segment(from, to, inverse_unit * points[point]));
        }
    }
    node.axis.set(lane, from, to);
    node.radius[lane] = radius + slack * (radius + length(to - from));
}

void FaceDistance::set_box(Boxes& node, Index lane, Points points, Offset first,
                           Offset last) const noexcept {
    node.clear(lane);
    if (first >= count) return;
    Box box;
    for (Face const& face : faces.from(first, min(last, Offset{count}) - first)) {
        for (Index const point : face.point) box.include(inverse_unit * points[point]);
    }
    Real const margin = slack * (box.size().x + box.size().y);
    node.low_x[lane] = box.low.x - margin;
    node.low_y[lane] = box.low.y - margin;
    node.high_x[lane] = box.high.x + margin;
    node.high_y[lane] = box.high.y + margin;
}

}  // namespace harmorph
