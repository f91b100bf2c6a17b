// Fluent's mesh files, in text and with binary sections (appendix "Mesh File Format" of the Fluent
// User's Guide), two dimensions.
//
// The file is a list of sections (NUMBER (HEAD) (BODY)): 10 nodes, 12 cells, 13 faces, 45 and 39
// names of zones; others stay as they are. Cells are given by their faces: a face goes from a node
// to another and has a cell on its right and one on its left, or 0. Whole numbers are hexadecimal,
// except those of sections, dimensions and zones in 45 and 39. Markers are the zones of boundary
// faces, by name if they have one, else "zone:NUMBER".
#include "formats/format.hpp"

#include "formats/bytes.hpp"
#include "formats/fluent_sections.hpp"
#include "formats/number_reader.hpp"
#include "basics/numbers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>

namespace cli {

namespace {

enum SectionType {
    dimension_section = 2,
    node_section = 10,
    cell_section = 12,
    face_section = 13,
    old_name_section = 39,
    name_section = 45,
    cell_tree_section = 58,
    face_tree_section = 59
};
enum ZoneType { no_type = 0, interior = 2 };
enum FaceType { mixed = 0, polygonal = 5 };  // those that have the number of nodes before each face

class FluentReader {
public:
    explicit FluentReader(Mesh& mesh) : mesh_(mesh), numbers_(mesh.file), sections_(mesh.file) {}

    void read() {
        while (sections_.next()) {
            section_ = sections_.section();
            read_section();
        }
        add_points();
        add_cells();
        add_faces();
    }

private:
    struct Node {
        std::int64_t number;
        double x, y;
        std::size_t x_offset, y_offset;
    };
    struct Face {
        std::int32_t nodes[2], cells[2];  // from 0; no cell: -1
        std::int64_t zone;
        bool is_interior;  // by the type of its zone
        std::size_t offset;
    };

    void read_section();
    void begin_body();
    void read_nodes();
    void read_faces();
    void read_name();
    std::int64_t hexadecimal(const char* what);
    std::int64_t hexadecimal(const char* what, std::int64_t low, std::int64_t high);
    std::int64_t whole(const char* what, std::int64_t low, std::int64_t high,
                       std::int64_t value) const;

    [[noreturn]] void lacks(const std::string& what) const;
    void add_points();
    void add_cells();
    void add_faces();

    Mesh& mesh_;
    NumberReader numbers_;
    FluentSections sections_;
    FluentSection section_;  // the one that is read
    std::vector<Node> nodes_;
    std::vector<Face> faces_;
    std::int64_t largest_cell_ = 0;
    std::map<std::int64_t, std::string> names_;  // of zones
};

void FluentReader::read_section() {
    numbers_.is_binary = false;
    numbers_.jump(section_.head);
    numbers_.stop_at(section_.head_end);
    const bool is_binary = section_.number >= first_binary_section;
    switch (is_binary ? section_.number % 1000 : section_.number) {
        case dimension_section:
            if (numbers_.whole("2, of two dimensions") != 2) {
                numbers_.expected(
                    "2: meshes of two dimensions are read; export one of the planes of a mesh of "
                    "three, or "
                    "save it in another format");
            }
            return;
        case node_section: return read_nodes();
        case face_section: return read_faces();
        case old_name_section:
        case name_section: return read_name();
        case cell_tree_section:
        case face_tree_section:
            mesh_.file.fail(section_.begin,
                            "the mesh has hanging nodes (from refinement), which are not read");
        default: break;
    }
}

// From the head to the numbers of a section; binary numbers are little-endian.
void FluentReader::begin_body() {
    numbers_.jump(section_.body);
    numbers_.stop_at(section_.body_end);
    numbers_.is_binary = section_.number >= first_binary_section;
    numbers_.swapped = mesh_.in_file.swapped = !little_endian_machine();
}

std::int64_t FluentReader::whole(const char* what, std::int64_t low, std::int64_t high,
                                 std::int64_t value) const {
    if (value >= low && value <= high) return value;
    numbers_.fail(std::string("expected ") + what + " between " + std::to_string(low) + " and " +
                  std::to_string(high) + ", found " + std::to_string(value));
}

std::int64_t FluentReader::hexadecimal(const char* what) {
    if (numbers_.is_binary) return numbers_.whole(what);
    const std::string_view word = numbers_.word();
    std::int64_t value = 0;
    const auto [after, error] = std::from_chars(word.data(), word.data() + word.size(), value, 16);
    if (error != std::errc() || after != word.data() + word.size()) {
        numbers_.expected(std::string(what) + " (hexadecimal)");
    }
    return value;
}

std::int64_t FluentReader::hexadecimal(const char* what, std::int64_t low, std::int64_t high) {
    return whole(what, low, high, hexadecimal(what));
}

// Head: zone, first node, last node, type, and mostly the dimension. Zone 0 says how many there are
// in all.
void FluentReader::read_nodes() {
    const std::int64_t zone = hexadecimal("a zone");
    const std::int64_t first = hexadecimal("the first node", 0, INT32_MAX);
    const std::int64_t last = hexadecimal("the last node", 0, INT32_MAX);
    if (zone == 0) return;
    if (section_.body == 0)
        mesh_.file.fail(section_.begin, "the section has no coordinates of nodes");
    begin_body();
    const NumberKind kind = !numbers_.is_binary                       ? NumberKind::text
                            : section_.number >= first_double_section ? NumberKind::real64
                                                                      : NumberKind::real32;
    if (!nodes_.empty() && kind != mesh_.in_file.kind) {
        mesh_.file.fail(section_.begin,
                        "sections of nodes are stored in several ways: save the mesh anew");
    }
    mesh_.in_file.kind = kind;
    const int bytes = kind == NumberKind::real32 ? 4 : 8;
    for (std::int64_t number = first; number <= last; ++number) {
        Node node = {number, 0, 0, 0, 0};
        node.x = numbers_.real("a node's x", bytes);
        node.x_offset = numbers_.number_offset();
        node.y = numbers_.real("a node's y", bytes);
        node.y_offset = numbers_.number_offset();
        nodes_.push_back(node);
    }
    if (!numbers_.is_binary && !numbers_.at_end()) {
        const std::string nodes = plural(last - first + 1, "node");
        mesh_.file.fail(numbers_.offset(), "the section has more numbers than x and y of " + nodes);
    }
}

// Head: zone, first face, last face, type of the zone, type of the faces.
void FluentReader::read_faces() {
    const std::int64_t zone = hexadecimal("a zone");
    const std::int64_t first = hexadecimal("the first face", 0, INT32_MAX);
    const std::int64_t last = hexadecimal("the last face", 0, INT32_MAX);
    if (zone == 0) return;
    const std::int64_t type = hexadecimal("the type of a zone"),
                       face_type = hexadecimal("the type of faces");
    if (section_.body == 0) mesh_.file.fail(section_.begin, "the section has no faces");
    begin_body();
    for (std::int64_t i = first; i <= last; ++i) {
        Face face = {{}, {}, zone, type == interior, 0};
        if (face_type == mixed || face_type == polygonal) hexadecimal("2 nodes of a face", 2, 2);
        for (std::size_t k = 0; k < 2; ++k) {
            face.nodes[k] =
                static_cast<std::int32_t>(hexadecimal("a node of a face", 1, INT32_MAX)) - 1;
            if (k == 0) face.offset = numbers_.number_offset();
        }
        for (std::int32_t& cell : face.cells) {
            const std::int64_t number = hexadecimal("a cell beside a face", 0, INT32_MAX);
            largest_cell_ = std::max(largest_cell_, number);
            cell = static_cast<std::int32_t>(number) - 1;
        }
        faces_.push_back(face);
    }
    if (!numbers_.is_binary && !numbers_.at_end()) {
        mesh_.file.fail(numbers_.offset(),
                        "the section has more numbers than " + plural(last - first + 1, "face"));
    }
}

// Head: zone (decimal), type, name.
void FluentReader::read_name() {
    const std::int64_t zone = numbers_.whole("a zone");
    numbers_.word();
    const std::string_view name = numbers_.word();
    if (name.empty()) numbers_.expected("the name of a zone");
    names_.emplace(zone, name);
}

void FluentReader::lacks(const std::string& what) const {
    mesh_.file.fail(mesh_.file.text().size(), "expected " + what + ", found the end of the file");
}

// Sections of nodes may stand in any order.
void FluentReader::add_points() {
    if (nodes_.empty()) lacks("a section (10 ...) with nodes");
    const auto before = [](const Node& a, const Node& b) { return a.number < b.number; };
    if (!std::is_sorted(nodes_.begin(), nodes_.end(), before))
        std::stable_sort(nodes_.begin(), nodes_.end(), before);
    for (const Node& node : nodes_) {
        if (node.number != mesh_.points() + 1) {
            const std::string expected = std::to_string(mesh_.points() + 1),
                              found = std::to_string(node.number);
            mesh_.file.fail(node.x_offset, "expected node " + expected + ", found node " + found);
        }
        mesh_.add_point(node.x, node.y, node.x_offset, node.y_offset);
    }
}

// The points round a cell, in the direction of its first side; some sides may be written the other
// way round. Empty: the sides are none of one polygon. Sides are found by their ends in order, as a
// cell may have any number of them.
static std::vector<std::int32_t> polygon_of(const std::vector<std::array<std::int32_t, 2>>& sides) {
    std::vector<std::pair<std::int32_t, std::size_t>> ends;  // a point, and a side there
    for (std::size_t side = 0; side < sides.size(); ++side) {
        for (const std::int32_t point : sides[side]) ends.emplace_back(point, side);
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t k = 0; k < ends.size(); k += 2) {  // each point has two sides
        if (k + 1 >= ends.size() || ends[k].first != ends[k + 1].first) return {};
        if (k + 2 < ends.size() && ends[k].first == ends[k + 2].first) return {};
    }
    std::vector<std::int32_t> points;
    std::size_t side = 0;
    std::int32_t from = sides.empty() ? 0 : sides[0][0];
    do {
        points.push_back(from);
        const std::int32_t to = sides[side][0] == from ? sides[side][1] : sides[side][0];
        const auto at =
            std::lower_bound(ends.begin(), ends.end(), std::make_pair(to, std::size_t{0}));
        side = at[0].second == side ? at[1].second : at[0].second;
        from = to;
    } while (from != points[0] && points.size() <= sides.size());
    return points.size() == sides.size() ? points : std::vector<std::int32_t>();
}

// The faces of a cell, each with the cell on its left, one behind the other.
void FluentReader::add_cells() {
    struct Cell {
        std::vector<std::array<std::int32_t, 2>> sides;
        std::size_t offset;
    };
    const auto cell_name = [](std::size_t cell) { return "cell " + std::to_string(cell + 1); };
    if (faces_.empty()) lacks("a section (13 ...) with faces");
    const auto n_faces = static_cast<std::int64_t>(faces_.size());
    if (largest_cell_ > n_faces) {
        const std::string largest = std::to_string(largest_cell_), there = plural(n_faces, "face");
        mesh_.file.fail(faces_[0].offset,
                        "faces have cells up to " + largest + ", but there are " + there);
    }
    std::vector<Cell> list(static_cast<std::size_t>(largest_cell_), Cell{{}, faces_[0].offset});
    for (const Face& face : faces_) {
        for (std::size_t side = 0; side < 2; ++side) {
            if (face.cells[side] < 0) continue;
            const auto number = static_cast<std::size_t>(face.cells[side]);
            Cell& cell = list[number];
            if (cell.sides.empty()) cell.offset = face.offset;
            cell.sides.push_back({face.nodes[side == 0 ? 1 : 0], face.nodes[side == 0 ? 0 : 1]});
        }
    }
    for (std::size_t number = 0; number < list.size(); ++number) {
        const Cell& cell = list[number];
        const std::vector<std::int32_t> points = polygon_of(cell.sides);
        if (points.size() < 3) {
            const std::string its = plural(static_cast<std::int64_t>(cell.sides.size()), "face");
            mesh_.file.fail(cell.offset, "the faces of " + cell_name(number) + " (" + its +
                                             ") do not form a polygon");
        }
        mesh_.add_cell(points, cell.offset);
    }
    mesh_.find_polygons();
}

void FluentReader::add_faces() {
    for (const Face& face : faces_) {
        if (face.is_interior && face.cells[0] >= 0 && face.cells[1] >= 0) continue;
        const auto name = names_.find(face.zone);
        const std::int32_t marker = mesh_.add_marker(
            name == names_.end() ? "zone:" + std::to_string(face.zone) : name->second);
        mesh_.add_face(face.nodes[0], face.nodes[1], marker, face.offset);
    }
}

// A bracket, and the number of a section.
bool probe_fluent(const TextFile& file) {
    const std::string_view start = trimmed(std::string_view(file.text()).substr(0, 64));
    if (start.substr(0, 1) != "(") return false;
    const std::string_view number = trimmed(start.substr(1));
    return !number.empty() && number[0] >= '0' && number[0] <= '9';
}

void read_fluent(Mesh& mesh, const ReadOptions&) { FluentReader(mesh).read(); }

}  // namespace

const Format fluent_format = {"fluent",     ".msh",      "Fluent, text and binary, two dimensions",
                              probe_fluent, read_fluent, nullptr};

}  // namespace cli
