// harmorph align: moves a mesh until its body has the shape of the body of a reference mesh, and
// brings the fields of the mesh to the points of the reference mesh.
#include "basics/json.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "mesh/mesh_analysis.hpp"
#include "work/mesh_fields.hpp"
#include "work/morph.hpp"
#include "work/read_mesh.hpp"
#include "work/solver.hpp"
#include "work/task.hpp"
#include "work/to_airfoil.hpp"

#include <harmorph_design.h>

#include <memory>

namespace cli {

namespace {

// Returns the boundary points of a marker in order.
Section outline(const Mesh& mesh, const std::string& marker) {
    const BoundaryPiece piece = MeshAnalysis(mesh).boundary(mesh.find_markers(marker));
    Section section;
    section.is_loop = piece.is_loop;
    for (const std::int32_t point : piece.points) {
        section.x.push_back(mesh.x[static_cast<std::size_t>(point)]);
        section.y.push_back(mesh.y[static_cast<std::size_t>(point)]);
    }
    return section;
}

Curves fitted(const Mesh& mesh, const Section& section, std::int32_t control_points) {
    auto options = sized<hm_fit_options>();
    options.n_control = control_points;
    options.closed = HM_CLOSED_AUTO;
    const auto n = static_cast<std::int32_t>(section.x.size());
    Block block;
    const hm_curves* curves = nullptr;
    const hm_points points = {section.x.data(), section.y.data(), 1};
    with_memory(block, [&](hm_memory* memory) {
        return call(mesh, hm_fit, &curves, memory, &points, n, std::int32_t{section.is_loop},
                    &options, nullptr);
    });
    return copied(*curves);
}

Task task_on(const Mesh& mesh, const std::string& marker, const Curves& curves) {
    Task task;
    task.curves = curves;
    for (const std::int32_t number : mesh.find_markers(marker)) {
        auto condition = sized<hm_condition>();
        condition.marker = number;
        condition.kind = HM_ON_CURVE;
        condition.n_curves = static_cast<std::int32_t>(curves.curves.size());
        task.conditions.push_back(condition);
    }
    return task;
}

// Returns the columns of --fields, and the coordinates of the points before the mesh moved.
std::vector<Column> fields_to_bring(const Arguments& arguments, const Mesh& mesh) {
    std::vector<Column> fields;
    if (arguments.has("--fields"))
        fields = read_fields(arguments.text("--fields"), arguments.all("--field"), mesh,
                             arguments.has("--in-order"));
    for (const Column& field : fields)
        if (field.name == "from_x" || field.name == "from_y")
            arguments.refuse("a field cannot have the name " + field.name +
                             ", which --fields-out gives to the coordinates before");
    fields.push_back({"from_x", mesh.x});
    fields.push_back({"from_y", mesh.y});
    return fields;
}

void report(const Arguments& arguments, const Morph& morph, const ToAirfoil& airfoil) {
    if (arguments.has("--json")) {
        JsonObject object;
        object.add("steps", morph.safe.steps).add("min_quality", morph.quality.min_quality);
        object.add("max_distance", airfoil.max_error).add("rms_distance", airfoil.rms_error);
        print("%s\n", object.text().c_str());
        return;
    }
    print("steps            %d, smallest quality %s\n", morph.safe.steps,
          brief(morph.quality.min_quality).c_str());
    print("distance         %s chord at most between the moved curve and the reference's points\n",
          brief(airfoil.max_error / airfoil.chord).c_str());
}

}  // namespace

void run_align(const Arguments& arguments) {
    const std::string &to = arguments.text("--to"), &marker = arguments.text("--marker");
    if (arguments.has("--fields") && !arguments.has("--fields-out"))
        arguments.refuse("--fields needs --fields-out");
    if (!arguments.has("-o") && !arguments.has("--fields-out"))
        arguments.refuse("-o or --fields-out is required");
    const Mesh mesh = read_mesh(arguments, 0), reference = read_mesh(to);
    const std::vector<Column> fields = fields_to_bring(arguments, mesh);
    const Section target =
        outline(reference, arguments.has("--to-marker") ? arguments.text("--to-marker") : marker);
    const Threads threads(threads_of(arguments));
    const Curves curves =
        fitted(mesh, outline(mesh, marker), arguments.whole("--points", 20, 4, INT32_MAX));
    const Task task = task_on(mesh, marker, curves);
    Solver solver(mesh, task, threads);
    solver.run();
    const Basis basis(solver.basis(), mesh);
    const ToAirfoil airfoil = moves_to_airfoil(basis, 0, target, to, false);
    // Fields follow the points, so that better cells are not worth a detour of the points.
    auto options = sized<hm_safe_options>();
    options.min_quality = -1;  // the first valid mesh
    const Morph morph(basis, mesh, airfoil.moves, options, basis.info().operator_kind, threads);
    if (!morph.valid() || !morph.refusal.empty()) {
        throw Failure(exit_unusable, mesh.file.path() + " cannot be moved to the shape of " + to +
                                         ": " + morph.refusal);
    }
    OutputFiles files;
    if (arguments.has("-o"))
        warn_of(arguments.text("-o"), write_moved(files, mesh, arguments.text("-o"),
                                                  morph.moved.x.data(), morph.moved.y.data()));
    if (arguments.has("--fields-out")) {
        const Interpolated found = interpolated(mesh, morph.moved, fields, reference, threads);
        judge_outside(arguments, found, mesh.file.path(), to);
        write_fields(files, arguments.text("--fields-out"), reference, found.fields);
    }
    files.commit();
    report(arguments, morph, airfoil);
}

}  // namespace cli
