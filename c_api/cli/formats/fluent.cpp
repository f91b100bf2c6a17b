// Fluent's mesh files, in text and with binary sections (appendix "Mesh File Format" of the Fluent
// User's Guide), in two dimensions or one cell thick.
//
// Cells are given by their faces: in two dimensions a face goes from a node to another and has a
// cell on its right and one on its left, or none. Markers are the zones of boundary faces, with the
// names of the zones, or else "zone:NUMBER".
#include "basics/failure.hpp"
#include "basics/numbers.hpp"
#include "basics/place.hpp"
#include "formats/fluent_read.hpp"
#include "formats/fluent_sections.hpp"
#include "formats/format.hpp"
#include "mesh/one_cell_thick.hpp"

#include <algorithm>
#include <array>

namespace cli {

namespace {

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
