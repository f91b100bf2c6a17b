// Reads Gmsh files: the sections of versions 2.2 and 4.1.
#include "formats/gmsh_content.hpp"

#include "formats/number_reader.hpp"
#include "formats/one_plane.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <unordered_map>
#include <utility>

namespace cli {

namespace {

constexpr GmshElementType element_types[] = {{15, 0, 1, 1}, {1, 1, 2, 2}, {8, 1, 2, 3},
                                             {2, 2, 3, 3},  {9, 2, 3, 6}, {3, 2, 4, 4},
                                             {16, 2, 4, 8}, {10, 2, 4, 9}};
constexpr int first_solid = 4, last_solid = 7;  // tetrahedron, hexahedron, prism, pyramid

class GmshReader {
public:
    explicit GmshReader(Mesh& mesh) : mesh_(mesh), numbers_(mesh.file) {}
    GmshContent read();

private:
    void read_format();
    void read_section(std::string_view name);
    void read_names();
    void read_entities();
    void read_nodes_2();
    void read_nodes_4();
    void read_elements_2();
    void read_elements_4();
    void read_node(std::int64_t tag);
    void read_element(const GmshElementType& type, std::int32_t marker, std::size_t offset);
    const GmshElementType& element_type(std::int64_t number);
    void end_section(std::string_view name);

    std::int32_t marker_of(std::int64_t physical, std::int64_t curve);
    std::int64_t size(const char* what) { return numbers_.count(what, 8); }  // 4.1: size_t

    Mesh& mesh_;
    NumberReader numbers_;
    int version_ = 0;  // 2 or 4
    bool nodes_read_ = false, elements_read_ = false;
    OnePlane plane_;
    GmshContent content_;
    std::map<std::int64_t, std::string> names_;              // of physical groups of curves
    std::unordered_map<std::int64_t, std::int64_t> groups_;  // 4.1: of curves
};

GmshContent GmshReader::read() {
    read_format();
    while (!numbers_.at_end()) {
        const std::string_view line = numbers_.next_line();
        if (line.empty()) break;
        if (line[0] != '$') numbers_.expected("a section such as $Nodes");
        read_section(line.substr(1));
    }
    if (!nodes_read_) numbers_.expected("a section $Nodes");
    if (!elements_read_) numbers_.expected("a section $Elements");
    return std::move(content_);
}

void GmshReader::read_format() {
    if (numbers_.next_line() != "$MeshFormat") numbers_.expected("$MeshFormat");
    const std::string version(numbers_.word());
    version_ = version == "2.2" || version == "2" || version == "2.1" ? 2
               : version == "4.1"                                     ? 4
                                                                      : 0;
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
        if (one != 1 && one != 1 << 24)
            numbers_.fail("expected the number 1 in one byte order or the other");
    }
    end_section("MeshFormat");
}

void GmshReader::read_section(std::string_view name) {
    const bool was_binary = numbers_.is_binary;
    if (name == "PhysicalNames") {
        numbers_.is_binary = false;  // text in all files
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
    } else {  // stays as it is
        const std::size_t end =
            mesh_.file.text().find("$End" + std::string(name), numbers_.offset());
        if (end == std::string::npos)
            numbers_.fail("the section " + in_quotes(name) + " has no end");
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
                if (dimension == 1)
                    groups_.emplace(tag,
                                    std::abs(group));  // the first; negative: the other way round
            }
            if (dimension == 0) continue;
            const std::int64_t n_around = size("a number of bounding entities");
            for (std::int64_t k = 0; k < n_around; ++k) numbers_.whole("a bounding entity");
        }
    }
}

void GmshReader::read_node(std::int64_t tag) {
    GmshNode node = {tag, 0, 0, 0, 0};
    node.x = numbers_.real("a node's x");
    node.x_offset = numbers_.number_offset();
    node.y = numbers_.real("a node's y");
    node.y_offset = numbers_.number_offset();
    plane_.check(numbers_.real("a node's z"), numbers_);
    content_.nodes.push_back(node);
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
    for (const char* what : {"the number of nodes", "the least node", "the largest node"})
        numbers_.whole(what, 8);
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
            for (std::int64_t k = 0; parametric != 0 && k < std::min<std::int64_t>(dimension, 3);
                 ++k) {
                numbers_.real("a node's parameter");
            }
        }
    }
}

const GmshElementType& GmshReader::element_type(std::int64_t number) {
    for (const GmshElementType& type : element_types) {
        if (type.number == number) return type;
    }
    if (number >= first_solid && number <= last_solid) {
        numbers_.fail("element type " + std::to_string(number) + ": a mesh of three dimensions");
    }
    numbers_.fail("element type " + std::to_string(number) +
                  " is not read: triangles and quadrilaterals of first and second order are");
}

void GmshReader::read_element(const GmshElementType& type, std::int32_t marker,
                              std::size_t offset) {
    const std::size_t first = content_.element_nodes.size();
    const int bytes = version_ == 4 ? 8 : 4;
    for (int k = 0; k < type.nodes; ++k) {
        content_.element_nodes.push_back(numbers_.whole("a node of an element", bytes));
    }
    if (type.dimension == 0) {
        content_.element_nodes.resize(first);  // points are kept, but are no boundary
    } else {
        content_.elements.push_back({&type, marker, offset, first});
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
        const GmshElementType& type = element_type(numbers_.whole("an element's type"));
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
            read_element(type, type.dimension == 1 ? marker_of(std::abs(tags[0]), tags[1]) : -1,
                         offset);
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
        const GmshElementType& type = element_type(numbers_.whole("an element's type"));
        const std::int64_t n = size("the number of elements of a block");
        const auto group = groups_.find(entity);
        std::int32_t marker = -1;
        if (type.dimension == 1)
            marker = marker_of(group == groups_.end() ? 0 : group->second, entity);
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

}  // namespace

GmshContent read_gmsh_content(Mesh& mesh) { return GmshReader(mesh).read(); }

}  // namespace cli
