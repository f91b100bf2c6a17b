// Part of `make deform`: seeded random movements that the safe morph should follow: with good
// cells, and with few solutions. Movements whose prescribed walls cross are not counted: the
// library says so before anything moves. Nor are those whose walls fold so sharply, stretch so
// much, or leave gaps so narrow, that no mesh with these cells is good: a bound of the quality is
// computed from the wall (wall_bound.hpp).
//   seeded FOLDER N MESH:MARKER ...     airfoils of chord 1; the channel and the cascade come
//   always; N of each
// In the environment: DETAILS (any value) prints every movement; OPERATOR is a value of
// hm_options.operator_kind.
#include "work/basis_file.hpp"
#include "commands/commands.hpp"
#include "work/read_mesh.hpp"
#include "curves/curve_file.hpp"
#include "basics/failure.hpp"
#include "work/morph.hpp"
#include "basics/numbers.hpp"
#include "files/output_file.hpp"
#include "work/solver.hpp"
#include "seeds.hpp"
#include "wall_bound.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>

namespace deform {
namespace {

constexpr double good_quality = .05;  // of the smallest quality of the start
constexpr int few_solutions = 6;

// The counts on all meshes.
struct Counts {
    int counted = 0, impossible = 0, folded = 0, reached = 0, good = 0, quick = 0;
    void add(const Counts& more) {
        counted += more.counted;
        impossible += more.impossible;
        folded += more.folded;
        reached += more.reached;
        good += more.good;
        quick += more.quick;
    }
    void print(const std::string& name, double seconds) const {
        std::printf("  %-28s  %5d  %8d  %6d  %9d  %6d  %6d  %8.2g\n", name.c_str(), counted,
                    impossible, folded, reached, good, quick, seconds);
    }
};

using Movement =
    std::function<std::vector<double>(const std::vector<double>& control, std::uint64_t seed)>;

// One marker on all curves, by the default operator.
cli::Task task_on(const cli::Mesh& mesh, const std::string& marker, const cli::Curves& curves) {
    cli::Task task;
    task.curves = curves;
    auto condition = cli::sized<hm_condition>();
    condition.marker = mesh.find_markers(marker)[0];
    condition.n_curves = static_cast<std::int32_t>(curves.curves.size());
    task.conditions = {condition};
    return task;
}

// The wall as the linear step has it.
cli::Field target(const cli::Mesh& mesh, const cli::Basis& basis, const std::vector<double>& moves,
                  const cli::Threads& threads) {
    cli::Field out = cli::displacement(basis, mesh, moves, threads);
    for (std::size_t k = 0; k < mesh.x.size(); ++k) {
        out.x[k] += mesh.x[k];
        out.y[k] += mesh.y[k];
    }
    return out;
}

WallBound bound_of(const cli::Mesh& mesh, const cli::Task& task, const cli::Field& at) {
    return {mesh.cell_start,
            mesh.cell_points,
            mesh.face_points,
            mesh.face_markers,
            task.conditions[0].marker,
            mesh.x,
            mesh.y,
            at.x,
            at.y};
}

Counts count(const std::string& name, const cli::Mesh& mesh, cli::Task task,
             const std::string& folder, int wanted, const cli::Threads& threads,
             const Movement& movement) {
    const std::string path = folder + "/seeded.basis";
    if (const char* const kind = std::getenv("OPERATOR"))
        task.options.operator_kind = std::atoi(kind);
    {
        cli::Solver solver(mesh, task, threads);
        solver.run();
        cli::OutputFiles files;
        cli::write_basis(files.add(path), solver.basis(), mesh);
        files.commit();
    }
    const cli::Basis basis(path, mesh);
    const bool details = std::getenv("DETAILS") != nullptr;
    Counts counts;
    std::vector<double> seconds;
    for (std::uint64_t seed = 1;
         counts.counted < wanted && seed < 1000 * static_cast<std::uint64_t>(wanted); ++seed) {
        const cli::Morph morph(basis, mesh, movement(task.curves.control, seed),
                               cli::sized<hm_safe_options>(), basis.info().operator_kind, threads);
        if (morph.impossible) {
            ++counts.impossible;
            continue;
        }
        const hm_safe_report& report = morph.safe;
        const bool whole = morph.valid() && report.step_fraction >= 1;
        const bool good = whole && morph.quality.min_quality >= good_quality * report.start_quality;
        const bool quick = report.resolves <= few_solutions;
        const std::vector<double> moves = movement(task.curves.control, seed);
        const WallBound bound =
            bound_of(mesh, task, whole ? morph.moved : target(mesh, basis, moves, threads));
        if (!good && bound.quality < good_quality * report.start_quality) {
            ++counts.folded;
            std::printf(
                "    seed %d: left out: because of the wall at point %d (angle %.2f degrees; 0: a "
                "face or a gap) no\n"
                "        smallest quality is above %.4f of the start's; found was %.4f\n",
                static_cast<int>(seed), static_cast<int>(bound.point), bound.angle,
                bound.quality / report.start_quality,
                morph.quality.min_quality / report.start_quality);
            continue;
        }
        ++counts.counted;
        counts.reached += whole ? 1 : 0;
        counts.good += good ? 1 : 0;
        counts.quick += quick ? 1 : 0;
        seconds.push_back(morph.seconds);
        const std::string& why = morph.refusal.empty() ? morph.warning : morph.refusal;
        if (details || !good || !quick) {
            std::printf(
                "    seed %d: %d solutions, strategy %d, quality %.3f of the start's, at most "
                "%.3f; %s\n",
                static_cast<int>(seed), report.resolves, report.strategy,
                morph.quality.min_quality / report.start_quality,
                std::min(1.0, bound.quality / report.start_quality), why.c_str());
        }
    }
    counts.print(name, seconds.empty() ? 0 : cli::median(seconds));
    return counts;
}

cli::Curves fit(const std::string& path, const std::string& marker, const std::string& folder) {
    const std::string curve = folder + "/seeded.curve";
    const cli::Mesh mesh = cli::read_mesh(path);
    cli::run_command({"fit", path, "--marker", marker, "-o", curve});
    return cli::read_curves(curve);
}

// [0, 3] x [0, 1] in 60 x 24 cells, the first of height .002 at the floor, whose middle third is
// the wall that moves.
void write_channel(const std::string& path) {
    constexpr int n = 20, n_y = 24;
    constexpr double first = .002;
    std::vector<double> height;
    double low = 1, high = 2;  // the ratio of neighbouring heights, by bisection
    for (int k = 0; k < 60; ++k) {
        double const ratio = .5 * (low + high),
                     top = first * (std::pow(ratio, n_y) - 1) / (ratio - 1);
        (top < 1 ? low : high) = ratio;
    }
    for (int j = 0; j <= n_y; ++j)
        height.push_back(j == n_y ? 1 : first * (std::pow(low, j) - 1) / (low - 1));
    cli::OutputFiles files;
    std::ostream& out = files.add(path);
    const auto id = [&](int i, int j) { return j * (3 * n + 1) + i; };
    out << "NDIME= 2\nNELEM= " << 3 * n * n_y << "\n";
    for (int j = 0; j < n_y; ++j)
        for (int i = 0; i < 3 * n; ++i)
            out << "9 " << id(i, j) << " " << id(i + 1, j) << " " << id(i + 1, j + 1) << " "
                << id(i, j + 1) << "\n";
    out << "NPOIN= " << (3 * n + 1) * (n_y + 1) << "\n";
    out.precision(17);
    for (int j = 0; j <= n_y; ++j)
        for (int i = 0; i <= 3 * n; ++i)
            out << 1.0 * i / n << " " << height[static_cast<std::size_t>(j)] << "\n";
    const auto marker = [&](const char* tag, int faces) {
        out << "MARKER_TAG= " << tag << "\nMARKER_ELEMS= " << faces << "\n";
    };
    out << "NMARK= 5\n";
    marker("bump", n);
    for (int i = n; i < 2 * n; ++i) out << "3 " << id(i, 0) << " " << id(i + 1, 0) << "\n";
    marker("floor", 2 * n);
    for (int i = 0; i < 3 * n; ++i)
        if (i < n || i >= 2 * n) out << "3 " << id(i, 0) << " " << id(i + 1, 0) << "\n";
    marker("ceiling", 3 * n);
    for (int i = 0; i < 3 * n; ++i) out << "3 " << id(i, n_y) << " " << id(i + 1, n_y) << "\n";
    for (const int end : {0, 3 * n}) {
        marker(end == 0 ? "inlet" : "outlet", n_y);
        for (int j = 0; j < n_y; ++j) out << "3 " << id(end, j) << " " << id(end, j + 1) << "\n";
    }
    files.commit();
}

// A clamped cubic from (1, 0) to (2, 0) with control points at the means of their knots.
cli::Curves straight_wall(int n_control) {
    cli::Curves out;
    cli::Curve curve;
    curve.degree = 3;
    curve.closed = HM_OPEN;
    for (int k = 0; k < n_control + 4; ++k)
        curve.knots.push_back(std::clamp((k - 3.) / (n_control - 3), 0., 1.));
    for (std::size_t k = 0; k < static_cast<std::size_t>(n_control); ++k) {
        curve.indices.push_back(static_cast<std::int32_t>(k));
        out.control.push_back(1 +
                              (curve.knots[k + 1] + curve.knots[k + 2] + curve.knots[k + 3]) / 3);
        out.control.push_back(0);
    }
    out.curves = {curve};
    return out;
}

Counts channel(const std::string& folder, int wanted, const cli::Threads& threads) {
    const std::string path = folder + "/channel.su2";
    write_channel(path);
    const cli::Mesh mesh = cli::read_mesh(path);
    return count("a piece of a channel's floor", mesh, task_on(mesh, "bump", straight_wall(20)),
                 folder, wanted, threads,
                 [](const std::vector<double>& control, std::uint64_t seed) {
                     return random_bump(control.size() / 2, seed, .5);
                 });
}

// The mesh that `make meshes` leaves beside the folder of the results.
std::string cascade_of(const std::string& folder) { return folder + "/../meshes/cascade.su2"; }

Counts cascade(const std::string& folder, int wanted, const cli::Curves& curves,
               const cli::Threads& threads) {
    constexpr double pitch = .9;
    const cli::Mesh mesh = cli::read_mesh(cascade_of(folder));
    cli::Task task = task_on(mesh, "blade", curves);
    auto condition = cli::sized<hm_condition>();
    condition.kind = HM_PERIODIC_PAIR;
    condition.marker = mesh.find_markers("lower")[0];
    condition.partner = mesh.find_markers("upper")[0];
    task.conditions.push_back(condition);
    return count("a cascade, half a pitch", mesh, task, folder, wanted, threads,
                 [](const std::vector<double>& control, std::uint64_t seed) {
                     return random_flight(control, seed, .5 * pitch);
                 });
}

void run(const std::string& folder, int wanted, const std::vector<std::string>& airfoils,
         const cli::Threads& threads) {
    std::printf(
        "\n== Seeded random movements\n\ntable The curves through the airfoils' points\n  what  "
        "is\n");
    std::vector<cli::Curves> curves = {fit(cascade_of(folder), "blade", folder)};
    const auto colon = [](const std::string& word) { return word.rfind(':'); };
    for (const std::string& word : airfoils)
        curves.push_back(fit(word.substr(0, colon(word)), word.substr(colon(word) + 1), folder));
    std::printf(
        "\ntable Movements that cross no walls, how many that do were left out, and how many whose "
        "walls fold or "
        "stretch so much\n"
        "that no mesh can have the quality asked for; how many of the first end at the target\n"
        "with valid cells, how many of these with %.2f of the smallest quality of the start or "
        "more, how many of all\n"
        "with at most %d solutions, and the median of the time\n"
        "  mesh                          count  crossing  folded  at target    good   quick   "
        "seconds\n",
        good_quality, few_solutions);
    Counts all;
    all.add(channel(folder, wanted, threads));
    all.add(cascade(folder, wanted, curves[0], threads));
    for (std::size_t i = 0; i < airfoils.size(); ++i) {
        const std::string path = airfoils[i].substr(0, colon(airfoils[i]));
        const cli::Mesh mesh = cli::read_mesh(path);
        const cli::Task task =
            task_on(mesh, airfoils[i].substr(colon(airfoils[i]) + 1), curves[i + 1]);
        all.add(count(std::filesystem::path(path).stem().string(), mesh, task, folder, wanted,
                      threads, [](const std::vector<double>& control, std::uint64_t seed) {
                          return random_movement(control.size() / 2, seed);
                      }));
    }
    all.print("all", 0);
}

}  // namespace
}  // namespace deform

int main(int argc, char** argv) {
    try {
        std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
        if (argc < 3) throw cli::Failure(cli::exit_usage, "usage: seeded FOLDER N MESH:MARKER ...");
        std::filesystem::create_directories(argv[1]);
        const cli::Threads threads(1);
        deform::run(argv[1], std::atoi(argv[2]), {argv + 3, argv + argc}, threads);
        return 0;
    } catch (const cli::Failure& failure) {
        std::fprintf(stderr, "seeded: %s\n", failure.what());
        return 2;
    }
}
