#include "formats/tidy.hpp"

#include "basics/numbers.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace cli {

namespace {

using EdgeKey = std::uint64_t;  // of two points, either way round

EdgeKey edge_of(std::int32_t a, std::int32_t b) {
    const auto low = static_cast<std::uint32_t>(std::min(a, b)),
               high = static_cast<std::uint32_t>(std::max(a, b));
    return std::uint64_t{high} << 32 | low;
}

template <class Visit>
void for_each_edge(const Mesh& mesh, Visit visit) {  // visit(from, to), once for each cell
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        const std::int32_t* points = mesh.cell_points.data() + mesh.cell_start[cell];
        const std::int32_t n = mesh.cell_start[cell + 1] - mesh.cell_start[cell];
        for (std::int32_t i = 0; i < n; ++i) visit(points[i], points[i + 1 < n ? i + 1 : 0]);
    }
}

}  // namespace

void check_points(const Mesh& mesh) {
    const auto check = [&mesh](std::int32_t point, const std::vector<std::size_t>& offsets,
                               std::size_t item) {
        if (point >= 0 && point < mesh.points()) return;
        const std::size_t offset = item < offsets.size() ? offsets[item] : 0;
        const std::string last = std::to_string(mesh.points() - 1), found = std::to_string(point);
        mesh.file.fail(offset, "expected points between 0 and " + last + ", found " + found);
    };
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        for (std::int32_t i = mesh.cell_start[cell]; i < mesh.cell_start[cell + 1]; ++i) {
            check(mesh.cell_points[static_cast<std::size_t>(i)], mesh.cell_offset, cell);
        }
    }
    for (std::size_t i = 0; i < mesh.face_points.size(); ++i)
        check(mesh.face_points[i], mesh.face_offset, i / 2);
}

void drop_interior_faces(Mesh& mesh, bool remark) {
    std::unordered_map<EdgeKey, int> cells_at;  // cells beside each face
    std::vector<char> on_face(mesh.x.size());
    for (std::size_t i = 0; i < mesh.face_points.size(); i += 2) {
        const std::int32_t a = mesh.face_points[i], b = mesh.face_points[i + 1];
        cells_at[edge_of(a, b)] = 0;
        on_face[static_cast<std::size_t>(a)] = on_face[static_cast<std::size_t>(b)] = 1;
    }
    for_each_edge(mesh, [&](std::int32_t a, std::int32_t b) {
        if (!on_face[static_cast<std::size_t>(a)] || !on_face[static_cast<std::size_t>(b)]) return;
        const auto face = cells_at.find(edge_of(a, b));
        if (face != cells_at.end()) ++face->second;
    });
    std::vector<std::int32_t> dropped(mesh.markers.size());
    std::size_t kept = 0;
    for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
        const std::int32_t a = mesh.face_points[2 * face], b = mesh.face_points[2 * face + 1];
        if (cells_at[edge_of(a, b)] > 1) {
            ++dropped[static_cast<std::size_t>(mesh.face_markers[face])];
            continue;
        }
        mesh.face_points[2 * kept] = a;
        mesh.face_points[2 * kept + 1] = b;
        mesh.face_markers[kept] = mesh.face_markers[face];
        if (!mesh.face_offset.empty()) mesh.face_offset[kept] = mesh.face_offset[face];
        ++kept;
    }
    mesh.face_points.resize(2 * kept);
    mesh.face_markers.resize(kept);
    if (!mesh.face_offset.empty()) mesh.face_offset.resize(kept);
    for (std::size_t marker = 0; marker < dropped.size(); ++marker) {
        if (dropped[marker] == 0 || !remark) continue;
        mesh.remark(plural(dropped[marker], "face") + " of marker " +
                    in_quotes(mesh.markers[marker]) + " between two cells: ignored (and kept)");
    }
}

void drop_empty_markers(Mesh& mesh) {
    std::vector<std::int32_t> number(mesh.markers.size(), -1);
    for (const std::int32_t marker : mesh.face_markers)
        number[static_cast<std::size_t>(marker)] = 0;
    std::int32_t kept = 0;
    for (std::size_t marker = 0; marker < number.size(); ++marker) {
        if (number[marker] < 0) continue;
        number[marker] = kept;
        mesh.markers[static_cast<std::size_t>(kept++)] = mesh.markers[marker];
    }
    mesh.markers.resize(static_cast<std::size_t>(kept));
    for (std::int32_t& marker : mesh.face_markers)
        marker = number[static_cast<std::size_t>(marker)];
}

void name_open_boundary(Mesh& mesh, const std::string& name) {
    // Edges of cells by their lower point: those there once, and without a marker, are open.
    std::vector<std::size_t> start(mesh.x.size() + 1);
    const auto low = [](std::int32_t a, std::int32_t b) {
        return static_cast<std::size_t>(std::min(a, b));
    };
    const auto n = static_cast<std::int32_t>(mesh.x.size());
    const auto exists = [n](std::int32_t a, std::int32_t b) {
        return a >= 0 && b >= 0 && a < n && b < n;
    };
    const auto for_each_side =
        [&](auto visit) {  // and each face, which is a second cell beside an edge
            for_each_edge(mesh, [&](std::int32_t a, std::int32_t b) {
                if (exists(a, b)) visit(a, b);
            });
            for (std::size_t i = 0; i < mesh.face_points.size(); i += 2) {
                if (exists(mesh.face_points[i], mesh.face_points[i + 1]))
                    visit(mesh.face_points[i], mesh.face_points[i + 1]);
            }
        };
    for_each_side([&](std::int32_t a, std::int32_t b) { ++start[low(a, b) + 1]; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::pair<std::int32_t, std::int32_t>> sides(start.back());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for_each_side([&](std::int32_t a, std::int32_t b) { sides[next[low(a, b)]++] = {a, b}; });

    // Points of one loop have one root.
    std::vector<std::int32_t> parent(mesh.x.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&parent](std::int32_t point) {
        while (parent[static_cast<std::size_t>(point)] != point) {
            std::int32_t& up = parent[static_cast<std::size_t>(point)];
            point = up = parent[static_cast<std::size_t>(up)];
        }
        return point;
    };
    std::vector<std::pair<std::int32_t, std::int32_t>> open;
    for (std::size_t point = 0; point < mesh.x.size(); ++point) {
        const auto key = [](const std::pair<std::int32_t, std::int32_t>& side) {
            return edge_of(side.first, side.second);
        };
        const auto begin = sides.begin() + static_cast<std::ptrdiff_t>(start[point]);
        const auto end = sides.begin() + static_cast<std::ptrdiff_t>(start[point + 1]);
        std::sort(begin, end, [key](const auto& a, const auto& b) { return key(a) < key(b); });
        for (auto side = begin; side != end; ++side) {
            if (side != begin && key(side[-1]) == key(side[0])) continue;
            if (side + 1 != end && key(side[1]) == key(side[0])) continue;
            open.push_back(*side);
            const std::int32_t a = root(side->first), b = root(side->second);
            parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
        }
    }
    if (open.empty()) return;
    std::vector<std::int32_t> roots;
    for (const auto& edge : open) roots.push_back(root(edge.first));
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
    for (const auto& edge : open) {
        const auto loop =
            std::lower_bound(roots.begin(), roots.end(), root(edge.first)) - roots.begin();
        mesh.face_points.insert(mesh.face_points.end(), {edge.first, edge.second});
        mesh.face_markers.push_back(mesh.add_marker(name + std::to_string(loop + 1)));
    }
    mesh.face_offset.resize(mesh.face_markers.size());
    const std::string edges = plural(static_cast<std::int64_t>(open.size()), "boundary edge");
    mesh.remark(edges + " without a marker: named " + name + "1, ... loop by loop");
}

}  // namespace cli
