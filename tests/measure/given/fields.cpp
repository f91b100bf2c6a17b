// Displacements given point by point, on the meshes that are named: a B-spline's movement gives the
// morph by this B-spline, and random fields end in a valid mesh or are refused with a reason.
// Prints a table and "N passed, M failed".
//   fields FOLDER SEEDS MESH:MARKER ...      FOLDER/MESH.MARKER.curve: the fitted curves
#include "curves/curve_file.hpp"
#include "basics/failure.hpp"
#include "basics/library.hpp"
#include "commands/morph.hpp"
#include "commands/solver.hpp"
#include "commands/task.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>

namespace {

int passed = 0, failed = 0;

void check(bool holds, const std::string& what) {
    if (holds) {
        ++passed;
    } else {
        ++failed;
        std::printf("FAIL %s\n", what.c_str());
    }
}

struct Wall {
    std::vector<std::int32_t> points;
    std::vector<double> x, y;  // where they are
    cli::Field by{0};
    double extent = 0;
    hm_points read() const { return {by.x.data(), by.y.data(), 1}; }
    std::int32_t count() const { return static_cast<std::int32_t>(points.size()); }
};

Wall wall_of(const cli::Mesh& mesh, hm_plan* plan) {
    Wall out;
    std::int32_t n = 0;
    hm_given_points(plan, nullptr, 0, &n, nullptr);
    out.points.resize(static_cast<std::size_t>(n));
    cli::call(mesh, hm_given_points, plan, out.points.data(), n, &n);
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    for (const std::int32_t point : out.points) {
        const auto k = static_cast<std::size_t>(point);
        const double at[2] = {mesh.x[k], mesh.y[k]};
        for (int c = 0; c < 2; ++c)
            low[c] = std::min(low[c], at[c]), high[c] = std::max(high[c], at[c]);
        out.x.push_back(at[0]);
        out.y.push_back(at[1]);
    }
    out.extent = std::hypot(high[0] - low[0], high[1] - low[1]);
    out.by = cli::Field(out.points.size());
    return out;
}

// An operator, and the engine that solves for it.
struct Way {
    const char* name;
    std::int32_t operator_kind, engine;
};
constexpr Way ways[] = {{"conformal", HM_CONFORMAL, HM_DIRECT},
                        {"Laplace", HM_LAPLACE, HM_DIRECT},
                        {"weighted", HM_WEIGHTED, HM_DIRECT},
                        {"Laplace*", HM_LAPLACE, HM_MULTIGRID},
                        {"weighted*", HM_WEIGHTED, HM_MULTIGRID}};

cli::Task task_on(const cli::Mesh& mesh, const std::string& marker, std::int32_t kind,
                  const Way& way) {
    cli::Task task;
    auto condition = cli::sized<hm_condition>();
    for (std::size_t k = 0; k < mesh.markers.size(); ++k)
        if (mesh.markers[k] == marker) condition.marker = static_cast<std::int32_t>(k);
    condition.kind = kind;
    task.conditions = {condition};
    task.options.operator_kind = way.operator_kind;
    task.options.engine = way.engine;
    return task;
}

double uniform(std::mt19937& random) {
    return std::uniform_real_distribution<double>(-1, 1)(random);
}

// The largest difference between the mesh that a B-spline moves and the one that is displaced as
// its wall is.
double difference_from_morph(const cli::Mesh& mesh, const std::string& marker,
                             const cli::Curves& curves, const Way& way,
                             const cli::Threads& threads) {
    cli::Task on_curve = task_on(mesh, marker, HM_ON_CURVE, way);
    on_curve.curves = curves;
    on_curve.conditions[0].n_curves = static_cast<std::int32_t>(curves.curves.size());
    cli::Solver functions(mesh, on_curve, threads);
    functions.run();
    const cli::Task given = task_on(mesh, marker, HM_GIVEN, way);
    cli::Solver solver(mesh, given, threads);
    solver.prepare();
    cli::call(mesh, hm_plan_factor, solver.plan(), nullptr);
    Wall wall = wall_of(mesh, solver.plan());

    std::mt19937 random(7);
    std::vector<double> move;
    for (std::size_t k = 0; k < curves.control.size(); ++k)
        move.push_back(.01 * wall.extent * uniform(random));
    cli::Field expected(mesh.x.size()), found(mesh.x.size());
    const hm_points_out to_expected = expected.write(), to_found = found.write();
    cli::call(mesh, hm_morph, functions.basis(), move.data(), nullptr, &to_expected,
              threads.executor());
    for (std::size_t k = 0; k < wall.points.size(); ++k) {
        wall.by.x[k] = expected.x[static_cast<std::size_t>(wall.points[k])];
        wall.by.y[k] = expected.y[static_cast<std::size_t>(wall.points[k])];
    }
    std::size_t bytes = 0;
    cli::call(mesh, hm_displace_size, solver.plan(), 1, &bytes);
    cli::Block work(bytes);
    const hm_points given_wall = wall.read();
    cli::call(mesh, hm_displace, solver.plan(), wall.count(), wall.points.data(), 1, &given_wall,
              nullptr, &to_found, work.data(), bytes, nullptr);
    double worst = 0;
    for (std::size_t k = 0; k < found.x.size(); ++k)
        worst = std::max(worst, std::hypot(found.x[k] - expected.x[k], found.y[k] - expected.y[k]) /
                                    wall.extent);
    std::size_t other_bits = 0;
    for (std::size_t k = 0; k < wall.points.size(); ++k) {
        const auto at = static_cast<std::size_t>(wall.points[k]);
        other_bits += found.x[at] != wall.by.x[k] || found.y[at] != wall.by.y[k];
    }
    check(other_bits == 0, "wall points have the given bits");
    return worst;
}

enum class Kind { smooth, rough, large };

// Smooth: a few waves along x, 5 % of the extent. Rough: each point by itself, a part of the
// distance to its neighbour. Large: a turn of up to 120 degrees and a shift, with waves.
void make_field(Wall& wall, Kind kind, std::mt19937& random) {
    const std::size_t n = wall.points.size();
    const double turn = 2.1 * uniform(random), shift = .2 * wall.extent * uniform(random),
                 waves = .05 * wall.extent;
    double phase[6], cx = 0, cy = 0;
    for (double& p : phase) p = 3.2 * uniform(random);
    for (std::size_t k = 0; k < n; ++k)
        cx += wall.x[k] / static_cast<double>(n), cy += wall.y[k] / static_cast<double>(n);
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t next = (k + 1) % n;
        const double s = 6.283185307179586 * (wall.x[k] - cx) / wall.extent;
        const double step = std::hypot(wall.x[next] - wall.x[k], wall.y[next] - wall.y[k]);
        double x = 0, y = 0;
        if (kind != Kind::rough) {
            const double part = kind == Kind::smooth ? 1 : .3;
            x = part * waves * (std::sin(s + phase[0]) + .3 * std::sin(2 * s + phase[1])) * .3;
            y = part * waves * (std::sin(s + phase[2]) + .3 * std::sin(3 * s + phase[3]));
        }
        if (kind == Kind::rough) x = .2 * step * uniform(random), y = .2 * step * uniform(random);
        if (kind == Kind::large) {
            const double dx = wall.x[k] - cx, dy = wall.y[k] - cy;
            x += std::cos(turn) * dx - std::sin(turn) * dy - dx + shift;
            y += std::sin(turn) * dx + std::cos(turn) * dy - dy;
        }
        wall.by.x[k] = x;
        wall.by.y[k] = y;
    }
}

struct Ends {
    int reached = 0, poor = 0, part = 0, refused = 0;
};

// Is what hm_displace_safe leaves valid, with the given wall if it says so,
// or else refused with a reason and untouched?
void run_safely(const cli::Mesh& mesh, cli::Solver& solver, const Wall& wall, cli::Block& work,
                const cli::Threads& threads, Ends& ends) {
    cli::Field to(mesh.x.size());
    to.x = mesh.x;
    to.y = mesh.y;
    const hm_points given = wall.read();
    const hm_points_out out = to.write();
    auto report = cli::sized<hm_safe_report>();
    hm_error error = {};
    const hm_status status =
        hm_displace_safe(solver.plan(), solver.basis(), nullptr, wall.count(), wall.points.data(),
                         &given, &out, work.data(), work.size(), nullptr, &report, &error);
    if (status < 0) {
        ++ends.refused;
        check(status == HM_CROSSING && error.text[0] != 0, std::string("refused: ") + error.text);
        check(to.x == mesh.x && to.y == mesh.y, "untouched where refused");
        return;
    }
    ++(status == HM_SHORT ? ends.part : status == HM_POOR ? ends.poor : ends.reached);
    if (status != HM_OK) check(error.text[0] != 0, "a reason");
    const hm_mesh view = mesh.view();
    const hm_points at = to.read(), start = mesh.coordinates();
    auto quality = cli::sized<hm_quality_report>();
    cli::call(mesh, hm_assess, solver.basis(), &view, &at, nullptr, &start, threads.executor(),
              nullptr, &quality);
    check(quality.inverted == 0, "no inverted cell");
    check(quality.self_crossing == 0, "no crossing");
    if (status == HM_SHORT) return;
    std::size_t other_bits = 0;
    for (std::size_t k = 0; k < wall.points.size(); ++k) {
        const auto point = static_cast<std::size_t>(wall.points[k]);
        other_bits += to.x[point] != mesh.x[point] + wall.by.x[k] ||
                      to.y[point] != mesh.y[point] + wall.by.y[k];
    }
    check(other_bits == 0, "the given wall");
}

// Random fields of all kinds by one operator and engine: the counts of their ends.
void run_fields(const cli::Mesh& mesh, const std::string& marker, const Way& way, int seeds,
                const cli::Threads& threads) {
    const cli::Task task = task_on(mesh, marker, HM_GIVEN, way);
    cli::Solver solver(mesh, task, threads);
    solver.prepare();
    Wall wall = wall_of(mesh, solver.plan());
    std::size_t bytes = 0;
    cli::call(mesh, hm_displace_safe_size, solver.plan(), solver.basis(), &bytes);
    cli::Block work(bytes);
    for (const Kind kind : {Kind::smooth, Kind::rough, Kind::large}) {
        Ends ends;
        for (int seed = 0; seed < seeds; ++seed) {
            std::mt19937 random(static_cast<unsigned>(seed));
            make_field(wall, kind, random);
            run_safely(mesh, solver, wall, work, threads, ends);
        }
        std::printf("  %3d %3d %3d %3d", ends.reached, ends.poor, ends.part, ends.refused);
        std::fflush(stdout);
    }
}

void run(const std::string& folder, int seeds, const std::string& path, const std::string& marker) {
    const cli::Threads threads(1);
    const std::string name = std::filesystem::path(path).stem().string(),
                      curve = folder + "/" + name + "." + marker + ".curve";
    const cli::Mesh mesh = cli::read_mesh(path);
    const cli::Curves curves = cli::read_curves(curve);
    for (const Way& way : ways) {
        const double worst = difference_from_morph(mesh, marker, curves, way, threads);
        check(worst <= 1e-9, name + ", " + way.name + ": the morph by the B-spline, to 1e-9");
        std::printf("%-24s %7d  %-9s %9.1e ", (name + ":" + marker).c_str(),
                    static_cast<int>(mesh.x.size()), way.name, worst);
        run_fields(mesh, marker, way, seeds, threads);
        std::printf("\n");
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) return 2;
    std::printf(
        "largest difference from the morph, in extents of the wall (*: by multigrid,\n"
        "to its tolerance of 1e-10); random fields: at the target, poor, part of the way, refused\n"
        "%-24s %7s  %-9s %9s  %-15s  %-15s  %-15s\n",
        "mesh", "points", "operator", "morph", "smooth", "rough", "large");
    for (int i = 3; i < argc; ++i) {
        const std::string word = argv[i];
        const std::size_t colon = word.rfind(':');
        try {
            run(argv[1], std::atoi(argv[2]), word.substr(0, colon), word.substr(colon + 1));
        } catch (const cli::Failure& failure) {
            check(false, word + ": " + failure.what());
        }
    }
    std::printf("%d passed, %d failed\n", passed, failed);
    return failed > 0;
}
