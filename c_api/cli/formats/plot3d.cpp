// PLOT3D grids (https://www.grc.nasa.gov/www/wind/valid/plot3d.html): one block or many, two dimensions or one cell
// thick, in text, in binary, or of Fortran's unformatted records; plot3d_layout finds out which.
//
// Points of blocks' sides at the same coordinates (to 1e-12 of the largest) are one point of the mesh, so that
// interfaces and cuts close and cells at a pole become triangles. What is left of the sides is boundary: of the names
// in a .nmf file beside the grid, else BLOCK:SIDE, as 1:jmin. Numbers with a repeat count, 3*1.0, are written out when the
// file is read: the morphed file has them one by one.
#include "formats/format.hpp"

#include "formats/bytes.hpp"
#include "formats/nmf.hpp"
#include "formats/number_reader.hpp"
#include "formats/plot3d_layout.hpp"
#include "formats/repeats.hpp"
#include "formats/tidy.hpp"
#include "numbers.hpp"
#include "one_cell_thick.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unordered_map>

namespace cli {

namespace {

constexpr double rounding = 1e-12; // of the largest coordinate: generators compute both sides of a cut

class Plot3dReader {
public:
    Plot3dReader(Mesh& mesh, const Plot3dLayout& layout) : mesh_(mesh), layout_(layout) {}
    void read();

private:
    using Index3 = std::array<std::int64_t, 3>;
    using Square = std::pair<std::int64_t, std::int64_t>; // of a fine grid, in which points of sides are looked up
    struct SquareHash {
        std::size_t operator()(const Square& square) const {
            return static_cast<std::size_t>(square.first) * 0x9E3779B97F4A7C15u +
                   static_cast<std::size_t>(square.second);
        }
    };

    void read_points();
    void read_block(const Plot3dBlock& block, NumberReader& numbers);
    int direction_across(std::size_t block) const;
    std::int64_t number(const Plot3dBlock& block, const Index3& index) const {
        return index[0] + block.n[0] * (index[1] + block.n[1] * index[2]);
    }
    std::int32_t point_on_side(double x, double y);
    void build_block(std::size_t block);
    void build_cells(std::size_t block, int across);
    void build_sides(std::size_t block, int across);
    void add_patch(const NmfPatch& patch, int across);
    std::int32_t plane_point(std::size_t block, const Index3& index, int across) const;

    Mesh& mesh_;
    const Plot3dLayout& layout_;
    SpacePoints space_;
    Planes planes_ = {2, 0, 1, {}};
    std::vector<std::int64_t> first_;       // point of each block in space_
    std::vector<std::int32_t> point_of_;    // the mesh's, of those in space_; -1: none
    std::vector<NmfPatch> patches_;
    std::unordered_multimap<Square, std::int32_t, SquareHash> on_sides_;
    double same_place_ = 0; // coordinates that differ by no more are equal
    std::int64_t blanked_ = 0;
};

void Plot3dReader::read() {
    read_points();
    if (layout_.dimensions == 3) planes_ = find_planes(mesh_, space_);
    const std::filesystem::path map = std::filesystem::path(mesh_.file.path()).replace_extension(".nmf");
    if (std::filesystem::exists(map)) {
        std::vector<Index3> sizes;
        for (const Plot3dBlock& block : layout_.blocks) sizes.push_back(block.n);
        patches_ = read_nmf(map.string(), sizes);
    }
    double largest = 0;
    for (const auto& values : space_.x) {
        for (const double value : values) largest = std::max(largest, std::fabs(value));
    }
    same_place_ = rounding * largest;
    point_of_.assign(space_.x[0].size(), -1);
    for (std::size_t block = 0; block < layout_.blocks.size(); ++block) build_block(block);
    drop_interior_faces(mesh_, false);
    drop_empty_markers(mesh_);
    if (blanked_ > 0) mesh_.remark(plural(blanked_, "point") + " with iblank 0: iblank is ignored (and kept)");
}

void Plot3dReader::read_points() {
    NumberReader numbers(mesh_.file);
    numbers.is_binary = !layout_.is_text;
    numbers.swapped = mesh_.in_file.swapped = layout_.swapped;
    if (!layout_.is_text) mesh_.in_file.kind = layout_.real_bytes == 8 ? NumberKind::real64 : NumberKind::real32;
    numbers.jump(layout_.data);
    for (const Plot3dBlock& block : layout_.blocks) {
        first_.push_back(static_cast<std::int64_t>(space_.x[0].size()));
        if (!layout_.is_text) numbers.jump(block.data);
        read_block(block, numbers);
        if (space_.x[0].size() > INT32_MAX) mesh_.file.fail(0, "more than 2147483647 points");
    }
}

void Plot3dReader::read_block(const Plot3dBlock& block, NumberReader& numbers) {
    for (std::size_t d = 0; d < static_cast<std::size_t>(layout_.dimensions); ++d) {
        for (std::int64_t i = 0; i < block.points(); ++i) {
            space_.x[d].push_back(numbers.real("a coordinate", layout_.real_bytes));
            space_.offset[d].push_back(numbers.number_offset());
        }
    }
    if (layout_.dimensions == 2) space_.x[2].resize(space_.x[0].size());
    for (std::int64_t i = 0; layout_.has_iblank && i < block.points(); ++i) {
        if (numbers.whole("an iblank") == 0) ++blanked_;
    }
}

// Of a block one cell thick: the direction from one plane to the other.
int Plot3dReader::direction_across(std::size_t block) const {
    if (layout_.dimensions == 2) return 2;
    const Plot3dBlock& its = layout_.blocks[block];
    const auto upper = [&](const Index3& index) {
        return planes_.upper[static_cast<std::size_t>(first_[block] + number(its, index))];
    };
    for (const int d : {2, 1, 0}) {
        Index3 next = {0, 0, 0};
        next[static_cast<std::size_t>(d)] = 1;
        if (its.n[static_cast<std::size_t>(d)] == 2 && upper(next) != upper({0, 0, 0})) return d;
    }
    mesh_.file.fail(space_.offset[0][static_cast<std::size_t>(first_[block])],
                    "block " + std::to_string(block + 1) + " (" + std::to_string(its.n[0]) + " x " +
                        std::to_string(its.n[1]) + " x " + std::to_string(its.n[2]) + ") is not one cell thick");
}

std::int32_t Plot3dReader::plane_point(std::size_t block, const Index3& index, int across) const {
    Index3 in_plane = index;
    in_plane[static_cast<std::size_t>(across)] = 0;
    return point_of_[static_cast<std::size_t>(first_[block] + number(layout_.blocks[block], in_plane))];
}

// The mesh's point at this place; if there is none, the number that it is going to have.
std::int32_t Plot3dReader::point_on_side(double x, double y) {
    const double size = 4 * same_place_; // of a square: a point has neighbours in its own and at most three more
    const auto square = [size](double at) { return size > 0 ? static_cast<std::int64_t>(std::floor(at / size)) : 0; };
    for (std::int64_t i = square(x - same_place_); i <= square(x + same_place_); ++i) {
        for (std::int64_t j = square(y - same_place_); j <= square(y + same_place_); ++j) {
            const auto range = on_sides_.equal_range({i, j});
            for (auto other = range.first; other != range.second; ++other) {
                const auto point = static_cast<std::size_t>(other->second);
                if (std::fabs(mesh_.x[point] - x) <= same_place_ && std::fabs(mesh_.y[point] - y) <= same_place_) {
                    return other->second;
                }
            }
        }
    }
    on_sides_.emplace(Square(square(x), square(y)), mesh_.points());
    return mesh_.points();
}

void Plot3dReader::build_block(std::size_t block) {
    const Plot3dBlock& its = layout_.blocks[block];
    const int across = direction_across(block);
    const std::size_t a = static_cast<std::size_t>(across), p = a == 0 ? 1 : 0, q = a == 2 ? 1 : 2;
    Index3 index = {0, 0, 0};
    for (index[q] = 0; index[q] < its.n[q]; ++index[q]) {
        for (index[p] = 0; index[p] < its.n[p]; ++index[p]) {
            const auto here = static_cast<std::int32_t>(first_[block] + number(its, index));
            Index3 opposite = index;
            opposite[a] = 1;
            const auto partner = its.n[a] < 2 ? -1 : static_cast<std::int32_t>(first_[block] + number(its, opposite));
            std::int32_t& point = point_of_[static_cast<std::size_t>(here)];
            point = mesh_.points();
            if (index[p] == 0 || index[q] == 0 || index[p] + 1 == its.n[p] || index[q] + 1 == its.n[q]) {
                point =
                    point_on_side(space_.x[static_cast<std::size_t>(planes_.first)][static_cast<std::size_t>(here)],
                                  space_.x[static_cast<std::size_t>(planes_.second)][static_cast<std::size_t>(here)]);
            }
            if (point == mesh_.points()) {
                add_plane_point(mesh_, space_, planes_, here, partner);
            } else {
                follow_both(mesh_, space_, planes_, point, here, partner);
            }
        }
    }
    build_cells(block, across);
    build_sides(block, across);
}

void Plot3dReader::build_cells(std::size_t block, int across) {
    const Plot3dBlock& its = layout_.blocks[block];
    const std::size_t a = static_cast<std::size_t>(across), p = a == 0 ? 1 : 0, q = a == 2 ? 1 : 2;
    std::vector<std::int32_t> cell;
    Index3 index = {0, 0, 0};
    for (std::int64_t j = 0; j + 1 < its.n[q]; ++j) {
        for (std::int64_t i = 0; i + 1 < its.n[p]; ++i) {
            cell.clear();
            for (const auto& corner : {std::array<std::int64_t, 2>{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
                index[p] = i + corner[0];
                index[q] = j + corner[1];
                const std::int32_t point = plane_point(block, index, across);
                if (cell.empty() || (point != cell.back() && point != cell.front())) cell.push_back(point);
            }
            if (cell.size() >= 3) mesh_.add_cell(cell, mesh_.point_offset[static_cast<std::size_t>(cell[0])]);
        }
    }
}

// The parts of sides that no patch names get the side's name.
void Plot3dReader::build_sides(std::size_t block, int across) {
    const Plot3dBlock& its = layout_.blocks[block];
    for (int direction = 0; direction < 3; ++direction) {
        if (direction == across) continue;
        for (const bool at_end : {false, true}) {
            NmfPatch whole = {std::to_string(block + 1) + ":" + "ijk"[direction] + (at_end ? "max" : "min"),
                              block,
                              direction,
                              at_end,
                              {0, 0, 0},
                              {its.n[0] - 1, its.n[1] - 1, its.n[2] - 1}};
            const auto d = static_cast<std::size_t>(direction);
            const auto along = static_cast<std::size_t>(3 - direction - across);
            whole.low[d] = whole.high[d] = at_end ? its.n[d] - 1 : 0;
            std::vector<NmfPatch> parts; // one for each edge, with the name of a patch that has it
            for (std::int64_t i = 0; i + 1 < its.n[along]; ++i) {
                NmfPatch part = whole;
                part.low[along] = i;
                part.high[along] = i + 1;
                for (const NmfPatch& patch : patches_) {
                    if (patch.block == block && patch.direction == direction && patch.at_end == at_end &&
                        patch.low[along] <= i && i + 1 <= patch.high[along]) {
                        part.name = patch.name;
                    }
                }
                add_patch(part, across);
            }
        }
    }
}

void Plot3dReader::add_patch(const NmfPatch& patch, int across) {
    const std::int32_t a = plane_point(patch.block, patch.low, across),
                       b = plane_point(patch.block, patch.high, across);
    if (a == b) return; // a pole
    mesh_.add_face(a, b, mesh_.add_marker(patch.name), mesh_.point_offset[static_cast<std::size_t>(a)]);
}

bool begins_with_number(const TextFile& file) {
    const std::string_view text = trimmed(std::string_view(file.text()).substr(0, 256));
    return !text.empty() && text.find_first_not_of("0123456789+-.eEdD*, \t\r\n") == std::string_view::npos;
}

bool has_usual_extension(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    for (const char* usual :
         {".p3d", ".p2d", ".xyz", ".x", ".grd", ".p3dfmt", ".p2dfmt", ".ufmt", ".fmt", ".g", ".gu"}) {
        if (extension == usual) return true;
    }
    return false;
}

// A file that is cut off fits no layout, but its records or its name may still say what it should be.
bool probe(const TextFile& file) {
    Plot3dLayout layout;
    std::string reason, expanded;
    if (find_plot3d_layout(file, layout, reason)) return true;
    if (begins_with_number(file) && expand_repeats(file.text(), expanded)) {
        return find_plot3d_layout(TextFile(file.path(), expanded), layout, reason) || has_usual_extension(file.path());
    }
    return (!reason.empty() && !begins_with_number(file)) || has_usual_extension(file.path());
}

void read(Mesh& mesh, const ReadOptions&) {
    Plot3dLayout layout;
    std::string reason, expanded;
    if (expand_repeats(mesh.file.text(), expanded)) {
        mesh.file = TextFile(mesh.file.path(), std::move(expanded));
        mesh.remark("repeat counts, as 3*1.0, are written out");
    }
    if (!find_plot3d_layout(mesh.file, layout, reason)) {
        mesh.file.fail(mesh.file.text().size(),
                       "no layout of PLOT3D fits the file" + (reason.empty() ? "" : ": " + reason));
    }
    Plot3dReader(mesh, layout).read();
}

} // namespace

const Format plot3d_format = {"plot3d", ".p3d", "PLOT3D, 2D or one cell thick: text, binary, Fortran unformatted",
                              probe,    read,   nullptr};

} // namespace cli
