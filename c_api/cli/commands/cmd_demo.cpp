// harmorph demo: runs all steps on the shipped mesh, by the commands that a user would type.
#include "basics/geometry.hpp"
#include "basics/elementary.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "curves/curve_file.hpp"
#include "files/output_file.hpp"
#include "files/own_folder.hpp"
#include "files/paths.hpp"
#include "mesh/refine.hpp"
#include "page/page_text.hpp"
#include "work/basis_file.hpp"
#include "work/morph.hpp"
#include "work/moves_file.hpp"
#include "work/read_mesh.hpp"

#include <harmorph_design.h>

#include <algorithm>

namespace cli {

namespace {

// Prints the command that a user would type, and runs the command.
void step(const std::string& purpose, const std::vector<std::string>& words) {
    std::string line = "harmorph";
    for (const std::string& word : words) line += " " + word_of_shell(word);
    print("\n# %s\n$ %s\n", purpose.c_str(), line.c_str());
    run_command(words);
}

// The camber is in chords, the thickening a fraction of the thickness.
constexpr double added_camber = .03, thickening = .4;

// Returns moves that give an airfoil of chord 1 from x = 0 to 1 more camber (a parabolic arc) and
// more thickness.
std::vector<double> pleasing_moves(const Curves& curves) {
    std::vector<double> moves(curves.control.size());
    for (std::size_t i = 0; i < moves.size(); i += 2) {
        const double x = std::clamp(curves.control[i], 0.0, 1.0), y = curves.control[i + 1];
        moves[i + 1] = 4 * added_camber * x * (1 - x) + thickening * y;
    }
    return moves;
}

// The moves are at most half of the admissible step, so that the picture shows good cells.
void write_admissible_moves(const std::string& mesh_path, const std::string& curve_path,
                            const std::string& basis_path, const std::string& moves_path) {
    const Mesh mesh = read_mesh(mesh_path);
    const Basis basis(basis_path, mesh);
    std::vector<double> moves = pleasing_moves(read_curves(curve_path));
    const Threads threads(1);
    const double admissible = valid_fraction(
        admissible_step(basis, mesh, displacement(basis, mesh, moves, threads), threads));
    const double scale = std::min(1.0, admissible / 2);
    for (double& move : moves) move *= scale;
    print("\n# more camber (%s chord) and thickness (%s %%), written to %s\n",
          brief(added_camber * scale).c_str(), brief(100 * thickening * scale).c_str(),
          moves_path.c_str());
    OutputFiles files;
    write_moves(files.add(moves_path), moves, basis, mesh);
    files.commit();
}

// The airfoil turns by this angle about this point, which is too far for one step.
constexpr double far_degrees = 170, far_x = .25, far_y = 0;

void write_far_moves(const std::string& mesh_path, const std::string& curve_path,
                     const std::string& basis_path, const std::string& moves_path) {
    const Mesh mesh = read_mesh(mesh_path);
    const Basis basis(basis_path, mesh);
    const std::vector<double> control = read_curves(curve_path).control;
    const auto [s, c] = sine_cosine(far_degrees * pi / 180);
    std::vector<double> moves(control.size());
    for (std::size_t i = 0; i < moves.size(); i += 2) {
        const double x = control[i] - far_x, y = control[i + 1] - far_y;
        moves[i] = c * x - s * y - x;
        moves[i + 1] = s * x + c * y - y;
    }
    print("\n# a turn by %s degrees about x = %s, written to %s\n", brief(far_degrees).c_str(),
          brief(far_x).c_str(), moves_path.c_str());
    OutputFiles files;
    write_moves(files.add(moves_path), moves, basis, mesh);
    files.commit();
}

// New points on the airfoil are as far from the curve as the ends of their faces are on average.
void write_fine_mesh(const std::string& mesh_path, const std::string& curve_path,
                     const std::string& fine_path) {
    const Mesh mesh = read_mesh(mesh_path);
    const Curves curves = read_curves(curve_path);
    const CurvesView view(curves);
    const std::int32_t airfoil = mesh.find_markers("airfoil").front();
    const auto foot_of = [&](Point at) {
        double u = 0, distance = 0, foot[2] = {0, 0};
        call(curve_path, hm_curve_project, view.get(), std::int32_t{0}, at.x, at.y, &u, &distance);
        call(curve_path, hm_curve_point, view.get(), std::int32_t{0}, u, std::int32_t{0}, foot);
        return Point{foot[0], foot[1]};
    };
    print("\n# the mesh with each cell divided in four, written to %s\n", fine_path.c_str());
    OutputFiles files;
    write_refined(files.add(fine_path), mesh, [&](std::int32_t marker, Point a, Point b) {
        const Point middle = {.5 * (a.x + b.x), .5 * (a.y + b.y)};
        if (marker != airfoil) return middle;
        const Point foot = foot_of(middle), foot_a = foot_of(a), foot_b = foot_of(b);
        return Point{foot.x + middle.x - .5 * (foot_a.x + foot_b.x),
                     foot.y + middle.y - .5 * (foot_a.y + foot_b.y)};
    });
    files.commit();
}

void copy_mesh(const std::string& from, const std::string& to) {
    const Mesh mesh = read_mesh(from);
    OutputFiles files;
    write_moved(files.add(to), mesh, mesh.x.data(), mesh.y.data());
    files.commit();
}

// All files of the demo except mesh.su2, the copy of the shipped mesh.
constexpr const char* made_files[] = {
    "airfoil.curve", "airfoil.basis",     "function.svg", "moves.txt",   "far.txt", "morphed.su2",
    "morphed.vtu",   "morphed.su2.curve", "morph.svg",    "report.html", "far.su2", "far.su2.curve",
    "far.svg",       "fine.su2",          "fine.basis",   "page.html"};

// The file by which the demo recognises its own folder.
constexpr const char* demo_sign = "demo.txt";

void write_sign(const std::string& path) {
    OutputFiles files;
    files.add(path) << "harmorph demo made the files of this folder, and replaces them when it is "
                       "run again.\n";
    files.commit();
}

// Returns false if this program has no pages.
bool write_page(const std::string& mesh, const std::string& basis, const std::string& page) {
    if (*page_module == '\0') {
        print("\n# left out: %s, as this program was made without %s\n", page.c_str(),
              no_page_module);
        return false;
    }
    step("a page on which control points can be dragged", {"explore", mesh, basis, "-o", page});
    return true;
}

void print_where_to_look(const std::string& folder, bool has_page) {
    const auto in_folder = [&folder](const char* name) { return path_in(folder, name); };
    const std::string page = has_page ? " and " + in_folder("page.html") : std::string();
    print("\n# look at %s and %s, and open %s%s in a browser\n", in_folder("morph.svg").c_str(),
          in_folder("function.svg").c_str(), in_folder("report.html").c_str(), page.c_str());
}

}  // namespace

void run_demo(const Arguments& arguments) {
    const std::string folder = arguments.operand(0);
    const std::string shipped =
        arguments.has("--mesh") ? arguments.text("--mesh") : "build/meshes/naca0012.su2";
    if (!exists(shipped)) {
        throw Failure(exit_file, shipped +
                                     " does not exist; run the demo in the folder of harmorph, or "
                                     "name the mesh with --mesh");
    }
    const auto in_folder = [&folder](const char* name) { return path_in(folder, name); };
    const std::string mesh = in_folder("mesh.su2"), curve = in_folder("airfoil.curve"),
                      basis = in_folder("airfoil.basis"), moves = in_folder("moves.txt"),
                      far_moves = in_folder("far.txt"), fine = in_folder("fine.su2");
    for (const char* const name : made_files)
        refuse_overwriting(arguments, {FileUse::output, "a file of DIR,", in_folder(name)});
    const OwnFolder owned(folder, demo_sign);
    write_sign(in_folder(demo_sign));
    copy_mesh(shipped, mesh);

    step("is the mesh sound?", {"check", mesh});
    step("a B-spline through the airfoil's points",
         {"fit", mesh, "--marker", "airfoil", "-o", curve});
    step("one function for each control point",
         {"solve", mesh, "--curve", "airfoil=" + curve, "-o", basis});
    step("one of them as a picture",
         {"export", mesh, basis, "--function", "16", "--svg", in_folder("function.svg")});
    write_admissible_moves(mesh, curve, basis, moves);
    step("airfoil and mesh move together",
         {"morph", mesh, basis, "--move", moves, "-o", in_folder("morphed.su2"), "--vtu",
          in_folder("morphed.vtu"), "--svg", in_folder("morph.svg"), "--report",
          in_folder("report.html")});
    write_far_moves(mesh, curve, basis, far_moves);
    step("farther than one step can go", {"morph", mesh, basis, "--move", far_moves, "--safe", "-o",
                                          in_folder("far.su2"), "--svg", in_folder("far.svg")});
    write_fine_mesh(mesh, curve, fine);
    step("the same functions for a finer mesh",
         {"transfer", mesh, basis, fine, "-o", in_folder("fine.basis")});
    print_where_to_look(folder, write_page(mesh, basis, in_folder("page.html")));
}

}  // namespace cli
