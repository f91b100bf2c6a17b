#include "commands/morph_report.hpp"

#include "basics/json.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "mesh/loops.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

void print_json(const Morph& morph, bool safe, const Companions& written, const AskedMoves& asked) {
    JsonObject object;
    object.add("inverted", morph.quality.inverted);
    if (!safe) {
        object.add("admissible_step", valid_fraction(morph.step));
        object.add("boundary_step", morph.step.boundary);
    }
    object.add("self_crossing", morph.quality.self_crossing != 0)
        .add("boundary_error", morph.boundary_error);
    object.add("min_quality", morph.quality.min_quality)
        .add("mean_quality", morph.quality.mean_quality);
    object.add("morph_seconds", morph.seconds);
    if (safe) {
        add_safe(object, morph.safe, morph.warning, &written.reached);
        add_trials(object, morph.trials);
    }
    object.add("moved_curve", written.curve);
    if (asked.airfoil)
        object.add("airfoil_max_error", asked.airfoil->max_error)
            .add("airfoil_rms_error", asked.airfoil->rms_error)
            .add("airfoil_wall_error", asked.airfoil->wall_error);
    double largest = 0;
    for (const MovementError& error : asked.errors) largest = std::max(largest, error.largest);
    if (!asked.errors.empty()) object.add("movement_error", largest);
    print("%s\n", object.text().c_str());
}

void print_airfoil(const std::string& path, const ToAirfoil& airfoil) {
    print("layout           %s\n", airfoil.layout.c_str());
    print(
        "airfoil          %s: its %s are %s chord off the moved curve at most (point %d), %s rms\n",
        path.c_str(), plural(airfoil.points, "point").c_str(),
        brief(airfoil.max_error / airfoil.chord).c_str(), airfoil.worst_point,
        brief(airfoil.rms_error / airfoil.chord).c_str());
    if (airfoil.wall_error < 0) return;
    print("wall             the wall of the moved mesh is %s chord off this section at most\n",
          brief(airfoil.wall_error / airfoil.chord).c_str());
}

void print_for_people(const Morph& morph, bool safe, const Companions& written) {
    const double admissible = safe ? morph.safe.admissible : valid_fraction(morph.step);
    print_trials(morph.trials);
    if (safe) print_target(morph.safe);
    print("inverted cells   %d\n", morph.quality.inverted);
    const std::string step =
        std::isinf(admissible)
            ? "unlimited"
            : brief(admissible) + (safe ? " of the last step that was tried" : " of this one");
    const bool touches = !safe && morph.step.boundary < morph.step.admissible;
    print("admissible step  %s%s\n", step.c_str(),
          touches ? ": there the boundary first touches itself" : "");
    print("boundary         %s; %s off the B-spline at most\n",
          morph.quality.self_crossing != 0 ? "crosses itself" : "does not cross itself",
          brief(morph.boundary_error).c_str());
    print(
        "quality          %s at least, %s on average (size and skew, relative to the mesh as it "
        "was)\n",
        brief(morph.quality.min_quality).c_str(), brief(morph.quality.mean_quality).c_str());
    if (safe) print_worst_cells(morph.safe);
    print("seconds          %s\n", brief(morph.seconds).c_str());
    if (!written.curve.empty()) print("moved curve      %s\n", written.curve.c_str());
    if (written.reached.empty()) return;
    print("reached moves    %s", written.reached.c_str());
    if (morph.refusal.empty()) {
        print("\n");
    } else {
        print(
            ": the movement that the mesh has, which is not %s %% of each line of the file, "
            "as bodies turn on the way\n",
            brief(100 * morph.safe.step_fraction).c_str());
    }
}

std::string what_goes_farther(const Mesh& mesh, const Field& moved, const hm_step_report& step,
                              const hm_quality_report& quality) {
    if (!(step.admissible > 0) || quality.self_crossing != 0) return {};
    const std::string nowhere = why_bodies_cannot_be_there(mesh, moved);
    return nowhere.empty() ? "; --safe goes farther" : "; " + nowhere;
}

namespace {

// A file whose points are not in the unit of the mesh, but in per cent of the chord, say.
std::string why_of_other_size(const AskedMoves& asked) {
    if (!asked.airfoil) return {};
    const double ratio = asked.airfoil->relative_size;
    if (ratio > 0.5 && ratio < 2) return {};
    return "; the airfoil of the file is " + brief(ratio) +
           " times as long as that of the mesh: --on-chord gives it the chord of the mesh";
}

}  // namespace

std::string why_not_reached(const Morph& morph, const Mesh& mesh, const AskedMoves& asked) {
    const std::string other_size = why_of_other_size(asked);
    if (!morph.refusal.empty()) return morph.refusal + other_size;
    std::string text = morph.torn;
    if (morph.quality.inverted > 0) {
        text += text.empty() ? "" : "; ";
        text += plural(morph.quality.inverted, "inverted cell");
        if (morph.step.cell >= 0) {
            const std::size_t line = mesh.cell_offset[static_cast<std::size_t>(morph.step.cell)];
            text += ": " + brief(morph.step.admissible) +
                    " of this movement is admissible, limited by cell " +
                    std::to_string(morph.step.cell) + " (" + mesh.file.place(line) + ")" +
                    (other_size.empty()
                         ? what_goes_farther(mesh, morph.moved, morph.step, morph.quality)
                         : "");
        }
    }
    if (morph.quality.self_crossing != 0) {
        const std::int32_t* points = morph.quality.crossing_points;
        text += (text.empty() ? "" : "; ") +
                std::string("the boundary crosses itself between points ") +
                std::to_string(points[0]) + ", " + std::to_string(points[1]) + " and " +
                std::to_string(points[2]) + ", " + std::to_string(points[3]);
        if (morph.step.boundary <= 1) {
            text += ": after " + brief(morph.step.boundary) +
                    " of this movement the boundary first touches itself";
        }
    }
    return text + other_size;
}

}  // namespace cli
