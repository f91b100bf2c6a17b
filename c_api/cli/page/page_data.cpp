#include "page/page_data.hpp"

#include "basics/geometry.hpp"
#include "basics/json.hpp"
#include "files/paths.hpp"
#include "formats/bytes.hpp"
#include "options/operators.hpp"
#include "page/page_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <ostream>
#include <queue>
#include <type_traits>
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
                const double longer = way + std::hypot(x, y);
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

    PageSelection select() {
        select_cells();
        selection_.in_cells = static_cast<std::int32_t>(selection_.points.size());
        if (selection_.cells.size() < place(mesh_.cells())) thin_the_rest();
        for (std::int32_t face = 0; face < mesh_.faces(); ++face) {
            const std::int32_t* ends = mesh_.face_points.data() + 2 * face;
            if (slot_[place(ends[0])] != unselected && slot_[place(ends[1])] != unselected)
                selection_.faces.push_back(face);
        }
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
    PageSelection selection_;
};

}  // namespace

PageSelection select_for_page(const Mesh& mesh, const std::vector<std::int32_t>& body,
                              std::int32_t max_points) {
    return Selector(mesh, body, max_points).select();
}

namespace {

// The bytes of numbers as text, the lowest byte first on any processor.
class Base64 {
public:
    template <class Number>
    void add(Number number) {
        using Bits = std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t>;
        Bits bits;
        std::memcpy(&bits, &number, sizeof bits);
        for (std::size_t i = 0; i < sizeof bits; ++i)
            bytes_ += static_cast<char>(bits >> (8 * i) & 255u);
    }
    std::string text() const { return encode_base64(bytes_); }

private:
    std::string bytes_;
};

template <class Number>
std::string base64(const Number* numbers, std::size_t n) {
    Base64 result;
    for (std::size_t i = 0; i < n; ++i) result.add(numbers[i]);
    return result.text();
}

template <class Number>
std::string base64(const std::vector<Number>& numbers) {
    return base64(numbers.data(), numbers.size());
}

class Writer {
public:
    Writer(const Mesh& mesh, const PageSubject& subject, const PageSelection& selection)
        : mesh_(mesh), subject_(subject), selection_(selection) {}

    // Adds everything except functions and displacements.
    JsonObject& run() {
        object_.add("version", std::string(hm_version())).add("mesh", last_name(mesh_.file.path()));
        object_.add("basis", last_name(subject_.basis));
        object_.add("all_points", mesh_.points()).add("all_cells", mesh_.cells());
        object_.add("points", static_cast<std::int64_t>(selection_.points.size()))
            .add("in_cells", selection_.in_cells);
        object_.add("cells", static_cast<std::int64_t>(selection_.cells.size()));
        object_.add("operator", std::string(operator_named(subject_.info.operator_kind).functions))
            .add("numbers", subject_.info.numbers_per_value);
        add_points();
        add_cells();
        add_boundary();
        add_curves();
        add_bodies();
        return object_;
    }

    // Adds the values at the points, function by function, and number by number of a function.
    void add_functions(const Basis& basis) {
        Base64 all;
        for (std::int32_t function = 0; function < basis.functions(); ++function) {
            for (std::int32_t number = 0; number < subject_.info.numbers_per_value; ++number) {
                const std::vector<double> values = basis.values(function, number, mesh_);
                for (const std::int32_t point : selection_.points) {
                    all.add(static_cast<float>(values[static_cast<std::size_t>(point)]));
                }
            }
        }
        object_.add("functions", all.text());
    }

    void add_displacement(const Field& displacement) {
        std::vector<double> dx, dy;
        for (const std::int32_t point : selection_.points) {
            dx.push_back(displacement.x[static_cast<std::size_t>(point)]);
            dy.push_back(displacement.y[static_cast<std::size_t>(point)]);
        }
        add_array("dx", dx);
        add_array("dy", dy);
    }

private:
    template <class Number>
    void add_array(const char* key, const std::vector<Number>& numbers) {
        object_.add(key, base64(numbers));
    }

    void add_points() {
        std::vector<double> x, y;
        for (const std::int32_t point : selection_.points) {
            x.push_back(mesh_.x[static_cast<std::size_t>(point)]);
            y.push_back(mesh_.y[static_cast<std::size_t>(point)]);
        }
        add_array("point", selection_.points);
        add_array("x", x);
        add_array("y", y);
    }

    void add_cells() {
        std::vector<std::int32_t> slot(mesh_.x.size(), -1), start = {0}, points;
        for (std::size_t k = 0; k < selection_.points.size(); ++k) {
            slot[static_cast<std::size_t>(selection_.points[k])] = static_cast<std::int32_t>(k);
        }
        for (const std::int32_t cell : selection_.cells) {
            const auto c = static_cast<std::size_t>(cell);
            for (std::int32_t i = mesh_.cell_start[c]; i < mesh_.cell_start[c + 1]; ++i) {
                const std::int32_t point = mesh_.cell_points[static_cast<std::size_t>(i)];
                points.push_back(slot[static_cast<std::size_t>(point)]);
            }
            start.push_back(static_cast<std::int32_t>(points.size()));
        }
        add_array("cell", selection_.cells);
        object_.add("has_polygons", mesh_.has_polygons);
        add_array("cell_start", start);
        add_array("cell_points", points);
        std::vector<std::int32_t> faces, markers, edges;
        for (const std::int32_t face : selection_.faces) {
            for (std::int32_t end = 0; end < 2; ++end) {
                const std::int32_t point =
                    mesh_.face_points[static_cast<std::size_t>(2 * face + end)];
                faces.push_back(slot[static_cast<std::size_t>(point)]);
            }
            markers.push_back(mesh_.face_markers[static_cast<std::size_t>(face)]);
        }
        for (const Edge edge : selection_.edges) edges.insert(edges.end(), {edge.a, edge.b});
        add_array("face_points", faces);
        add_array("face_markers", markers);
        add_array("thin_edges", edges);
    }

    // Adds the condition on each marker, in the numbering of the faces.
    void add_boundary() {
        static const char* const kinds[] = {"curve", "rigid",    "fixed", "slip",
                                            "free",  "periodic", "given", "rotation"};
        std::vector<hm_condition> conditions(mesh_.markers.size());
        std::vector<std::int32_t> across(mesh_.markers.size(), -1);  // of sliding interfaces
        for (hm_condition& condition : conditions) condition.kind = HM_FIXED;
        for (const hm_condition& condition : subject_.conditions) {
            const auto marker = static_cast<std::size_t>(condition.marker);
            if (condition.kind != HM_INTERFACE) {
                conditions[marker] = condition;
                continue;
            }
            across[marker] = condition.partner;
            across[static_cast<std::size_t>(condition.partner)] = condition.marker;
        }
        std::vector<JsonObject> markers;
        for (std::size_t i = 0; i < conditions.size(); ++i) {
            const hm_condition& condition = conditions[i];
            markers.emplace_back()
                .add("name", mesh_.markers[i])
                .add("kind", std::string(kinds[condition.kind]));
            markers.back()
                .add("first_curve", condition.first_curve)
                .add("n_curves", condition.n_curves)
                .add("body", condition.body)
                .add("across", across[i]);
        }
        object_.add("markers", markers);
    }

    void add_curves() {
        const hm_curves& curves = subject_.curves;
        const auto n = static_cast<std::size_t>(curves.n_control);
        object_.add("control", base64(curves.control, 2 * n));
        object_.add("weights",
                    curves.weights == nullptr ? std::string() : base64(curves.weights, n));
        std::vector<JsonObject> list;
        for (std::int32_t i = 0; i < curves.n_curves && n > 0; ++i) {
            const hm_curve& curve = curves.curve[i];
            std::vector<std::int32_t> indices;
            for (std::int32_t k = 0; k < curve.n_indices; ++k) {
                indices.push_back(curve.indices == nullptr ? k
                                                           : curve.indices[k] - curves.index_base);
            }
            const auto n_knots = static_cast<std::size_t>(curve.n_indices + curve.degree + 1);
            list.emplace_back().add("degree", curve.degree).add("indices", base64(indices));
            list.back().add("knots", base64(curve.knots, n_knots));
        }
        object_.add("curves", list);
    }

    void add_bodies() {
        std::vector<JsonObject> bodies(static_cast<std::size_t>(subject_.info.bodies));
        const auto add_body = [&](const hm_condition& condition) {
            JsonObject& body = bodies[static_cast<std::size_t>(condition.body)];
            body.add("marker", mesh_.name_of(condition));
            body.add("x", condition.x).add("y", condition.y);
        };
        for_each_body(subject_.conditions, subject_.info.bodies, add_body);
        object_.add("bodies", bodies);
    }

    const Mesh& mesh_;
    const PageSubject& subject_;
    const PageSelection& selection_;
    JsonObject object_;
};

// Escapes "<", because a tag in the name of a marker could end the script.
std::string for_script(std::string json) {
    for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos;)
        json.replace(at, 1, "\\u003c");
    return json;
}

}  // namespace

void write_page_data(std::ostream& out, const Mesh& mesh, const Basis& basis,
                     const PageSelection& selection, const std::string& moves) {
    const PageSubject subject = {basis.path(), basis.info(), basis.curves(), basis.conditions()};
    Writer writer(mesh, subject, selection);
    JsonObject& object = writer.run();
    writer.add_functions(basis);
    out << for_script(object.add("moves", moves).text());
}

void write_report(std::ostream& out, const Mesh& mesh, const PageSubject& subject,
                  const std::vector<std::int32_t>& body, const MovedMesh& moved) {
    const PageSelection selection = select_for_page(mesh, body, 20000);
    Writer writer(mesh, subject, selection);
    JsonObject& object = writer.run();
    writer.add_displacement(moved.displacement);
    object.add("functions", std::string())
        .add("moved", base64(moved.moves))
        .add("refusal", moved.refusal);
    object.add("inverted", moved.quality.inverted)
        .add("self_crossing", moved.quality.self_crossing != 0);
    object.add("admissible_step", std::min(moved.step.admissible, moved.step.boundary))
        .add("limiting_cell", moved.step.cell);
    object.add("min_quality", moved.quality.min_quality)
        .add("mean_quality", moved.quality.mean_quality);
    object.add("worst_cell", moved.quality.min_quality_cell)
        .add("boundary_error", moved.boundary_error)
        .add("boundary_error_note", moved.boundary_error_note);
    object.add("safe", moved.is_safe)
        .add("strategy", moved.safe.strategy)
        .add("steps", moved.safe.steps);
    object.add("resolves", moved.safe.resolves).add("step_fraction", moved.safe.step_fraction);
    object.add("untangled", moved.safe.untangled);
    out << page_head << report_page.before_data
        << "<script>\nconst page_data = " << for_script(object.text()) << ";\n</script>\n"
        << report_page.after_data;
}

}  // namespace cli
