#include "sampling/sample_shard.hpp"

#include "basics/numbers.hpp"

namespace cli {

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
