#include "page/report_selection.hpp"

#include "basics/elementary.hpp"
#include "basics/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

namespace cli {

namespace {

constexpr std::int32_t unselected = -1;

// Computes the length of the shortest path along edges of the mesh from given points to each point.
// The length is infinite if there is no path.
class Distances {
public:
    explicit Distances(const Mesh& mesh) : mesh_(mesh), start_(mesh.x.size() + 1) {
        const std::vector<Edge> edges = mesh_edges(mesh, [](Edge) { return true; });
        for (const Edge edge : edges) {
            ++start_[place(edge.a) + 1];
            ++start_[place(edge.b) + 1];
        }
        for (std::size_t k = 1; k < start_.size(); ++k) start_[k] += start_[k - 1];
        neighbour_.resize(2 * edges.size());
        std::vector<std::size_t> end(start_.begin(), start_.end() - 1);
        for (const Edge edge : edges) {
            neighbour_[end[place(edge.a)]++] = edge.b;
            neighbour_[end[place(edge.b)]++] = edge.a;
        }
    }

    // E. W. Dijkstra, Numer. Math. 1 (1959) 269.
    std::vector<double> from(const std::vector<std::int32_t>& points) const {
        std::vector<double> distance(mesh_.x.size(), std::numeric_limits<double>::infinity());
        std::priority_queue<Reached, std::vector<Reached>, std::greater<Reached>> front;
        for (const std::int32_t point : points) {
            distance[place(point)] = 0;
            front.push({0, point});
        }
        while (!front.empty()) {
            const auto [way, here] = front.top();
            front.pop();
            if (way > distance[place(here)]) continue;
            for (std::size_t i = start_[place(here)]; i < start_[place(here) + 1]; ++i) {
                const std::size_t next = place(neighbour_[i]);
                const double x = mesh_.x[next] - mesh_.x[place(here)],
                             y = mesh_.y[next] - mesh_.y[place(here)];
                const double longer = way + length_of(x, y);
                if (!(longer < distance[next])) continue;
                distance[next] = longer;
                front.push({longer, neighbour_[i]});
            }
        }
        return distance;
    }

private:
    using Reached = std::pair<double, std::int32_t>;

    const Mesh& mesh_;
    std::vector<std::size_t> start_;
    std::vector<std::int32_t> neighbour_;
};

class Selector {
public:
    Selector(const Mesh& mesh, const std::vector<std::int32_t>& body, std::int32_t max_points)
        : mesh_(mesh), slot_(mesh.x.size(), unselected) {
        is_whole_ = mesh.x.size() <= place(max_points);
        if (is_whole_) return;
        distance_ = Distances(mesh).from(body);
        std::vector<double> sorted = distance_;
        std::nth_element(sorted.begin(), sorted.begin() + max_points, sorted.end());
        reach_ = sorted[place(max_points)];
    }

    ReportSelection select() {
        select_cells();
        selection_.in_cells = static_cast<std::int32_t>(selection_.points.size());
        if (selection_.cells.size() < place(mesh_.cells())) thin_the_rest();
        return std::move(selection_);
    }

private:
    bool is_near(std::int32_t point) const { return is_whole_ || distance_[place(point)] < reach_; }

    bool is_in_cells(std::int32_t point) const {
        return slot_[place(point)] != unselected && slot_[place(point)] < selection_.in_cells;
    }

    void add(std::int32_t point) {
        if (slot_[place(point)] != unselected) return;
        slot_[place(point)] = static_cast<std::int32_t>(selection_.points.size());
        selection_.points.push_back(point);
    }

    void select_cells() {
        for (std::int32_t cell = 0; cell < mesh_.cells(); ++cell) {
            const auto begin = mesh_.cell_points.begin() + mesh_.cell_start[place(cell)];
            const auto end = mesh_.cell_points.begin() + mesh_.cell_start[place(cell) + 1];
            if (!std::all_of(begin, end, [this](std::int32_t point) { return is_near(point); }))
                continue;
            selection_.cells.push_back(cell);
            for (auto point = begin; point != end; ++point) add(*point);
        }
    }

    // Selects one point of each square of a grid, whose squares are larger far from the body. Two
    // such points are joined by an edge if a mesh edge connects their squares. All points of the
    // boundary are selected.
    void thin_the_rest() {
        for (const std::int32_t point : mesh_.face_points) add(point);
        const std::size_t max_stand_ins = place(selection_.in_cells) / 4 + 100;
        for (double share = 1.0 / 64; share < 16; share *= 1.5) {
            group(share);
            if (stand_ins_.size() <= max_stand_ins) break;
        }
        const auto outside = [this](Edge edge) {
            return !is_in_cells(edge.a) || !is_in_cells(edge.b);
        };
        const std::vector<Edge> edges = mesh_edges(mesh_, outside);
        for (const std::int32_t point : stand_ins_) add(point);
        for (const Edge edge : edges) {
            const std::int32_t a = stand_in(edge.a), b = stand_in(edge.b);
            if (a != b) selection_.edges.push_back({std::min(a, b), std::max(a, b)});
        }
        remove_repeats(selection_.edges);
    }

    // Makes squares whose sides are about `share` times the distance to the body. The distance is
    // positive, because all points on the body have been selected.
    void group(double share) {
        std::unordered_map<std::uint64_t, std::int32_t> first;
        stand_ins_.clear();
        group_.assign(mesh_.x.size(), unselected);
        for (std::size_t k = 0; k < mesh_.x.size(); ++k) {
            if (slot_[k] != unselected || !std::isfinite(distance_[k])) continue;
            const int level = std::ilogb(share * distance_[k]);
            const double side = std::ldexp(1.0, level);
            const auto column = static_cast<std::int64_t>(std::floor(mesh_.x[k] / side));
            const auto row = static_cast<std::int64_t>(std::floor(mesh_.y[k] / side));
            const std::uint64_t key = (static_cast<std::uint64_t>(level) << 54) ^
                                      ((static_cast<std::uint64_t>(column) & 0x7ffffff) << 27) ^
                                      (static_cast<std::uint64_t>(row) & 0x7ffffff);
            const auto found = first.try_emplace(key, static_cast<std::int32_t>(k));
            if (found.second) stand_ins_.push_back(static_cast<std::int32_t>(k));
            group_[k] = found.first->second;
        }
    }

    std::int32_t stand_in(std::int32_t point) const {
        const std::int32_t group = group_[place(point)];
        return slot_[place(group == unselected ? point : group)];
    }

    const Mesh& mesh_;
    bool is_whole_ = false;
    double reach_ = 0;
    std::vector<double> distance_;     // of each point from the body
    std::vector<std::int32_t> slot_;   // place of each point in the selection
    std::vector<std::int32_t> group_;  // the selected point in the square of each other point
    std::vector<std::int32_t> stand_ins_;
    ReportSelection selection_;
};

}  // namespace

ReportSelection select_for_report(const Mesh& mesh, const std::vector<std::int32_t>& body,
                                  std::int32_t max_points) {
    return Selector(mesh, body, max_points).select();
}

}  // namespace cli
