#include "mesh/tidy.hpp"

#include "basics/numbers.hpp"
#include "files/threads.hpp"
#include "mesh/loops.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>

namespace cli {

namespace {

using EdgeKey = std::uint64_t;  // identifies the edge between two points in both directions

EdgeKey edge_of(std::int32_t a, std::int32_t b) {
    const auto low = static_cast<std::uint32_t>(std::min(a, b)),
               high = static_cast<std::uint32_t>(std::max(a, b));
    return std::uint64_t{high} << 32 | low;
}

// Removes pairs of edges (two points each) at the same place. Such a pair is a cut, as in the wake
// of a C-mesh or between the blocks of a grid; the library closes cuts whose edges have no marker.
void drop_cuts(Mesh& mesh, std::vector<std::int32_t>& edges) {
    std::unordered_map<std::int32_t, std::int32_t> place = points_by_place(mesh, edges);
    const auto ends_of = [&](std::size_t edge) {
        return edge_of(place[edges[2 * edge]], place[edges[2 * edge + 1]]);
    };
    std::vector<std::pair<EdgeKey, std::size_t>> order;
    for (std::size_t edge = 0; 2 * edge < edges.size(); ++edge)
        order.emplace_back(ends_of(edge), edge);
    std::sort(order.begin(), order.end());
    std::vector<char> is_cut(order.size(), 0);
    std::int64_t cuts = 0;
    for (std::size_t k = 1; k < order.size(); ++k) {
        if (order[k].first != order[k - 1].first) continue;
        is_cut[order[k].second] = is_cut[order[k - 1].second] = 1;
        ++cuts;
    }
    if (cuts == 0) return;
    std::size_t kept = 0;
    for (std::size_t edge = 0; edge < is_cut.size(); ++edge) {
        if (is_cut[edge]) continue;
        edges[2 * kept] = edges[2 * edge];
        edges[2 * kept + 1] = edges[2 * edge + 1];
        ++kept;
    }
    edges.resize(2 * kept);
    mesh.remark(plural(cuts, "pair") +
                " of boundary edges without a marker at the same places: they are a cut, which "
                "stays closed");
}

}  // namespace

void check_points(const Mesh& mesh) {
    const auto check = [&mesh](std::int32_t point, const std::vector<std::size_t>& offsets,
                               std::size_t item) {
        if (point >= 0 && point < mesh.points()) return;
        const std::size_t offset = item < offsets.size() ? offsets[item] : 0;
        const std::string last = std::to_string(mesh.points() - 1), found = std::to_string(point);
        mesh.file.fail(offset, "the file needs points between 0 and " + last + " here, but " +
                                   found + " follows");
    };
    // Threads find out whether there is a wrong point. Only then the first one is searched.
    const auto n = static_cast<std::uint32_t>(mesh.points());
    std::vector<char> is_wrong(static_cast<std::size_t>(mesh.threads));
    run_ranges(mesh.cell_points.size(), mesh.threads,
               [&](std::size_t begin, std::size_t end, std::size_t range) {
                   bool wrong = false;
                   for (std::size_t i = begin; i < end; ++i)
                       wrong |= static_cast<std::uint32_t>(mesh.cell_points[i]) >= n;
                   is_wrong[range] = wrong;
               });
    const bool any_wrong = std::find(is_wrong.begin(), is_wrong.end(), 1) != is_wrong.end();
    for (std::size_t cell = 0; any_wrong && cell + 1 < mesh.cell_start.size(); ++cell) {
        for (std::int32_t i = mesh.cell_start[cell]; i < mesh.cell_start[cell + 1]; ++i) {
            check(mesh.cell_points[static_cast<std::size_t>(i)], mesh.cell_offset, cell);
        }
    }
    for (std::size_t i = 0; i < mesh.face_points.size(); ++i)
        check(mesh.face_points[i], mesh.face_offset, i / 2);
}

void drop_interior_faces(Mesh& mesh, bool remark) {
    std::unordered_map<EdgeKey, int> cells_at;  // number of cells beside each face
    std::vector<char> on_face(mesh.x.size());
    for (std::size_t i = 0; i < mesh.face_points.size(); i += 2) {
        const std::int32_t a = mesh.face_points[i], b = mesh.face_points[i + 1];
        cells_at[edge_of(a, b)] = 0;
        on_face[static_cast<std::size_t>(a)] = on_face[static_cast<std::size_t>(b)] = 1;
    }
    // Few edges have both ends on faces. Each thread collects these edges of a range of cells.
    std::vector<std::vector<EdgeKey>> near(static_cast<std::size_t>(mesh.threads));
    run_ranges(
        mesh.cell_start.size() - 1, mesh.threads,
        [&](std::size_t begin, std::size_t end, std::size_t range) {
            for_each_side(mesh, begin, end, [&](std::int32_t a, std::int32_t b) {
                if (on_face[static_cast<std::size_t>(a)] && on_face[static_cast<std::size_t>(b)])
                    near[range].push_back(edge_of(a, b));
            });
        });
    for (const std::vector<EdgeKey>& edges : near) {
        for (const EdgeKey edge : edges) {
            const auto face = cells_at.find(edge);
            if (face != cells_at.end()) ++face->second;
        }
    }
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
    constexpr int max_named = 5;
    int named = 0;
    for (std::size_t marker = 0; marker < dropped.size(); ++marker) {
        if (dropped[marker] == 0 || !remark) continue;
        if (++named > max_named) {
            mesh.remark_ignored("faces of other markers between two cells");
            break;
        }
        mesh.remark_ignored(plural(dropped[marker], "face") + " of marker " +
                            in_quotes(mesh.markers[marker]) + " between two cells");
    }
}

void join_double_faces(Mesh& mesh) {
    std::vector<std::pair<EdgeKey, std::size_t>> order;
    for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
        order.emplace_back(edge_of(mesh.face_points[2 * face], mesh.face_points[2 * face + 1]),
                           face);
    }
    std::sort(order.begin(), order.end());
    std::vector<char> is_double(order.size(), 0);
    // The marker of faces that have several markers, for each set of markers.
    std::map<std::set<std::int32_t>, std::int32_t> joint;
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        std::set<std::int32_t> markers;
        for (end = begin; end < order.size() && order[end].first == order[begin].first; ++end) {
            markers.insert(mesh.face_markers[order[end].second]);
            is_double[order[end].second] = end > begin;
        }
        if (markers.size() == 1) continue;
        const auto known = joint.emplace(markers, -1);
        if (known.second) {
            std::string name;
            for (const std::int32_t marker : markers)
                name += (name.empty() ? "" : "+") + mesh.markers[static_cast<std::size_t>(marker)];
            for (const std::int32_t marker : markers)
                mesh.groups[mesh.markers[static_cast<std::size_t>(marker)]].push_back(name);
            known.first->second = mesh.add_marker(name);
        }
        mesh.face_markers[order[begin].second] = known.first->second;
    }
    std::size_t kept = 0;
    for (std::size_t face = 0; face < is_double.size(); ++face) {
        if (is_double[face]) continue;
        mesh.face_points[2 * kept] = mesh.face_points[2 * face];
        mesh.face_points[2 * kept + 1] = mesh.face_points[2 * face + 1];
        mesh.face_markers[kept] = mesh.face_markers[face];
        mesh.face_offset[kept] = mesh.face_offset[face];
        ++kept;
    }
    mesh.face_points.resize(2 * kept);
    mesh.face_markers.resize(kept);
    mesh.face_offset.resize(kept);
    for (const auto& [markers, name] : joint) {
        mesh.remark("some edges are in several groups: their marker is " +
                    in_quotes(mesh.markers[static_cast<std::size_t>(name)]) +
                    ", which each of the names selects; a converted mesh has this marker alone");
    }
    drop_empty_markers(mesh);
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
    // Edges of cells are sorted by their lower points. An edge of only one cell that has no marker
    // is open.
    std::vector<std::size_t> start(mesh.x.size() + 1);
    const auto low = [](std::int32_t a, std::int32_t b) {
        return static_cast<std::size_t>(std::min(a, b));
    };
    const auto n = static_cast<std::int32_t>(mesh.x.size());
    const auto exists = [n](std::int32_t a, std::int32_t b) {
        return a >= 0 && b >= 0 && a < n && b < n;
    };
    // Also visits faces, which count as a second cell beside an edge.
    const auto for_each_end = [&](auto visit) {
        for_each_side(mesh, 0, mesh.cell_start.size() - 1, [&](std::int32_t a, std::int32_t b) {
            if (exists(a, b)) visit(a, b);
        });
        for (std::size_t i = 0; i < mesh.face_points.size(); i += 2) {
            if (exists(mesh.face_points[i], mesh.face_points[i + 1]))
                visit(mesh.face_points[i], mesh.face_points[i + 1]);
        }
    };
    for_each_end([&](std::int32_t a, std::int32_t b) { ++start[low(a, b) + 1]; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::pair<std::int32_t, std::int32_t>> sides(start.back());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for_each_end([&](std::int32_t a, std::int32_t b) { sides[next[low(a, b)]++] = {a, b}; });

    std::vector<std::int32_t> open;  // two points of each edge
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
            open.insert(open.end(), {side->first, side->second});
        }
    }
    drop_cuts(mesh, open);
    if (open.empty()) return;
    const BoundaryLoops loops(joined_ends(mesh, open), n);
    for (std::size_t edge = 0; 2 * edge < open.size(); ++edge) {
        mesh.face_points.insert(mesh.face_points.end(), {open[2 * edge], open[2 * edge + 1]});
        mesh.face_markers.push_back(
            mesh.add_marker(name + std::to_string(loops.of_edge[edge] + 1)));
    }
    mesh.face_offset.resize(mesh.face_markers.size());
    const std::string edges = plural(static_cast<std::int64_t>(open.size() / 2), "boundary edge");
    mesh.remark(edges + " without a marker: named " + name + "1, ... loop by loop");
}

}  // namespace cli
