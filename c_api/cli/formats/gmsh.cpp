// Gmsh's MSH files (https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format), versions 2.2 and 4.1, in text and binary.
//
// Markers are the physical groups of curves, by name if they have one; a curve without a group is "curve:TAG". Of
// quadratic elements the mesh has the corners; the other nodes are written with it: the middle of an edge keeps its
// distance from the straight edge, relative to the edge's length and direction; the middle of a cell moves by the mean
// of the corners.
#include "formats/format.hpp"

#include "formats/number_reader.hpp"
#include "formats/tidy.hpp"
#include "numbers.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <unordered_map>

namespace cli {

namespace {

struct ElementType {
    int number, dimension, corners, nodes;
};
constexpr ElementType element_types[] = {{15, 0, 1, 1}, {1, 1, 2, 2},  {8, 1, 2, 3},  {2, 2, 3, 3},
                                         {9, 2, 3, 6},  {3, 2, 4, 4},  {16, 2, 4, 8}, {10, 2, 4, 9}};
constexpr int first_solid = 4, last_solid = 7; // tetrahedron, hexahedron, prism, pyramid

class GmshReader {
public:
    explicit GmshReader(Mesh& mesh) : mesh_(mesh), numbers_(mesh.file) {}
    void read();

private:
    struct Node {
        std::int64_t tag;
        double x, y;
        std::size_t x_offset, y_offset;
    };

    void read_format();
    void read_section(std::string_view name);
    void read_names();
    void read_entities();
    void read_nodes_2();
    void read_nodes_4();
    void read_elements_2();
    void read_elements_4();
    void read_node(std::int64_t tag);
    void read_element(const ElementType& type, std::int32_t marker, std::size_t offset);
    const ElementType& element_type(std::int64_t number);
    void end_section(std::string_view name);

    std::int32_t marker_of(std::int64_t physical, std::int64_t curve);
    void index_nodes();
    std::size_t node_of(std::int64_t tag, std::size_t offset) const;
    std::int32_t corner(std::int64_t tag, std::size_t offset);
    void build();
    void build_between();

    std::int64_t size(const char* what) { return numbers_.count(what, 8); } // 4.1: size_t

    Mesh& mesh_;
    NumberReader numbers_;
    int version_ = 0; // 2 or 4
    bool nodes_read_ = false, elements_read_ = false;
    double z_ = 0;
    std::vector<Node> nodes_;
    std::map<std::int64_t, std::string> names_;             // of physical groups of curves
    std::unordered_map<std::int64_t, std::int64_t> groups_; // 4.1: of curves
    std::vector<std::int64_t> dense_;                       // node of a tag, -1: none
    std::unordered_map<std::int64_t, std::int64_t> sparse_;
    std::vector<std::int32_t> point_of_;                    // of a node; -1: no corner

    struct Element {
        const ElementType* type;
        std::int32_t marker;
        std::size_t offset, first; // of its nodes in element_nodes_
    };
    std::vector<Element> elements_;
    std::vector<std::int64_t> element_nodes_; // tags
};

void GmshReader::read() {
    read_format();
    while (!numbers_.at_end()) {
        const std::string_view line = numbers_.next_line();
        if (line.empty()) break;
        if (line[0] != '$') numbers_.expected("a section such as $Nodes");
        read_section(line.substr(1));
    }
    if (!nodes_read_) numbers_.expected("a section $Nodes");
    if (!elements_read_) numbers_.expected("a section $Elements");
    build();
}

void GmshReader::read_format() {
    if (numbers_.next_line() != "$MeshFormat") numbers_.expected("$MeshFormat");
    const std::string version(numbers_.word());
    version_ = version == "2.2" || version == "2" || version == "2.1" ? 2 : version == "4.1" ? 4 : 0;
    if (version_ == 0) numbers_.expected("version 2.2 or 4.1 of the format");
    const std::int64_t kind = numbers_.whole("0 (text) or 1 (binary)");
    if (kind != 0 && kind != 1) numbers_.expected("0 (text) or 1 (binary)");
    if (numbers_.whole("8 bytes for a number") != 8) numbers_.expected("8 bytes for a number");
    if (kind == 1) {
        const std::string& text = mesh_.file.text();
        numbers_.jump(std::min(text.find('\n', numbers_.offset()), text.size() - 1) + 1);
        numbers_.is_binary = true;
        mesh_.in_file.kind = NumberKind::real64;
        const std::int64_t one = numbers_.whole("the number 1 in the file's byte order");
        numbers_.swapped = mesh_.in_file.swapped = one != 1;
        if (one != 1 && one != 1 << 24) numbers_.fail("expected the number 1 in one byte order or the other");
    }
    end_section("MeshFormat");
}

void GmshReader::read_section(std::string_view name) {
    const bool was_binary = numbers_.is_binary;
    if (name == "PhysicalNames") {
        numbers_.is_binary = false; // text in all files
        read_names();
        numbers_.is_binary = was_binary;
    } else if (name == "Entities" && version_ == 4) {
        read_entities();
    } else if (name == "Nodes") {
        version_ == 2 ? read_nodes_2() : read_nodes_4();
        nodes_read_ = true;
    } else if (name == "Elements") {
        version_ == 2 ? read_elements_2() : read_elements_4();
        elements_read_ = true;
    } else if (name == "PartitionedEntities") {
        numbers_.fail("the mesh is partitioned: save it as one part");
    } else { // stays as it is
        const std::size_t end = mesh_.file.text().find("$End" + std::string(name), numbers_.offset());
        if (end == std::string::npos) numbers_.fail("the section " + quoted(name) + " has no end");
        numbers_.jump(end);
    }
    end_section(name);
}

void GmshReader::end_section(std::string_view name) {
    const std::string end = "$End" + std::string(name);
    if (numbers_.word() != end) numbers_.expected(end);
}

void GmshReader::read_names() {
    const std::int64_t n = numbers_.count("the number of physical names");
    for (std::int64_t i = 0; i < n; ++i) {
        const std::int64_t dimension = numbers_.whole("the dimension of a physical name");
        const std::int64_t tag = numbers_.whole("the number of a physical group");
        std::string_view name = numbers_.next_line();
        if (name.size() < 2 || name.front() != '"' || name.back() != '"')
            numbers_.expected("a name in quotation marks");
        name = name.substr(1, name.size() - 2);
        if (dimension == 1) names_[tag] = name;
    }
}

void GmshReader::read_entities() {
    std::int64_t counts[4];
    for (std::int64_t& n : counts) n = size("a number of entities");
    for (int dimension = 0; dimension < 4; ++dimension) {
        for (std::int64_t i = 0; i < counts[dimension]; ++i) {
            const std::int64_t tag = numbers_.whole("an entity's number");
            for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) numbers_.real("an entity's bounds");
            const std::int64_t n_groups = size("a number of physical groups");
            for (std::int64_t k = 0; k < n_groups; ++k) {
                const std::int64_t group = numbers_.whole("a physical group");
                if (dimension == 1) groups_.emplace(tag, std::abs(group)); // the first; negative: the other way round
            }
            if (dimension == 0) continue;
            const std::int64_t n_around = size("a number of bounding entities");
            for (std::int64_t k = 0; k < n_around; ++k) numbers_.whole("a bounding entity");
        }
    }
}

void GmshReader::read_node(std::int64_t tag) {
    Node node = {tag, 0, 0, 0, 0};
    node.x = numbers_.real("a node's x");
    node.x_offset = numbers_.number_offset();
    node.y = numbers_.real("a node's y");
    node.y_offset = numbers_.number_offset();
    const double z = numbers_.real("a node's z");
    if (nodes_.empty()) z_ = z;
    if (std::fabs(z - z_) > 1e-9 * (1 + std::fabs(z_))) {
        numbers_.fail("expected nodes in one plane z = " + brief(z_) + ", found " + brief(z) +
                      ": the mesh has three dimensions");
    }
    nodes_.push_back(node);
}

void GmshReader::read_nodes_2() {
    const bool binary = numbers_.is_binary;
    numbers_.is_binary = false;
    const std::int64_t n = numbers_.count("the number of nodes");
    numbers_.is_binary = binary;
    if (binary) numbers_.skip_bytes(1, "the end of the line");
    for (std::int64_t i = 0; i < n; ++i) read_node(numbers_.whole("a node's number"));
}

void GmshReader::read_nodes_4() {
    const std::int64_t n_blocks = size("the number of blocks of nodes");
    for (const char* what : {"the number of nodes", "the least node", "the largest node"}) numbers_.whole(what, 8);
    std::vector<std::int64_t> tags;
    for (std::int64_t block = 0; block < n_blocks; ++block) {
        const std::int64_t dimension = numbers_.whole("an entity's dimension");
        numbers_.whole("an entity's number");
        const std::int64_t parametric = numbers_.whole("0 or 1, for parameters of nodes");
        const std::int64_t n = size("the number of nodes of a block");
        tags.clear();
        for (std::int64_t i = 0; i < n; ++i) tags.push_back(numbers_.whole("a node's number", 8));
        for (const std::int64_t tag : tags) {
            read_node(tag);
            for (std::int64_t k = 0; parametric != 0 && k < std::min<std::int64_t>(dimension, 3); ++k) {
                numbers_.real("a node's parameter");
            }
        }
    }
}

const ElementType& GmshReader::element_type(std::int64_t number) {
    for (const ElementType& type : element_types) {
        if (type.number == number) return type;
    }
    if (number >= first_solid && number <= last_solid) {
        numbers_.fail("element type " + std::to_string(number) + ": a mesh of three dimensions");
    }
    numbers_.fail("element type " + std::to_string(number) +
                  " is not read: triangles and quadrilaterals of first and second order are");
}

void GmshReader::read_element(const ElementType& type, std::int32_t marker, std::size_t offset) {
    const std::size_t first = element_nodes_.size();
    const int bytes = version_ == 4 ? 8 : 4;
    for (int k = 0; k < type.nodes; ++k) element_nodes_.push_back(numbers_.whole("a node of an element", bytes));
    if (type.dimension == 0) {
        element_nodes_.resize(first); // points are kept, but are no boundary
    } else {
        elements_.push_back({&type, marker, offset, first});
    }
}

void GmshReader::read_elements_2() {
    const bool binary = numbers_.is_binary;
    numbers_.is_binary = false;
    const std::int64_t n = numbers_.count("the number of elements");
    numbers_.is_binary = binary;
    if (binary) numbers_.skip_bytes(1, "the end of the line");
    for (std::int64_t i = 0; i < n;) {
        std::int64_t in_block = 1;
        if (!binary) numbers_.whole("an element's number");
        std::size_t offset = numbers_.number_offset();
        const ElementType& type = element_type(numbers_.whole("an element's type"));
        if (binary) in_block = std::min(numbers_.count("the number of elements of a block"), n - i);
        const std::int64_t n_tags = numbers_.count("the number of an element's tags");
        for (std::int64_t k = 0; k < in_block; ++k, ++i) {
            if (binary) numbers_.whole("an element's number");
            if (binary) offset = numbers_.number_offset();
            std::int64_t tags[2] = {0, 0};
            for (std::int64_t t = 0; t < n_tags; ++t) {
                const std::int64_t tag = numbers_.whole("a tag of an element");
                if (t < 2) tags[t] = tag;
            }
            read_element(type, type.dimension == 1 ? marker_of(std::abs(tags[0]), tags[1]) : -1, offset);
        }
        if (in_block == 0) numbers_.fail("a block without elements");
    }
}

void GmshReader::read_elements_4() {
    const std::int64_t n_blocks = size("the number of blocks of elements");
    for (const char* what : {"the number of elements", "the least element", "the largest element"})
        numbers_.whole(what, 8);
    for (std::int64_t block = 0; block < n_blocks; ++block) {
        numbers_.whole("an entity's dimension");
        const std::int64_t entity = numbers_.whole("an entity's number");
        const ElementType& type = element_type(numbers_.whole("an element's type"));
        const std::int64_t n = size("the number of elements of a block");
        const auto group = groups_.find(entity);
        std::int32_t marker = -1;
        if (type.dimension == 1) marker = marker_of(group == groups_.end() ? 0 : group->second, entity);
        for (std::int64_t i = 0; i < n; ++i) {
            numbers_.whole("an element's number", 8);
            read_element(type, marker, numbers_.number_offset());
        }
    }
}

std::int32_t GmshReader::marker_of(std::int64_t physical, std::int64_t curve) {
    if (physical == 0) return mesh_.add_marker("curve:" + std::to_string(curve));
    const auto name = names_.find(physical);
    return mesh_.add_marker(name == names_.end() ? std::to_string(physical) : name->second);
}

// Tags are mostly 1 .. n, but need not be.
void GmshReader::index_nodes() {
    std::int64_t largest = 0;
    for (const Node& node : nodes_) largest = std::max(largest, node.tag);
    const bool is_dense = largest <= static_cast<std::int64_t>(8 * nodes_.size() + 1000);
    if (is_dense) dense_.assign(static_cast<std::size_t>(largest) + 1, -1);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const std::int64_t tag = nodes_[i].tag;
        if (tag < 0) mesh_.file.fail(nodes_[i].x_offset, "a node has the number " + std::to_string(tag));
        std::int64_t& place = is_dense ? dense_[static_cast<std::size_t>(tag)] : sparse_.emplace(tag, -1).first->second;
        if (place != -1) mesh_.file.fail(nodes_[i].x_offset, "two nodes have the number " + std::to_string(tag));
        place = static_cast<std::int64_t>(i);
    }
}

std::size_t GmshReader::node_of(std::int64_t tag, std::size_t offset) const {
    std::int64_t node = -1;
    if (!dense_.empty()) {
        if (tag >= 0 && tag < static_cast<std::int64_t>(dense_.size())) node = dense_[static_cast<std::size_t>(tag)];
    } else {
        const auto found = sparse_.find(tag);
        if (found != sparse_.end()) node = found->second;
    }
    if (node < 0) mesh_.file.fail(offset, "an element has node " + std::to_string(tag) + ", which does not exist");
    return static_cast<std::size_t>(node);
}

std::int32_t GmshReader::corner(std::int64_t tag, std::size_t offset) { return point_of_[node_of(tag, offset)]; }

// Points of the mesh are all nodes but those that are in the middle of edges and cells only.
void GmshReader::build() {
    index_nodes();
    enum : std::int32_t { middle = -1, unused = -2, is_corner = -3 };
    point_of_.assign(nodes_.size(), unused);
    for (const Element& element : elements_) {
        for (int k = 0; k < element.type->nodes; ++k) {
            std::int32_t& kind =
                point_of_[node_of(element_nodes_[element.first + static_cast<std::size_t>(k)], element.offset)];
            kind = k < element.type->corners ? is_corner : kind == unused ? middle : kind;
        }
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (point_of_[i] == middle) continue;
        point_of_[i] = mesh_.points();
        mesh_.add_point(nodes_[i].x, nodes_[i].y, nodes_[i].x_offset, nodes_[i].y_offset);
    }
    std::int32_t points[4] = {};
    std::vector<std::int32_t> cell;
    for (const Element& element : elements_) {
        const auto n = static_cast<std::size_t>(element.type->corners);
        for (std::size_t k = 0; k < n; ++k) points[k] = corner(element_nodes_[element.first + k], element.offset);
        if (element.type->dimension == 1) {
            mesh_.add_face(points[0], points[1], element.marker, element.offset);
        } else {
            cell.assign(points, points + n);
            mesh_.add_cell(cell, element.offset);
        }
    }
    build_between();
    name_open_boundary(mesh_, "boundary");
}

void GmshReader::build_between() {
    for (const Element& element : elements_) {
        const auto corners = static_cast<std::size_t>(element.type->corners);
        const std::int64_t* const nodes = element_nodes_.data() + element.first;
        for (auto k = corners; k < static_cast<std::size_t>(element.type->nodes); ++k) {
            const std::size_t node = node_of(nodes[k], element.offset);
            if (point_of_[node] != -1) continue; // a corner elsewhere, or done by a neighbour
            Between between = {{}, 2, nodes_[node].x, nodes_[node].y};
            const std::size_t edge = k - corners, n_edges = element.type->dimension == 1 ? 1 : corners;
            if (edge < n_edges) {
                between.corners = {corner(nodes[edge], element.offset),
                                   corner(nodes[(edge + 1) % corners], element.offset)};
            } else {
                between.n_corners = static_cast<std::int32_t>(corners);
                for (std::size_t i = 0; i < corners; ++i) between.corners[i] = corner(nodes[i], element.offset);
            }
            const auto number = static_cast<std::int32_t>(mesh_.x.size() + mesh_.in_file.between.size());
            mesh_.in_file.between.push_back(between);
            mesh_.in_file.slots.push_back({nodes_[node].x_offset, number, takes_x});
            mesh_.in_file.slots.push_back({nodes_[node].y_offset, number, takes_y});
            point_of_[node] = number;
        }
    }
    if (mesh_.in_file.between.empty()) return;
    mesh_.remark("quadratic elements: the mesh has their corners; points between move along (" +
                 plural(static_cast<std::int64_t>(mesh_.in_file.between.size()), "point") + ")");
}

bool probe(const TextFile& file) {
    return trimmed(std::string_view(file.text()).substr(0, 64)).substr(0, 11) == "$MeshFormat";
}

void read(Mesh& mesh, const ReadOptions&) { GmshReader(mesh).read(); }

// Version 2.2: what every program reads that reads any. Cells are the physical surface 1, markers curves from 2 on.
void create(std::ostream& out, const Mesh& mesh) {
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << mesh.markers.size() + 1 << "\n2 1 \"domain\"\n";
    for (std::size_t marker = 0; marker < mesh.markers.size(); ++marker) {
        out << "1 " << marker + 2 << " \"" << mesh.markers[marker] << "\"\n";
    }
    out << "$EndPhysicalNames\n$Nodes\n" << mesh.points() << '\n';
    for (std::size_t i = 0; i < mesh.x.size(); ++i)
        out << i + 1 << ' ' << exact(mesh.x[i]) << ' ' << exact(mesh.y[i]) << " 0\n";
    out << "$EndNodes\n$Elements\n" << mesh.faces() + mesh.cells() << '\n';
    std::size_t number = 0;
    for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
        const std::int32_t tag = mesh.face_markers[face] + 2;
        out << ++number << " 1 2 " << tag << ' ' << tag << ' ' << mesh.face_points[2 * face] + 1 << ' '
            << mesh.face_points[2 * face + 1] + 1 << '\n';
    }
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        const std::int32_t begin = mesh.cell_start[cell], end = mesh.cell_start[cell + 1];
        out << ++number << (end - begin == 3 ? " 2 2 1 1" : " 3 2 1 1");
        for (std::int32_t i = begin; i < end; ++i) out << ' ' << mesh.cell_points[static_cast<std::size_t>(i)] + 1;
        out << '\n';
    }
    out << "$EndElements\n";
}

} // namespace

const Format gmsh_format = {"gmsh", ".msh", "Gmsh MSH 2.2 and 4.1, text and binary", probe, read, create};

} // namespace cli
