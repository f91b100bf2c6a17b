// `make deform`: how far meshes follow large movements, per basis and with the safe morph; tables
// and pictures. A client of the program's own parts. It prints sections and captions as
// tests/figures.sh reads them.
//   deform FOLDER MESH:MARKER ...      airfoils of chord 1 from x = 0 to 1; the block of
//   tests/meshes comes always
#include "mesh/basis_file.hpp"
#include "commands/commands.hpp"
#include "curves/curve_file.hpp"
#include "basics/failure.hpp"
#include "commands/morph.hpp"
#include "basics/numbers.hpp"
#include "basics/output_file.hpp"
#include "pictures/pictures.hpp"
#include "commands/solver.hpp"
#include "basics/stopwatch.hpp"
#include "movements.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>

namespace deform {
namespace {

using Moves = std::vector<double>;

struct Operator {
    const char* name;
    std::int32_t kind;
    double exponent;
};
constexpr Operator operators[] = {{"laplace", HM_LAPLACE, 0},
                                  {"weighted 1", HM_WEIGHTED, 1},
                                  {"conformal 1", HM_CONFORMAL, 1},
                                  {"conformal 1.5", HM_CONFORMAL, 1.5},
                                  {"conformal 2", HM_CONFORMAL, 2}};

// One mesh with the basis of one operator, solved.
class Case {
public:
    Case(const cli::Mesh& mesh, cli::Task task, const cli::Threads& threads,
         const std::string& path)
        : mesh_(mesh), threads_(threads), task_(std::move(task)), solver_(mesh, task_, threads) {
        solver_.run();
        solver_.run();  // the first one warms up
        seconds_ = solver_.times().setup + solver_.times().factor + solver_.times().solve;
        cli::OutputFiles files;
        cli::write_basis(files.add(path), solver_.basis(), mesh);
        files.commit();
        basis_ = std::make_unique<cli::Basis>(path, mesh);
    }

    double seconds() const { return seconds_; }
    const cli::Basis& basis() const { return *basis_; }
    cli::Morph linear(const Moves& moves) const {
        return cli::Morph(*basis_, mesh_, moves, 1, threads_);
    }
    cli::Morph safe(const Moves& moves, double heights = 0) const {
        auto options = cli::sized<hm_safe_options>();
        options.heights = heights;
        return cli::Morph(*basis_, mesh_, moves, options, basis_->info().operator_kind, threads_);
    }

    // The largest amount for which a single linear morph is valid, by bisection.
    double limit(const std::function<Moves(double)>& moves, double most) const {
        double low = 0, high = most;
        if (linear(moves(most)).valid()) return most;
        while (high - low > 2e-3 * high) {
            double const middle = (low + high) / 2;
            (linear(moves(middle)).valid() ? low : high) = middle;
        }
        return low;
    }
    // what: the movement, as the captions name it.
    void draw(const std::string& stem, const std::string& what, const cli::Morph& morph) const {
        const Moves& moves = morph.moves;
        const hm_curves& curves = basis_->curves();
        cli::OutputFiles files;
        files.add(stem + ".svg") << cli::morph_picture(mesh_, *basis_, morph);
        const auto caption = [&](const std::string& path, const std::string& text) {
            std::printf("figure %s %s\n", std::filesystem::path(path).filename().c_str(),
                        text.c_str());
        };
        caption(stem + ".svg", "The safe morph of " + what +
                                   ": the mesh is drawn before in blue and after in red. It has " +
                                   cli::plural(morph.quality.inverted, "inverted cell") +
                                   " and a size-skew quality of " +
                                   cli::brief(morph.quality.min_quality) + " at least.");
        if (curves.n_control > 4) {  // an airfoil: both of its edges, where they are now
            for (const bool leading : {true, false}) {
                std::size_t edge = 0;
                for (std::size_t i = 0; i < moves.size(); i += 2) {
                    const bool further = leading ? curves.control[i] < curves.control[edge]
                                                 : curves.control[i] > curves.control[edge];
                    if (further) edge = i;
                }
                const cli::Point at = {curves.control[edge] + moves[edge],
                                       curves.control[edge + 1] + moves[edge + 1]};
                const cli::Box window = cli::Box{at, at}.widened(.05);
                const std::string name = stem + (leading ? "-leading.svg" : "-trailing.svg");
                files.add(name) << cli::morph_picture(mesh_, *basis_, morph, window);
                caption(name, std::string("The same mesh round the ") +
                                  (leading ? "leading" : "trailing") + " edge after " + what + ".");
            }
        }
        files.commit();
    }

private:
    const cli::Mesh& mesh_;
    const cli::Threads& threads_;
    cli::Task task_;
    cli::Solver solver_;
    double seconds_ = 0;
    std::unique_ptr<cli::Basis> basis_;
};

void print_limits(const char* name, const Case& setup, const Movements& movements,
                  double laplace_seconds) {
    const auto limit = [&](Moves (Movements::*kind)(double) const, double most) {
        return setup.limit([&](double amount) { return (movements.*kind)(amount); }, most);
    };
    const double rotation =
        setup.limit([&](double degrees) { return movements.rotation(degrees); }, 180);
    std::printf("  %-14s  %8.3f  %8.1f  %8.3f  %9.2f  %8.2f  %20.2f\n", name,
                limit(&Movements::camber, 4), rotation, limit(&Movements::bump, 8),
                limit(&Movements::thickening, 99), limit(&Movements::translation, 99),
                setup.seconds() / laplace_seconds);
}

bool print_safe(const std::string& name, const std::string& what, const Case& setup,
                const Moves& moves, const std::string& picture) {
    const cli::Morph morph = setup.safe(moves);
    static const char* const strategies[] = {"linear", "other", "substeps", "untangled",
                                             "improved"};
    const hm_safe_report& report = morph.safe;
    const bool good = morph.valid() && morph.refusal.empty();
    std::printf("  %-14s  %6.1f %%  %6d  %8d  %-9s  %8d  %6.3f  %6.3f  %8.2g  %10.1f\n",
                name.c_str(), 100 * report.step_fraction, report.steps, report.resolves,
                strategies[report.strategy], morph.quality.inverted, morph.quality.min_quality,
                morph.quality.mean_quality, morph.boundary_error, morph.seconds / setup.seconds());
    if (!morph.refusal.empty()) std::printf("    %s\n", morph.refusal.c_str());
    setup.draw(picture, what, morph);
    return good;
}

constexpr const char* safe_heading =
    "\ntable Safe morphs: how much of the movement was reached, quality at least and on average, "
    "distance from the "
    "B-spline\n"
    "  movement          target   steps  resolves  strategy   inverted  min q   mean q  boundary  "
    "time/solve\n";

// Safe morphs to targets beyond every limit, and what becomes of the first layer. Returns how many
// targets were missed.
int safe_targets(const Case& setup, const Movements& movements, const std::string& stem) {
    std::printf("%s", safe_heading);
    int missed = 0;
    const auto target = [&](const char* name, const char* what, const Moves& moves,
                            const char* picture) {
        missed += print_safe(name, what, setup, moves, stem + picture) ? 0 : 1;
    };
    target("camber 1.2", "a camber of 1.2 chords", movements.camber(1.2), "-camber");
    target("rotation 170", "a rotation by 170 degrees", movements.rotation(170), "-rotation");
    target("bump 1.5", "a bump of 1.5 chords", movements.bump(1.5), "-bump");
    target("rotation 30", "a rotation by 30 degrees", movements.rotation(30), "-rotation30");
    std::printf("\n");
    const hm_safe_report turned = setup.safe(movements.rotation(30)).safe;
    std::printf(
        "  wall angles at 30 degrees of rotation: changed by %.3g degrees on average, %.3g at "
        "most\n",
        turned.mean_angle_change, turned.max_angle_change);
    for (const double heights : {0., 1.}) {
        const hm_safe_report bent = setup.safe(movements.camber(.08), heights).safe;
        std::printf(
            "  first-layer heights at camber .08, %s: %.3f .. %.3f of what they were, %.3f on "
            "average\n",
            heights > 0 ? "brought back" : "as they are", bent.min_height_ratio,
            bent.max_height_ratio, bent.mean_height_ratio);
    }
    return missed;
}

int airfoil(const std::string& folder, const std::string& path, const std::string& marker,
            const cli::Threads& threads) {
    const std::string stem = folder + "/" + std::filesystem::path(path).stem().string(),
                      curve_path = stem + ".curve";
    std::printf("\n== %s\n", path.c_str());
    std::printf("\ntable The curve through the airfoil's points\n  what  is\n");
    cli::run_command({"fit", path, "--marker", marker, "-o", curve_path});
    const cli::Mesh mesh = cli::read_mesh(path);
    const Movements movements{cli::read_curves(curve_path).control};
    std::printf(
        "\ntable Limits of one linear morph: camber and bump in chords, rotation in degrees\n"
        "  %-14s  %8s  %8s  %8s  %9s  %8s  %20s\n",
        "functions", "camber", "rotation", "bump", "thickness", "shift", "solve time / laplace");
    double laplace_seconds = 0;
    std::unique_ptr<Case> usual;
    for (const Operator& method : operators) {
        cli::Task task;
        task.curves = cli::read_curves(curve_path);
        auto condition = cli::sized<hm_condition>();
        condition.marker = mesh.find_markers(marker)[0];
        condition.n_curves = static_cast<std::int32_t>(task.curves.curves.size());
        task.conditions = {condition};
        task.options.operator_kind = method.kind;
        task.options.exponent = method.exponent;
        auto setup = std::make_unique<Case>(mesh, task, threads, stem + ".basis");
        if (laplace_seconds == 0) laplace_seconds = setup->seconds();
        print_limits(method.name, *setup, movements, laplace_seconds);
        if (method.kind == HM_CONFORMAL && method.exponent == 1.5) usual = std::move(setup);
    }
    return safe_targets(*usual, movements, stem);
}

// A block in a square, turned by 60 degrees and moved by (-0.2, -0.3); the outer boundary slips.
// (For radial basis functions in 20 steps .1497 at least and .6554 on average were published.)
int block(const std::string& folder, const cli::Threads& threads) {
    const cli::Mesh mesh = cli::read_mesh("tests/meshes/block.su2");
    const Movements movements{{.4, .48, .6, .48, .6, .52, .4, .52}};
    std::printf(
        "\n== tests/meshes/block.su2: 60 degrees and (-0.2, -0.3), sliding outer boundary\n%s",
        safe_heading);
    int missed = 0;
    for (const double exponent : {.5, .75, 1., 1.25, 1.5}) {
        cli::Task task;
        task.curves.control = movements.control;
        task.curves.curves.push_back({1, HM_TIED, {0, 1, 2, 3, 0}, {0, 0, 1, 2, 3, 4, 4}});
        auto condition = cli::sized<hm_condition>();
        condition.marker = mesh.find_markers("block")[0];
        condition.n_curves = 1;
        task.conditions.push_back(condition);
        condition.marker = mesh.find_markers("outer")[0];
        condition.kind = HM_SLIP;
        condition.n_curves = 0;
        task.conditions.push_back(condition);
        task.options.exponent = exponent;
        const Case setup(mesh, task, threads, folder + "/block.basis");
        const std::string name = "conformal " + cli::brief(exponent);
        const std::string what =
            "the block by 60 degrees and (-0.2, -0.3) with the exponent " + cli::brief(exponent);
        const std::string picture = folder + "/block-" + cli::brief(exponent);
        missed += print_safe(name, what, setup, movements.rotation(60, .5, .5, -.2, -.3), picture)
                      ? 0
                      : 1;
    }
    std::printf("\n");
    return missed;
}

}  // namespace
}  // namespace deform

int main(int argc, char** argv) {
    try {
        std::setvbuf(stdout, nullptr, _IOLBF,
                     BUFSIZ);  // tables appear as they grow, also through a pipe
        const std::string folder = argc > 1 ? argv[1] : ".";
        std::filesystem::create_directories(folder);
        const cli::Threads threads(1);
        int missed = deform::block(folder, threads);
        for (int i = 2; i < argc; ++i) {
            const std::string word = argv[i];
            const std::size_t colon = word.rfind(':');
            missed +=
                deform::airfoil(folder, word.substr(0, colon), word.substr(colon + 1), threads);
        }
        std::printf("\n%s of the safe morph missed\n", cli::plural(missed, "target").c_str());
        return missed == 0 ? 0 : 1;
    } catch (const cli::Failure& failure) {
        std::fprintf(stderr, "deform: %s\n", failure.what());
        return 2;
    }
}
