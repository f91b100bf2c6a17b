#include "page/report_data.hpp"

#include "basics/json.hpp"
#include "files/paths.hpp"
#include "options/operators.hpp"
#include "page/numbers_as_text.hpp"
#include "page/page_text.hpp"

#include <algorithm>
#include <ostream>

namespace cli {

namespace {

class Writer {
public:
    Writer(const Mesh& mesh, const ReportSubject& subject, const ReportSelection& selection)
        : mesh_(mesh), subject_(subject), selection_(selection) {}

    // Adds everything except displacements.
    JsonObject& run() {
        object_.add("version", std::string(hm_version())).add("mesh", last_name(mesh_.file.path()));
        object_.add("all_cells", mesh_.cells())
            .add("cells", static_cast<std::int64_t>(selection_.cells.size()));
        object_.add("operator", std::string(operator_named(subject_.info.operator_kind).functions))
            .add("n_control", subject_.curves.n_control);
        add_points();
        add_cells();
        add_boundary();
        add_bodies();
        return object_;
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
        object_.add(key, numbers_as_text(numbers));
    }

    void add_points() {
        std::vector<double> x, y;
        for (const std::int32_t point : selection_.points) {
            x.push_back(mesh_.x[static_cast<std::size_t>(point)]);
            y.push_back(mesh_.y[static_cast<std::size_t>(point)]);
        }
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

    // Adds the name of each marker, in the numbering of the faces, and the kind of its condition.
    void add_boundary() {
        static const char* const kinds[] = {"curve", "rigid",    "fixed", "slip",
                                            "free",  "periodic", "given", "rotation"};
        std::vector<std::int32_t> kind(mesh_.markers.size(), HM_FIXED);
        for (const hm_condition& condition : subject_.conditions) {
            if (condition.kind != HM_INTERFACE)
                kind[static_cast<std::size_t>(condition.marker)] = condition.kind;
        }
        std::vector<JsonObject> markers;
        for (std::size_t i = 0; i < kind.size(); ++i) {
            markers.emplace_back()
                .add("name", mesh_.markers[i])
                .add("kind", std::string(kinds[kind[i]]));
        }
        object_.add("markers", markers);
    }

    void add_bodies() {
        std::vector<JsonObject> bodies(static_cast<std::size_t>(subject_.info.bodies));
        const auto add_body = [&](const hm_condition& condition) {
            bodies[static_cast<std::size_t>(condition.body)].add("marker",
                                                                 mesh_.name_of(condition));
        };
        for_each_body(subject_.conditions, subject_.info.bodies, add_body);
        object_.add("bodies", bodies);
    }

    const Mesh& mesh_;
    const ReportSubject& subject_;
    const ReportSelection& selection_;
    JsonObject object_;
};

}  // namespace

void write_report(std::ostream& out, const Mesh& mesh, const ReportSubject& subject,
                  const std::vector<std::int32_t>& body, const MovedMesh& moved) {
    const ReportSelection selection = select_for_report(mesh, body, 20000);
    Writer writer(mesh, subject, selection);
    JsonObject& object = writer.run();
    writer.add_displacement(moved.displacement);
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
