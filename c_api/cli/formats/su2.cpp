// SU2 mesh files (https://su2code.github.io/docs_v7/Mesh-File): two dimensions, triangles and
// quadrilaterals.
#include "formats/su2.hpp"

#include "basics/failure.hpp"
#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "basics/text_out.hpp"
#include "files/memory.hpp"
#include "files/threads.hpp"
#include "files/text_file.hpp"
#include "formats/number_reader.hpp"

#include <algorithm>
#include <cstdint>
#include <ostream>
#include <set>
#include <string>

namespace cli {

namespace {

bool probe_su2(const TextFile& file) {
    LineReader lines(file, '%');
    if (!lines.next()) return false;
    const std::string_view line = lines.line().substr(0, 64);
    const std::size_t equals = line.find('=');
    const std::string_view key = trimmed(line.substr(0, equals));
    const bool is_tecplot = key == "TITLE" || key == "VARIABLES" || key == "ZONE";
    return equals != std::string_view::npos && !is_tecplot &&
           key.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_") == std::string::npos;
}

void create_su2(std::ostream& out, const Mesh& mesh) {
    mesh.refuse_polygons("SU2");
    out << "NDIME= 2\nNELEM= " << mesh.cells() << '\n';
    write_rows(out, mesh.cell_start.size() - 1, mesh.threads, [&](std::size_t cell, TextOut& to) {
        const std::int32_t begin = mesh.cell_start[cell], end = mesh.cell_start[cell + 1];
        to << static_cast<int>(end - begin == 3 ? element_triangle : element_quad);
        for (std::int32_t i = begin; i < end; ++i)
            to << ' ' << mesh.cell_points[static_cast<std::size_t>(i)];
        to << ' ' << cell << '\n';
    });
    out << "NPOIN= " << mesh.points() << '\n';
    write_rows(out, mesh.x.size(), mesh.threads, [&](std::size_t point, TextOut& to) {
        to << mesh.x[point] << ' ' << mesh.y[point] << ' ' << point << '\n';
    });
    out << "NMARK= " << mesh.markers.size() << '\n';
    for (std::size_t marker = 0; marker < mesh.markers.size(); ++marker) {
        const auto number = static_cast<std::int32_t>(marker);
        out << "MARKER_TAG= " << mesh.markers[marker] << "\nMARKER_ELEMS= " << mesh.faces(number)
            << '\n';
        for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
            if (mesh.face_markers[face] != number) continue;
            out << static_cast<int>(element_line) << ' ' << mesh.face_points[2 * face] << ' '
                << mesh.face_points[2 * face + 1] << '\n';
        }
    }
}

}  // namespace

const Format su2_format = {"su2", ".su2", "SU2", probe_su2, read_su2, create_su2, true, "%"};

// Reads SU2 files.
//
// Files differ: sections are in any order; there may be tabs, carriage returns, "KEY=value" and
// "KEY= value", two counts after NPOIN, 2 to 4 numbers per point, elements with or without their
// number, and periodic blocks and FFD boxes between or after them. One of
// several zones (NZONE, IZONE) is read; a morphed mesh keeps the lines of the others.

namespace {

// The rows of points and cells of SU2 files, as read_plain_rows() reads them into a mesh.

// Rows "x y", with up to two whole numbers more.
struct Su2PointRows {
    Mesh& mesh;

    std::int64_t items(PlainRow) const { return 0; }
    void resize(TableEnd end) {
        const auto n = static_cast<std::size_t>(end.rows);
        mesh.x.resize(n);
        mesh.y.resize(n);
        mesh.point_offset.resize(n);
    }
    bool read(PlainRow& row, TableEnd& end) {
        row.over_blanks();
        const auto point = static_cast<std::size_t>(end.rows);
        std::int32_t number = 0;
        const std::size_t x_offset = row.offset();
        if (!row.real(mesh.x[point]) || !row.real(mesh.y[point])) return false;
        for (int more = 0; more < 2 && row.at_digit(); ++more) {
            if (!row.whole(number)) return false;
        }
        mesh.point_offset[point] = x_offset;
        if (!row.end_of_line()) return false;
        ++end.rows;
        return true;
    }
};

// Rows "type points [number]".
struct Su2CellRows {
    Mesh& mesh;

    static std::int64_t corners(std::int32_t type) {
        return type == element_triangle ? 3 : type == element_quad ? 4 : 0;
    }
    std::int64_t items(PlainRow row) const {
        std::int32_t type = 0;
        row.over_blanks();
        return row.whole(type) ? corners(type) : 0;
    }
    void resize(TableEnd end) {
        mesh.cell_start.resize(static_cast<std::size_t>(end.rows) + 1);
        mesh.cell_offset.resize(static_cast<std::size_t>(end.rows));
        mesh.cell_points.resize(static_cast<std::size_t>(end.items));
    }
    bool read(PlainRow& row, TableEnd& end) {
        row.over_blanks();
        const std::size_t offset = row.offset();
        std::int32_t type = 0;
        if (!row.whole(type) || corners(type) == 0) return false;
        const std::int64_t after = end.items + corners(type);
        for (std::int64_t k = end.items; k < after; ++k) {
            if (!row.whole(mesh.cell_points[static_cast<std::size_t>(k)])) return false;
        }
        if (row.at_digit() && !row.whole(type)) return false;
        if (!row.end_of_line()) return false;
        mesh.cell_offset[static_cast<std::size_t>(end.rows)] = offset;
        ++end.rows;
        end.items = after;
        mesh.cell_start[static_cast<std::size_t>(end.rows)] = static_cast<std::int32_t>(after);
        return true;
    }
};

// The zones of an SU2 file, of which one is read (NZONE= and IZONE=).

class Su2Zones {
public:
    // chosen: the number of the zone to read, or empty if the file must have only one.
    explicit Su2Zones(const std::string& chosen) : chosen_(chosen) {}

    void choose(const LineReader& lines, std::int32_t count);  // at NZONE=
    // At IZONE=. Returns whether this zone is the one to read. Refuses zones that are not numbered
    // 1, 2, ...
    bool begin(const LineReader& lines, std::int32_t zone);
    bool has_begun() const { return begun_ > 0; }
    void check_complete(const TextFile& file) const;  // at the end of the file

private:
    const std::string& chosen_;
    std::int32_t count_ = 1, number_ = 1, begun_ = 0;
    bool is_announced_ = false;
    std::size_t line_ = 0;  // the place of NZONE=
};

void Su2Zones::choose(const LineReader& lines, std::int32_t count) {
    count_ = count;
    is_announced_ = true;
    line_ = lines.offset();
    if (chosen_.empty() && count_ > 1) {
        lines.fail("the file has " + std::to_string(count_) +
                   " zones; choose one with --zone (the others stay as they are)");
    }
    if (chosen_.empty()) return;
    if (!parse(chosen_, number_) || number_ < 1 || number_ > count_) {
        throw Failure(exit_usage, "--zone expects a number between 1 and " +
                                      std::to_string(count_) + ", not " + in_quotes(chosen_));
    }
}

bool Su2Zones::begin(const LineReader& lines, std::int32_t zone) {
    if (zone != ++begun_ || zone > count_) {
        lines.expected("IZONE= " + std::to_string(begun_) + " of the " + plural(count_, "zone") +
                       " that NZONE= announces");
    }
    return zone == number_;
}

void Su2Zones::check_complete(const TextFile& file) const {
    if (!is_announced_) refuse_zone_of_one(chosen_);
    if (count_ <= 1 || begun_ >= count_) return;
    file.fail(line_, "NZONE= announces " + std::to_string(count_) + " zones, but the file has " +
                         plural(begun_, "line") + " IZONE=");
}

struct Heading {  // a line KEY= value
    std::string key;
    std::string_view value;
};

// Tells whether the key is MARKER_TAG, MARKERTAG or MARKER TAG, between which SU2 does not
// distinguish.
bool is_marker_tag(const std::string& key) {
    std::string letters;
    for (const char c : key) letters += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    letters.erase(
        std::remove_if(letters.begin(), letters.end(), [](char c) { return c < 'A' || c > 'Z'; }),
        letters.end());
    return letters == "MARKERTAG";
}

bool is_transfer(const std::string& key) {
    return key.compare(0, 4, "SEND") == 0 || key.compare(0, 4, "RECE") == 0;
}

class Su2Reader {
public:
    Su2Reader(Mesh& mesh, const ReadOptions& options)
        : mesh_(mesh), lines_(mesh.file, '%'), zones_(options.zone) {}
    void read();

private:
    using Words = std::vector<std::string_view>;

    bool read_section(const Heading& heading);
    void read_dimension(const Heading& heading);
    template <class Table, class ReadRow>
    void read_rows(std::int64_t n, Table table, const ReadRow& read_row);
    void read_points(const Heading& heading);
    void read_cells(const Heading& heading);
    void read_marker(const Heading& heading);
    void read_face(const Words& words, std::int32_t marker);
    void pass_over_halo(std::int32_t n);
    void pass_over_section(const std::string& key);

    bool at_heading() const { return lines_.line().find('=') != std::string_view::npos; }
    Heading heading() const;
    void refuse_repeated(const Heading& heading);
    std::int32_t count(const Heading& heading) const;
    const Words& data_line(const std::string& what, std::int32_t index, std::int32_t n);
    const std::vector<std::int32_t>& points_of(const Words& words, std::size_t n);

    void check_complete() const;

    Mesh& mesh_;
    LineReader lines_;
    Su2Zones zones_;
    bool dimension_before_zones_ = false;
    std::vector<std::int32_t> points_;  // the points of one element
    std::set<std::string> seen_;        // sections that may occur only once
    std::int32_t markers_announced_ = 0, markers_found_ = 0;
};

void Su2Reader::read() {
    bool understood = true;   // lines after an unknown heading are ignored
    bool other_zone = false;  // the lines belong to a zone that is not read
    while (lines_.next()) {
        if (at_heading()) {
            const Heading here = heading();
            if (here.key == "IZONE") other_zone = !zones_.begin(lines_, count(here));
            if (!other_zone) understood = here.key == "IZONE" || read_section(here);
        } else if (understood && !other_zone) {
            lines_.expected("a heading such as NPOIN= or MARKER_TAG=");
        }
    }
    check_complete();
}

bool Su2Reader::read_section(const Heading& heading) {
    if (heading.key == "NDIME") {
        read_dimension(heading);
    } else if (heading.key == "NZONE") {
        refuse_repeated(heading);
        zones_.choose(lines_, count(heading));
    } else if (heading.key == "NPOIN") {
        read_points(heading);
    } else if (heading.key == "NELEM") {
        read_cells(heading);
    } else if (heading.key == "NMARK") {
        refuse_repeated(heading);
        markers_announced_ = count(heading);
    } else if (is_marker_tag(heading.key)) {
        read_marker(heading);
    } else {
        pass_over_section(heading.key);
        return false;
    }
    return true;
}

// NDIME= may occur before NZONE=, and again in each zone.
void Su2Reader::read_dimension(const Heading& heading) {
    if (zones_.has_begun() && dimension_before_zones_) seen_.erase(heading.key);
    dimension_before_zones_ = !zones_.has_begun();
    refuse_repeated(heading);
    if (count(heading) != 2) lines_.expected("NDIME= 2 (meshes of two dimensions)");
}

// Rows that are not plain are read one by one, and twice as many each time, so that a table without
// plain rows does not take long. read_row(row) reads one row, and returns its items.
template <class Table, class ReadRow>
void Su2Reader::read_rows(std::int64_t n, Table table, const ReadRow& read_row) {
    TableEnd done;
    for (std::int64_t slowly = 1; done.rows < n; slowly *= 2) {
        std::size_t at = lines_.next_offset();
        read_plain_rows(mesh_.file.text(), at, n, mesh_.threads, table, done);
        lines_.jump(at);
        for (std::int64_t k = 0; k < slowly && done.rows < n; ++k, ++done.rows)
            done.items += read_row(static_cast<std::int32_t>(done.rows));
    }
}

void Su2Reader::read_points(const Heading& heading) {
    refuse_repeated(heading);
    const std::int32_t n = count(heading);
    const std::size_t max_rows =
        std::min(place(n), mesh_.file.text().size() / 4);  // "0 0" and its end
    reserve_by_threads(mesh_.x, max_rows, mesh_.threads);
    reserve_by_threads(mesh_.y, max_rows, mesh_.threads);
    reserve_by_threads(mesh_.point_offset, max_rows, mesh_.threads);
    mesh_.in_file.in_pairs = true;
    read_rows(n, Su2PointRows{mesh_}, [&](std::int32_t point) {
        const Words& words = data_line("point", point, n);
        if (words.size() < 2 || words.size() > 4)
            lines_.expected("a point: x, y and at most two numbers more");
        double xyz[4];
        for (std::size_t i = 0; i < words.size(); ++i) {
            if (!parse(words[i], xyz[i])) lines_.expected("a finite number", words[i]);
        }
        mesh_.add_point(xyz[0], xyz[1], lines_.offset(words[0]));
        return 0;
    });
}

void Su2Reader::read_cells(const Heading& heading) {
    refuse_repeated(heading);
    const std::int32_t n = count(heading);
    const std::size_t max_rows = std::min(place(n), mesh_.file.text().size() / 8);  // "5 0 1 2"
    reserve_by_threads(mesh_.cell_start, max_rows + 1, mesh_.threads);
    reserve_by_threads(mesh_.cell_offset, max_rows, mesh_.threads);
    reserve_by_threads(mesh_.cell_points, 4 * max_rows, mesh_.threads);
    read_rows(n, Su2CellRows{mesh_}, [&](std::int32_t cell) {
        const Words& words = data_line("element", cell, n);
        std::int32_t type = 0;
        if (!parse(words[0], type) || (type != element_triangle && type != element_quad)) {
            lines_.expected("element type 5 (triangle) or 9 (quadrilateral)", words[0]);
        }
        const std::int64_t corners = Su2CellRows::corners(type);
        mesh_.add_cell(points_of(words, static_cast<std::size_t>(corners)), lines_.offset());
        return corners;
    });
}

void Su2Reader::read_marker(const Heading& heading) {
    ++markers_found_;
    if (heading.value.empty())
        lines_.fail("the file needs the name of the marker after MARKER_TAG=");
    const std::string_view tag = heading.value;
    if (!lines_.next() || this->heading().key != "MARKER_ELEMS") lines_.expected("MARKER_ELEMS=");
    const std::int32_t n = count(this->heading());
    if (tag == "SEND_RECEIVE") return pass_over_halo(n);
    const std::int32_t marker = mesh_.add_marker(tag);
    for (std::int32_t face = 0; face < n; ++face) read_face(data_line("element", face, n), marker);
}

void Su2Reader::read_face(const Words& words, std::int32_t marker) {
    std::int32_t type = 0;
    if (!parse(words[0], type) || (type != element_line && type != element_vertex)) {
        lines_.expected("element type 3 (line) in a marker", words[0]);
    }
    if (type == element_vertex) {
        mesh_.remark("vertex elements of marker " +
                     in_quotes(mesh_.markers[static_cast<std::size_t>(marker)]) + " are ignored");
        return;
    }
    const std::vector<std::int32_t>& ends = points_of(words, 2);
    mesh_.add_face(ends[0], ends[1], marker, lines_.offset());
}

// Passes over points that are shared with other parts or periodic partners: first SEND_RECV= 1, or
// SEND_TO= 1, RECEIVE_FROM= 1, ...; then n lines such as "1 point transformation".
void Su2Reader::pass_over_halo(std::int32_t n) {
    mesh_.remark_ignored("SEND_RECEIVE blocks");
    mesh_.likely_fault =
        "the file has SEND_RECEIVE blocks: halo layers of a periodic or divided mesh, "
        "whose outer edges are on no marker; make the mesh without halo layers";
    for (std::int32_t i = 0; i < n; ++i) {
        bool there = lines_.next();
        while (there && i == 0 && at_heading() && is_transfer(heading().key)) there = lines_.next();
        if (!there || at_heading())
            lines_.expected("element " + std::to_string(i + 1) + " of " + std::to_string(n));
    }
}

void Su2Reader::pass_over_section(const std::string& key) {
    if (key.compare(0, 3, "FFD") == 0) {
        mesh_.remark("FFD boxes are kept as they are: they do not move with the mesh");
    } else if (key.find("PERIODIC") != std::string::npos) {
        mesh_.remark_ignored("sections about periodic boundaries");
    } else {
        mesh_.remark_ignored("section " + in_quotes(key));
    }
}

Heading Su2Reader::heading() const {
    const std::size_t equals = lines_.line().find('=');
    if (equals == std::string_view::npos) return {};
    return {std::string(trimmed(lines_.line().substr(0, equals))),
            trimmed(lines_.line().substr(equals + 1))};
}

void Su2Reader::refuse_repeated(const Heading& heading) {
    if (!seen_.insert(heading.key).second) {
        lines_.fail(heading.key + "= appears here for the second time in one mesh or zone");
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

const Su2Reader::Words& Su2Reader::data_line(const std::string& what, std::int32_t index,
                                             std::int32_t n) {
    if (!lines_.next() || at_heading()) {
        lines_.expected(what + " " + std::to_string(index + 1) + " of " + std::to_string(n));
    }
    return lines_.words();
}

// Returns the n points after the type. In most files, the number of the element follows.
const std::vector<std::int32_t>& Su2Reader::points_of(const Words& words, std::size_t n) {
    if (words.size() < n + 1 || words.size() > n + 2) {
        lines_.expected("element type " + std::string(words[0]) + ", " + std::to_string(n) +
                        " points and at most one number more");
    }
    points_.clear();
    for (std::size_t i = 1; i < words.size(); ++i) {
        std::int64_t number = 0;
        if (!parse(words[i], number)) lines_.expected("a whole number", words[i]);
        if (i > n) continue;
        if (number < INT32_MIN || number > INT32_MAX) lines_.expected("a point's number", words[i]);
        points_.push_back(static_cast<std::int32_t>(number));
    }
    return points_;
}

void Su2Reader::check_complete() const {
    zones_.check_complete(mesh_.file);
    for (const char* key : {"NDIME", "NELEM", "NPOIN"}) {
        if (seen_.count(key) == 0) lines_.expected(std::string(key) + "=");
    }
    if (markers_found_ < markers_announced_) {
        lines_.expected(plural(markers_announced_, "MARKER_TAG= block") +
                        " as NMARK says (there are " + std::to_string(markers_found_) + ")");
    }
}

}  // namespace

void read_su2(Mesh& mesh, const ReadOptions& options) { Su2Reader(mesh, options).read(); }

}  // namespace cli
