// harmorph morph: moves control points and with them the mesh, and judges the result.
#include "basics/numbers.hpp"
#include "commands/asked_moves.hpp"
#include "commands/commands.hpp"
#include "commands/morph_report.hpp"
#include "curves/curve_file.hpp"
#include "files/output_file.hpp"
#include "formats/format.hpp"
#include "formats/vtu.hpp"
#include "options/window_option.hpp"
#include "page/report_data.hpp"
#include "pictures/draw_curves.hpp"
#include "pictures/pictures.hpp"
#include "work/engine.hpp"
#include "work/morph.hpp"
#include "work/moves_file.hpp"
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
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        const auto point = static_cast<std::size_t>(info.curve_point[k]);
        const bool on_curve = info.point_curve[k] < info.curves;
        out << "mesh," << (on_curve ? std::to_string(info.point_curve[k] + 1) : "") << ',' << point
            << ',' << (on_curve ? exact(info.point_u[k]) : "");
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
    write_report(out, mesh, {basis.path(), info, basis.curves(), basis.conditions()},
                 {info.curve_point, info.curve_point + info.curve_points},
                 {morph.displacement, morph.moves, morph.step, morph.quality, morph.boundary_error,
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
        return warn(basis.why_on_no_curve() + "; the morphed mesh is written without a curve");
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

}  // namespace

const Command morph_command = {
    "morph",
    {{"MESH", FileUse::mesh}, {"BASIS", FileUse::input}},
    "Moves control points, and the mesh with them",
    "MOVES is a text file with lines \"index dx dy\": control point (from 1) and its movement; "
    "for bodies of solve --rigid\n"
    "\"rigid MARKER dx dy degrees [scale]\", for tables of solve --mode \"mode "
    "K amplitude [amplitude y]\". A section moves as\n"
    "a whole by \"turn MARKER degrees [X,Y]\" (counter-clockwise, about X,Y or the quarter chord), "
    "\"shift MARKER dx dy\",\n"
    "\"scale MARKER factor [X,Y]\" and \"flap MARKER X,Y degrees [length]\", a smooth "
    "deflection behind the hinge X,Y, over a\n"
    "tenth of the chord or `length`. MARKER may be a piece A@X:Y, or a name in quotes, \"a "
    "name\". Lines are applied in their order.\n"
    "Control points and bodies without a line do not move; `#` starts a comment. Points of the "
    "mesh on the curve move exactly as\n"
    "the B-spline does. A movement that takes a point away from one of two moving conditions is "
    "refused. A mesh with inverted cells or a boundary that crosses itself is not written.\n"
    "The file of the morphed mesh has the text of MESH with other coordinates. The moved B-spline "
    "is written beside the\n"
    "file, with .curve appended to its name. With --safe --force the mesh may stop before the "
    "target; the movement that the\n"
    "mesh then has is not a fraction of MOVES where bodies turn, and is written to a file with "
    ".reached appended.\n",
    std::vector<Option>{
        {"--move", "MOVES",
         "movement of the control points (this, --by or --to-airfoil is required)", FileUse::input},
        by_option,
        {"--variables", "MAP",
         "MOVES has lines \"variable value\" (or \"variable x y\") of the design variables in MAP, "
         "a file of\n"
         "`harmorph variables`; bodies stay",
         FileUse::input},
        {"--to-airfoil", "DAT",
         "morph the airfoil of the mesh to this one (see `harmorph fit`): the "
         "control points\n"
         "are fitted by least squares, the knots stay; the distances of the points of DAT from the "
         "curve, and of\n"
         "the moved wall from the section are reported",
         FileUse::input},
        {"--on-chord", nullptr,
         "for --to-airfoil: scale, turn and shift the points of DAT so that their leading and "
         "trailing edges\n"
         "are those of the curve (default: DAT has the coordinates of the mesh)"},
        {"--element", "K", "for --to-airfoil: the element of a DAT with several sections, from 1"},
        {"--airfoil-curve", "N",
         "for --to-airfoil: which curve of the basis is the airfoil (default 1)"},
        {"--moves-out", "MOVES",
         "for --to-airfoil: where to write the movement, for --move; written even if the morphed "
         "mesh is not valid",
         FileUse::output},
        {"-o", "MESH",
         "morphed mesh to write: the file MESH with other coordinates, or, by another ending\n"
         "(.su2, .msh, .vtk, .vtu), a new file as of `convert`",
         FileUse::moved_mesh},
        {"--curve-out", "CURVE",
         "where to write the moved curve (default: the file of -o with .curve "
         "appended)\n" CURVE_FORMATS,
         FileUse::output, ".curve"},
        {"--vtu", "FILE", "morphed mesh and its displacement for ParaView", FileUse::output},
        {"--svg", "FILE", "picture: mesh before in blue, after in red, with the control points",
         FileUse::output},
        window_option,
        {"--boundary-svg", "FILE", "picture: the moved B-spline, and the mesh's points on it",
         FileUse::output},
        {"--csv", "FILE",
         "the curves of these pictures as a table: what (curve, control, mesh), curve, number (of "
         "the control\n"
         "point, from 1, or of the mesh point), u (where it has one), x, y, moved_x, moved_y",
         FileUse::output},
        {"--report", "FILE",
         "HTML page for any browser: what moved, quality before and after, the worst cells, angles "
         "and heights\n"
         "along the wall; written even if the morphed mesh is not valid",
         FileUse::output}} +
        safe_options() +
        std::vector<Option>{
            {"--other", "BASIS",
             "for --safe: a basis of the same problem, solved with another operator or exponent\n"
             "(may be repeated)",
             FileUse::input},
            {"--flux", "FLUXES", "for --safe: the file of --flux with which the basis was solved",
             FileUse::input},
            {"--operator", "auto",
             "for --safe: laplace and conformal functions are both tried, and the mesh with the "
             "larger smallest\n"
             "quality is taken; the quality and the time of both are reported"},
            {"--reached", "MOVES",
             "for --safe: where to write the movement that the mesh has (default, if the mesh does "
             "not reach the\n"
             "target: the file of -o with .reached appended)",
             FileUse::output, ".reached", "--force"},
            {"--repeat", "N",
             "morph N times after a warm-up, in memory, and report the median time (default 1, no "
             "warm-up)"},
            threads_option,
            kernel_option,
            {"--force", nullptr,
             "write the files even if the morphed mesh is not valid, with --safe the last valid "
             "mesh\n"
             "(the exit code is still 1)"},
            format_option,
            zone_option,
            {"--json", nullptr,
             "print one JSON object: inverted, admissible_step (null: unlimited), boundary_step "
             "(where the boundary\n"
             "first touches itself, in parts of the movement; null: not before a cell inverts), "
             "self_crossing,\n"
             "boundary_error (from the B-spline as far as it went), min_quality, mean_quality,\n"
             "morph_seconds, moved_curve (its file, or empty); with --safe no admissible_step but "
             "step_fraction\n"
             "(1: all of the movement), steps, resolves, strategy (linear, other, substeps, "
             "untangled, improved),\n"
             "last_step_admissible (the admissible multiple of the last step that was tried), "
             "heights (the part of\n"
             "the change of the distances from the wall that was undone), reached_moves (the "
             "file),\n"
             "rotated_offset (the largest change of a wall point's offset from the curve, because "
             "the body turned),\n"
             "start_quality, end_point (the end of a wall that leaves the line of the neighbouring "
             "boundary;\n"
             "-1: none), end_distance, warning, worst_cells (cell, quality, start_quality, x, y); "
             "with movements of\n"
             "sections movement_error (the largest distance of the curve from the movement, as the "
             "control points do\n"
             "not follow it); with --to-airfoil\n"
             "airfoil_max_error, airfoil_rms_error (distances of the points of DAT from the curve) "
             "and\n"
             "airfoil_wall_error (distance of the moved wall from the polygon of DAT; below 0: not "
             "known)"}},
    "  harmorph morph naca0012.su2 airfoil.basis --move moves.txt -o morphed.su2 --svg "
    "morphed.svg\n"
    "  harmorph morph naca0012.su2 airfoil.basis --to-airfoil naca2412.dat --safe -o "
    "naca2412.su2\n",
    run_morph};

}  // namespace cli
