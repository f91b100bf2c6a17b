// harmorph check: tests whether a mesh is well formed, and reports size and quality.
#include "basics/geometry.hpp"
#include "basics/json.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "curves/curve_file.hpp"
#include "files/output_file.hpp"
#include "mesh/boundary_pieces.hpp"
#include "mesh/loops.hpp"
#include "mesh/mesh_analysis.hpp"
#include "options/place_options.hpp"
#include "pictures/pictures.hpp"
#include "work/read_mesh.hpp"

#include <harmorph_study.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace cli {

namespace {

std::vector<JsonObject> json_of_pieces(const Mesh& mesh) {
    std::vector<JsonObject> objects;
    for (const BoundarySegment& piece : marker_pieces(mesh)) {
        objects.emplace_back();
        objects.back()
            .add("name", mesh.markers[place(piece.marker)])
            .add("faces", piece.faces)
            .add("loop", piece.loop + 1)
            .add("closed", piece.is_closed)
            .add("body", piece.is_of_body)
            .add("x", mesh.x[place(piece.point)])
            .add("y", mesh.y[place(piece.point)])
            .add("low_x", piece.box.low.x)
            .add("high_x", piece.box.high.x)
            .add("low_y", piece.box.low.y)
            .add("high_y", piece.box.high.y);
    }
    return objects;
}

void print_json(const hm_mesh_report& report, const Mesh& mesh) {
    std::vector<JsonObject> markers;
    for (std::size_t marker = 0; marker < mesh.markers.size(); ++marker) {
        markers.emplace_back();
        markers.back()
            .add("name", mesh.markers[marker])
            .add("faces", mesh.faces(static_cast<std::int32_t>(marker)));
    }
    JsonObject object;
    object.add("points", report.points).add("cells", report.cells);
    object.add("triangles", report.triangles)
        .add("quads", report.quads)
        .add("polygons", report.polygons);
    object.add("inverted", report.inverted);
    object.add("min_area", report.min_area).add("min_quality", report.min_quality);
    object.add("mean_quality", report.mean_quality).add("markers", markers);
    object.add("pieces", json_of_pieces(mesh));
    print("%s\n", object.text().c_str());
}

// Prints all markers. If there are many, prints the first ones and the loops that the markers form.
void print_markers(const Mesh& mesh) {
    constexpr std::size_t max_printed = 20;
    const std::size_t n = mesh.markers.size(), printed = n > max_printed ? max_printed / 2 : n;
    for (std::size_t marker = 0; marker < printed; ++marker) {
        print("marker        %s: %s\n", mesh.markers[marker].c_str(),
              plural(mesh.faces(static_cast<std::int32_t>(marker)), "face").c_str());
    }
    if (printed == n) return;
    print("marker        ... and %s more\n", std::to_string(n - printed).c_str());
    const BoundaryLoops loops = loops_of(mesh);
    const std::vector<Box> boxes = boxes_of_loops(loops, mesh);
    std::vector<std::int32_t> faces(boxes.size());
    for (const std::int32_t loop : loops.of_edge) ++faces[place(loop)];
    for (std::size_t loop = 0; loop < boxes.size() && loop < max_printed; ++loop) {
        const Box& box = boxes[loop];
        print("loop          loop:%s: %s, x = %s .. %s, y = %s .. %s\n",
              std::to_string(loop + 1).c_str(), plural(faces[loop], "face").c_str(),
              brief(box.low.x).c_str(), brief(box.high.x).c_str(), brief(box.low.y).c_str(),
              brief(box.high.y).c_str());
    }
}

void print_for_people(const hm_mesh_report& report, const Mesh& mesh) {
    print("points        %d, %d of them in cells\n", report.points, report.used_points);
    const std::string polygons =
        report.polygons == 0 ? "" : ", " + plural(report.polygons, "polygon");
    print("cells         %d: %s, %s%s\n", report.cells,
          plural(report.triangles, "triangle").c_str(), plural(report.quads, "quad").c_str(),
          polygons.c_str());
    print("edges         %d, %d of them boundary in %s\n", report.edges, report.boundary_edges,
          plural(report.boundary_loops, "loop").c_str());
    print_markers(mesh);
    for (const auto& [one, other] : mesh.interfaces)
        print("interface     %s and %s slide along each other\n", one.c_str(), other.c_str());
    print("corner areas  %s at least\n", brief(report.min_area).c_str());
    print("skew quality  %s at least, %s on average\n", brief(report.min_quality).c_str(),
          brief(report.mean_quality).c_str());
    print("inverted      %d\n", report.inverted);
}

// Draws the mesh, or volumes around some points of the mesh.
void write_picture(const Arguments& arguments, const Mesh& mesh) {
    const std::optional<Box> window = window_of(arguments);
    OutputFiles files;
    std::ostream& out = files.add(arguments.text("--svg"));
    const auto points = [&](const char* option) {
        return arguments.whole_list(option, 0, mesh.points() - 1);
    };
    if (arguments.has("--dual-volumes")) {
        out << volume_picture(mesh, points("--dual-volumes"), Volume::dual, window);
    } else if (arguments.has("--gradient-volumes")) {
        out << volume_picture(mesh, points("--gradient-volumes"), Volume::gradient, window);
    } else {
        Curves curves;
        for (const std::string& path : arguments.all("--curve")) curves.append(read_curves(path));
        out << mesh_picture(mesh, arguments.has("--boundaries"), *CurvesView(curves).get(), window);
    }
    files.commit();
}

// Makes the further checks of `harmorph solve`, as if the displacements of the whole boundary were
// given. The whole boundary is one marker here, as the time grows with the number of conditions.
void check_as_solve_does(const Mesh& mesh) {
    const std::vector<std::int32_t> one_marker(mesh.face_markers.size(), 0);
    hm_mesh view = mesh.view();
    view.face_markers = one_marker.data();
    auto condition = sized<hm_condition>();
    condition.kind = HM_GIVEN;
    auto problem = sized<hm_problem>();
    problem.mesh = &view;
    problem.n_conditions = 1;
    problem.conditions = &condition;
    hm_error error = {};
    hm_analysis* analysis = nullptr;
    hm_memory memory = {};
    if (one_marker.empty()) return;
    if (hm_analysis_init(nullptr, &memory, &problem, nullptr, &error) < 0) return;
    Block block(memory.bytes);
    memory.block = block.data();
    if (hm_analysis_init(&analysis, &memory, &problem, nullptr, &error) == HM_BAD_MESH)
        refuse(error, mesh);
}

}  // namespace

void run_check(const Arguments& arguments) {
    const Mesh mesh = read_mesh(arguments, 0);
    const hm_mesh_report report = MeshAnalysis(mesh).report();
    if (arguments.has("--json")) {
        print_json(report, mesh);
    } else {
        print_for_people(report, mesh);
    }
    if (arguments.has("--svg")) write_picture(arguments, mesh);
    if (report.inverted == 0) return check_as_solve_does(mesh);
    const std::size_t first = mesh.cell_offset[static_cast<std::size_t>(report.first_inverted)];
    throw Failure(exit_unusable,
                  mesh.file.place(first) + ": cell " + std::to_string(report.first_inverted) +
                      " is inverted, the first of " + std::to_string(report.inverted));
}

}  // namespace cli
