// Gmsh's MSH files (https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format), versions 2 and 4.1,
// in text and binary, of two dimensions or one cell thick.
//
// Markers are the physical groups of curves, or of surfaces in meshes one cell thick, by name if
// there is one; a curve or surface without a group is "curve:TAG" or "surface:TAG".
#include "basics/text_out.hpp"
#include "files/threads.hpp"
#include "formats/element_mesh.hpp"
#include "formats/format.hpp"
#include "formats/number_reader.hpp"
#include "mesh/mesh_file.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <ostream>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cli {

namespace {

// The elements of Gmsh files, by their types.

struct GmshElementType {
    int number;
    ElementShape shape;
};
constexpr GmshElementType element_types[] = {
    {15, {0, 1}},
    {1, {1, 2}},
    {8, {1, 2, "01"}},
    {2, {2, 3}},
    {9, {2, 3, "01 12 20"}},
    {3, {2, 4}},
    {16, {2, 4, "01 12 23 30"}},
    {10, {2, 4, "01 12 23 30 0123"}},
    {4, {3, 4}},
    {11, {3, 4, "01 12 20 30 23 13"}},
    {5, {3, 8}},
    {17, {3, 8, "01 03 04 12 15 23 26 37 45 47 56 67"}},
    {12,
     {3, 8,
      "01 03 04 12 15 23 26 37 45 47 56 67 0321 0154 0473 1265 2376 4567 "
      "01234567"}},
    {6, {3, 6}},
    {18, {3, 6, "01 02 03 12 14 25 34 35 45"}},
    {13, {3, 6, "01 02 03 12 14 25 34 35 45 0143 0352 1254"}},
    {7, {3, 5}},
    {19, {3, 5, "01 03 04 12 14 23 24 34"}},
    {14, {3, 5, "01 03 04 12 14 23 24 34 0321"}}};

// Returns the shape of a type of elements, or NULL if the type is not read.
inline const ElementShape* gmsh_element(std::int64_t number) {
    for (const GmshElementType& type : element_types) {
        if (type.number == number) return &type.shape;
    }
    return nullptr;
}

// The physical groups of a Gmsh file, from which the markers get their names. The sections that
// define groups may follow the elements that are in them.

class GmshGroups {
public:
    // Names a physical group of curves (dimension 1) or surfaces (2).
    void add_name(int dimension, std::int64_t physical, std::string_view name);

    // Puts a curve or a surface into a physical group, as $Entities of version 4.1 does. The sign
    // of the group tells the orientation and is dropped. Returns false if the entity is in too many
    // groups.
    bool add_to_group(int dimension, std::int64_t entity, std::int64_t physical);

    // Returns the index in names() of the elements of an entity, or -1 for elements that are no
    // curve and no surface. physical: the group of the element; 0 if the element has none (version
    // 2), or if the groups are those of the entity (version 4.1).
    std::int32_t find(int dimension, std::int64_t physical, std::int64_t entity);

    // Returns the names for each index that find() returned: the names or numbers of the physical
    // groups, or else "curve:TAG" or "surface:TAG". All sections must have been read.
    std::vector<std::vector<std::string>> names() const;

    static constexpr std::size_t max_groups = 16;  // of one curve or surface

private:
    using Item = std::pair<int, std::int64_t>;  // a dimension, and a number there
    struct Group {
        int dimension;
        std::int64_t physical, entity;
    };
    std::map<Item, std::string> names_;                    // of physical groups
    std::map<Item, std::vector<std::int64_t>> physicals_;  // of entities
    std::map<std::tuple<int, std::int64_t, std::int64_t>, std::int32_t> places_;  // in groups_
    std::vector<Group> groups_;
};

bool has_groups(int dimension) { return dimension == 1 || dimension == 2; }

void GmshGroups::add_name(int dimension, std::int64_t physical, std::string_view name) {
    // A group whose name is empty is selected by its number, as one without a name.
    if (has_groups(dimension) && !name.empty()) names_[{dimension, physical}] = name;
}

bool GmshGroups::add_to_group(int dimension, std::int64_t entity, std::int64_t physical) {
    if (!has_groups(dimension)) return true;
    std::vector<std::int64_t>& groups = physicals_[{dimension, entity}];
    groups.push_back(std::abs(physical));
    return groups.size() <= max_groups;
}

std::int32_t GmshGroups::find(int dimension, std::int64_t physical, std::int64_t entity) {
    if (!has_groups(dimension)) return -1;
    const auto known =
        places_.emplace(std::make_tuple(dimension, physical, physical == 0 ? entity : 0),
                        static_cast<std::int32_t>(groups_.size()));
    if (known.second) groups_.push_back({dimension, physical, entity});
    return known.first->second;
}

std::vector<std::vector<std::string>> GmshGroups::names() const {
    std::vector<std::vector<std::string>> result;
    for (const Group& group : groups_) {
        std::vector<std::int64_t> physicals;
        if (group.physical != 0) physicals.push_back(group.physical);
        const auto of_entity = physicals_.find({group.dimension, group.entity});
        if (group.physical == 0 && of_entity != physicals_.end()) physicals = of_entity->second;
        std::vector<std::string> names;
        for (const std::int64_t physical : physicals) {
            const auto name = names_.find({group.dimension, physical});
            names.push_back(name == names_.end() ? std::to_string(physical) : name->second);
        }
        const char* const kind = group.dimension == 1 ? "curve:" : "surface:";
        if (names.empty()) names.push_back(kind + std::to_string(group.entity));
        result.push_back(names);
    }
    return result;
}

// Finds nodes of a Gmsh file by their numbers, which are mostly 1 .. n, but need not be.

class GmshNodes {
public:
    // numbers, offsets: the numbers of the nodes in the order of the file, and their places.
    GmshNodes(const TextFile& file, const std::vector<std::int64_t>& numbers,
              const std::vector<std::size_t>& offsets)
        : file_(file) {
        std::int64_t largest = 0;
        for (const std::int64_t number : numbers) largest = std::max(largest, number);
        is_dense_ = largest <= static_cast<std::int64_t>(8 * numbers.size() + 1000);
        if (is_dense_) dense_.assign(static_cast<std::size_t>(largest) + 1, -1);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const std::int64_t number = numbers[i];
            if (number < 0)
                file.fail(offsets[i], "a node has the number " + std::to_string(number));
            std::int32_t& node = is_dense_ ? dense_[static_cast<std::size_t>(number)]
                                           : sparse_.emplace(number, -1).first->second;
            if (node != -1)
                file.fail(offsets[i], "two nodes have the number " + std::to_string(number));
            node = static_cast<std::int32_t>(i);
        }
    }

    // offset: the place of the element that names the node.
    std::int32_t find(std::int64_t number, std::size_t offset) const {
        std::int32_t node = -1;
        if (is_dense_) {
            if (number >= 0 && number < static_cast<std::int64_t>(dense_.size()))
                node = dense_[static_cast<std::size_t>(number)];
        } else {
            const auto found = sparse_.find(number);
            if (found != sparse_.end()) node = found->second;
        }
        if (node < 0)
            file_.fail(offset,
                       "an element has node " + std::to_string(number) + ", which does not exist");
        return node;
    }

private:
    const TextFile& file_;
    bool is_dense_ = false;
    std::vector<std::int32_t> dense_;  // -1: none
    std::unordered_map<std::int64_t, std::int32_t> sparse_;
};

class GmshReader {
public:
    explicit GmshReader(Mesh& mesh) : mesh_(mesh), numbers_(mesh.file) {}
    Elements read();

private:
    void read_format();
    void read_section(std::string_view name);
    void read_names();
    void read_entities();
    void read_nodes_2();
    void read_nodes_4();
    void read_elements_2();
    void read_elements_4();
    void read_node(std::int64_t number);
    void read_element(const ElementShape& shape, std::int32_t group, std::size_t offset);
    const ElementShape& element_shape(std::int64_t number);
    void pass_over_section(std::string_view name);
    void end_section(std::string_view name);
    std::int64_t physical_group();

    std::int64_t size(const char* what) { return numbers_.count(what, 8); }  // 4.1: size_t

    Mesh& mesh_;
    NumberReader numbers_;
    int version_ = 0;  // 2 or 4; 0: not known yet
    bool nodes_read_ = false, elements_read_ = false;
    Elements content_;
    std::vector<std::int64_t> node_numbers_;   // of content_.points
    std::vector<std::int64_t> element_nodes_;  // the numbers of the nodes of all elements
    GmshGroups groups_;
};

Elements GmshReader::read() {
    while (!numbers_.at_end()) {
        const std::string_view line = numbers_.next_line();
        if (line.empty()) break;
        if (line[0] != '$') numbers_.expected("a section such as $Nodes");
        read_section(line.substr(1));
    }
    if (version_ == 0) numbers_.expected("a section $MeshFormat");
    if (!nodes_read_) numbers_.expected("a section $Nodes");
    if (!elements_read_) numbers_.expected("a section $Elements");
    const GmshNodes nodes(mesh_.file, node_numbers_, content_.points.offset[0]);
    content_.nodes.resize(element_nodes_.size());
    for (const Elements::Element& element : content_.elements) {
        for (std::size_t k = 0; k < static_cast<std::size_t>(element.shape.nodes); ++k) {
            content_.nodes[element.first + k] =
                nodes.find(element_nodes_[element.first + k], element.offset);
        }
    }
    content_.groups = groups_.names();
    return std::move(content_);
}

void GmshReader::read_format() {
    const std::string version(numbers_.word());
    version_ = version == "2.2" || version == "2" || version == "2.0" || version == "2.1" ? 2
               : version == "4.1"                                                         ? 4
                                                                                          : 0;
    if (version_ == 0) {
        numbers_.expected(
            "version 2.2 or 4.1 of the format (in Gmsh: -format msh41, or Mesh.MshFileVersion = "
            "4.1, when "
            "saving)");
    }
    const std::int64_t kind = numbers_.whole("0 (text) or 1 (binary)");
    if (kind != 0 && kind != 1) numbers_.expected("0 (text) or 1 (binary)");
    if (numbers_.whole("8 bytes for a number") != 8) numbers_.expected("8 bytes for a number");
    if (kind == 1) {
        const std::string_view text = mesh_.file.text();
        numbers_.jump(std::min(text.find('\n', numbers_.offset()), text.size() - 1) + 1);
        numbers_.is_binary = true;
        mesh_.in_file.kind = NumberKind::real64;
        const std::int64_t one = numbers_.whole("the number 1 in the file's byte order");
        numbers_.swapped = mesh_.in_file.swapped = one != 1;
        if (one != 1 && one != 1 << 24)
            numbers_.fail("the file needs the number 1 in one byte order or the other here");
    }
}

void GmshReader::read_section(std::string_view name) {
    const bool was_binary = numbers_.is_binary;
    const bool is_mesh = name == "Nodes" || name == "Elements" || name == "Entities";
    if (version_ == 0 && is_mesh) numbers_.expected("a section $MeshFormat before the mesh");
    if (nodes_read_ && name == "Nodes") numbers_.fail("the file has a second section $Nodes");
    if (name == "MeshFormat" && version_ == 0) {
        read_format();
    } else if (name == "PhysicalNames") {
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
        numbers_.fail("the mesh is partitioned; save it as one part (in Gmsh: Mesh > Unpartition)");
    } else if (name == "NOD" || name == "NOE" || name == "ELM") {
        numbers_.fail(
            "this is version 1 of the format, which is not read; save the mesh in version 2.2 or "
            "4.1 (in Gmsh: "
            "-format msh41, or Mesh.MshFileVersion = 4.1)");
    } else {
        pass_over_section(name);  // the section stays as it is
    }
    end_section(name);
}

void GmshReader::pass_over_section(std::string_view name) {
    const std::size_t end = mesh_.file.text().find("$End" + std::string(name), numbers_.offset());
    if (end == std::string::npos) numbers_.fail("the section " + in_quotes(name) + " has no end");
    numbers_.jump(end);
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
        groups_.add_name(static_cast<int>(dimension), tag, name);
    }
}

// Reads the number of a physical group, whose sign is the orientation.
std::int64_t GmshReader::physical_group() {
    const std::int64_t group = numbers_.whole("a physical group");
    if (group < -INT32_MAX || group > INT32_MAX)
        numbers_.expected("a physical group between -2147483647 and 2147483647");
    return group;
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
                const std::int64_t group = physical_group();
                if (!groups_.add_to_group(dimension, tag, group)) {
                    numbers_.fail("a curve or a surface is in more than " +
                                  std::to_string(GmshGroups::max_groups) + " physical groups");
                }
            }
            if (dimension == 0) continue;
            const std::int64_t n_around = size("a number of bounding entities");
            for (std::int64_t k = 0; k < n_around; ++k) numbers_.whole("a bounding entity");
        }
    }
}

void GmshReader::read_node(std::int64_t number) {
    node_numbers_.push_back(number);
    for (std::size_t d = 0; d < 3; ++d) {
        content_.points.x[d].push_back(numbers_.real("a coordinate of a node"));
        content_.points.offset[d].push_back(numbers_.number_offset());
    }
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
    for (const char* what : {"the number of nodes", "the smallest node", "the largest node"})
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

const ElementShape& GmshReader::element_shape(std::int64_t number) {
    if (const ElementShape* const shape = gmsh_element(number)) return *shape;
    numbers_.fail("element type " + std::to_string(number) +
                  " is not read: save elements of first or second order (in Gmsh: -order 1 or "
                  "-order 2)");
}

void GmshReader::read_element(const ElementShape& shape, std::int32_t group, std::size_t offset) {
    const std::size_t first = element_nodes_.size();
    for (int k = 0; k < shape.nodes; ++k) {
        element_nodes_.push_back(numbers_.whole("a node of an element", version_ == 4 ? 8 : 4));
    }
    if (shape.dimension == 0) {
        element_nodes_.resize(first);  // elements that are points are not part of the mesh
    } else {
        content_.elements.push_back({shape, group, offset, first});
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
        const ElementShape& shape = element_shape(numbers_.whole("an element's type"));
        if (binary) in_block = std::min(numbers_.count("the number of elements of a block"), n - i);
        const std::int64_t n_tags = numbers_.count("the number of an element's tags");
        for (std::int64_t k = 0; k < in_block; ++k, ++i) {
            if (binary) numbers_.whole("an element's number");
            if (binary) offset = numbers_.number_offset();
            std::int64_t tags[2] = {0, 0};
            for (std::int64_t t = 0; t < n_tags; ++t) {
                const std::int64_t tag =
                    t == 0 ? physical_group() : numbers_.whole("a tag of an element");
                if (t < 2) tags[t] = tag;
            }
            read_element(shape, groups_.find(shape.dimension, std::abs(tags[0]), tags[1]), offset);
        }
        if (in_block == 0) numbers_.fail("a block has no elements");
    }
}

void GmshReader::read_elements_4() {
    const std::int64_t n_blocks = size("the number of blocks of elements");
    for (const char* what :
         {"the number of elements", "the smallest element", "the largest element"})
        numbers_.whole(what, 8);
    for (std::int64_t block = 0; block < n_blocks; ++block) {
        numbers_.whole("an entity's dimension");
        const std::int64_t entity = numbers_.whole("an entity's number");
        const ElementShape& shape = element_shape(numbers_.whole("an element's type"));
        const std::int64_t n = size("the number of elements of a block");
        const std::int32_t group = groups_.find(shape.dimension, 0, entity);
        for (std::int64_t i = 0; i < n; ++i) {
            numbers_.whole("an element's number", 8);
            read_element(shape, group, numbers_.number_offset());
        }
    }
}

// Reads mesh.file, and sets the kind of numbers of mesh.in_file.
Elements read_gmsh(Mesh& mesh) { return GmshReader(mesh).read(); }

// The section $MeshFormat is the first one, or $Comments.
bool probe_gmsh(const TextFile& file) {
    const std::string_view text = trimmed(file.text().substr(0, 64));
    return text.size() > 1 && text[0] == '$' && text[1] >= 'A' && text[1] <= 'Z';
}

void read_gmsh(Mesh& mesh, const ReadOptions&) { build_mesh(mesh, read_gmsh(mesh)); }

// Writes version 2.2, which all programs read. The cells are the physical surface 1, and the
// markers are the physical curves from 2 on.
void create_gmsh(std::ostream& out, const Mesh& mesh) {
    mesh.refuse_polygons("Gmsh");
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n"
        << mesh.markers.size() + 1 << "\n2 1 \"domain\"\n";
    for (std::size_t marker = 0; marker < mesh.markers.size(); ++marker) {
        out << "1 " << marker + 2 << " \"" << mesh.markers[marker] << "\"\n";
    }
    out << "$EndPhysicalNames\n$Nodes\n" << mesh.points() << '\n';
    write_rows(out, mesh.x.size(), mesh.threads, [&](std::size_t i, TextOut& to) {
        (to << i + 1 << ' ').exact(mesh.x[i]);
        (to << ' ').exact(mesh.y[i]) << " 0\n";
    });
    out << "$EndNodes\n$Elements\n" << mesh.faces() + mesh.cells() << '\n';
    const std::size_t n_faces = mesh.face_markers.size();
    for (std::size_t face = 0; face < n_faces; ++face) {
        const std::int32_t tag = mesh.face_markers[face] + 2;
        out << face + 1 << " 1 2 " << tag << ' ' << tag << ' ' << mesh.face_points[2 * face] + 1
            << ' ' << mesh.face_points[2 * face + 1] + 1 << '\n';
    }
    write_rows(out, mesh.cell_start.size() - 1, mesh.threads, [&](std::size_t cell, TextOut& to) {
        const std::int32_t begin = mesh.cell_start[cell], end = mesh.cell_start[cell + 1];
        to << n_faces + cell + 1 << (end - begin == 3 ? " 2 2 1 1" : " 3 2 1 1");
        for (std::int32_t i = begin; i < end; ++i)
            to << ' ' << mesh.cell_points[static_cast<std::size_t>(i)] + 1;
        to << '\n';
    });
    out << "$EndElements\n";
}

}  // namespace

const Format gmsh_format = {
    "gmsh",     ".msh",    "Gmsh MSH 2.0 to 2.2 and 4.1, 2D or one cell thick",
    probe_gmsh, read_gmsh, create_gmsh,
    true,       "\""};

}  // namespace cli
