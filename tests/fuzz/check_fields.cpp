// Distances to the walls and interpolated fields, against searches over all faces and cells.
#include "fields_model.hpp"

#include <map>

namespace fuzz {
namespace {

// The nearest place of a face to a point.
struct Foot {
    Wide distance, t, x, y;  // x, y: from the foot to the point
    Wide length;             // of the face
};
Foot foot_on(Point a, Point b, Point p) {
    Wide const dx = Wide(b.x) - a.x, dy = Wide(b.y) - a.y, px = Wide(p.x) - a.x,
               py = Wide(p.y) - a.y, length = std::hypot(dx, dy);
    Wide const ux = length > 0 ? dx / length : 0, uy = length > 0 ? dy / length : 0;
    Wide const along = std::max(Wide(0), std::min(length, ux * px + uy * py));
    Wide const x = px - along * ux, y = py - along * uy;
    return {std::hypot(x, y), length > 0 ? along / length : 0, x, y, length};
}

}  // namespace

FieldsModel::FieldsModel(Problem& problem, Input& input)
    : problem_(problem),
      input_(input),
      judged_(judge_by_header(problem.domain)),
      points_(problem.domain.points),
      size_(problem.size()) {
    Point low = points_[0], high = points_[0];
    for (Point const& p : points_) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    extent_ = std::max(high.x - low.x, high.y - low.y);
    if (input_.one_in(2)) {
        problem_.problem.n_conditions = 0;
        problem_.problem.curves = nullptr;
    }
}

Outcome FieldsModel::run() {
    hm_status const status = in_block(
        [&](std::size_t* bytes) {
            return hm_analysis_size(&problem_.problem, &problem_.options, bytes, &error_);
        },
        [&](void* memory, std::size_t bytes) {
            return hm_analysis_init(&analysis_, memory, bytes, &problem_.problem, &problem_.options,
                                    &error_);
        });
    if (status < 0) return Outcome::refused;
    for (std::int32_t k = input_.from(1, 4); k > 0; --k) {
        switch (input_.below(4)) {
            case 0: areas(); break;
            case 1: walls(); break;
            case 2: levels(); break;
            default: interpolation();
        }
    }
    for (Block const& block : blocks_) block.expect_intact();
    return Outcome::done;
}

std::vector<Point> FieldsModel::displaced() {
    double const by = extent_ * input_.any_of({0.0, 1e-9, 1e-3, 0.1});
    std::vector<Point> out = points_;
    for (Point& p : out) p = {p.x + by * input_.between(-1, 1), p.y + by * input_.between(-1, 1)};
    return out;
}

std::vector<Point> FieldsModel::places() {
    std::vector<Point> out(input_.below(12) + 1);
    auto const some = [&] {
        return points_[input_.below(static_cast<std::uint32_t>(points_.size()))];
    };
    for (Point& place : out) {
        Point const a = some(), b = some();
        double const t = input_.any_of({0.0, 0.5, 0.25, 1.0 / 3});
        place = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
        if (input_.one_in(2)) continue;
        double const far = extent_ * input_.any_of({1e-12, 0.01, 0.3, 1e3});
        place.x += far * input_.between(-1, 1);
        place.y += far * input_.between(-1, 1);
    }
    return out;
}

void FieldsModel::walls() {
    std::vector<std::int32_t> markers;
    for (std::int32_t marker = 1; marker < 8; ++marker)
        if (input_.one_in(3)) markers.push_back(marker);
    if (input_.one_in(16)) markers.push_back(input_.wild_index());
    if (markers.empty()) markers.push_back(problem_.domain.faces[0].marker);
    bool all_exist = true;
    std::vector<Face> faces;
    for (std::int32_t const marker : markers) {
        bool any = false;
        for (Face const& face : problem_.domain.faces) any = any || face.marker == marker;
        all_exist = all_exist && any;
    }
    for (Face const& face : problem_.domain.faces)
        if (std::find(markers.begin(), markers.end(), face.marker) != markers.end())
            faces.push_back(face);
    std::int32_t const n = static_cast<std::int32_t>(markers.size());
    std::vector<Point> const moved = displaced();
    hm_points const coordinates = in(moved);
    hm_walls* walls = nullptr;
    hm_status const status = in_block(
        [&](std::size_t* bytes) {
            return hm_walls_size(analysis_, n, markers.data(), bytes, &error_);
        },
        [&](void* memory, std::size_t bytes) {
            return hm_walls_init(&walls, memory, bytes, analysis_, n, markers.data(), nullptr,
                                 &error_);
        });
    expect((status >= 0) == all_exist, all_exist ? std::string("walls are refused: ") + error_.text
                                                 : "walls of a marker that no face has");
    if (status < 0) return;
    hm_walls_info info{};
    info.struct_size = sizeof info;
    done(hm_walls_info_get(walls, &info, &error_), "what the walls have");
    // Of points that a cut joins, the library names the first one.
    std::map<std::pair<double, double>, std::int32_t> first;
    for (std::size_t k = 0; k < points_.size(); ++k)
        first.try_emplace({points_[k].x, points_[k].y}, static_cast<std::int32_t>(k));
    auto const named = [&](std::int32_t point) {
        return first.at({points_[at(point)].x, points_[at(point)].y});
    };
    std::map<std::pair<std::int32_t, std::int32_t>, int> sides;
    for (Face const& face : faces) ++sides[std::minmax(named(face.from), named(face.to))];
    expect(at(info.n_faces) == faces.size(), "the walls have another number of faces");
    for (std::int32_t k = 0; k < info.n_faces; ++k) {
        std::int32_t const a = info.face_points[2 * k] - problem_.mesh.index_base,
                           b = info.face_points[2 * k + 1] - problem_.mesh.index_base;
        expect(sides[std::minmax(named(a), named(b))]-- > 0,
               "a face of the walls that the mesh does not have");
        faces[at(k)] = {a, b, info.face_markers[k]};
    }
    if (input_.one_in(2)) {
        distances(walls, faces, points_);
    } else {
        std::vector<Point> broken = moved;
        broken[at(faces[0].from)].y = input_.any_of({double(NAN), HUGE_VAL, 1.01e100});
        hm_points const bad = in(broken);
        hm_status const refused = hm_walls_move(walls, &bad, &error_);
        expect_told(refused, error_);
        expect(refused == HM_BAD_MESH, "walls are moved to a place that does not exist");
        if (input_.one_in(2)) return distances(walls, faces, points_);
        done(hm_walls_move(walls, &coordinates, &error_), "moved walls");
        distances(walls, faces, moved);
    }
    Numbers heights(at(info.n_wall_points), 7);
    done(hm_first_layer(walls, &coordinates, heights.data(), &error_), "heights");
    for (std::int32_t k = 0; k < info.n_wall_points; ++k) {
        std::int32_t const base = problem_.mesh.index_base, other = info.layer_points[k];
        if (other < 0) {
            expect(heights[at(k)] == 0, "a height without an edge");
            continue;
        }
        Point const a = moved[at(info.wall_points[k] - base)], b = moved[at(other - base)];
        Wide const edge = std::hypot(Wide(b.x) - a.x, Wide(b.y) - a.y);
        expect(std::abs(heights[at(k)]) <= edge * (1 + 1e-12L),
               "a height is larger than the edge is long");
    }
}

void FieldsModel::distances(hm_walls const* walls, std::vector<Face> const& faces,
                            std::vector<Point> const& mesh) {
    std::vector<Point> places = this->places();
    bool const is_bad = input_.one_in(12);
    std::size_t const n = places.size();
    if (is_bad) places[n - 1].x = input_.any_of({double(NAN), -HUGE_VAL, 1.01e100});
    Numbers distance(n, 7), parameter(n, 7), again(n, 7);
    std::vector<std::int32_t> face(n, 7), hint(n);
    for (std::int32_t& k : hint) k = input_.one_in(2) ? input_.wild_index() : input_.from(0, 9);
    hm_points const to = in(places);
    std::int32_t const count = static_cast<std::int32_t>(n), base = problem_.mesh.index_base;
    hm_status const status =
        hm_wall_distance(walls, count, &to, nullptr, distance.data(), face.data(), parameter.data(),
                         problem_.options.executor, &error_);
    expect_told(status, error_);
    expect((status >= 0) == !is_bad, "a point is refused or taken against the header");
    if (status < 0) return untouched(distance), untouched(parameter);
    done(hm_wall_distance(walls, count, &to, hint.data(), again.data(), hint.data(), nullptr,
                          nullptr, &error_),
         "distances with hints");
    for (std::size_t k = 0; k < n; ++k) {
        expect(again[k] == distance[k] && hint[k] == face[k], "hints change the result");
        std::int32_t const found = face[k] - base;
        expect(found >= 0 && at(found) < faces.size(), "a face that does not exist");
        Wide least = HUGE_VALL, longest = 0;
        for (Face const& each : faces) {
            Foot const foot = foot_on(mesh[at(each.from)], mesh[at(each.to)], places[k]);
            least = std::min(least, foot.distance);
            longest = std::max(longest, foot.length);
        }
        Wide const within = 16 * 0x1p-53L * (least + longest);
        expect(std::abs(distance[k] - least) <= within, "a distance differs from the reference");
        Face const& nearest = faces[at(found)];
        Foot const foot = foot_on(mesh[at(nearest.from)], mesh[at(nearest.to)], places[k]);
        expect(std::abs(foot.distance - least) <= within, "another face is nearer");
        expect(parameter[k] >= 0 && parameter[k] <= 1, "a parameter out of range");
        Wide const off = std::abs(parameter[k] - foot.t) * foot.length;
        expect(off <= within * 4, "a parameter differs from the reference");
    }
    distance_derivatives(walls, faces, mesh, places);
}

void FieldsModel::distance_derivatives(hm_walls const* walls, std::vector<Face> const& faces,
                                       std::vector<Point> const& mesh,
                                       std::vector<Point> const& places) {
    std::size_t const n = places.size();
    Numbers distance(n), change(n, 7), dj(n);
    std::vector<std::int32_t> face(n);
    std::vector<Point> place_change(n), mesh_change(mesh.size()), place_dj(n, {1, 2}),
        mesh_dj(mesh.size(), {3, 4});
    for (Point& p : place_change) p = {input_.between(-1, 1), input_.between(-1, 1)};
    for (Point& p : mesh_change) p = {input_.between(-1, 1), input_.between(-1, 1)};
    for (double& number : dj) number = input_.between(-1, 1);
    hm_points const to = in(places), moves = in(place_change), mesh_moves = in(mesh_change);
    hm_points_out const to_places{&place_dj[0].x, &place_dj[0].y, 2},
        to_mesh{&mesh_dj[0].x, &mesh_dj[0].y, 2};
    std::int32_t const count = static_cast<std::int32_t>(n);
    done(hm_wall_distance(walls, count, &to, nullptr, distance.data(), face.data(), nullptr,
                          nullptr, &error_),
         "distances");
    done(hm_wall_distance_change(walls, count, &to, face.data(), &moves, &mesh_moves, change.data(),
                                 &error_),
         "changes of distances");
    done(hm_wall_distance_adjoint(walls, count, &to, face.data(), dj.data(), &to_places, &to_mesh,
                                  &error_),
         "derivatives of distances");
    Wide left = 0, right = 0;
    for (std::size_t k = 0; k < n; ++k) {
        left += Wide(dj[k]) * change[k];
        right += (Wide(place_dj[k].x) - 1) * place_change[k].x +
                 (Wide(place_dj[k].y) - 2) * place_change[k].y;
        Face const& each = faces[at(face[k] - problem_.mesh.index_base)];
        Foot const foot = foot_on(mesh[at(each.from)], mesh[at(each.to)], places[k]);
        if (foot.distance < 1e-6L * (foot.length + std::abs(Wide(places[k].x) - mesh[0].x)))
            continue;  // the direction is rounding
        Point const from = mesh_change[at(each.from)], end = mesh_change[at(each.to)];
        Wide const vx = place_change[k].x - (1 - foot.t) * from.x - foot.t * end.x,
                   vy = place_change[k].y - (1 - foot.t) * from.y - foot.t * end.y;
        Wide const expected = (foot.x * vx + foot.y * vy) / foot.distance;
        expect(std::abs(change[k] - expected) <= 1e-8L,
               "the change of a distance differs from the reference");
    }
    for (std::size_t k = 0; k < mesh.size(); ++k)
        right += (Wide(mesh_dj[k].x) - 3) * mesh_change[k].x +
                 (Wide(mesh_dj[k].y) - 4) * mesh_change[k].y;
    expect(std::abs(left - right) <= 1e-13L * Wide(n + mesh.size()),
           "the adjoint of distances is not the transpose");
}

void FieldsModel::interpolation() {
    std::vector<Point> places = this->places();
    std::size_t const n = places.size();
    bool const is_bad = input_.one_in(12);
    if (is_bad) places[n - 1].y = input_.any_of({double(NAN), HUGE_VAL, -1.01e100});
    std::int32_t const count = static_cast<std::int32_t>(n);
    hm_points const to = in(places);
    Numbers distance(n, 7);
    hm_interpolation* interpolation = nullptr;
    hm_interpolation_report report{};
    report.struct_size = sizeof report;
    std::size_t bytes = 0;
    expect(hm_interpolation_size(analysis_, -1, &bytes, &error_) < 0, "-1 points are taken");
    hm_status const status = in_block(
        [&](std::size_t* size) { return hm_interpolation_size(analysis_, count, size, &error_); },
        [&](void* memory, std::size_t size) {
            return hm_interpolation_init(&interpolation, memory, size, analysis_, nullptr, count,
                                         &to, distance.data(), problem_.options.executor, &report,
                                         &error_);
        });
    if (status < 0) {
        untouched(distance);
        bool const is_valid = inverted_cells(judged_, points_, 1e-12) == 0;
        expect(is_bad || !is_valid || judged_.ambiguous > 0,
               std::string("an interpolation is refused: ") + error_.text);
        return;
    }
    expect(!is_bad, "a point is taken that does not exist");
    std::int32_t outside = 0;
    for (double const number : distance) outside += number > 0 ? 1 : 0;
    expect(report.outside == outside, "another number of points is outside than have a distance");
    interpolated(interpolation, places, distance);
    transpose(interpolation, n);
}

// A place that rounding puts beside its thin cell must not be taken by the large cell next to it:
// cells that contain the place come first, and then those that nearly do.
bool FieldsModel::value_in_mesh(Point place, Numbers const& field, Wide& value,
                                Wide& rounding) const {
    return value_in_cells(place, field, 0, value, rounding) ||
           value_in_cells(place, field, 1e-9L, value, rounding);
}

bool FieldsModel::value_in_cells(Point place, Numbers const& field, Wide beside, Wide& value,
                                 Wide& rounding) const {
    std::vector<std::pair<std::array<std::int32_t, 3>, bool>> triangles;  // is one of two divisions
    Wide sum = 0;
    int found = 0, wanted = 1;
    auto const search = [&](std::array<std::int32_t, 3> const& k) {
        Point const a = points_[at(k[0])], b = points_[at(k[1])], c = points_[at(k[2])];
        auto const area = [](Point p, Point q, Point r) {
            return (Wide(q.x) - p.x) * (Wide(r.y) - p.y) - (Wide(q.y) - p.y) * (Wide(r.x) - p.x);
        };
        Wide const whole = area(a, b, c), u = area(place, b, c) / whole,
                   v = area(place, c, a) / whole, w = area(place, a, b) / whole;
        if (!(u >= -beside && v >= -beside && w >= -beside)) return false;
        sum += u * field[at(k[0])] + v * field[at(k[1])] + w * field[at(k[2])];
        Wide const side = std::max({std::hypot(Wide(b.x) - a.x, Wide(b.y) - a.y),
                                    std::hypot(Wide(c.x) - b.x, Wide(c.y) - b.y),
                                    std::hypot(Wide(a.x) - c.x, Wide(a.y) - c.y)});
        rounding = std::max(rounding, 1e-8L + 64 * 0x1p-53L * side * side / std::abs(whole));
        return true;
    };
    rounding = 0;
    for (auto const& triangle : judged_.triangles)
        if (search(triangle)) return value = sum, true;
    for (std::size_t c = 0; c < problem_.domain.cells.size(); ++c) {
        if (judged_.is_divided[c]) continue;
        Cell const& cell = problem_.domain.cells[c];
        sum = 0, found = 0, wanted = cell.size() == 3 ? 1 : 2;
        if (wanted == 1) found = search({cell[0], cell[1], cell[2]}) ? 1 : 0;
        else {
            found += search({cell[0], cell[1], cell[2]}) || search({cell[0], cell[2], cell[3]});
            found += search({cell[0], cell[1], cell[3]}) || search({cell[1], cell[2], cell[3]});
        }
        if (found == wanted) return value = sum / wanted, true;
    }
    return false;
}

void FieldsModel::interpolated(hm_interpolation const* interpolation,
                               std::vector<Point> const& places, Numbers const& distance) {
    std::size_t const n = places.size(), n_points = points_.size();
    Numbers fields(2 * n_points), values(2 * n, 7);
    std::map<std::pair<double, double>, double> at_place;  // both sides of a cut have one value
    for (std::size_t k = 0; k < n_points; ++k) {
        fields[k] =
            at_place.try_emplace({points_[k].x, points_[k].y}, input_.between(-1, 1)).first->second;
        fields[n_points + k] =
            (points_[k].x - points_[0].x) / extent_ + 2 * ((points_[k].y - points_[0].y) / extent_);
    }
    done(hm_interpolate(interpolation, 2, fields.data(), values.data(), problem_.options.executor,
                        &error_),
         "interpolated fields");
    if (has_short_sides()) return;
    for (std::size_t k = 0; k < n; ++k) {
        Wide least = HUGE_VALL, on_boundary = 0, value = 0, rounding = 0;
        int equal = 0;
        for (Face const& face : problem_.domain.faces) {
            Foot const foot = foot_on(points_[at(face.from)], points_[at(face.to)], places[k]);
            bool const is_close = std::abs(foot.distance - least) <= 1e-9L * extent_;
            if (foot.distance < least) {
                least = foot.distance;
                on_boundary = (1 - foot.t) * fields[at(face.from)] + foot.t * fields[at(face.to)];
            }
            equal = is_close ? equal + 1 : foot.distance == least ? 1 : equal;
        }
        bool const is_inside = value_in_mesh(places[k], fields, value, rounding);
        // In a cell whose sides differ by many powers of ten, rounding decides about a place.
        if (judged_.ambiguous > 0 || rounding > 2e-8L) continue;
        if (is_inside) {
            expect(distance[k] <= 1e-7 * extent_, "a point of the mesh is said to be outside");
        } else {
            expect(std::abs(distance[k] - least) <= 1e-12L * least + 1e-9L * extent_,
                   "the distance of a point outside differs from the reference");
            value = on_boundary;
            rounding = 1e-7L;
            if (equal > 1 || least > 1e2L * extent_) continue;  // rounding decides where
        }
        if (rounding > 0.1L || least < 1e-9L * extent_) continue;
        expect(std::abs(values[k] - value) <= rounding * 4,
               "an interpolated value differs from the reference by " +
                   std::to_string(double(values[k] - value)));
        if (!is_inside) continue;
        Wide const linear = (Wide(places[k].x) - points_[0].x) / extent_ +
                            2 * ((Wide(places[k].y) - points_[0].y) / extent_);
        Wide const of_origin = 0x1p-48L * size_ / extent_;
        expect(std::abs(values[n + k] - linear) <= 1e-11L + of_origin,
               "a linear field is not interpolated exactly, but with an error of " +
                   std::to_string(double(values[n + k] - linear) * 1e12) + "e-12");
    }
}

void FieldsModel::transpose(hm_interpolation const* interpolation, std::size_t n) {
    std::size_t const n_points = points_.size();
    Numbers from(3 * n_points), to(3 * n, 7), to_dj(3 * n), from_dj(3 * n_points, 5);
    for (double& number : from) number = input_.between(-1, 1);
    for (double& number : to_dj) number = input_.between(-1, 1);
    done(hm_interpolate(interpolation, 3, from.data(), to.data(), nullptr, &error_), "fields");
    done(hm_interpolate_adjoint(interpolation, 3, to_dj.data(), from_dj.data(), &error_),
         "derivatives by fields");
    Wide left = 0, right = 0;
    for (std::size_t k = 0; k < 3 * n; ++k) left += Wide(to[k]) * to_dj[k];
    for (std::size_t k = 0; k < 3 * n_points; ++k) right += Wide(from[k]) * (from_dj[k] - 5);
    expect(std::abs(left - right) <= 1e-13L * Wide(n_points + n),
           "the adjoint of an interpolation is not the transpose");
}

}  // namespace fuzz
