// Fluent's mesh files, in text and with binary sections (appendix "Mesh File Format" of the Fluent
// User's Guide), in two dimensions or one cell thick.
//
// Cells are given by their faces: in two dimensions a face goes from a node to another and has a
// cell on its right and one on its left, or none. Markers are the zones of boundary faces, with the
// names of the zones, or else "zone:NUMBER".
#include "basics/failure.hpp"
#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "files/text_file.hpp"
#include "formats/bytes.hpp"
#include "formats/format.hpp"
#include "formats/number_reader.hpp"
#include "mesh/mesh_file.hpp"
#include "mesh/one_cell_thick.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>

namespace cli {

namespace {

// Finds the sections (NUMBER (HEAD) (BODY)) or (NUMBER HEAD) of a Fluent mesh file, one after
// another. Sections whose first word is no number, such as (cad/adv-options ...), are settings in
// the language Scheme, and are passed over.

// Sections of this number and above have binary bodies: 2010 and 3010 nodes in single and double
// precision, and so on.
constexpr std::int64_t first_binary_section = 2000, first_double_section = 3000;

struct FluentSection {
    std::int64_t number = 0;
    std::size_t begin = 0;  // all members are places in the file; here: the first bracket
    std::size_t head = 0, head_end = 0;  // without the brackets
    std::size_t body = 0, body_end = 0;  // without the brackets; 0: there is none
};

class FluentSections {
public:
    explicit FluentSections(const TextFile& file) : file_(file), text_(file.text()) {}

    bool next();  // goes to the next section with a number; false: the end of the file
    const FluentSection& section() const { return section_; }

private:
    void over_blanks();
    bool read_number();
    void read_section(std::size_t begin);
    std::size_t end_of_list(std::size_t begin) const;
    std::size_t end_of_binary(std::size_t begin) const;

    const TextFile& file_;
    std::string_view text_;
    std::size_t at_ = 0;  // the place after the section
    FluentSection section_;
};

void FluentSections::over_blanks() {
    at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
}

// Returns the place after the bracket that closes the list which begins here, or npos. Brackets in
// quotation marks and characters such as #\( are ignored. In Scheme, a backslash in quotation marks
// takes away the meaning of the next character.
std::size_t closed_list(std::string_view text, std::size_t begin, bool has_escapes) {
    int depth = 0;
    for (std::size_t at = begin; (at = text.find_first_of("()\"", at)) != text.npos; ++at) {
        if (at >= 2 && text[at - 1] == '\\' && text[at - 2] == '#') continue;
        if (text[at] == '"') {
            do {
                at = text.find_first_of(has_escapes ? "\"\\" : "\"", at + 1);
                if (at != text.npos && text[at] == '\\') ++at;
                else break;
            } while (at < text.size());
            if (at >= text.size()) return text.npos;
        } else {
            depth += text[at] == '(' ? 1 : -1;
            if (depth == 0) return at + 1;
        }
    }
    return text.npos;
}

// Some programs write the paths of Windows without escapes: "C:\" is then a whole text.
std::size_t FluentSections::end_of_list(std::size_t begin) const {
    std::size_t end = closed_list(text_, begin, true);
    if (end == text_.npos) end = closed_list(text_, begin, false);
    if (end == text_.npos)
        file_.fail(begin, "this bracket is not closed before the end of the file");
    return end;
}

// Returns the place after "End of Binary Section NUMBER)". Brackets in binary data are ignored.
std::size_t FluentSections::end_of_binary(std::size_t begin) const {
    const std::size_t mark = text_.find("End of Binary Section", begin);
    const std::size_t end = mark == text_.npos ? mark : text_.find(')', mark);
    if (end == text_.npos)
        file_.fail(begin, "this binary section has no end 'End of Binary Section NUMBER)'");
    return end + 1;
}

// Reads the number of a section. Returns false if the first word is none: the word may also begin
// with a digit.
bool FluentSections::read_number() {
    std::int64_t number = 0;
    const std::size_t n = parse_front(text_.substr(at_), number), after = at_ + n;
    const std::string_view breaks = " \t\v\f\r\n()\"";
    if (n == 0 || number < 0 || number > INT32_MAX ||
        (after < text_.size() && breaks.find(text_[after]) == breaks.npos))
        return false;
    section_.number = static_cast<std::int32_t>(number);
    at_ = after;
    return true;
}

bool FluentSections::next() {
    for (over_blanks(); at_ < text_.size(); over_blanks()) {
        section_ = {};
        section_.begin = at_;
        if (text_[at_] != '(') {
            file_.fail(at_, "the file needs a section such as (10 ...) here, but " +
                                in_quotes(text_.substr(at_, 16)) + " follows");
        }
        const std::size_t begin = at_++;
        over_blanks();
        if (read_number()) {
            read_section(begin);
            return true;
        }
        at_ = end_of_list(begin);
    }
    return false;
}

// Finds the head and the body of the section that begins here, after its number.
void FluentSections::read_section(std::size_t begin) {
    over_blanks();
    const bool is_binary = section_.number >= first_binary_section;
    const std::size_t end = is_binary ? end_of_binary(begin) : end_of_list(begin);
    section_.head = at_;
    section_.head_end = end - 1;
    if (at_ < text_.size() && text_[at_] == '(') {
        section_.head = at_ + 1;
        at_ = end_of_list(at_);
        section_.head_end = at_ - 1;
        over_blanks();
        if (at_ < text_.size() && text_[at_] == '(') {
            section_.body = at_ + 1;
            section_.body_end =
                is_binary ? std::max(text_.rfind(')', text_.rfind("End of Binary", end)), at_ + 1)
                          : end_of_list(at_) - 1;
        }
    }
    at_ = end;
}

// The nodes, faces and names of a Fluent mesh file, as its sections list them.

struct FluentNode {
    std::int64_t number;                // counted from 1
    std::array<double, 3> x;            // in two dimensions, the last one is 0
    std::array<std::size_t, 3> offset;  // of each coordinate in the file
};

struct FluentFace {
    std::size_t first;  // its nodes are face_nodes[first] ... face_nodes[first + n - 1]
    std::int32_t n;
    std::int32_t cells[2];  // counted from 0; -1: none. In two dimensions the first one is on the
                            // right of the face.
    std::int64_t zone;
    bool is_interior;  // according to the type of the zone
    std::size_t offset;
};

struct FluentContent {
    int dimension = 2;
    std::vector<FluentNode> nodes;  // in the order of their numbers, which are 1, 2, ...
    std::vector<FluentFace> faces;
    std::vector<std::int32_t> face_nodes;  // counted from 0
    std::int32_t n_cells = 0;
    std::map<std::int64_t, std::string> names;  // of zones

    const std::int32_t* nodes_of(const FluentFace& face) const { return &face_nodes[face.first]; }
};

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
    const std::size_t n = parse_front(word, value, 16);
    if (n == 0 || n < word.size()) numbers_.expected(std::string(what) + " (hexadecimal)");
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

// Reads all sections of the file of the mesh and sets mesh.in_file.kind. Refuses nodes that do not
// exist, and more cells than the faces can have.
FluentContent read_fluent_content(Mesh& mesh) { return FluentReader(mesh).read(); }

class FluentMesh {
public:
    explicit FluentMesh(Mesh& mesh) : mesh_(mesh), content_(read_fluent_content(mesh)) {}

    void build() {
        find_faces_of_cells();
        content_.dimension == 2 ? build_flat() : build_solid();
        mesh_.find_polygons();
    }

private:
    void find_faces_of_cells();
    void build_flat();
    void add_polygon(std::int32_t cell);
    void build_solid();
    std::int32_t marker_of(const FluentFace& face);
    bool is_boundary(const FluentFace& face) const {
        return !face.is_interior || face.cells[0] < 0 || face.cells[1] < 0;
    }
    // The place of a cell in the file, for messages.
    std::size_t offset_of(std::int32_t cell) const {
        const std::size_t first = start_[place(cell)];
        const bool has_faces = first < start_[place(cell) + 1];
        return content_.faces[has_faces ? faces_[first] : 0].offset;
    }

    Mesh& mesh_;
    FluentContent content_;
    std::vector<std::size_t> start_, faces_;  // the faces of each cell, in compressed rows
};

void FluentMesh::find_faces_of_cells() {
    start_.assign(place(content_.n_cells) + 2, 0);
    for (const FluentFace& face : content_.faces) {
        for (const std::int32_t cell : face.cells)
            if (cell >= 0) ++start_[place(cell) + 2];
    }
    for (std::size_t k = 1; k < start_.size(); ++k) start_[k] += start_[k - 1];
    faces_.resize(start_.back());
    for (std::size_t f = 0; f < content_.faces.size(); ++f) {
        for (const std::int32_t cell : content_.faces[f].cells)
            if (cell >= 0) faces_[start_[place(cell) + 1]++] = f;
    }
}

std::int32_t FluentMesh::marker_of(const FluentFace& face) {
    const auto name = content_.names.find(face.zone);
    return mesh_.add_marker(name == content_.names.end() ? "zone:" + std::to_string(face.zone)
                                                         : name->second);
}

// Returns the points round a cell, in the direction of its first side; some sides may be written
// the other way round. The list is empty if the sides do not form one polygon, or if there are
// none. Sides are found by their sorted ends, as a cell may have any number of sides.
std::vector<std::int32_t> polygon_of(const std::vector<std::array<std::int32_t, 2>>& sides) {
    if (sides.empty()) return {};
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
    std::int32_t from = sides[0][0];
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

void FluentMesh::add_polygon(std::int32_t cell) {
    std::vector<std::array<std::int32_t, 2>> sides;  // with the cell on the left
    for (std::size_t k = start_[place(cell)]; k < start_[place(cell) + 1]; ++k) {
        const FluentFace& face = content_.faces[faces_[k]];
        const std::int32_t* const nodes = content_.nodes_of(face);
        const bool is_left = face.cells[0] != cell;
        sides.push_back({nodes[is_left ? 0 : 1], nodes[is_left ? 1 : 0]});
    }
    const std::vector<std::int32_t> points = polygon_of(sides);
    if (points.size() < 3) {
        mesh_.file.fail(offset_of(cell),
                        "the faces of cell " + std::to_string(cell + 1) + " (" +
                            plural(static_cast<std::int64_t>(sides.size()), "face") +
                            ") do not form a polygon");
    }
    mesh_.add_cell(points, offset_of(cell));
}

void FluentMesh::build_flat() {
    mesh_.in_file.in_pairs = true;
    for (const FluentNode& node : content_.nodes)
        mesh_.add_point(node.x[0], node.x[1], node.offset[0]);
    for (std::int32_t cell = 0; cell < content_.n_cells; ++cell) add_polygon(cell);
    for (const FluentFace& face : content_.faces) {
        if (!is_boundary(face)) continue;
        const std::int32_t* const nodes = content_.nodes_of(face);
        mesh_.add_face(nodes[0], nodes[1], marker_of(face), face.offset);
    }
}

void FluentMesh::build_solid() {
    SpacePoints points;
    for (const FluentNode& node : content_.nodes) {
        for (std::size_t d = 0; d < 3; ++d) {
            points.x[d].push_back(node.x[d]);
            points.offset[d].push_back(node.offset[d]);
        }
    }
    OneCellThick solid(mesh_, std::move(points));
    for (std::int32_t cell = 0; cell < content_.n_cells; ++cell) {
        for (std::size_t k = start_[place(cell)]; k < start_[place(cell) + 1]; ++k) {
            const FluentFace& face = content_.faces[faces_[k]];
            solid.add_cell_face(content_.nodes_of(face), place(face.n));
        }
        solid.end_cell(offset_of(cell));
    }
    for (const FluentFace& face : content_.faces) {
        if (is_boundary(face))
            solid.add_side(content_.nodes_of(face), place(face.n), marker_of(face), face.offset);
    }
    solid.finish();
}

// The file begins with a bracket and the number of a section, or with settings in Scheme before the
// first such section.
bool probe_fluent(const TextFile& file) {
    if (trimmed(file.text().substr(0, 64)).substr(0, 1) != "(") return false;
    try {
        return FluentSections(file).next();
    } catch (const Failure&) {
        return false;
    }
}

void read_fluent(Mesh& mesh, const ReadOptions&) { FluentMesh(mesh).build(); }

}  // namespace

const Format fluent_format = {
    "fluent",     ".msh",      "Fluent, text and binary, two dimensions or one cell thick",
    probe_fluent, read_fluent, nullptr};

}  // namespace cli
