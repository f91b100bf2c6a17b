// Files from outside vary: sections in any order, tabs, carriage returns, "KEY=value" and "KEY= value", two counts after
// NPOIN, 2 to 4 numbers per point, elements with or without their number, periodic blocks and FFD boxes between or after.
#include "su2.hpp"

#include "numbers.hpp"

#include <algorithm>
#include <set>

namespace cli {

namespace {

enum { element_vertex = 1, element_line = 3, element_triangle = 5, element_quad = 9 }; // VTK's numbers

struct Heading { // a line KEY= value
    std::string key;
    std::string_view value;
};

class Su2Reader {
public:
    explicit Su2Reader(Mesh& mesh) : mesh_(mesh), lines_(mesh.file, '%') {}
    void read();

private:
    using Words = std::vector<std::string_view>;

    bool read_section(const Heading& heading);
    void read_dimension(const Heading& heading);
    void read_zones(const Heading& heading);
    void read_points(const Heading& heading);
    void read_cells(const Heading& heading);
    void read_marker(const Heading& heading);
    void read_face(const Words& words, std::int32_t marker);
    void pass_over_periodic(std::int32_t n);
    void pass_over_section(const std::string& key);

    bool at_heading() const { return lines_.line().find('=') != std::string_view::npos; }
    Heading heading() const;
    void only_once(const Heading& heading);
    std::int32_t count(const Heading& heading) const;
    std::int32_t add_marker(std::string_view tag);
    const Words& data_line(const std::string& what, std::int32_t index, std::int32_t n);
    void append_points(const Words& words, std::size_t n, std::vector<std::int32_t>& points) const;
    void remark(const std::string& text);

    void check_complete() const;
    void check_indices() const;
    void check_point(std::int32_t point, std::size_t offset) const;

    Mesh& mesh_;
    LineReader lines_;
    std::set<std::string> seen_; // sections that may stand only once
    std::int32_t markers_announced_ = 0, markers_found_ = 0;
};

void Su2Reader::read() {
    bool understood = true; // lines after a heading that is not are passed over
    while (lines_.next()) {
        if (at_heading()) {
            understood = read_section(heading());
        } else if (understood) {
            lines_.expected("a heading such as NPOIN= or MARKER_TAG=");
        }
    }
    check_complete();
    check_indices();
}

bool Su2Reader::read_section(const Heading& heading) {
    if (heading.key == "NDIME") {
        read_dimension(heading);
    } else if (heading.key == "NZONE" || heading.key == "IZONE") {
        read_zones(heading);
    } else if (heading.key == "NPOIN") {
        read_points(heading);
    } else if (heading.key == "NELEM") {
        read_cells(heading);
    } else if (heading.key == "NMARK") {
        only_once(heading);
        markers_announced_ = count(heading);
    } else if (heading.key == "MARKER_TAG") {
        read_marker(heading);
    } else {
        pass_over_section(heading.key);
        return false;
    }
    return true;
}

void Su2Reader::read_dimension(const Heading& heading) {
    only_once(heading);
    if (count(heading) != 2) lines_.expected("NDIME= 2 (meshes of two dimensions)");
}

void Su2Reader::read_zones(const Heading& heading) {
    if (count(heading) != 1) lines_.expected("a single zone (NZONE= 1): files of several zones are not read");
}

void Su2Reader::read_points(const Heading& heading) {
    only_once(heading);
    const std::int32_t n = count(heading);
    for (std::int32_t point = 0; point < n; ++point) {
        const Words& words = data_line("point", point, n);
        if (words.size() < 2 || words.size() > 4) lines_.expected("a point: x, y and at most two numbers more");
        double xyz[4];
        for (std::size_t i = 0; i < words.size(); ++i) {
            if (!parse(words[i], xyz[i])) lines_.expected("a finite number", words[i]);
        }
        mesh_.x.push_back(xyz[0]);
        mesh_.y.push_back(xyz[1]);
        mesh_.point_offset.push_back(lines_.offset(words[0]));
    }
}

void Su2Reader::read_cells(const Heading& heading) {
    only_once(heading);
    const std::int32_t n = count(heading);
    for (std::int32_t cell = 0; cell < n; ++cell) {
        const Words& words = data_line("element", cell, n);
        std::int32_t type = 0;
        if (!parse(words[0], type) || (type != element_triangle && type != element_quad)) {
            lines_.expected("element type 5 (triangle) or 9 (quadrilateral)", words[0]);
        }
        append_points(words, type == element_triangle ? 3 : 4, mesh_.cell_points);
        mesh_.cell_start.push_back(static_cast<std::int32_t>(mesh_.cell_points.size()));
        mesh_.cell_offset.push_back(lines_.offset());
    }
}

void Su2Reader::read_marker(const Heading& heading) {
    ++markers_found_;
    if (heading.value.empty()) lines_.fail("expected the marker's name after MARKER_TAG=");
    const std::string_view tag = heading.value;
    if (!lines_.next() || this->heading().key != "MARKER_ELEMS") lines_.expected("MARKER_ELEMS=");
    const std::int32_t n = count(this->heading());
    if (tag == "SEND_RECEIVE") return pass_over_periodic(n);
    const std::int32_t marker = add_marker(tag);
    for (std::int32_t face = 0; face < n; ++face) read_face(data_line("element", face, n), marker);
}

void Su2Reader::read_face(const Words& words, std::int32_t marker) {
    std::int32_t type = 0;
    if (!parse(words[0], type) || (type != element_line && type != element_vertex)) {
        lines_.expected("element type 3 (line) in a marker", words[0]);
    }
    if (type == element_vertex) {
        remark("vertex elements of marker " + quoted(mesh_.markers[static_cast<std::size_t>(marker)]) + " are ignored");
        return;
    }
    append_points(words, 2, mesh_.face_points);
    mesh_.face_markers.push_back(marker);
    mesh_.face_offset.push_back(lines_.offset());
}

// Pairs of points that other programs take for one, of the form: SEND_RECV= 1, then lines "1 point transformation".
void Su2Reader::pass_over_periodic(std::int32_t n) {
    remark("periodic SEND_RECEIVE blocks are ignored (and kept)");
    for (std::int32_t i = 0; i < n; ++i) {
        const bool sign_first = lines_.next() && i == 0 && heading().key == "SEND_RECV";
        if (sign_first) lines_.next();
        if (lines_.line().empty() || at_heading()) {
            lines_.expected("element " + std::to_string(i + 1) + " of " + std::to_string(n));
        }
    }
}

void Su2Reader::pass_over_section(const std::string& key) {
    if (key.compare(0, 3, "FFD") == 0) {
        remark("FFD boxes are kept as they are: they do not move with the mesh");
    } else if (key.find("PERIODIC") != std::string::npos) {
        remark("sections about periodic boundaries are ignored (and kept)");
    } else {
        remark("section " + quoted(key) + " is ignored (and kept)");
    }
}

Heading Su2Reader::heading() const {
    const std::size_t equals = lines_.line().find('=');
    if (equals == std::string_view::npos) return {};
    return {std::string(trimmed(lines_.line().substr(0, equals))), trimmed(lines_.line().substr(equals + 1))};
}

void Su2Reader::only_once(const Heading& heading) {
    if (!seen_.insert(heading.key).second) {
        lines_.fail(heading.key + "= stands here a second time: files of several zones are not read");
    }
}

std::int32_t Su2Reader::count(const Heading& heading) const {
    std::int32_t value = 0;
    const std::string_view first = heading.value.substr(0, heading.value.find_first_of(" \t"));
    if (!parse(first, value) || value < 0) {
        lines_.expected("a count after " + heading.key + "=");
    }
    return value;
}

std::int32_t Su2Reader::add_marker(std::string_view tag) {
    const auto found = std::find(mesh_.markers.begin(), mesh_.markers.end(), tag);
    const auto marker = static_cast<std::int32_t>(found - mesh_.markers.begin());
    if (found == mesh_.markers.end()) mesh_.markers.emplace_back(tag);
    return marker;
}

const Su2Reader::Words& Su2Reader::data_line(const std::string& what, std::int32_t index, std::int32_t n) {
    if (!lines_.next() || at_heading()) {
        lines_.expected(what + " " + std::to_string(index + 1) + " of " + std::to_string(n));
    }
    return lines_.words();
}

// After the type come n points and, in most files, the element's number.
void Su2Reader::append_points(const Words& words, std::size_t n, std::vector<std::int32_t>& points) const {
    if (words.size() < n + 1 || words.size() > n + 2) {
        lines_.expected("element type " + std::string(words[0]) + ", " + std::to_string(n) +
                        " points and at most one number more");
    }
    for (std::size_t i = 1; i < words.size(); ++i) {
        std::int32_t point = 0;
        if (!parse(words[i], point)) lines_.expected("a whole number", words[i]);
        if (i <= n) points.push_back(point);
    }
}

void Su2Reader::remark(const std::string& text) {
    if (std::find(mesh_.remarks.begin(), mesh_.remarks.end(), text) == mesh_.remarks.end()) mesh_.remarks.push_back(text);
}

void Su2Reader::check_complete() const {
    for (const char* key : {"NDIME", "NELEM", "NPOIN"}) {
        if (seen_.count(key) == 0) lines_.expected(std::string(key) + "=");
    }
    if (markers_found_ < markers_announced_) {
        lines_.expected(plural(markers_announced_, "MARKER_TAG= block") + " as NMARK says (there are " +
                        std::to_string(markers_found_) + ")");
    }
}

void Su2Reader::check_indices() const {
    for (std::size_t cell = 0; cell < mesh_.cell_offset.size(); ++cell) {
        for (std::int32_t i = mesh_.cell_start[cell]; i < mesh_.cell_start[cell + 1]; ++i) {
            check_point(mesh_.cell_points[static_cast<std::size_t>(i)], mesh_.cell_offset[cell]);
        }
    }
    for (std::size_t i = 0; i < mesh_.face_points.size(); ++i) {
        check_point(mesh_.face_points[i], mesh_.face_offset[i / 2]);
    }
}

void Su2Reader::check_point(std::int32_t point, std::size_t offset) const {
    if (point >= 0 && point < mesh_.points()) return;
    mesh_.file.fail(offset, "expected points between 0 and " + std::to_string(mesh_.points() - 1) + ", found " +
                                std::to_string(point));
}

} // namespace

Mesh read_su2(const std::string& path) {
    Mesh mesh(path);
    Su2Reader(mesh).read();
    return mesh;
}

} // namespace cli
