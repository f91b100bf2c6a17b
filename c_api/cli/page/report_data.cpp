#include "page/report_data.hpp"

#include "basics/json.hpp"
#include "files/paths.hpp"
#include "options/operators.hpp"
#include "page/numbers_as_text.hpp"
#include "page/page_text.hpp"

#include <algorithm>
#include <numeric>
#include <ostream>

namespace cli {

namespace {

class Writer {
public:
    Writer(const Mesh& mesh, const ReportSubject& subject, const ReportSelection& selection)
        : mesh_(mesh), subject_(subject), selection_(selection), slot_(mesh.x.size(), -1) {
        for (std::size_t k = 0; k < selection.points.size(); ++k)
            slot_[place(selection.points[k])] = static_cast<std::int32_t>(k);
    }

    JsonObject& run(const MovedMesh& moved) {
        object_.add("version", std::string(hm_version())).add("mesh", last_name(mesh_.file.path()));
        object_.add("all_cells", mesh_.cells())
            .add("cells", static_cast<std::int64_t>(selection_.cells.size()));
        object_.add("operator", std::string(operator_named(subject_.info.operator_kind).functions))
            .add("n_control", subject_.curves.n_control);
        add_points("x", mesh_.x);
        add_points("y", mesh_.y);
        add_points("dx", moved.displacement.x);
        add_points("dy", moved.displacement.y);
        add_cells(moved.judged);
        add_walls(moved.judged);
        add_bodies();
        return object_;
    }

private:
    template <class Number>
    void add_array(const char* key, const std::vector<Number>& numbers) {
        object_.add(key, numbers_as_text(numbers));
    }

    void add_points(const char* key, const std::vector<double>& of_mesh) {
        std::vector<double> values;
        for (const std::int32_t point : selection_.points) values.push_back(of_mesh[place(point)]);
        add_array(key, values);
    }

    void add_cells(const JudgedMesh& judged) {
        std::vector<std::int32_t> start = {0}, points, edges;
        for (const std::int32_t cell : selection_.cells) {
            const std::size_t first = place(mesh_.cell_start[place(cell)]),
                              end = place(mesh_.cell_start[place(cell) + 1]);
            for (std::size_t i = first; i < end; ++i)
                points.push_back(slot_[place(mesh_.cell_points[i])]);
            start.push_back(static_cast<std::int32_t>(points.size()));
        }
        add_array("cell", selection_.cells);
        add_array("cell_start", start);
        add_array("cell_points", points);
        for (const Edge edge : selection_.edges) edges.insert(edges.end(), {edge.a, edge.b});
        add_array("thin_edges", edges);
        const auto add_qualities = [this](const char* key, const std::vector<double>& all) {
            std::vector<double> values;
            for (const std::int32_t cell : selection_.cells) values.push_back(all[place(cell)]);
            add_array(key, values);
        };
        add_qualities("quality_before", judged.before);
        add_qualities("quality_after", judged.after);
        const std::vector<double>& before = judged.before;
        object_.add("min_quality_before", *std::min_element(before.begin(), before.end()));
        object_.add("mean_quality_before", std::accumulate(before.begin(), before.end(), 0.0) /
                                               static_cast<double>(before.size()));
    }

    void add_walls(const JudgedMesh& judged) {
        std::vector<JsonObject> walls, sections;
        for (const JudgedWall& wall : judged.walls) {
            const std::string& name = mesh_.markers[place(wall.marker)];
            std::vector<std::int32_t> points;
            for (const std::int32_t point : wall.points) points.push_back(slot_[place(point)]);
            walls.emplace_back()
                .add("marker", name)
                .add("closed", wall.is_closed)
                .add("points", numbers_as_text(points))
                .add("arc", numbers_as_text(wall.arc))
                .add("angle", numbers_as_text(wall.angle))
                .add("height", numbers_as_text(wall.height));
            if (!wall.is_closed) continue;
            const auto [before, now] = judged.measures(wall);
            sections.emplace_back()
                .add("name", name)
                .add("thickness", before.thickness)
                .add("thickness_now", now.thickness)
                .add("camber", before.camber)
                .add("camber_now", now.camber)
                .add("area", before.area)
                .add("area_now", now.area);
        }
        object_.add("walls", walls).add("sections", sections);
    }

    void add_bodies() {
        std::vector<JsonObject> bodies(static_cast<std::size_t>(subject_.info.bodies));
        const auto add_body = [&](const hm_condition& condition) {
            const std::string& whole = mesh_.markers[place(condition.marker)];
            bodies[place(condition.body)].add(
                "marker", condition.piece == 0 ? whole : mesh_.name_of(condition));
        };
        for_each_body(subject_.conditions, subject_.info.bodies, add_body);
        object_.add("bodies", bodies);
    }

    const Mesh& mesh_;
    const ReportSubject& subject_;
    const ReportSelection& selection_;
    std::vector<std::int32_t> slot_;  // of each mesh point in the selection, or -1
    JsonObject object_;
};

}  // namespace

void write_report(std::ostream& out, const Mesh& mesh, const ReportSubject& subject,
                  const std::vector<std::int32_t>& body, const MovedMesh& moved) {
    const ReportSelection selection = select_for_report(mesh, body, 20000);
    Writer writer(mesh, subject, selection);
    JsonObject& object = writer.run(moved);
    object.add("moved", numbers_as_text(moved.moves)).add("refusal", moved.refusal);
    object.add("inverted", moved.quality.inverted)
        .add("self_crossing", moved.quality.self_crossing != 0);
    object.add("admissible_step", std::min(moved.step.admissible, moved.step.boundary));
    object.add("min_quality", moved.quality.min_quality)
        .add("mean_quality", moved.quality.mean_quality);
    object.add("boundary_error", moved.boundary_error)
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
