// `make compare`: harmorph in one step and with --safe --heights --improve, linear elasticity,
// radial basis functions and inverse distances, on the same movements by the same measures. Built
// only where Eigen is installed.
//   compare FOLDER MESH:MARKER ...      airfoils of chord 1 from x = 0 to 1; the block of
//   tests/meshes comes always
#include "commands/commands.hpp"
#include "mesh/basis_file.hpp"
#include "curves/curve_file.hpp"
#include "basics/failure.hpp"
#include "commands/morph.hpp"
#include "basics/numbers.hpp"
#include "basics/output_file.hpp"
#include "commands/solver.hpp"
#include "bars.hpp"
#include "elasticity.hpp"
#include "inverse_distance.hpp"
#include "radial_basis.hpp"
#include "row.hpp"
#include "../deform/movements.hpp"
#include "../deform/task.hpp"

#include <cstdio>
#include <filesystem>
#include <set>

namespace compare {
namespace {

using deform::Movements;
using deform::task_on;

Motion motion_of(const cli::Mesh& mesh, std::int32_t wall) {
    Motion out;
    out.cells = {mesh.cell_start, mesh.cell_points};
    for (std::size_t k = 0; k < mesh.x.size(); ++k) out.start.emplace_back(mesh.x[k], mesh.y[k]);
    for (std::int32_t cell = 0; cell < out.cells.count(); ++cell) {
        const auto begin = out.cells.point.begin() + out.cells.start[cell],
                   end = begin + out.cells.size(cell);
        if (twice_area(out.start[begin[0]], out.start[begin[1]], out.start[begin[2]]) < 0)
            std::reverse(begin, end);
    }
    std::set<std::pair<std::int32_t, std::int32_t>> sides;  // as the cells go round
    for (std::int32_t cell = 0; cell < out.cells.count(); ++cell)
        for (std::int32_t k = 0; k < out.cells.size(cell); ++k)
            sides.insert({out.cells.at(cell, k), out.cells.at(cell, k + 1)});
    out.next.assign(mesh.x.size(), -1);
    std::set<std::int32_t> on_wall, outside;
    for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
        std::int32_t a = mesh.face_points[2 * face], b = mesh.face_points[2 * face + 1];
        if (sides.count({a, b}) == 0) std::swap(a, b);
        std::set<std::int32_t>& points = mesh.face_markers[face] == wall ? on_wall : outside;
        points.insert({a, b});
        if (mesh.face_markers[face] == wall) out.next[a] = b;
    }
    out.wall.assign(on_wall.begin(), on_wall.end());
    for (const std::int32_t point : outside)
        if (on_wall.count(point) == 0) out.outer.push_back(point);
    return out;
}

// The rows of a table, in order. The last row is that of harmorph's safe morph.
const char* const methods[] = {"elasticity 1/area", "RBF Wendland C2", "inverse distance",
                               "harmorph, one step", "harmorph --safe"};

void print(const std::vector<Row>& rows) {
    double min_quality = 0, mean_quality = 0, angle = 1e300, height = 1e300;
    for (const Row& row : rows) {
        if (!row.valid) continue;
        min_quality = std::max(min_quality, row.measures.min_quality);
        mean_quality = std::max(mean_quality, row.measures.mean_quality);
        angle = std::min(angle, row.measures.angle);
        height = std::min(height, row.measures.height_error);
    }
    // Within 2 % of the best: of quality, of a radian, and of the height.
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Row& row = rows[k];
        const Measures& measures = row.measures;
        const auto mark = [&](bool good) { return row.valid && good ? '*' : ' '; };
        std::printf("  %-18s  %5d  %8s  %8.3f%c  %8.3f%c", methods[k], row.steps,
                    row.valid ? "valid" : "inverted", measures.min_quality,
                    mark(measures.min_quality >= .98 * min_quality), measures.mean_quality,
                    mark(measures.mean_quality >= .98 * mean_quality));
        std::printf("  %7.2f%c  %6.3f  %6.3f  %7.4f%c  %8.4f  %8.5f  %6.1f\n", measures.angle,
                    mark(measures.angle <= angle + 1.15), measures.min_height, measures.max_height,
                    measures.height_error, mark(measures.height_error <= height + .02), row.setup,
                    row.movement, row.memory);
    }
}

// One mesh, its curve and the conditions of the safe morph.
class Comparison {
public:
    Comparison(const cli::Mesh& mesh, const cli::Task& task, std::int32_t wall,
               const cli::Threads& threads, const std::string& path)
        : mesh_(mesh), task_(task), motion_(motion_of(mesh, wall)), threads_(threads) {
        cli::Solver solver(mesh, task, threads);
        solver.run();
        cli::OutputFiles files;
        cli::write_basis(files.add(path), solver.basis(), mesh);
        files.commit();
        basis_ = std::make_unique<cli::Basis>(path, mesh);
    }
    // moves(t): of the control points. All methods get the wall that the B-spline makes of them.
    void compare(const std::string& what, const std::function<std::vector<double>(double)>& moves) {
        motion_.wall_at = [&](double t) {
            const cli::Field field = cli::displacement(*basis_, mesh_, moves(t), threads_);
            std::vector<Point> out;
            for (const std::int32_t k : motion_.wall)
                out.push_back(motion_.start[k] + Point(field.x[k], field.y[k]));
            return out;
        };
        std::printf("  %s\n", what.c_str());
        const std::vector<Row> rows = {
            alone([&] { return moved_by<Elasticity>(motion_); }),
            alone([&] { return moved_by<RadialBasis>(motion_); }),
            alone([&] { return moved_by<InverseDistance>(motion_); }),
            alone([&] { return by_one_step(moves(1)); }),
            alone([&] { return by_safe_morph(moves(1)); }),
        };
        print(rows);
        count(rows);
        bars_.groups.push_back({what, {}, {}});
        bars_.methods.assign(std::begin(methods), std::end(methods));
        for (const Row& row : rows) {
            bars_.groups.back().least.push_back(row.valid ? row.measures.min_quality : 0);
            bars_.groups.back().mean.push_back(row.valid ? row.measures.mean_quality : 0);
        }
    }
    // After the last movement.
    void draw(const std::string& path, const std::string& mesh) const {
        cli::OutputFiles files;
        bars_.draw(files.add(path));
        files.commit();
        std::printf(
            "\n"
            "figure %s Size-skew quality on %s by method: full bars at least, outlines on average; "
            "no bar where cells "
            "are inverted.\n",
            std::filesystem::path(path).filename().c_str(), mesh.c_str());
    }
    static int best, columns;  // of the safe morph

private:
    double time_of_solution() const {
        const double begin = seconds();
        cli::Solver solver(mesh_, task_, threads_);
        solver.run();
        return seconds() - begin;
    }
    Row by_one_step(const std::vector<double>& moves) const {
        Row row;
        row.setup = time_of_solution();
        const double begin = seconds();
        const cli::Field field = cli::displacement(*basis_, mesh_, moves, threads_);
        row.movement = seconds() - begin;
        std::vector<Point> at = motion_.start;
        for (std::size_t k = 0; k < at.size(); ++k) at[k] += Point(field.x[k], field.y[k]);
        row.valid = motion_.is_valid(at);
        row.measures = measure(motion_, at);
        return row;
    }
    Row by_safe_morph(const std::vector<double>& moves) const {
        Row row;
        row.setup = time_of_solution();
        const double begin = seconds();
        auto options = cli::sized<hm_safe_options>();
        options.heights = 1;
        cli::Morph morph(*basis_, mesh_, moves, options, basis_->info().operator_kind, threads_);
        if (morph.valid()) morph.improve(*basis_, mesh_, threads_);
        row.movement = seconds() - begin;
        row.steps = morph.safe.steps;
        row.valid = morph.valid() && morph.refusal.empty();
        std::vector<Point> at;
        for (std::size_t k = 0; k < mesh_.x.size(); ++k)
            at.emplace_back(morph.moved.x[k], morph.moved.y[k]);
        row.measures = measure(motion_, at);
        return row;
    }
    static void count(const std::vector<Row>& rows) {
        const Measures& own = rows.back().measures;
        bool within[4] = {true, true, true, true};
        for (const Row& row : rows) {
            const Measures& measures = row.measures;
            if (!row.valid) continue;
            within[0] = within[0] && own.min_quality >= .98 * measures.min_quality;
            within[1] = within[1] && own.mean_quality >= .98 * measures.mean_quality;
            within[2] = within[2] && own.angle <= measures.angle + 1.15;
            within[3] = within[3] && own.height_error <= measures.height_error + .02;
        }
        for (const bool good : within) {
            best += good && rows.back().valid ? 1 : 0;
            ++columns;
        }
    }

    const cli::Mesh& mesh_;
    const cli::Task task_;
    Motion motion_;
    const cli::Threads& threads_;
    std::unique_ptr<cli::Basis> basis_;
    Bars bars_;
};
int Comparison::best = 0, Comparison::columns = 0;

void begin_table(const std::string& mesh, const char* remark) {
    std::printf(
        "\n"
        "== Against other methods: %s\n"
        "\n"
        "table The same movements by other methods%s. Quality is size-skew; angle is the mean "
        "change [degrees] "
        "between the wall and the first-layer edges; heights are ratios of first-layer heights, "
        "error the mean of "
        "|ratio - 1|; a star: the best, or within 2 %% of the best valid one; seconds of processor "
        "time for what is done once for a mesh, and for this movement; memory [MB]\n",
        mesh.c_str(), remark);
    std::printf("  %-18s  %5s  %8s  %9s  %9s  %8s  %6s  %6s  %8s  %8s  %8s  %6s\n", "method",
                "steps", "cells", "min q", "mean q", "angle", "lowest", "highest", "error",
                "set-up", "movement", "memory");
}

void airfoil(const std::string& folder, const std::string& path, const std::string& marker,
             const cli::Threads& threads) {
    const std::string curve_path = folder + "/compared.curve";
    std::printf(
        "\n== The curve of the comparison: %s\n\ntable The curve through the airfoil's points\n  "
        "what  is\n",
        path.c_str());
    cli::run_command({"fit", path, "--marker", marker, "-o", curve_path});
    begin_table(path, "");
    const cli::Mesh mesh = cli::read_mesh(path);
    const cli::Curves curves = cli::read_curves(curve_path);
    const Movements movements{curves.control};
    const std::int32_t wall = mesh.find_markers(marker)[0];
    Comparison comparison(mesh, task_on(mesh, marker, curves), wall, threads,
                          folder + "/compared.basis");
    for (const double height : {.1, .3, .6})
        comparison.compare("camber " + cli::brief(height),
                           [&](double t) { return movements.camber(t * height); });
    for (const double degrees : {20., 60., 120.})
        comparison.compare("rotation " + cli::brief(degrees),
                           [&](double t) { return movements.rotation(t * degrees); });
    comparison.compare("bump .3", [&](double t) { return movements.bump(.3 * t); });
    comparison.compare("flap 30", [&](double t) { return movements.flap(30 * t); });
    const std::string name = std::filesystem::path(path).stem().string();
    comparison.draw(folder + "/compared-" + name + ".svg", name);
}

void block(const std::string& folder, const cli::Threads& threads) {
    const cli::Mesh mesh = cli::read_mesh("tests/meshes/block.su2");
    const Movements movements{{.4, .48, .6, .48, .6, .52, .4, .52}};
    begin_table("tests/meshes/block.su2",
                " (the outer sides slide in harmorph's mesh, and are fixed in the others)");
    cli::Curves curves;
    curves.control = movements.control;
    curves.curves.push_back({1, HM_TIED, {0, 1, 2, 3, 0}, {0, 0, 1, 2, 3, 4, 4}});
    cli::Task task = task_on(mesh, "block", curves);
    auto condition = cli::sized<hm_condition>();
    condition.marker = mesh.find_markers("outer")[0];
    condition.kind = HM_SLIP;
    task.conditions.push_back(condition);
    Comparison comparison(mesh, task, mesh.find_markers("block")[0], threads,
                          folder + "/compared.basis");
    comparison.compare("60 degrees and (-.2, -.3)", [&](double t) {
        return movements.rotation(60 * t, .5, .5, -.2 * t, -.3 * t);
    });
    comparison.draw(folder + "/compared-block.svg", "the block");
}

}  // namespace
}  // namespace compare

int main(int argc, char** argv) {
    try {
        std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
        const std::string folder = argc > 1 ? argv[1] : ".";
        std::filesystem::create_directories(folder);
        const cli::Threads threads(1);
        compare::block(folder, threads);
        for (int i = 2; i < argc; ++i) {
            const std::string word = argv[i];
            const std::size_t colon = word.rfind(':');
            compare::airfoil(folder, word.substr(0, colon), word.substr(colon + 1), threads);
        }
        std::printf("\nharmorph is best or within 2 %% of the best in %d of %d columns\n",
                    compare::Comparison::best, compare::Comparison::columns);
        return 0;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "compare: %s\n", failure.what());
        return 2;
    }
}
