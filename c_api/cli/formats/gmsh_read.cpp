// Reads Gmsh files: the sections of versions 2.0 to 2.2 and 4.1, in any order.
#include "formats/gmsh_read.hpp"

#include "formats/gmsh_elements.hpp"
#include "formats/gmsh_groups.hpp"
#include "formats/gmsh_nodes.hpp"
#include "formats/number_reader.hpp"

#include <algorithm>
#include <cstdlib>

namespace cli {

namespace {

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

}  // namespace

Elements read_gmsh(Mesh& mesh) { return GmshReader(mesh).read(); }

}  // namespace cli
