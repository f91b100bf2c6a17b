// AFLR's UGRID files
// (http://www.simcenter.msstate.edu/software/documentation/ug_io/3d_grid_file_type_ugrid.html), one
// cell thick, between planes of any direction or in a wedge: text, or binary of both byte orders
// (.b8, .lb8, .b4, .lb4). Markers are called after their tags in a .mapbc file beside the
// mesh, or else by the tags.
#include "basics/numbers.hpp"
#include "files/paths.hpp"
#include "formats/bytes.hpp"
#include "formats/format.hpp"
#include "formats/number_reader.hpp"
#include "mesh/one_cell_thick.hpp"

#include <map>

namespace cli {

namespace {

enum Count { nodes, triangles, quads, tetrahedra, pyramids, prisms, hexahedra, n_counts };
using Counts = std::array<std::int64_t, n_counts>;
constexpr std::size_t corners_of[n_counts] = {1, 3, 4, 4, 5, 6, 8};

struct Layout {
    bool is_text = true, swapped = false;
    int real_bytes = 8;
};

// Returns the number of whole numbers after the coordinates: points of faces, tags of faces and
// points of cells.
std::int64_t whole_numbers(const Counts& n) {
    return 4 * n[triangles] + 5 * n[quads] + 4 * n[tetrahedra] + 5 * n[pyramids] + 6 * n[prisms] +
           8 * n[hexahedra];
}

bool binary_counts(const TextFile& file, bool swapped, Counts& n) {
    if (file.text().size() < 4 * n_counts) return false;
    for (std::size_t i = 0; i < n_counts; ++i) {
        n[i] = load<std::int32_t>(file.text().data() + 4 * i, swapped);
        if (n[i] < 0) return false;
    }
    return n[nodes] > 0;
}

bool is_binary(const TextFile& file) {
    return file.text().substr(0, 4 * n_counts).find('\0') != std::string::npos;
}

// Returns the smallest size of a binary file of such a layout, in bytes. Files with grid levels are
// larger.
std::int64_t binary_size(const Counts& n, int real_bytes) {
    return 4 * n_counts + 3 * real_bytes * n[nodes] + 4 * whole_numbers(n);
}

bool find_layout(const TextFile& file, Layout& layout) {
    layout.is_text = !is_binary(file);
    Counts n = {};
    for (const bool swapped : {false, true}) {
        for (const int real_bytes : {8, 4}) {
            layout.swapped = swapped;
            layout.real_bytes = real_bytes;
            if (layout.is_text || !binary_counts(file, swapped, n)) continue;
            if (binary_size(n, real_bytes) == static_cast<std::int64_t>(file.text().size()))
                return true;
        }
    }
    return false;
}

// Returns the layout that fits the size of the file. If none fits, the name selects the layout.
Layout layout_of(const TextFile& file) {
    Layout layout;
    if (find_layout(file, layout) || layout.is_text) return layout;
    const bool little =
        ends_with(file.path(), ".lb8.ugrid") || ends_with(file.path(), ".lb4.ugrid");
    layout.swapped = little != little_endian_machine();
    layout.real_bytes = ends_with(file.path(), "b4.ugrid") ? 4 : 8;
    Counts n = {};
    const std::string kind = little ? "little-endian" : "big-endian";
    if (!binary_counts(file, layout.swapped, n))
        file.fail(0, "the file needs 7 counts in " + kind + " byte order, as the name says");
    const std::int64_t wanted = binary_size(n, layout.real_bytes);
    if (wanted > static_cast<std::int64_t>(file.text().size())) {
        const std::string announced =
            "of " + std::to_string(n[nodes]) + " nodes in " + kind + " byte order";
        const std::string found = std::to_string(file.text().size());
        file.fail(file.text().size(), announced + " the file would have " + std::to_string(wanted) +
                                          " bytes, but it has " + found);
    }
    return layout;
}

std::string mapbc_file(const std::string& mesh) {
    std::string path = without_ending(without_gz(mesh));  // .ugrid
    for (const char* kind : {".b8", ".lb8", ".b4", ".lb4"}) {
        if (ending_of(path) == kind) path = without_ending(path);
    }
    return path + ".mapbc";
}

std::map<std::int64_t, std::string> read_names(const std::string& mesh) {
    const std::string path = mapbc_file(mesh);
    std::map<std::int64_t, std::string> names;
    if (!exists(path)) return names;
    const TextFile file(path);
    LineReader lines(file, '!');
    if (!lines.next()) lines.expected("the number of boundaries");
    while (lines.next()) {
        const auto& words = lines.words();
        std::int64_t tag = 0;
        if (words.size() < 2 || !parse(words[0], tag))
            lines.expected("a boundary: tag, condition and name");
        names[tag] = words.size() > 2 ? std::string(words[2]) : std::string(words[0]);
    }
    return names;
}

class UgridReader {
public:
    UgridReader(Mesh& mesh, const Layout& layout)
        : mesh_(mesh), layout_(layout), numbers_(mesh.file) {
        numbers_.is_binary = !layout.is_text;
        numbers_.swapped = mesh.in_file.swapped = layout.swapped;
        if (!layout.is_text)
            mesh.in_file.kind = layout.real_bytes == 8 ? NumberKind::real64 : NumberKind::real32;
    }

    void read() {
        for (std::int64_t& n : counts_) n = numbers_.count("a count");
        if (counts_[nodes] == 0 || counts_[prisms] + counts_[hexahedra] == 0) {
            numbers_.fail("the mesh has no prisms and no hexahedra: it is not one cell thick");
        }
        OneCellThick thick(mesh_, read_points());
        read_sides(thick);
        for (const Count kind : {tetrahedra, pyramids, prisms, hexahedra}) {
            for (std::int64_t i = 0; i < counts_[kind]; ++i) {
                const std::size_t n = corners_of[kind];
                std::int32_t points[8];
                const std::size_t offset = read_item(points, n);
                if (kind == pyramids) {  // the base has the corners 1 4 5 2, the apex is 3
                    const std::int32_t apex = points[2];
                    points[2] = points[4];
                    points[4] = apex;
                    std::swap(points[1], points[3]);
                }
                thick.add_cell(points, n, offset);
            }
        }
        thick.finish();
    }

private:
    SpacePoints read_points() {
        SpacePoints space;
        for (std::int64_t i = 0; i < counts_[nodes]; ++i) {
            for (std::size_t d = 0; d < 3; ++d) {
                space.x[d].push_back(numbers_.real("a coordinate", layout_.real_bytes));
                space.offset[d].push_back(numbers_.number_offset());
            }
        }
        return space;
    }

    std::size_t read_item(std::int32_t* points, std::size_t n) {
        std::size_t offset = 0;
        for (std::size_t k = 0; k < n; ++k) {
            const std::int64_t point = numbers_.whole("a point");
            if (k == 0) offset = numbers_.number_offset();
            if (point < 1 || point > counts_[nodes]) {
                numbers_.fail("the file needs points between 1 and " +
                              std::to_string(counts_[nodes]) + " here, but " +
                              std::to_string(point) + " follows");
            }
            points[k] = static_cast<std::int32_t>(point) - 1;
        }
        return offset;
    }

    // The file lists all faces, and then the tags of all faces.
    void read_sides(OneCellThick& thick) {
        struct Side {
            std::int32_t points[4];
            std::size_t n, offset;
        };
        std::vector<Side> sides;
        for (const Count kind : {triangles, quads}) {
            for (std::int64_t i = 0; i < counts_[kind]; ++i) {
                Side side = {{}, kind == triangles ? 3u : 4u, 0};
                side.offset = read_item(side.points, side.n);
                sides.push_back(side);
            }
        }
        const std::map<std::int64_t, std::string> names = read_names(mesh_.file.path());
        for (const Side& side : sides) {
            const std::int64_t tag = numbers_.whole("a face's tag");
            const auto name = names.find(tag);
            const std::int32_t marker =
                mesh_.add_marker(name == names.end() ? std::to_string(tag) : name->second);
            thick.add_side(side.points, side.n, marker, side.offset);
        }
    }

    Mesh& mesh_;
    const Layout& layout_;
    NumberReader numbers_;
    Counts counts_ = {};
};

// A file in text has seven counts in the first line, and nothing else there.
bool probe_ugrid(const TextFile& file) {
    Layout layout;
    if (ends_with(file.path(), ".ugrid") || find_layout(file, layout)) return true;
    if (!layout.is_text) return false;
    LineReader lines(file, '#');
    if (!lines.next() || lines.words().size() != n_counts) return false;
    std::int32_t count = 0;
    for (const std::string_view word : lines.words()) {
        if (!parse(word, count) || count < 0) return false;
    }
    return true;
}

void read_ugrid(Mesh& mesh, const ReadOptions&) {
    const Layout layout = layout_of(mesh.file);
    UgridReader(mesh, layout).read();
}

}  // namespace

const Format ugrid_format = {
    "ugrid",     ".ugrid",   "UGRID, one cell thick: text, .b8, .lb8, .b4, .lb4",
    probe_ugrid, read_ugrid, nullptr,
    true,        "",         mapbc_file};

}  // namespace cli
