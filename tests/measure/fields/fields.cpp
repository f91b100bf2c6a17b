// Measures the calls of harmorph_fields.h on a mesh of a million points, on one thread, in
// processor time: the smallest of several runs.
#include <harmorph_fields.h>
#include <harmorph_study.h>

#include <fixtures/naca0012.hpp>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>

namespace {

void require(hm_status status, hm_error const& error, const char* call) {
    if (status >= 0) return;
    std::printf("%s: %s\n", call, error.text);
    std::exit(1);
}

// Milliseconds of processor time of the fastest of several calls.
template <class Call>
double fastest(int runs, Call call) {
    double best = 1e30;
    for (int k = 0; k < runs; ++k) {
        std::clock_t const start = std::clock();
        call();
        best = std::fmin(best, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return best;
}

struct Analysed {
    std::unique_ptr<char[]> block;
    hm_analysis* analysis = nullptr;
    hm_error error;
    explicit Analysed(hm_mesh const& mesh) {
        hm_problem problem;
        HM_INIT(problem);
        problem.mesh = &mesh;
        std::size_t bytes = 0;
        require(hm_analysis_size(&problem, nullptr, &bytes, &error), error, "hm_analysis_size");
        block.reset(new char[bytes]);
        require(hm_analysis_init(&analysis, block.get(), bytes, &problem, nullptr, &error), error,
                "hm_analysis_init");
    }
};

void measure_swept_areas(fixtures::Mesh const& mesh) {
    hm_mesh const view = mesh.view();
    std::vector<double> x = mesh.x;
    for (double& each : x) each += 1e-3 * std::sin(each);
    hm_points const to = {x.data(), mesh.y.data(), 1};
    hm_error error;
    std::int64_t n = 0;
    require(hm_swept_count(&view, &n, &error), error, "hm_swept_count");
    std::vector<double> sides(static_cast<std::size_t>(n)), duals(sides);
    std::printf("%-52s %8.1f ms\n", "swept areas of all sides and dual faces", fastest(5, [&] {
                    require(hm_swept_areas(&view, nullptr, &to, sides.data(), duals.data(), nullptr,
                                           nullptr, &error),
                            error, "hm_swept_areas");
                }));
}

// The walls bend a little between two calls, as in a step of a solver.
void measure_distances(fixtures::Mesh mesh) {
    Analysed const analysed(mesh.view());
    hm_error error;
    std::size_t bytes = 0;
    std::int32_t const wall = fixtures::body;
    require(hm_walls_size(analysed.analysis, 1, &wall, &bytes, &error), error, "hm_walls_size");
    std::unique_ptr<char[]> const block(new char[bytes]);
    hm_walls* walls = nullptr;
    require(hm_walls_init(&walls, block.get(), bytes, analysed.analysis, 1, &wall, nullptr, &error),
            error, "hm_walls_init");
    hm_executor executor;
    HM_INIT(executor);
    executor.kernel = hm_best_kernel();
    std::size_t const n = mesh.x.size();
    std::vector<double> distance(n), again(n);
    std::vector<std::int32_t> face(n), hint(n);
    hm_points const at = {mesh.x.data(), mesh.y.data(), 1};
    auto const find = [&](const std::int32_t* with, std::vector<double>& to) {
        require(hm_wall_distance(walls, mesh.n_points(), &at, with, to.data(), face.data(), nullptr,
                                 &executor, &error),
                error, "hm_wall_distance");
    };
    find(nullptr, distance);
    hint = face;
    for (std::size_t k = 0; k < n; ++k) mesh.y[k] += 1e-2 * std::sin(mesh.x[k]);
    double const move =
        fastest(5, [&] { require(hm_walls_move(walls, &at, &error), error, "hm_walls_move"); });
    double const plain = fastest(5, [&] { find(nullptr, distance); });
    double const hinted = fastest(5, [&] { find(hint.data(), again); });
    std::printf("%-52s %8.2f ms\n", "walls move", move);
    std::printf("%-52s %8.1f ms\n", "wall distances without hints", plain);
    std::printf("%-52s %8.1f ms\n", "wall distances, the faces before the movement hints", hinted);
    if (distance != again) std::printf("the distances differ\n");
}

void measure_levels(fixtures::Mesh const& mesh) {
    Analysed const analysed(mesh.view());
    hm_error error;
    std::size_t bytes = 0;
    require(hm_levels_size(analysed.analysis, &bytes, &error), error, "hm_levels_size");
    std::unique_ptr<char[]> const block(new char[bytes]);
    hm_levels* levels = nullptr;
    std::printf("%-52s %8.1f ms\n", "coarse levels", fastest(2, [&] {
                    require(hm_levels_init(&levels, block.get(), bytes, analysed.analysis, nullptr,
                                           HM_AGGLOMERATE_AUTO, 0, &error),
                            error, "hm_levels_init");
                }));
    std::int32_t n = 0, n_levels = 0;
    require(hm_level_cells(levels, 1, nullptr, &n, &n_levels, &error), error, "hm_level_cells");
    std::vector<double> areas(static_cast<std::size_t>(n));
    hm_points const at = {mesh.x.data(), mesh.y.data(), 1};
    std::printf("%-52s %8.1f ms\n", "areas of the volumes of one level", fastest(3, [&] {
                    require(hm_level_areas(levels, 1, nullptr, &at, areas.data(), &error), error,
                            "hm_level_areas");
                }));
}

// Fields go from one mesh to the points of another, in the order of the mesh and shuffled.
void measure_interpolation(fixtures::Mesh const& from, fixtures::Mesh const& to) {
    hm_error error;
    std::unique_ptr<Analysed> analysed;
    std::printf("%-52s %8.1f ms\n", "analysis of the mesh with the fields",
                fastest(2, [&] { analysed = std::make_unique<Analysed>(from.view()); }));
    std::vector<double> x = to.x, y = to.y, field(from.x), value(to.x.size());
    std::int32_t const n = to.n_points();
    std::size_t bytes = 0;
    require(hm_interpolation_size(analysed->analysis, n, &bytes, &error), error, "size");
    std::unique_ptr<char[]> const block(new char[bytes]);
    hm_interpolation* object = nullptr;
    hm_interpolation_report report;
    HM_INIT(report);
    for (bool const shuffled : {false, true}) {
        for (std::size_t k = 0; shuffled && k < x.size(); ++k) {
            std::size_t const other = (k * 1664525 + 1013904223) % x.size();
            std::swap(x[k], x[other]);
            std::swap(y[k], y[other]);
        }
        hm_points const at = {x.data(), y.data(), 1};
        std::printf(
            "%-52s %8.1f ms\n",
            shuffled ? "the points in random order" : "cells and weights of all points",
            fastest(2, [&] {
                require(hm_interpolation_init(&object, block.get(), bytes, analysed->analysis,
                                              nullptr, n, &at, nullptr, nullptr, &report, &error),
                        error, "hm_interpolation_init");
            }));
    }
    std::printf("%-52s %8.1f ms\n", "one field", fastest(5, [&] {
                    require(hm_interpolate(object, 1, field.data(), value.data(), nullptr, &error),
                            error, "hm_interpolate");
                }));
    std::printf("%d points are outside, at most by %g\n", report.outside, report.max_distance);
}

// Two fields go from the control volumes of one mesh to those of another.
void measure_remap(fixtures::Mesh const& from, fixtures::Mesh const& to) {
    hm_error error;
    Analysed const source(from.view()), target(to.view());
    std::vector<double> field(from.x), value(2 * to.x.size()), covered(to.x.size());
    field.insert(field.end(), from.y.begin(), from.y.end());
    hm_remap_report report;
    HM_INIT(report);
    for (std::int32_t const order : {1, 2}) {
        std::size_t bytes = 0;
        require(hm_remap_size(source.analysis, target.analysis, 2, order, &bytes, &error), error,
                "hm_remap_size");
        std::unique_ptr<char[]> const work(new char[bytes]);
        std::printf("%-52s %8.1f ms\n",
                    order == 1 ? "two fields by control volumes, constant in each"
                               : "two fields by control volumes, linear in each",
                    fastest(2, [&] {
                        require(hm_remap(source.analysis, nullptr, target.analysis, nullptr, 2,
                                         order, field.data(), value.data(), covered.data(),
                                         work.get(), bytes, nullptr, &report, &error),
                                error, "hm_remap");
                    }));
    }
    std::printf("%d volumes are not covered, %d in part\n", report.uncovered, report.partial);
}

}  // namespace

int main(int n_arguments, char** arguments) {
    int const n = n_arguments > 1 ? std::atoi(arguments[1]) : 1000000;
    fixtures::Mesh const quads = fixtures::naca0012_viscous(n),
                         triangles = fixtures::naca0012_triangles(n);
    for (fixtures::Mesh const* const mesh : {&quads, &triangles}) {
        std::printf("%s: %d points, %d cells\n",
                    mesh == &quads ? "quads, 1e-5 chords high at the wall" : "triangles",
                    mesh->n_points(), mesh->n_cells());
        fixtures::Mesh const& other = mesh == &quads ? triangles : quads;
        measure_swept_areas(*mesh);
        measure_distances(*mesh);
        measure_levels(*mesh);
        measure_interpolation(*mesh, other);
        measure_remap(*mesh, other);
    }
    return 0;
}
