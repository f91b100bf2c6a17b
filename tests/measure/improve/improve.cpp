// Prints how long hm_improve takes after one linear morph, in multiples of one solution (analysis,
// plan, factor and 20 conformal functions), and the quality that it reaches.
//   improve SIZES KINDS MESH:MARKER ...      SIZES and KINDS: lists with spaces; airfoils have
//   chord 1 from x = 0 to 1
#include "../bench/cases.hpp"
#include "../deform/movements.hpp"
#include "basics/field.hpp"
#include "basics/failure.hpp"
#include "commands/solver.hpp"

#include <fixtures/hybrid.hpp>

#include <cstdio>
#include <ctime>
#include <functional>
#include <sstream>

namespace {

using Moves = std::vector<double>;
constexpr std::int32_t functions = 20;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

template <class Function, class... Arguments>
hm_status call(Function function, Arguments... arguments) {
    hm_error error = {};
    const hm_status status = function(arguments..., &error);
    if (status < 0) throw std::runtime_error(error.text);
    return status;
}

// A mesh whose wall has a fitted curve, with the objects of the library.
class Case {
public:
    Case(std::string name, const hm_mesh& mesh, std::int32_t wall)
        : name_(std::move(name)), mesh_(mesh), wall_(wall) {
        auto fit = cli::sized<hm_fit_options>();
        fit.n_control = functions;
        std::size_t bytes = 0, work_bytes = 0;
        call(hm_fit_marker_size, &mesh_, 1, &wall_, &fit, &bytes, &work_bytes);
        curves_block_.resize(bytes);
        cli::Block work(work_bytes);
        call(hm_fit_marker, &curves_, curves_block_.data(), bytes, &mesh_, 1, &wall_, &fit, nullptr,
             work.data(), work_bytes);
        solve();
        const double begin = processor_seconds();
        int runs = 0;
        do {
            solve();
            ++runs;
        } while (processor_seconds() - begin < 0.2);
        solution_ = (processor_seconds() - begin) / runs;
    }

    const hm_curves& curves() const { return *curves_; }
    double solution() const { return solution_; }

    // Halves the movement until the linear morph is valid, and improves the cells then.
    void print_row(const char* what, Moves moves) const {
        const auto n = static_cast<std::size_t>(mesh_.n_points);
        cli::Field moved(n), better(n);
        const hm_points_out to_moved = moved.write(), to_better = better.write();
        const hm_points at = moved.read();
        auto quality = cli::sized<hm_quality_report>();
        double part = 1;
        for (;; part *= 0.5) {
            call(hm_morph, basis_, moves.data(), &mesh_.points, &to_moved, nullptr);
            quality = cli::sized<hm_quality_report>();
            call(hm_assess, basis_, &mesh_, &at, nullptr, &mesh_.points, nullptr, nullptr,
                 &quality);
            if (quality.inverted == 0 && quality.min_quality > 0) break;
            for (double& move : moves) move *= 0.5;
        }
        std::size_t bytes = 0;
        call(hm_improve_size, plan_, &bytes);
        cli::Block work(bytes);
        auto options = cli::sized<hm_improve_options>();
        options.reference = &mesh_.points;
        auto report = cli::sized<hm_improve_report>();
        const double begin = processor_seconds();
        int runs = 0;
        do {
            call(hm_improve, plan_, &at, &to_better, work.data(), bytes, &options, &report);
            ++runs;
        } while (processor_seconds() - begin < 0.1);
        const double seconds = (processor_seconds() - begin) / runs;
        std::printf("%-22s %8d  %-9s %6.3f %10.4f %10.4f %7.2f %6d   %.4f %.5f   %.4f %.5f\n",
                    name_.c_str(), mesh_.n_points, what, part, solution_, seconds,
                    seconds / solution_, report.iterations, report.min_quality_before,
                    report.mean_quality_before, report.min_quality, report.mean_quality);
        std::fflush(stdout);
    }

private:
    void solve() {
        auto condition = cli::sized<hm_condition>();
        condition.marker = wall_;
        condition.kind = HM_ON_CURVE;
        condition.n_curves = curves_->n_curves;
        auto problem = cli::sized<hm_problem>();
        problem.mesh = &mesh_;
        problem.curves = curves_;
        problem.n_conditions = 1;
        problem.conditions = &condition;
        std::size_t bytes = 0;
        call(hm_analysis_size, &problem, nullptr, &bytes);
        analysis_block_.resize(bytes);
        call(hm_analysis_init, &analysis_, analysis_block_.data(), bytes, &problem, nullptr);
        call(hm_plan_size, analysis_, &bytes);
        plan_block_.resize(bytes);
        call(hm_plan_init, &plan_, plan_block_.data(), bytes, analysis_);
        call(hm_basis_size, analysis_, &bytes);
        basis_block_.resize(bytes);
        call(hm_basis_init, &basis_, basis_block_.data(), bytes, analysis_);
        call(hm_plan_factor, plan_, nullptr);
        call(hm_plan_solve, plan_, basis_, nullptr);
    }

    std::string name_;
    const hm_mesh& mesh_;
    std::int32_t wall_;
    cli::Block curves_block_, analysis_block_, plan_block_, basis_block_;
    const hm_curves* curves_ = nullptr;
    hm_analysis* analysis_ = nullptr;
    hm_plan* plan_ = nullptr;
    hm_basis* basis_ = nullptr;
    double solution_ = 0;
};

void run(const std::string& name, const hm_mesh& mesh, std::int32_t wall) {
    const Case with(name, mesh, wall);
    const hm_curves& curves = with.curves();
    deform::Movements movements;
    movements.control.assign(curves.control, curves.control + 2 * curves.n_control);
    with.print_row("turn 30", movements.rotation(30));
    with.print_row("turn 90", movements.rotation(90));
    with.print_row("camber .1", movements.camber(.1));
    with.print_row("camber .4", movements.camber(.4));
    with.print_row("bump .3", movements.bump(.3));
}

// Layers of quadrilaterals, the first 1e-5 chords high and the last as high as long, inside
// triangles.
bench::Case hybrid_case(std::int32_t size) {
    const double points_outside = 0.22;  // in squares of the wall's points; see bench::make_case()
    fixtures::HybridOptions options;
    options.first = 1e-5;
    options.radius = 20;
    int n = 0;  // points of the wall
    do {
        n += 2;
        options.layers =
            static_cast<int>(std::log(2 / (n * options.first)) / std::log(options.layer_growth));
    } while (n * (options.layers + points_outside * n) < size);
    options.ring_growth = 1 + 4 * std::acos(-1.0) / n;
    const int n_side = n / 2;
    bench::Case out;
    out.kind = "hybrid";
    out.mesh = hybrid_mesh(fixtures::naca4({}, n_side), options);
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) return 2;
    std::printf("%-22s %8s  %-9s %6s %10s %10s %7s %6s   %-14s   %s\n", "mesh", "points",
                "movement", "part", "solution", "improve", "ratio", "steps", "quality before",
                "after");
    std::istringstream sizes(argv[1]);
    try {
        for (std::int32_t size; sizes >> size;) {
            std::istringstream kinds(argv[2]);
            for (std::string kind; kinds >> kind;) {
                const bench::Case generated =
                    kind == "hybrid" ? hybrid_case(size) : bench::make_case(kind, size);
                run(generated.kind, generated.mesh.view(), fixtures::body);
            }
        }
        for (int i = 3; i < argc; ++i) {
            const std::string word = argv[i];
            const std::size_t colon = word.rfind(':'), slash = word.rfind('/', colon) + 1;
            const cli::Mesh mesh = cli::read_mesh(word.substr(0, colon));
            const std::int32_t wall = mesh.find_markers(word.substr(colon + 1)).at(0);
            run(word.substr(slash, colon - slash), mesh.view(), wall);
        }
    } catch (const std::exception& failure) {
        std::printf("failed: %s\n", failure.what());
        return 1;
    }
    return 0;
}
