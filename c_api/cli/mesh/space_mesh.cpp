#include "mesh/space_mesh.hpp"

#include "basics/library.hpp"
#include "basics/numbers.hpp"

#include <harmorph.h>
#include <harmorph_space.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>

namespace cli {

namespace {

// Collects the coordinates of the file that move: a number changes by dx along[0] + dy along[1] if
// its point of the plane, or the point between points of the plane, moves by dx, dy.
class Slots {
public:
    explicit Slots(Mesh& mesh) : mesh_(mesh) {}

    void add(std::size_t offset, double value, std::int32_t point, const Direction& direction,
             std::int64_t number) {
        const auto p = static_cast<std::size_t>(point);
        const bool is_between = p >= mesh_.x.size();
        std::int32_t rule = 0;
        if (direction.along[0] == 0 && direction.along[1] == 0) return;
        if (direction.along[0] == 1 && direction.along[1] == 0 &&
            (is_between || same(value, mesh_.x[p]))) {
            rule = takes_x;
        } else if (direction.along[0] == 0 && direction.along[1] == 1 &&
                   (is_between || same(value, mesh_.y[p]))) {
            rule = takes_y;
        } else {
            std::vector<Direction>& directions = mesh_.in_file.directions;
            const auto next = static_cast<std::int32_t>(directions.size());
            const auto known =
                numbers_.emplace(std::make_pair(direction.along[0], direction.along[1]), next);
            if (known.second) directions.push_back(direction);
            rule = known.first->second;
        }
        mesh_.in_file.slots.push_back({offset, point, rule, number});
    }

private:
    static bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

    Mesh& mesh_;
    std::map<std::pair<double, double>, std::int32_t> numbers_;
};

// Refuses the mesh with the text of the library, at the place of the point, side or cell that the
// error names.
[[noreturn]] void refuse_space(const Mesh& mesh, const SpaceMesh& space, const hm_error& error) {
    const std::vector<std::size_t>* offsets = &space.face_offset;
    if (error.item_kind == HM_ITEM_POINT) offsets = &space.points.offset[0];
    if (error.item_kind == HM_ITEM_SIDE) offsets = &space.side_offset;
    const bool is_known = error.item_kind == HM_ITEM_POINT || error.item_kind == HM_ITEM_SIDE ||
                          error.item_kind == HM_ITEM_CELL;
    const std::size_t item =
        is_known ? static_cast<std::size_t>(error.item - error.item_base) : std::size_t{0};
    const std::size_t offset = item < offsets->size() ? (*offsets)[item] : std::size_t{0};
    mesh.file.fail(offset, "the mesh has three dimensions and is not one cell thick: " +
                               std::string(error.text));
}

// Adds the marker "axis": if a wedge includes the axis, the edges on the axis are a boundary of the
// plane, but the file has no faces there.
void add_axis(Mesh& mesh) {
    double largest = 0;
    for (const double y : mesh.y) largest = std::max(largest, std::fabs(y));
    const auto is_on_axis = [&](std::int32_t point) {
        return std::fabs(mesh.y[static_cast<std::size_t>(point)]) <= 1e-12 * largest;
    };
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        const std::int32_t begin = mesh.cell_start[cell], end = mesh.cell_start[cell + 1];
        for (std::int32_t k = begin; k < end; ++k) {
            const std::int32_t a = mesh.cell_points[static_cast<std::size_t>(k)];
            const std::int32_t b =
                mesh.cell_points[static_cast<std::size_t>(k + 1 < end ? k + 1 : begin)];
            if (!is_on_axis(a) || !is_on_axis(b)) continue;
            mesh.add_face(a, b, mesh.add_marker("axis"), mesh.cell_offset[cell]);
        }
    }
}

// Adds a node in the middle of corners, which may move with one or several points of the plane.
void add_middle(Mesh& mesh, const hm_plane_info& info, const SpaceMiddle& middle,
                Slots& slots_of_file) {
    Between between = {{}, 0, 0, 0};
    for (const std::int32_t corner : middle.corners) {
        const std::int32_t point = info.follows[corner];
        std::int32_t* const end = between.corners.data() + between.n_corners;
        const bool is_new = std::find(between.corners.data(), end, point) == end;
        if (is_new && static_cast<std::size_t>(between.n_corners) < between.corners.size())
            between.corners[static_cast<std::size_t>(between.n_corners++)] = point;
    }
    double radius = 0, radial[3] = {};  // from the axis of a wedge
    for (std::size_t d = 0; d < 3; ++d) {
        between.x += (middle.x[d] - info.origin[d]) * info.x_direction[d];
        between.y += (middle.x[d] - info.origin[d]) * info.y_direction[d];
    }
    for (std::size_t d = 0; d < 3 && info.kind == HM_WEDGE; ++d) {
        radial[d] = middle.x[d] - info.origin[d] - between.x * info.x_direction[d];
        radius += radial[d] * radial[d];
    }
    radius = std::sqrt(radius);
    // The middle of an edge across a wedge keeps its place between the arc and the chord.
    const double at = mesh.y[static_cast<std::size_t>(between.corners[0])],
                 scale = between.n_corners == 1 && at > 0 ? at : radius;
    if (info.kind == HM_WEDGE) between.y = radius;
    const auto point = static_cast<std::int32_t>(mesh.x.size() + mesh.in_file.between.size());
    mesh.in_file.between.push_back(between);
    for (std::size_t d = 0; d < 3; ++d) {
        const double outwards = scale > 0 ? radial[d] / scale : 0;
        slots_of_file.add(
            middle.offset[d], middle.x[d], point,
            {{info.x_direction[d], info.kind == HM_WEDGE ? outwards : info.y_direction[d]}},
            3 * std::int64_t{middle.number} + static_cast<std::int64_t>(d));
    }
}

}  // namespace

void take_flat(Mesh& mesh, const SpacePoints& points, const std::vector<SpaceCopy>& copies) {
    constexpr double rounding = 1e-9;  // times the largest extent
    double extent = 0;
    for (const std::vector<double>& values : points.x) {
        const auto range = std::minmax_element(values.begin(), values.end());
        if (!values.empty()) extent = std::max(extent, *range.second - *range.first);
    }
    std::size_t normal = 3, offender = 0;
    for (const std::size_t d : {2u, 1u, 0u}) {
        const std::vector<double>& values = points.x[d];
        std::size_t k = 1;
        while (k < values.size() && std::fabs(values[k] - values[0]) <= rounding * extent) ++k;
        offender = std::max(offender, k);
        if (normal == 3 && k >= values.size()) normal = d;
    }
    if (normal == 3) {
        mesh.file.fail(points.offset[0][offender],
                       "the points must lie in a plane x, y or z = constant, as cells of two "
                       "dimensions do; this "
                       "point, (" +
                           brief(points.x[0][offender]) + ", " + brief(points.x[1][offender]) +
                           ", " + brief(points.x[2][offender]) + "), does not");
    }
    const std::size_t axes[2] = {normal == 0 ? 1u : 0u, normal == 2 ? 1u : 2u};
    std::copy(axes, axes + 2, mesh.in_file.axes);
    mesh.x = points.x[axes[0]];
    mesh.y = points.x[axes[1]];
    mesh.point_offset = points.offset[axes[0]];
    mesh.in_file.n_points = points.all_points();
    Slots slots(mesh);
    for (const std::size_t axis : {0u, 1u}) {
        const Direction direction = {{axis == 0 ? 1.0 : 0.0, axis == 0 ? 0.0 : 1.0}};
        const std::size_t d = axes[axis];
        for (std::size_t k = 0; k < points.x[d].size(); ++k) {
            slots.add(points.offset[d][k], points.x[d][k], static_cast<std::int32_t>(k), direction,
                      3 * points.number_of(k) + static_cast<std::int64_t>(d));
        }
        for (const SpaceCopy& copy : copies)
            slots.add(copy.offset[d], copy.x[d], copy.original, direction,
                      3 * std::int64_t{copy.number} + static_cast<std::int64_t>(d));
    }
}

namespace {

hm_space_mesh view_of(const SpaceMesh& space) {
    hm_space_mesh given = {};
    given.struct_size = sizeof given;
    given.n_points = space.points.points();
    given.points = {space.points.x[0].data(), space.points.x[1].data(), space.points.x[2].data(),
                    1};
    given.kind = space.kind;
    given.n_faces = static_cast<std::int32_t>(space.face_start.size()) - 1;
    given.face_start = space.face_start.data();
    given.face_points = space.face_points.data();
    given.n_sides = static_cast<std::int32_t>(space.side_markers.size());
    given.side_points = space.side_points.data();
    given.side_markers = space.side_markers.data();
    return given;
}

// Copies points, cells and faces of the plane, with their places in the file.
void copy_plane(Mesh& mesh, const SpaceMesh& space, const hm_mesh& found,
                const hm_plane_info& info) {
    mesh.x.assign(found.points.x, found.points.x + found.n_points);
    mesh.y.assign(found.points.y, found.points.y + found.n_points);
    for (std::int32_t p = 0; p < found.n_points; ++p) {
        mesh.point_offset.push_back(
            space.points.offset[0][static_cast<std::size_t>(info.space_point[p])]);
    }
    mesh.cell_start.assign(found.cell_start, found.cell_start + found.n_cells + 1);
    mesh.cell_points.assign(found.cell_points, found.cell_points + mesh.cell_start.back());
    mesh.cell_offset = space.face_offset;
    mesh.face_points.assign(found.face_points, found.face_points + 2 * found.n_faces);
    mesh.face_markers.assign(found.face_markers, found.face_markers + found.n_faces);
    mesh.face_offset = space.side_offset;
    if (info.kind == HM_WEDGE) add_axis(mesh);
}

// Adds the coordinates of the file that move with the plane. steps: the movement of each point of
// space for unit steps of its point in the plane, along x and along y.
void add_slots(Mesh& mesh, const SpaceMesh& space, const hm_plane_info& info,
               const std::vector<double> (&steps)[2]) {
    const auto n = static_cast<std::size_t>(info.n_space_points);
    Slots slots(mesh);
    const auto add = [&](std::size_t k, std::size_t d, std::size_t offset, double value,
                         std::int64_t number) {
        slots.add(offset, value, info.follows[k], {{steps[0][d * n + k], steps[1][d * n + k]}},
                  number);
    };
    mesh.in_file.n_points = space.points.all_points();
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t d = 0; d < 3; ++d)
            add(k, d, space.points.offset[d][k], space.points.x[d][k],
                3 * space.points.number_of(k) + static_cast<std::int64_t>(d));
    }
    for (const SpaceMiddle& middle : space.middles) add_middle(mesh, info, middle, slots);
    for (const SpaceCopy& copy : space.copies) {
        for (std::size_t d = 0; d < 3; ++d)
            add(static_cast<std::size_t>(copy.original), d, copy.offset[d], copy.x[d],
                3 * std::int64_t{copy.number} + static_cast<std::int64_t>(d));
    }
}

}  // namespace

void take_plane(Mesh& mesh, const SpaceMesh& space) {
    const hm_space_mesh given = view_of(space);
    hm_error error = {};
    const auto accepted = [&](hm_status status) {
        if (status < 0) refuse_space(mesh, space, error);
    };
    hm_memory memory = {};
    hm_plane* plane = nullptr;
    accepted(hm_plane_init(&plane, &memory, &given, &error));
    const std::unique_ptr<unsigned char[]> block(new unsigned char[memory.bytes]);
    memory.block = block.get();
    accepted(hm_plane_init(&plane, &memory, &given, &error));
    hm_plane_info info = {};
    info.struct_size = sizeof info;
    hm_mesh found = {};
    found.struct_size = sizeof found;
    accepted(hm_plane_info_get(plane, &info, &error));
    accepted(hm_plane_mesh(plane, &found, &error));
    copy_plane(mesh, space, found, info);

    const auto n = static_cast<std::size_t>(info.n_space_points),
               m = static_cast<std::size_t>(info.n_points);
    std::vector<double> steps[2], ones(m, 1.0), zeros(m, 0.0);
    for (const int along : {0, 1}) {
        std::vector<double>& step = steps[along];
        step.resize(3 * n);
        const hm_points unit = {along == 0 ? ones.data() : zeros.data(),
                                along == 1 ? ones.data() : zeros.data(), 1};
        const hm_space_points_out to = {step.data(), step.data() + n, step.data() + 2 * n, 1};
        accepted(hm_plane_spread(plane, &unit, nullptr, &to, nullptr, &error));
    }
    for (const double* direction : {info.x_direction, info.y_direction}) {
        const bool is_axis = direction[0] == 1 || direction[1] == 1 || direction[2] == 1;
        mesh.in_file.is_computed = mesh.in_file.is_computed || !is_axis;
    }
    add_slots(mesh, space, info, steps);
}

}  // namespace cli
