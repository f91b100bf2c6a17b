// Sections of a Fluent file (NUMBER (HEAD) (BODY)): 2 the dimension, 10 nodes, 13 faces, 45 and 39
// names of zones. Other sections stay as they are: cells are known from the faces. Whole numbers
// are hexadecimal, except the numbers of sections, the dimension, and the zones in 45 and 39.
#include "formats/fluent_read.hpp"

#include "basics/numbers.hpp"
#include "formats/bytes.hpp"
#include "formats/fluent_sections.hpp"
#include "formats/number_reader.hpp"

#include <algorithm>
#include <charconv>

namespace cli {

namespace {

enum SectionType {
    dimension_section = 2,
    node_section = 10,
    face_section = 13,
    old_name_section = 39,
    name_section = 45,
    cell_tree_section = 58,
    face_tree_section = 59
};
enum ZoneType { no_type = 0, interior = 2 };
// In sections of these types, each face begins with the number of its nodes. Another type is itself
// the number of nodes of each face.
enum FaceType { mixed = 0, polygonal = 5 };

class FluentReader {
public:
    explicit FluentReader(Mesh& mesh) : mesh_(mesh), numbers_(mesh.file), sections_(mesh.file) {}

    FluentContent read() {
        while (sections_.next()) {
            section_ = sections_.section();
            read_section();
        }
        check();
        return std::move(content_);
    }

private:
    void read_section();
    void begin_body();
    void read_dimension();
    void read_nodes();
    void read_faces();
    void read_face(std::int64_t n_nodes, FluentFace face);
    void read_name();
    void end_body(const std::string& items);
    void check();
    std::int64_t hexadecimal(const char* what);
    std::int64_t hexadecimal(const char* what, std::int64_t low, std::int64_t high);
    [[noreturn]] void lacks(const std::string& what) const;

    Mesh& mesh_;
    NumberReader numbers_;
    FluentSections sections_;
    FluentSection section_;  // the section that is being read
    FluentContent content_;
};

void FluentReader::read_section() {
    numbers_.is_binary = false;
    numbers_.jump(section_.head);
    numbers_.stop_at(section_.head_end);
    const bool is_binary = section_.number >= first_binary_section;
    switch (is_binary ? section_.number % 1000 : section_.number) {
        case dimension_section: return read_dimension();
        case node_section: return read_nodes();
        case face_section: return read_faces();
        case old_name_section:
        case name_section: return read_name();
        case cell_tree_section:
        case face_tree_section:
            mesh_.file.fail(section_.begin,
                            "the mesh has hanging nodes from adaption, which are not read; save "
                            "the mesh before adaption, or convert the mesh to polyhedra");
        default: break;
    }
}

void FluentReader::read_dimension() {
    const std::int64_t dimension = numbers_.whole("the dimension, 2 or 3");
    if (dimension != 2 && dimension != 3) numbers_.expected("the dimension, 2 or 3");
    if (!content_.nodes.empty() || !content_.faces.empty()) {
        mesh_.file.fail(section_.begin,
                        "the dimension must come before nodes and faces; save the mesh again");
    }
    content_.dimension = static_cast<int>(dimension);
}

// Goes from the head to the numbers of a section. Binary numbers are little-endian.
void FluentReader::begin_body() {
    numbers_.jump(section_.body);
    numbers_.stop_at(section_.body_end);
    numbers_.is_binary = section_.number >= first_binary_section;
    numbers_.swapped = mesh_.in_file.swapped = !little_endian_machine();
}

void FluentReader::end_body(const std::string& items) {
    if (numbers_.is_binary || numbers_.at_end()) return;
    mesh_.file.fail(numbers_.offset(), "the section has more numbers than those of " + items);
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
    const std::int64_t value = hexadecimal(what);
    if (value >= low && value <= high) return value;
    numbers_.fail(std::string("the file needs ") + what + " between " + std::to_string(low) +
                  " and " + std::to_string(high) + " here, but " + std::to_string(value) +
                  " follows");
}

// The head has the zone, the first node, the last node, the type, and mostly the dimension. Zone 0
// states the number of all nodes.
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
    if (!content_.nodes.empty() && kind != mesh_.in_file.kind) {
        mesh_.file.fail(section_.begin,
                        "the sections of nodes have different number formats; save the mesh again");
    }
    mesh_.in_file.kind = kind;
    const int bytes = kind == NumberKind::real32 ? 4 : 8;
    const auto dimension = static_cast<std::size_t>(content_.dimension);
    for (std::int64_t number = first; number <= last; ++number) {
        FluentNode node = {number, {}, {}};
        for (std::size_t d = 0; d < dimension; ++d) {
            const char* const names[] = {"a node's x", "a node's y", "a node's z"};
            node.x[d] = numbers_.real(names[d], bytes);
            node.offset[d] = numbers_.number_offset();
        }
        content_.nodes.push_back(node);
    }
    end_body(plural(last - first + 1, "node"));
}

// The head has the zone, the first face, the last face, the type of the zone, and the type of the
// faces.
void FluentReader::read_faces() {
    const std::int64_t zone = hexadecimal("a zone");
    const std::int64_t first = hexadecimal("the first face", 0, INT32_MAX);
    const std::int64_t last = hexadecimal("the last face", 0, INT32_MAX);
    if (zone == 0) return;
    const std::int64_t type = hexadecimal("the type of a zone");
    const std::int64_t face_type = hexadecimal("the type of faces");
    if (section_.body == 0) mesh_.file.fail(section_.begin, "the section has no faces");
    begin_body();
    const bool is_flat = content_.dimension == 2;
    for (std::int64_t i = first; i <= last; ++i) {
        std::int64_t n_nodes = is_flat ? 2 : face_type;
        if (face_type == mixed || face_type == polygonal) {
            n_nodes = is_flat ? hexadecimal("2 nodes of a face", 2, 2)
                              : hexadecimal("the number of nodes of a face", 3, INT32_MAX);
        } else if (!is_flat && face_type != 3 && face_type != 4) {
            mesh_.file.fail(section_.begin, "the section has faces of the type " +
                                                std::to_string(face_type) +
                                                ", but a face of three dimensions has the type 0, "
                                                "3, 4 or 5");
        }
        read_face(n_nodes, {content_.face_nodes.size(), 0, {}, zone, type == interior, 0});
    }
    end_body(plural(last - first + 1, "face"));
}

void FluentReader::read_face(std::int64_t n_nodes, FluentFace face) {
    face.n = static_cast<std::int32_t>(n_nodes);
    for (std::int64_t k = 0; k < n_nodes; ++k) {
        const std::int64_t node = hexadecimal("a node of a face", 1, INT32_MAX);
        content_.face_nodes.push_back(static_cast<std::int32_t>(node) - 1);
        if (k == 0) face.offset = numbers_.number_offset();
    }
    for (std::int32_t& cell : face.cells) {
        const std::int64_t number = hexadecimal("a cell beside a face", 0, INT32_MAX);
        content_.n_cells = std::max(content_.n_cells, static_cast<std::int32_t>(number));
        cell = static_cast<std::int32_t>(number) - 1;
    }
    content_.faces.push_back(face);
}

// The head has the zone (decimal), the type and the name.
void FluentReader::read_name() {
    const std::int64_t zone = numbers_.whole("a zone");
    numbers_.word();
    const std::string_view name = numbers_.word();
    if (name.empty()) numbers_.expected("the name of a zone");
    content_.names.emplace(zone, name);
}

void FluentReader::lacks(const std::string& what) const {
    mesh_.file.fail(mesh_.file.text().size(),
                    "the file needs " + what + " here, but the end of the file follows");
}

// Sections of nodes may be in any order.
void FluentReader::check() {
    std::vector<FluentNode>& nodes = content_.nodes;
    if (nodes.empty()) lacks("a section (10 ...) with nodes");
    const auto before = [](const FluentNode& a, const FluentNode& b) {
        return a.number < b.number;
    };
    if (!std::is_sorted(nodes.begin(), nodes.end(), before))
        std::stable_sort(nodes.begin(), nodes.end(), before);
    std::int64_t expected = 0;
    for (const FluentNode& node : nodes) {
        if (node.number == ++expected) continue;
        mesh_.file.fail(node.offset[0], "the file needs node " + std::to_string(expected) +
                                            " here, but node " + std::to_string(node.number) +
                                            " follows");
    }
    const std::vector<FluentFace>& faces = content_.faces;
    if (faces.empty()) lacks("a section (13 ...) with faces");
    const auto n_faces = static_cast<std::int64_t>(faces.size());
    if (content_.n_cells > n_faces) {
        mesh_.file.fail(faces[0].offset, "faces name cells up to " +
                                             std::to_string(content_.n_cells) + ", but there are " +
                                             plural(n_faces, "face"));
    }
    const auto n_nodes = static_cast<std::int64_t>(nodes.size());
    for (const FluentFace& face : faces) {
        for (std::int32_t k = 0; k < face.n; ++k) {
            const std::int64_t node = content_.nodes_of(face)[k];
            if (node < n_nodes) continue;
            mesh_.file.fail(face.offset, "a face names node " + std::to_string(node + 1) +
                                             ", but there are " + plural(n_nodes, "node"));
        }
    }
}

}  // namespace

FluentContent read_fluent_content(Mesh& mesh) { return FluentReader(mesh).read(); }

}  // namespace cli
