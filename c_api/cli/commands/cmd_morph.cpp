// harmorph morph: moves control points and with them the mesh, and judges the result.
#include "basics/numbers.hpp"
#include "work/moves_file.hpp"
#include "commands/commands.hpp"
#include "commands/morph_report.hpp"
#include "curves/curve_file.hpp"
#include "files/output_file.hpp"
#include "formats/format.hpp"
#include "formats/vtu.hpp"
#include "mesh/point_numbers.hpp"
#include "options/place_options.hpp"
#include "page/report_data.hpp"
#include "pictures/draw_curves.hpp"
#include "pictures/pictures.hpp"
#include "work/engine.hpp"
#include "work/morph.hpp"
#include "work/read_mesh.hpp"

#include <harmorph_design.h>

#include <memory>
#include <ostream>

namespace cli {

namespace {

// Writes a morph with the columns what, curve, number, u, x, y, moved_x, moved_y. `curve`: samples
// of the B-splines, between whose knots u runs; `control`: the control points; `mesh`: the mesh's
// points on curves and rigid bodies, as the functions moved them.
void write_moved_curves_csv(std::ostream& out, const Mesh& mesh, const Basis& basis,
                            const Morph& morph) {
    const hm_curves& before = basis.curves();
    const std::vector<double> control = morph.moved_control(basis);
    hm_curves after = before;
    after.control = control.data();
    const auto pair = [&out](double x, double y) { out << ',' << exact(x) << ',' << exact(y); };
    out << "what,curve,number,u,x,y,moved_x,moved_y\n";
    for (std::int32_t curve = 0; curve < before.n_curves; ++curve) {
        for (const double u : sample_parameters(before.curve[curve])) {
            out << "curve," << curve + 1 << ",," << exact(u);
            for (const hm_curves* curves : {&before, static_cast<const hm_curves*>(&after)}) {
                double xy[2];
                call(std::string("curve"), hm_curve_point, curves, curve, u, 0, xy);
                pair(xy[0], xy[1]);
            }
            out << '\n';
        }
    }
    for (std::int32_t i = 0; i < before.n_control; ++i) {
        out << "control,," << i + 1 << ',';
        pair(before.control[2 * i], before.control[2 * i + 1]);
        pair(after.control[2 * i], after.control[2 * i + 1]);
        out << '\n';
    }
    const hm_basis_info& info = basis.info();
    const PointNumbers numbers(mesh);
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        const auto point = static_cast<std::size_t>(info.curve_point[k]);
        const bool on_curve = info.point_curve[k] < info.curves;
        out << "mesh," << (on_curve ? std::to_string(info.point_curve[k] + 1) : "") << ','
            << numbers.number(info.curve_point[k]) << ','
            << (on_curve ? exact(info.point_u[k]) : "");
        pair(mesh.x[point], mesh.y[point]);
        pair(morph.moved.x[point], morph.moved.y[point]);
        out << '\n';
    }
}

// [chord] A wall that is farther from the section of --to-airfoil is reported.
constexpr double far_from_section = 5e-3;

Companions companions_of(const Arguments& arguments, const Basis& basis, const Morph& morph) {
    const bool has_reached = arguments.has("--reached") || !morph.refusal.empty();
    Companions names = {arguments.output("--curve-out"),
                        has_reached ? arguments.output("--reached") : ""};
    if (basis.info().curves == 0 || !basis.why_on_no_curve().empty())
        names.curve.clear();  // there are no curves, or their places are unknown
    return names;
}

void write_report(std::ostream& out, const Mesh& mesh, const Basis& basis, const Morph& morph,
                  bool safe) {
    const hm_basis_info& info = basis.info();
    const JudgedMesh judged(mesh, basis.get(), basis.conditions(), morph.displacement);
    write_report(
        out, mesh, {info, basis.curves(), basis.conditions()},
        {info.curve_point, info.curve_point + info.curve_points},
        {morph.displacement, judged, morph.moves, morph.step, morph.quality, morph.boundary_error,
         "largest distance from the B-spline", safe, morph.safe, morph.refusal});
}

void write_files(const Arguments& arguments, const Mesh& mesh, const Basis& basis,
                 const Morph& morph, const Companions& companions, OutputFiles& files) {
    const Field& moved = morph.moved;
    if (arguments.has("-o"))
        warn_of(arguments.text("-o"),
                write_moved(files, mesh, arguments.text("-o"), moved.x.data(), moved.y.data()));
    if (!companions.curve.empty())
        write_curve_file(files, companions.curve, morph.moved_curves(basis));
    if (!companions.reached.empty())
        write_moves(files.add(companions.reached), morph.moves, basis, mesh);
    if (arguments.has("--vtu")) {
        write_vtu(files.add(arguments.text("--vtu")), mesh, moved.x, moved.y,
                  {displacement_data(morph.displacement)});
    }
    if (arguments.has("--svg")) {
        files.add(arguments.text("--svg"))
            << morph_picture(mesh, basis, morph, window_of(arguments));
    }
    if (arguments.has("--boundary-svg")) {
        files.add(arguments.text("--boundary-svg")) << boundary_picture(basis, morph);
    }
    if (arguments.has("--csv"))
        write_moved_curves_csv(files.add(arguments.text("--csv")), mesh, basis, morph);
}

Morph safe_morph(const Arguments& arguments, const Mesh& mesh, const Basis& basis,
                 const std::vector<double>& moves, const Threads& threads) {
    std::vector<std::unique_ptr<Basis>> others;
    std::vector<const hm_basis*> views;
    for (const std::string& path : arguments.all("--other")) {
        others.push_back(std::make_unique<Basis>(path, mesh));
        views.push_back(others.back()->get());
    }
    hm_safe_options options = safe_options_of(arguments);
    options.n_others = static_cast<std::int32_t>(views.size());
    options.others = views.data();
    const std::int32_t own = basis.info().operator_kind;
    if (arguments.has("--operator") && !compares_operators(arguments))
        arguments.refuse(
            "--operator of this command must be auto, because the basis has an operator of its "
            "own");
    FluxList fluxes;
    if (arguments.has("--flux")) {
        fluxes = read_fluxes(arguments.text("--flux"), mesh,
                             static_cast<std::int32_t>(basis.info().control_points));
    }
    std::vector<OperatorTrial> trials;
    const auto run = [&](std::int32_t kind, OperatorTrial& trial) {
        Morph morph(basis, mesh, moves, options, kind, threads, fluxes);
        trial.step_fraction = morph.safe.step_fraction;
        trial.min_quality = morph.quality.min_quality;
        trial.is_short = own != HM_CONFORMAL && !morph.refusal.empty() && !morph.impossible;
        return morph;
    };
    Morph best =
        best_of_operators(operators_to_compare(own), compares_operators(arguments), trials, run);
    best.trials = trials;
    return best;
}

// Warns that the mesh has moved since the basis was solved. Refuses outputs that need the curves,
// if the places of the curves are unknown.
void warn_of_earlier_movement(const Arguments& arguments, const Basis& basis) {
    const bool needs_curves = arguments.has("--curve-out") || arguments.has("--svg") ||
                              arguments.has("--boundary-svg") || arguments.has("--csv") ||
                              arguments.has("--report") || arguments.has("--to-airfoil") ||
                              arguments.has("--variables");
    if (needs_curves) basis.curves();
    if (basis.info().curves > 0 && !basis.why_on_no_curve().empty())
        return warn(basis.why_on_no_curve() +
                    "; the curves of the moved mesh are unknown and are not written");
    warn("the mesh has moved since the basis was solved: wall points are up to " +
         brief(basis.distance_from_curves()) +
         " from the places to which a movement of the basis "
         "takes them");
}

void measure_wall_of(const Arguments& arguments, const Mesh& mesh, const Basis& basis,
                     const Morph& morph, ToAirfoil& airfoil) {
    const std::int32_t curve = arguments.whole("--airfoil-curve", 1, 1, INT32_MAX) - 1;
    measure_wall(airfoil, basis, curve, mesh, morph.moved.x, morph.moved.y);
    if (!(airfoil.wall_error > far_from_section * airfoil.chord)) return;
    warn("the wall of the morphed mesh is up to " + brief(airfoil.wall_error / airfoil.chord) +
         " chord off the section of " + arguments.text("--to-airfoil") +
         "; the curve of the basis was off the wall before the movement, or the movement stopped "
         "on its way");
}

}  // namespace

void run_morph(const Arguments& arguments) {
    const std::int32_t repeats = arguments.whole("--repeat", 1, 1, 1000000);
    const Mesh mesh = read_mesh(arguments, 0);
    const Basis basis(arguments.operand(1), mesh);
    if (basis.mesh_has_moved()) warn_of_earlier_movement(arguments, basis);
    AskedMoves asked = asked_moves(arguments, mesh, basis);
    const std::vector<double>& moves = asked.moves;
    warn_of_errors(asked.errors);
    const Threads threads(threads_of(arguments), kernel_of(arguments));
    const bool safe = arguments.has("--safe");
    check_safe_options(arguments);
    if (safe && basis.mesh_has_moved())
        throw Failure(exit_unusable, mesh.file.path() +
                                         ": the mesh has moved since the basis was solved, and "
                                         "--safe begins with that mesh; solve again on this mesh");
    for (const char* const option : {"--reached", "--operator", "--flux"}) {
        if (!safe && arguments.has(option)) arguments.refuse(std::string(option) + " needs --safe");
    }
    Morph morph = safe ? safe_morph(arguments, mesh, basis, moves, threads)
                       : Morph(basis, mesh, moves, repeats, threads);
    if (!safe && arguments.has("--improve") && morph.valid())
        morph.improve(basis, mesh, threads, improve_options_of(arguments));
    if (asked.airfoil) measure_wall_of(arguments, mesh, basis, morph, *asked.airfoil);
    if (safe) warn_of_heights(arguments, morph.safe, morph.valid());
    const bool strict = arguments.has("--strict") && !morph.warning.empty();
    const bool reached = morph.valid() && morph.refusal.empty() && !strict;
    OutputFiles files;
    Companions written;
    if (reached || arguments.has("--force")) {
        written = companions_of(arguments, basis, morph);
        write_files(arguments, mesh, basis, morph, written, files);
    }
    // These two files are written for invalid meshes too.
    if (arguments.has("--report"))
        write_report(files.add(arguments.text("--report")), mesh, basis, morph, safe);
    if (arguments.has("--moves-out"))
        write_moves(files.add(arguments.text("--moves-out")), moves, basis, mesh);
    files.commit();
    if (arguments.has("--json")) {
        print_json(morph, safe, written, asked);
    } else {
        if (asked.airfoil) print_airfoil(arguments.text("--to-airfoil"), *asked.airfoil);
        print_errors(asked.errors);
        print_for_people(morph, safe, written);
        const bool is_written = reached || arguments.has("--force");
        if (arguments.has("-o") && is_written) {
            print("morphed mesh     %s\n", arguments.text("-o").c_str());
        } else if (!arguments.has("-o")) {
            print("morphed mesh     not written: -o FILE writes the mesh\n");
        }
    }
    if (strict && morph.valid()) throw Failure(exit_unusable, morph.warning);
    if (!reached) throw Failure(exit_unusable, why_not_reached(morph, mesh, asked));
    if (!morph.warning.empty()) warn(morph.warning);
}

}  // namespace cli
