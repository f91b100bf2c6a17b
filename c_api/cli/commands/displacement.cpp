#include "commands/displacement.hpp"

#include "basics/elementary.hpp"
#include "basics/json.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "commands/morph_report.hpp"
#include "formats/format.hpp"
#include "formats/vtu.hpp"
#include "page/report_data.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace cli {

namespace {

// Returns the largest distance of a wall point from the target that its given displacement leads
// to.
double distance_from_targets(const Mesh& mesh, const WallMovement& movement,
                             const Displacement& found) {
    double largest = 0;
    for (std::size_t k = 0; k < movement.wall.points.size(); ++k) {
        const auto point = static_cast<std::size_t>(movement.wall.points[k]);
        largest =
            std::max(largest, length_of(found.moved.x[point] - mesh.x[point] - movement.wall.x[k],
                                        found.moved.y[point] - mesh.y[point] - movement.wall.y[k]));
    }
    return largest;
}

}  // namespace

void Displacement::measure_boundary(const Mesh& mesh, const Solver& solver,
                                    const WallMovement& movement) {
    if (!safe || safe->step_fraction == 1)
        boundary_error = distance_from_targets(mesh, movement, *this);
    if (moves.empty()) return;
    const hm_points from = mesh.coordinates(), to = moved.read();
    double on_curves = 0;
    call(mesh, hm_boundary_error, solver.basis(), moves.data(), &from, &to, &on_curves, nullptr);
    if (safe) on_curves = std::fabs(on_curves - safe->rotated_offset);
    boundary_error = std::max(boundary_error, on_curves);
}

void write_displacement_page(std::ostream& out, const Mesh& mesh, const Task& task,
                             const WallMovement& movement, const Displacement& found) {
    const CurvesView curves(task.curves);
    std::vector<std::int32_t> body = found.curve_points;
    body.insert(body.end(), movement.wall.points.begin(), movement.wall.points.end());
    const auto empty = sized<hm_safe_report>();
    write_report(out, mesh, {found.info, *curves.get(), task.conditions}, body,
                 {found.by, *found.judged, movement.moves, found.step, found.quality,
                  distance_from_targets(mesh, movement, found),
                  "largest distance of given points from their targets", found.safe.has_value(),
                  found.safe ? *found.safe : empty, found.refusal});
}

void write_displacement(const Arguments& arguments, const Mesh& mesh, const Displacement& found,
                        OutputFiles& files) {
    if (arguments.has("-o"))
        warn_of(arguments.text("-o"), write_moved(files, mesh, arguments.text("-o"),
                                                  found.moved.x.data(), found.moved.y.data()));
    if (arguments.has("--vtu")) {
        write_vtu(files.add(arguments.text("--vtu")), mesh, found.moved.x, found.moved.y,
                  {displacement_data(found.by)});
    }
}

void print_json(const Displacement& found) {
    JsonObject object;
    object.add("inverted", found.quality.inverted);
    if (!found.safe) object.add("admissible_step", valid_fraction(found.step));
    object.add("self_crossing", found.quality.self_crossing != 0)
        .add("boundary_error", found.boundary_error);
    object.add("min_quality", found.quality.min_quality)
        .add("mean_quality", found.quality.mean_quality);
    object.add("engine", found.engine);
    object.add("factor_seconds", found.factor_seconds)
        .add("displace_seconds", found.displace_seconds);
    if (found.safe) add_safe(object, *found.safe, found.warning, nullptr);
    add_trials(object, found.trials);
    print("%s\n", object.text().c_str());
}

void print_displacement(const Displacement& found) {
    print_trials(found.trials);
    print("engine           %s\n", found.engine.c_str());
    if (found.safe) print_target(*found.safe);
    print("inverted cells   %d\n", found.quality.inverted);
    if (!found.safe) {
        const double step = valid_fraction(found.step);
        const std::string text = std::isinf(step) ? "unlimited" : brief(step) + " of this one";
        print("admissible step  %s\n", text.c_str());
    }
    print("boundary         %s off its target at most\n", brief(found.boundary_error).c_str());
    print(
        "quality          %s at least, %s on average (size and skew, relative to the mesh as it "
        "was)\n",
        brief(found.quality.min_quality).c_str(), brief(found.quality.mean_quality).c_str());
    if (found.safe) print_worst_cells(*found.safe);
    print("seconds          %s for analysis and factor, %s for the displacement\n",
          brief(found.factor_seconds).c_str(), brief(found.displace_seconds).c_str());
}

std::string why_invalid(const Displacement& found, const Mesh& mesh) {
    if (!found.torn.empty()) return found.torn;
    std::string text = plural(found.quality.inverted, "inverted cell");
    if (found.step.cell >= 0) {
        const std::size_t line = mesh.cell_offset[static_cast<std::size_t>(found.step.cell)];
        text += ": " + brief(found.step.admissible) +
                " of this displacement is admissible, limited by cell " +
                std::to_string(found.step.cell) + " (" + mesh.file.place(line) + ")" +
                what_goes_farther(mesh, found.moved, found.step, found.quality);
    }
    return found.quality.inverted > 0
               ? text
               : "the boundary crosses itself once it is rounded to the file's digits";
}

}  // namespace cli
