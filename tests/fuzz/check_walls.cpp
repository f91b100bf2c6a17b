// Distances to the walls, their derivatives and heights of the first layer, against a search over
// all faces.
#include "fields_model.hpp"

#include <map>
#include <fixtures/memory.hpp>

namespace fuzz {

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
    hm_status const status =
        blocks_.make(error_, size_by(fixtures::walls_size, analysis_, n, markers.data()),
                     init_by(hm_walls_init, &walls, analysis_, n, markers.data(), nullptr));
    expect((status >= 0) == all_exist, all_exist ? std::string("walls are refused: ") + error_.text
                                                 : "walls of a marker that no face has");
    if (status < 0) return;
    hm_walls_info info = sized<hm_walls_info>();
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
    done(hm_first_layer(walls, nullptr, &coordinates, heights.data(), nullptr, nullptr, &error_),
         "heights");
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
    std::vector<Point> const places = this->places();
    std::size_t const n = places.size();
    Numbers distance(n, 7), parameter(n, 7), again(n, 7);
    std::vector<std::int32_t> face(n, 7), hint(n);
    for (std::int32_t& k : hint) k = input_.one_in(2) ? input_.wild_index() : input_.from(0, 9);
    hm_points const to = in(places);
    std::int32_t const count = static_cast<std::int32_t>(n), base = problem_.mesh.index_base;
    hm_status const status =
        hm_wall_distance(walls, count, &to, nullptr, distance.data(), face.data(), parameter.data(),
                         problem_.options.executor, &error_);
    expect_told(status, error_);
    expect((status >= 0) == !has_bad(places), "a point is refused or taken against the header");
    if (status < 0) return expect_untouched(distance), expect_untouched(parameter);
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

}  // namespace fuzz
