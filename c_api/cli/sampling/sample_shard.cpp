#include "sampling/sample_shard.hpp"

#include "basics/elementary.hpp"
#include "basics/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace cli {

namespace {

// Returns the faces of the walls, with the mesh on the left, as the next point of each point.
std::map<std::int32_t, std::int32_t> directed_faces(const Mesh& mesh,
                                                    const std::vector<std::int32_t>& markers) {
    std::set<std::pair<std::int32_t, std::int32_t>> faces;
    for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
        if (std::find(markers.begin(), markers.end(), mesh.face_markers[face]) == markers.end())
            continue;
        const std::int32_t a = mesh.face_points[2 * face], b = mesh.face_points[2 * face + 1];
        faces.insert({std::min(a, b), std::max(a, b)});
    }
    std::map<std::int32_t, std::int32_t> next;
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        const auto first = static_cast<std::size_t>(mesh.cell_start[cell]),
                   n = static_cast<std::size_t>(mesh.cell_start[cell + 1]) - first;
        double area = 0;
        const auto at = [&](std::size_t k) { return mesh.cell_points[first + k % n]; };
        const auto o = static_cast<std::size_t>(at(0));
        for (std::size_t k = 0; k < n; ++k) {
            const auto a = static_cast<std::size_t>(at(k)), b = static_cast<std::size_t>(at(k + 1));
            area += (mesh.x[a] - mesh.x[o]) * (mesh.y[b] - mesh.y[o]) -
                    (mesh.x[b] - mesh.x[o]) * (mesh.y[a] - mesh.y[o]);
        }
        for (std::size_t k = 0; k < n; ++k) {
            const std::int32_t a = at(k), b = at(k + 1);
            if (faces.count({std::min(a, b), std::max(a, b)}) == 0) continue;
            if (area > 0) next[a] = b;
            else next[b] = a;
        }
    }
    return next;
}

}  // namespace

WallChains::WallChains(const Mesh& mesh, const std::vector<std::int32_t>& markers) {
    std::map<std::int32_t, std::int32_t> next = directed_faces(mesh, markers);
    std::set<std::int32_t> followed;
    for (const auto& face : next) followed.insert(face.second);
    const auto walk = [&](std::int32_t from, bool is_loop) {
        const auto begin = static_cast<std::ptrdiff_t>(points_.size());
        points_.push_back(from);
        for (auto face = next.find(from); face != next.end(); face = next.find(points_.back())) {
            const std::int32_t to = face->second;
            next.erase(face);
            if (to != from) points_.push_back(to);
        }
        const auto right = [&](std::int32_t a, std::int32_t b) {
            return mesh.x[static_cast<std::size_t>(a)] < mesh.x[static_cast<std::size_t>(b)];
        };
        const auto first = points_.begin() + begin;
        if (is_loop)
            std::rotate(first, std::max_element(first, points_.end(), right), points_.end());
        start_.push_back(static_cast<std::int32_t>(points_.size()));
        is_loop_.push_back(is_loop);
    };
    std::vector<std::int32_t> ends;
    for (const auto& face : next)
        if (followed.count(face.first) == 0) ends.push_back(face.first);
    for (const std::int32_t end : ends) walk(end, false);
    while (!next.empty()) walk(next.begin()->first, true);
}

void WallChains::measure(const std::vector<double>& coordinates, std::vector<double>& normals,
                         std::vector<double>& arcs) const {
    const auto at = [&](std::int32_t place, int axis) {
        const auto point = static_cast<std::size_t>(points_[static_cast<std::size_t>(place)]);
        return coordinates[2 * point + static_cast<std::size_t>(axis)];
    };
    for (std::size_t piece = 0; piece < is_loop_.size(); ++piece) {
        const std::int32_t first = start_[piece], end = start_[piece + 1];
        double arc = 0;
        for (std::int32_t k = first; k < end; ++k) {
            const std::int32_t before = k > first         ? k - 1
                                        : is_loop_[piece] ? end - 1
                                                          : k,
                               after = k + 1 < end       ? k + 1
                                       : is_loop_[piece] ? first
                                                         : k;
            const double x = at(after, 0) - at(before, 0), y = at(after, 1) - at(before, 1),
                         length = length_of(x, y);
            normals.push_back(length > 0 ? -y / length : 0);
            normals.push_back(length > 0 ? x / length : 0);
            if (k > first) arc += length_of(at(k, 0) - at(k - 1, 0), at(k, 1) - at(k - 1, 1));
            arcs.push_back(arc);
        }
    }
}

WallDistances::WallDistances(const Mesh& mesh, const std::vector<std::int32_t>& markers,
                             const Threads& threads)
    : mesh_(mesh), threads_(threads), faces_(mesh.x.size(), -1), distances_(mesh.x.size()) {
    const MeshAnalysis analysis(mesh);
    const auto n = static_cast<std::int32_t>(markers.size());
    with_memory(block_, [&](hm_memory* memory) {
        return call(mesh, hm_walls_init, &walls_, memory, analysis.get(), n, markers.data(),
                    nullptr);
    });
}

const std::vector<double>& WallDistances::values(const std::vector<double>& coordinates) {
    const hm_points at = {coordinates.data(), coordinates.data() + 1, 2};
    call(mesh_, hm_walls_move, walls_, &at);
    call(mesh_, hm_wall_distance, walls_, mesh_.points(), &at, faces_.data(), distances_.data(),
         faces_.data(), nullptr, threads_.executor());
    return distances_;
}

SampleShard::SampleShard(const SampleFolder& folder, std::int64_t number, const Mesh& mesh,
                         const SampleTable& table, const WallChains* walls,
                         WallDistances* distances)
    : number_(number),
      mesh_(mesh),
      table_(table),
      walls_(walls),
      csv_(files_.add(folder.table_of(number))),
      distances_(distances),
      distance_out_(distances == nullptr ? nullptr : &files_.add(folder.distances_of(number))),
      out_(files_.add(folder.arrays_of(number))),
      npz_(out_) {
    const auto points = static_cast<std::uint64_t>(mesh.points());
    table.write_names(csv_);
    npz_.begin("coordinates", {points, 2});
    if (distances == nullptr) return;
    distance_npz_ = std::make_unique<NpzWriter>(*distance_out_);
    distance_npz_->begin("wall_distance", {points});
}

void SampleShard::append(std::vector<double>& to, const std::vector<double>& from) const {
    to.insert(to.end(), from.begin(), from.end());
}

void SampleShard::add(SampleRow row, const MorphedDesign& result) {
    row.shard = number_;
    if (row.is_accepted()) {
        row.row = accepted_++;
        npz_.append(result.coordinates);
        append(numbers_, row.numbers);
        append(control_, result.control);
        designs_.push_back(static_cast<std::int32_t>(row.design + 1));
        splits_.push_back(row.split == "train" ? 0 : row.split == "test" ? 1 : 2);
        if (distance_npz_) distance_npz_->append(distances_->values(result.coordinates));
        if (walls_ != nullptr) walls_->measure(result.coordinates, normals_, arcs_);
    }
    table_.write(csv_, row);
    const bool is_full = !out_ || !csv_ || (distance_out_ != nullptr && !*distance_out_);
    if (is_full) files_.commit();  // throws the Failure that names the file and the reason
}

void SampleShard::commit() {
    const auto n = static_cast<std::uint64_t>(accepted_);
    npz_.end(n);
    const std::size_t columns = table_.numbers().size(), first = table_.first_parameter();
    std::vector<double> column(static_cast<std::size_t>(n)), parameters;
    for (std::size_t k = 0; k < first; ++k) {
        for (std::size_t row = 0; row < column.size(); ++row)
            column[row] = numbers_[row * columns + k];
        npz_.add(table_.numbers()[k], column, {n});
    }
    for (std::size_t k = 0; k < numbers_.size(); ++k)
        if (k % columns >= first) parameters.push_back(numbers_[k]);
    npz_.add("variables", parameters, {n, columns - first});
    const std::uint64_t control = accepted_ > 0 ? control_.size() / (2 * n) : 0;
    npz_.add("control_points", control_, {n, control, 2});
    npz_.add("design", designs_, {n});
    npz_.add("split", splits_, {n});
    npz_.add("valid", std::vector<std::uint8_t>(static_cast<std::size_t>(n), 1), {n});
    npz_.add("cell_start", mesh_.cell_start, {mesh_.cell_start.size()});
    npz_.add("cell_points", mesh_.cell_points, {mesh_.cell_points.size()});
    npz_.add("face_points", mesh_.face_points, {mesh_.face_markers.size(), 2});
    npz_.add("face_markers", mesh_.face_markers, {mesh_.face_markers.size()});
    if (walls_ != nullptr) {
        const std::uint64_t w = walls_->points().size();
        npz_.add("wall_points", walls_->points(), {w});
        npz_.add("wall_start", walls_->start(), {walls_->start().size()});
        npz_.add("wall_normals", normals_, {n, w, 2});
        npz_.add("wall_arc_length", arcs_, {n, w});
    }
    npz_.finish();
    if (distance_npz_) {
        distance_npz_->end(n);
        distance_npz_->finish();
    }
    files_.commit();
}

std::string SampleShard::description(const SampleTable& table, const Mesh& mesh,
                                     const WallChains* walls) {
    const std::string p = std::to_string(mesh.points());
    std::string text = "| array | shape | meaning |\n|---|---|---|\n| coordinates | n, " + p +
                       ", 2 | x and y of the mesh points, in the unit of the mesh |\n";
    for (std::size_t k = 0; k < table.first_parameter(); ++k)
        text += "| " + table.numbers()[k] + " | n | the column of `designs.csv` |\n";
    text += "| variables | n, " + std::to_string(table.shown_parameters().size()) +
            " | the parameters, in the order of the columns of `designs.csv` |\n"
            "| control_points | n, c, 2 | x and y of the control points of the moved curves |\n"
            "| design | n | the number of the design, from 1 |\n"
            "| split | n | 0: train, 1: test, 2: out of range |\n"
            "| valid | n | 1: no cell is inverted and the boundary does not cross itself |\n"
            "| cell_start, cell_points | " +
            std::to_string(mesh.cells() + 1) +
            "; all | cells as compressed rows of points, counted from 0; the same for all |\n"
            "| face_points, face_markers | f, 2; f | boundary faces and their markers: ";
    for (std::size_t k = 0; k < mesh.markers.size(); ++k)
        text += (k == 0 ? "" : ", ") + std::to_string(k) + " " + mesh.markers[k];
    text += " |\n";
    if (walls == nullptr) return text;
    return text +
           "| wall_points, wall_start | w; pieces + 1 | points of the moving walls in order, piece "
           "by piece |\n"
           "| wall_normals | n, w, 2 | unit normals at these points, into the mesh |\n"
           "| wall_arc_length | n, w | arc length from the first point of the piece |\n"
           "| wall_distance | n, " +
           p + " | in `*.distance.npz` (--wall-distance): distances to the nearest moving wall |\n";
}

}  // namespace cli
