// PLOT3D grids (https://www.grc.nasa.gov/www/wind/valid/plot3d.html): one block or many, two
// dimensions or one cell thick (between planes of any direction, or in a wedge), in text, in
// binary, or in unformatted records of Fortran; plot3d_layout finds out which.
//
// Points on the sides of blocks with equal coordinates (within 1e-12 of the largest coordinate) are
// one point of the mesh. Thus interfaces between blocks and cuts are closed, and cells at a pole
// become triangles. The remaining sides are the boundary, with the names in a .nmf file beside the
// grid, or else BLOCK:SIDE, such as 1:jmin.
// Numbers with a repeat count, as 3*1.0, are expanded when the file is read, and remain expanded in
// the morphed file.
#include "basics/numbers.hpp"
#include "files/paths.hpp"
#include "files/text_file.hpp"
#include "formats/format.hpp"
#include "formats/number_reader.hpp"
#include "formats/plot3d_layout.hpp"
#include "mesh/one_cell_thick.hpp"
#include "mesh/tidy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace cli {

namespace {

// Neutral map files (https://geolab.larc.nasa.gov/Volume/Doc/nmf.htm): the boundary
// conditions of parts of the sides of blocks.

struct NmfPatch {
    std::string name;                       // the type of the boundary condition
    std::size_t block;                      // from 0
    int direction;                          // 0, 1, 2: a side i, j or k = constant
    bool at_end;                            // at the last index, and not at the first
    std::array<std::int64_t, 3> low, high;  // points of the patch, from 0, both ends included
};

// Reads the patches, except for sides between blocks (ONE_TO_ONE). Refuses, with the line, blocks
// of other sizes.
std::vector<NmfPatch> read_nmf(const std::string& path,
                               const std::vector<std::array<std::int64_t, 3>>& sizes);

// The two directions along a side, in the order of the file.
struct FaceSide {
    int direction, first, second;
};
constexpr FaceSide face_sides[] = {
    {2, 0, 1}, {0, 1, 2}, {1, 2, 0}};  // faces 1 and 2: k; 3 and 4: i; 5 and 6: j

std::vector<NmfPatch> read_nmf(const std::string& path,
                               const std::vector<std::array<std::int64_t, 3>>& sizes) {
    const TextFile file(path);
    LineReader lines(file, '#');
    const auto number = [&lines](std::size_t at, std::int64_t low, std::int64_t high,
                                 const char* what) {
        std::int64_t value = 0;
        const auto& words = lines.words();
        const std::string wanted =
            std::string(what) + " between " + std::to_string(low) + " and " + std::to_string(high);
        if (at >= words.size()) lines.expected(wanted);
        if (!parse(words[at], value) || value < low || value > high)
            lines.expected(wanted, words[at]);
        return value;
    };
    const auto n_blocks = static_cast<std::int64_t>(sizes.size());
    if (!lines.next()) lines.expected("the number of blocks");
    number(0, n_blocks, n_blocks, "the number of blocks");
    for (const auto& size : sizes) {
        if (!lines.next()) lines.expected("a block and its sizes");
        for (std::size_t d = 0; d < 3; ++d)
            number(d + 1, size[d], size[d], "the size of the block");
    }
    std::vector<NmfPatch> patches;
    while (lines.next()) {
        NmfPatch patch = {};
        patch.name = lines.words()[0];
        patch.block = static_cast<std::size_t>(number(1, 1, n_blocks, "a block") - 1);
        const std::int64_t face = number(2, 1, 6, "a face");
        const FaceSide& side = face_sides[(face - 1) / 2];
        const auto& size = sizes[patch.block];
        patch.direction = side.direction;
        patch.at_end = face % 2 == 0;
        const auto across = static_cast<std::size_t>(side.direction);
        patch.low[across] = patch.high[across] = patch.at_end ? size[across] - 1 : 0;
        std::size_t at = 3;
        for (const int along : {side.first, side.second}) {
            const auto d = static_cast<std::size_t>(along);
            const std::int64_t a = number(at, 1, size[d], "an index") - 1,
                               b = number(at + 1, 1, size[d], "an index") - 1;
            patch.low[d] = std::min(a, b);
            patch.high[d] = std::max(a, b);
            at += 2;
        }
        std::string type = patch.name;
        std::transform(type.begin(), type.end(), type.begin(),
                       [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; });
        if (type != "ONE_TO_ONE" && type != "ONE-TO-ONE") patches.push_back(patch);
    }
    return patches;
}

// Finds points that are at one place, within a tolerance.

class Places {
public:
    using Place = std::array<double, 3>;

    // Places are equal if no coordinate differs by more than `tolerance`, which may be 0.
    explicit Places(double tolerance) : tolerance_(tolerance) {}

    // Returns the number of the first point at this place. If there is none, adds a point with this
    // number.
    std::int32_t find_or_add(const Place& place, std::int32_t number);

private:
    using Cube = std::array<std::int64_t, 3>;  // of a grid that is so coarse that equal places lie
                                               // in eight cubes at most
    struct CubeHash {
        std::size_t operator()(const Cube& cube) const;
    };
    struct Point {
        Place place;
        std::int32_t number;
    };

    bool is_same(const Place& a, const Place& b) const;
    Cube cube_of(const Place& place, double offset) const;

    double tolerance_;
    std::unordered_multimap<Cube, Point, CubeHash> points_;
};

std::int32_t Places::find_or_add(const Place& place, std::int32_t number) {
    const Cube first = cube_of(place, -tolerance_), last = cube_of(place, tolerance_);
    for (Cube cube = first; cube[0] <= last[0]; ++cube[0]) {
        for (cube[1] = first[1]; cube[1] <= last[1]; ++cube[1]) {
            for (cube[2] = first[2]; cube[2] <= last[2]; ++cube[2]) {
                const auto range = points_.equal_range(cube);
                for (auto point = range.first; point != range.second; ++point) {
                    if (is_same(point->second.place, place)) return point->second.number;
                }
            }
        }
    }
    points_.emplace(cube_of(place, 0), Point{place, number});
    return number;
}

std::size_t Places::CubeHash::operator()(const Cube& cube) const {
    const auto mixed = [](std::int64_t value) {
        return static_cast<std::size_t>(value) * 0x9E3779B97F4A7C15u;
    };
    return mixed(cube[0]) ^ mixed(cube[1]) >> 7 ^ mixed(cube[2]) >> 13;
}

bool Places::is_same(const Place& a, const Place& b) const {
    for (std::size_t d = 0; d < 3; ++d) {
        if (!(std::fabs(a[d] - b[d]) <= tolerance_)) return false;
    }
    return true;
}

Places::Cube Places::cube_of(const Place& place, double offset) const {
    Cube cube = {0, 0, 0};
    for (std::size_t d = 0; d < 3 && tolerance_ > 0; ++d) {
        cube[d] = static_cast<std::int64_t>(std::floor((place[d] + offset) / (4 * tolerance_)));
    }
    return cube;
}

// Makes points, cells and sides of a mesh from the blocks of a PLOT3D grid.

// Points on both sides of a cut may differ by rounding errors of this size, relative to the largest
// coordinate.
constexpr double rounding_of_cuts = 1e-12;

class Plot3dReader {
public:
    Plot3dReader(Mesh& mesh, const Plot3dLayout& layout) : mesh_(mesh), layout_(layout) {}
    void read();

private:
    using Index3 = std::array<std::int64_t, 3>;

    void read_points();
    void join_points();
    int across(const Plot3dBlock& block) const;
    bool is_on_side(const Plot3dBlock& block, const Index3& index) const;
    std::int32_t point(std::size_t block, const Index3& index) const {
        const Plot3dBlock& grid = layout_.blocks[block];
        const auto number =
            first_[block] + index[0] + grid.n[0] * (index[1] + grid.n[1] * index[2]);
        return point_of_[static_cast<std::size_t>(number)];
    }
    std::vector<std::int32_t> corners(std::size_t block, const Index3& low, const Index3& high,
                                      int direction) const;
    void build_cells(std::size_t block);
    void build_sides(std::size_t block);
    void add_side(const NmfPatch& side);

    Mesh& mesh_;
    const Plot3dLayout& layout_;
    SpacePoints in_file_, points_;  // all points; points on sides at one place joined
    std::vector<SpaceCopy> copies_;
    std::vector<std::int64_t> first_;     // the number of the first point of each block in the file
    std::vector<std::int32_t> point_of_;  // for each point of the file: its point in points_
    std::unique_ptr<OneCellThick> solid_;  // empty for a grid of one plane
    std::vector<NmfPatch> patches_;
    std::int64_t blanked_ = 0;
};

std::string nmf_file(const std::string& mesh) { return without_ending(without_gz(mesh)) + ".nmf"; }

void Plot3dReader::read() {
    read_points();
    const std::string map = nmf_file(mesh_.file.path());
    if (exists(map)) {
        std::vector<Index3> sizes;
        for (const Plot3dBlock& block : layout_.blocks) sizes.push_back(block.n);
        patches_ = read_nmf(map, sizes);
    }
    join_points();
    const auto has_one_plane = [](const Plot3dBlock& block) {
        return std::count(block.n.begin(), block.n.end(), 1) > 0;
    };
    if (std::all_of(layout_.blocks.begin(), layout_.blocks.end(), has_one_plane)) {
        take_flat(mesh_, points_, copies_);
    } else {
        solid_ = std::make_unique<OneCellThick>(mesh_, std::move(points_));
        for (const SpaceCopy& copy : copies_) solid_->add_copy(copy);
    }
    for (std::size_t block = 0; block < layout_.blocks.size(); ++block) {
        build_cells(block);
        build_sides(block);
    }
    if (solid_) solid_->finish();
    drop_interior_faces(mesh_, false);
    drop_empty_markers(mesh_);
    if (blanked_ > 0) mesh_.remark_ignored("iblank, which is 0 at " + plural(blanked_, "point"));
}

void Plot3dReader::read_points() {
    NumberReader numbers(mesh_.file);
    numbers.is_binary = !layout_.is_text;
    numbers.swapped = mesh_.in_file.swapped = layout_.swapped;
    if (!layout_.is_text)
        mesh_.in_file.kind = layout_.real_bytes == 8 ? NumberKind::real64 : NumberKind::real32;
    numbers.jump(layout_.data);
    std::int64_t total = 0;
    for (const Plot3dBlock& block : layout_.blocks) total += block.points();
    if (total > INT32_MAX) mesh_.file.fail(0, "the grid has more than 2147483647 points");
    const auto dimensions = static_cast<std::size_t>(layout_.dimensions);
    for (std::size_t d = 0; d < 3; ++d) {
        in_file_.x[d].reserve(static_cast<std::size_t>(total));
        in_file_.offset[d].reserve(static_cast<std::size_t>(total));
    }
    for (const Plot3dBlock& block : layout_.blocks) {
        first_.push_back(in_file_.points());
        if (!layout_.is_text) numbers.jump(block.data);
        for (std::size_t d = 0; d < dimensions; ++d) {
            for (std::int64_t i = 0; i < block.points(); ++i) {
                in_file_.x[d].push_back(numbers.real("a coordinate", layout_.real_bytes));
                in_file_.offset[d].push_back(numbers.number_offset());
            }
        }
        for (std::size_t d = dimensions; d < 3; ++d) {
            in_file_.x[d].resize(in_file_.x[0].size());
            in_file_.offset[d].resize(in_file_.x[0].size());
        }
        for (std::int64_t i = 0; layout_.has_iblank && i < block.points(); ++i) {
            if (numbers.whole("an iblank") == 0) ++blanked_;
        }
    }
}

// Returns the direction across a block, from one plane to the other: the direction with two points,
// or with one point if the block is one plane. Returns -1 if no or several directions have two
// points; the direction then follows from the whole mesh.
int Plot3dReader::across(const Plot3dBlock& block) const {
    for (const int d : {2, 1, 0}) {
        if (block.n[static_cast<std::size_t>(d)] == 1) return d;
    }
    const auto found = std::find(block.n.begin(), block.n.end(), 2);
    if (std::count(block.n.begin(), block.n.end(), 2) != 1) return -1;
    return static_cast<int>(found - block.n.begin());
}

bool Plot3dReader::is_on_side(const Plot3dBlock& block, const Index3& index) const {
    const int except = across(block);
    for (int direction = 0; direction < 3; ++direction) {
        const auto d = static_cast<std::size_t>(direction);
        if (direction != except && (index[d] == 0 || index[d] + 1 == block.n[d])) return true;
    }
    return false;
}

// Joins points on the sides of blocks that are at one place.
void Plot3dReader::join_points() {
    double largest = 0;
    for (const auto& values : in_file_.x) {
        for (const double value : values) largest = std::max(largest, std::fabs(value));
    }
    Places on_sides(rounding_of_cuts * largest);
    point_of_.reserve(in_file_.x[0].size());
    points_.number.reserve(in_file_.x[0].size());
    points_.n_in_file = in_file_.points();
    for (std::size_t d = 0; d < 3; ++d) {
        points_.x[d].reserve(in_file_.x[0].size());
        points_.offset[d].reserve(in_file_.x[0].size());
    }
    for (const Plot3dBlock& block : layout_.blocks) {
        Index3 index = {0, 0, 0};
        for (index[2] = 0; index[2] < block.n[2]; ++index[2]) {
            for (index[1] = 0; index[1] < block.n[1]; ++index[1]) {
                for (index[0] = 0; index[0] < block.n[0]; ++index[0]) {
                    const std::size_t k = point_of_.size();
                    SpaceCopy copy = {points_.points(), {}, {}, static_cast<std::int32_t>(k)};
                    for (std::size_t d = 0; d < 3; ++d) {
                        copy.x[d] = in_file_.x[d][k];
                        copy.offset[d] = in_file_.offset[d][k];
                    }
                    if (is_on_side(block, index))
                        copy.original = on_sides.find_or_add(copy.x, copy.original);
                    point_of_.push_back(copy.original);
                    if (copy.original < points_.points()) {
                        copies_.push_back(copy);
                        continue;
                    }
                    points_.number.push_back(copy.number);
                    for (std::size_t d = 0; d < 3; ++d) {
                        points_.x[d].push_back(copy.x[d]);
                        points_.offset[d].push_back(copy.offset[d]);
                    }
                }
            }
        }
    }
    in_file_ = {};
}

// Returns the points round a cell, or the ends of a side of a cell, in the plane across
// `direction`. Each point is in the list once.
std::vector<std::int32_t> Plot3dReader::corners(std::size_t block, const Index3& low,
                                                const Index3& high, int direction) const {
    const auto u = static_cast<std::size_t>(direction == 0 ? 1 : 0),
               v = static_cast<std::size_t>(direction == 2 ? 1 : 2);
    std::vector<std::int32_t> found;
    for (const auto& corner :
         {std::array<bool, 2>{false, false}, {true, false}, {true, true}, {false, true}}) {
        Index3 index = low;
        index[u] = corner[0] ? high[u] : low[u];
        index[v] = corner[1] ? high[v] : low[v];
        const std::int32_t corner_point = point(block, index);
        if (std::find(found.begin(), found.end(), corner_point) == found.end())
            found.push_back(corner_point);
    }
    return found;
}

void Plot3dReader::build_cells(std::size_t block) {
    const Plot3dBlock& grid = layout_.blocks[block];
    const int flat = solid_ ? -1 : across(grid);
    if (solid_ && std::count(grid.n.begin(), grid.n.end(), 2) == 0) {
        const auto& offset = solid_->points().offset[0];
        mesh_.file.fail(offset[static_cast<std::size_t>(point(block, {0, 0, 0}))],
                        "the mesh has three dimensions and is not one cell thick: block " +
                            std::to_string(block + 1) + " (" + std::to_string(grid.n[0]) + " x " +
                            std::to_string(grid.n[1]) + " x " + std::to_string(grid.n[2]) +
                            ") has no direction of two points");
    }
    const auto cells_along = [&](std::size_t d) {
        return static_cast<int>(d) == flat ? 1 : grid.n[d] - 1;
    };
    Index3 low = {0, 0, 0};
    for (low[2] = 0; low[2] < cells_along(2); ++low[2]) {
        for (low[1] = 0; low[1] < cells_along(1); ++low[1]) {
            for (low[0] = 0; low[0] < cells_along(0); ++low[0]) {
                Index3 high = low;
                for (std::size_t d = 0; d < 3; ++d) high[d] += static_cast<int>(d) == flat ? 0 : 1;
                if (!solid_) {
                    const std::vector<std::int32_t> cell = corners(block, low, high, flat);
                    if (cell.size() >= 3)
                        mesh_.add_cell(cell, mesh_.point_offset[static_cast<std::size_t>(cell[0])]);
                    continue;
                }
                std::array<std::int32_t, 8> cell;
                for (std::size_t c = 0; c < 8;
                     ++c) {  // round the lower side, then round the upper side
                    const bool i = c % 4 == 1 || c % 4 == 2, j = c % 4 >= 2, k = c >= 4;
                    cell[c] = point(
                        block, {i ? high[0] : low[0], j ? high[1] : low[1], k ? high[2] : low[2]});
                }
                solid_->add_cell(cell.data(), 8,
                                 solid_->points().offset[0][static_cast<std::size_t>(cell[0])]);
            }
        }
    }
}

// Adds the faces of all sides. A face has the name of the patch that it is in, or else that of the
// side.
void Plot3dReader::build_sides(std::size_t block) {
    const Plot3dBlock& grid = layout_.blocks[block];
    for (int direction = 0; direction < 3; ++direction) {
        if (direction == across(grid)) continue;
        const std::size_t d = static_cast<std::size_t>(direction), u = d == 0 ? 1 : 0,
                          v = d == 2 ? 1 : 2;
        for (const bool at_end : {false, true}) {
            const std::string name =
                std::to_string(block + 1) + ":" + "ijk"[direction] + (at_end ? "max" : "min");
            for (std::int64_t i = 0; i < std::max<std::int64_t>(grid.n[u] - 1, 1); ++i) {
                for (std::int64_t j = 0; j < std::max<std::int64_t>(grid.n[v] - 1, 1); ++j) {
                    NmfPatch face = {name, block, direction, at_end, {0, 0, 0}, {0, 0, 0}};
                    face.low[d] = face.high[d] = at_end ? grid.n[d] - 1 : 0;
                    face.low[u] = i;
                    face.low[v] = j;
                    face.high[u] = std::min(i + 1, grid.n[u] - 1);
                    face.high[v] = std::min(j + 1, grid.n[v] - 1);
                    for (const NmfPatch& patch : patches_) {
                        if (patch.block == block && patch.direction == direction &&
                            patch.at_end == at_end && patch.low[u] <= face.low[u] &&
                            face.high[u] <= patch.high[u] && patch.low[v] <= face.low[v] &&
                            face.high[v] <= patch.high[v]) {
                            face.name = patch.name;
                        }
                    }
                    add_side(face);
                }
            }
        }
    }
}

void Plot3dReader::add_side(const NmfPatch& side) {
    const std::vector<std::int32_t> ends = corners(side.block, side.low, side.high, side.direction);
    if (ends.size() < (solid_ ? 3 : 2)) return;  // the side is a pole
    const auto first = static_cast<std::size_t>(ends[0]);
    if (solid_) {
        solid_->add_side(ends.data(), ends.size(), mesh_.add_marker(side.name),
                         solid_->points().offset[0][first]);
    } else {
        mesh_.add_face(ends[0], ends[1], mesh_.add_marker(side.name), mesh_.point_offset[first]);
    }
}

// mesh.file is the grid, in this layout.
void read_plot3d_blocks(Mesh& mesh, const Plot3dLayout& layout) {
    Plot3dReader(mesh, layout).read();
}

// Repeat counts of list-directed output of Fortran, such as 3*1.0 for 1.0 1.0 1.0.

constexpr std::size_t max_value_length = 64;  // characters of a number
constexpr std::int64_t max_per_word = 8,
                       max_of_few = 1000;  // numbers; at a pole all coordinates are repeated

std::int64_t count_words(std::string_view text) {
    std::int64_t words = 0;
    bool in_word = false;
    for (const char c : text) {
        const bool is_part = blanks.find(c) == blanks.npos && c != ',';
        words += is_part && !in_word ? 1 : 0;
        in_word = is_part;
    }
    return words;
}

bool is_part_of_number(char c) {
    return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.' || c == 'e' || c == 'E' ||
           c == 'd' || c == 'D';
}

// Returns false if the file has no repeat count. Otherwise `expanded` is the text with every number
// written out, in the same line. Refuses counts that no grid has: along one direction of a block,
// one coordinate at least changes from point to point, so a file has no more than four numbers
// (three coordinates and iblank) for each that is written.
bool expand_repeats(const TextFile& file, std::string& expanded) {
    const std::string_view text = file.text();
    if (std::memchr(text.data(), '*', text.size()) == nullptr) return false;
    if (std::memchr(text.data(), '\0', text.size()) != nullptr) return false;  // binary
    expanded.clear();
    std::size_t copied = 0;
    bool any = false;
    std::int64_t left = max_per_word * count_words(text) + max_of_few;
    for (std::size_t star = text.find('*'); star != std::string::npos;
         star = text.find('*', star + 1)) {
        std::size_t begin = star, end = star + 1;
        while (begin > copied && text[begin - 1] >= '0' && text[begin - 1] <= '9') --begin;
        while (end < text.size() && is_part_of_number(text[end])) ++end;
        std::int64_t count = 0;
        const std::string_view value = std::string_view(text).substr(star + 1, end - star - 1);
        const bool is_value = !value.empty() && value.size() <= max_value_length;
        if (!is_value || !parse(std::string_view(text).substr(begin, star - begin), count) ||
            count < 1)
            continue;
        if (count > left) {
            file.fail(begin, "the repeat count " + std::to_string(count) +
                                 " is larger than any in a grid with so few numbers");
        }
        left -= count;
        expanded.append(text, copied, begin - copied);
        for (std::int64_t i = 0; i < count; ++i) expanded.append(i == 0 ? "" : " ").append(value);
        copied = end;
        any = true;
    }
    expanded.append(text, copied, std::string::npos);
    return any;
}

bool begins_with_number(const TextFile& file) {
    const std::string_view text = trimmed(file.text().substr(0, 256));
    return !text.empty() &&
           text.find_first_not_of("0123456789+-.eEdD*, \t\r\n") == std::string_view::npos;
}

bool has_usual_extension(const std::string& path) {
    const std::string extension = ending_of(path);
    for (const char* usual : {".p3d", ".p2d", ".xyz", ".x", ".grd", ".p3dfmt", ".p2dfmt", ".ufmt",
                              ".fmt", ".g", ".gu"}) {
        if (extension == usual) return true;
    }
    return false;
}

// A file that is cut off fits no layout, but its records or its name may still identify it.
bool probe_plot3d(const TextFile& file) {
    Plot3dLayout layout;
    std::string reason, expanded;
    if (find_plot3d_layout(file, layout, reason)) return true;
    if (begins_with_number(file) && expand_repeats(file, expanded)) {
        return find_plot3d_layout(TextFile(file.path(), expanded), layout, reason) ||
               has_usual_extension(file.path());
    }
    return (!reason.empty() && !begins_with_number(file)) || has_usual_extension(file.path());
}

void read_plot3d(Mesh& mesh, const ReadOptions&) {
    Plot3dLayout layout;
    std::string reason, expanded;
    if (expand_repeats(mesh.file, expanded)) {
        mesh.file = TextFile(mesh.file.path(), std::move(expanded));
        mesh.remark("repeat counts, as 3*1.0, are written out as single numbers");
    }
    if (!find_plot3d_layout(mesh.file, layout, reason)) {
        mesh.file.fail(mesh.file.text().size(),
                       "no layout of PLOT3D fits the file" + (reason.empty() ? "" : ": " + reason));
    }
    read_plot3d_blocks(mesh, layout);
}

}  // namespace

const Format plot3d_format = {
    "plot3d",     ".p3d",      "PLOT3D, 2D or one cell thick: text, binary, Fortran unformatted",
    probe_plot3d, read_plot3d, nullptr,
    true,         "",          nmf_file};

}  // namespace cli
