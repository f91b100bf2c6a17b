// Iterations of HM_MULTIGRID on meshes and conditions of every kind, from small meshes to large
// ones: 12 functions, to a residual of 1e-10.
#define DOCTEST_CONFIG_IMPLEMENT  // The fixtures check what they build.
#include <harmorph_study.h>
#include <doctest/doctest.h>

#include "cases.hpp"
#include "settings.hpp"

#include <fixtures/operators.hpp>
#include <fixtures/polygons.hpp>
#include <fixtures/solved.hpp>

#include <cmath>

namespace bench {
namespace {

constexpr Index max_iterations = 30;  // What the engine shall not exceed with real functions.

struct Trial {
    std::string name;
    fixtures::Case setup;
    Index operator_kind;
    double exponent;  // Of the weight; the default if it is 0.
};

fixtures::Case round_airfoil(fixtures::Mesh mesh) {
    fixtures::Case out = fixtures::airfoil_case(40, 12, fixtures::Cells::quads);
    out.mesh = std::move(mesh);
    return out;
}

// The ring of a circle that the kinds of cells divide.
fixtures::Case round_circle(fixtures::Mesh mesh, int n_round) {
    fixtures::Case out = fixtures::ring_case(2, n_round, 0.5, 10);
    out.mesh = std::move(mesh);
    return out;
}

// The layers of quadrilaterals at the wall have a third of the points, triangles the rest.
fixtures::Mesh mixed_mesh(double size) {
    int const n_side = static_cast<int>(std::sqrt(size / 2));
    fixtures::HybridOptions options;
    options.layers = n_side / 3;
    options.first = 1e-5;
    options.layer_growth = std::pow(1.02 / n_side / options.first, 1.0 / options.layers);
    options.ring_growth = 1 + 2 * std::acos(-1.0) / n_side;
    return fixtures::hybrid_mesh(fixtures::naca4({}, n_side), options);
}

std::vector<Trial> trials_of(double size) {
    std::vector<Trial> out;
    auto const add = [&](char const* name, fixtures::Case setup, Index kind = HM_LAPLACE,
                         double exponent = 0) {
        out.push_back({name, std::move(setup), kind, exponent});
    };
    Index const n = static_cast<Index>(size);
    fixtures::Case const layers = round_airfoil(make_case("thinnest", n).mesh);
    fixtures::Case const triangles = round_airfoil(make_case("unstructured", n).mesh);
    add("quads, first layer 1e-7", layers);
    add("quads and triangles, first layer 1e-5", round_airfoil(mixed_mesh(size)));
    int const n_round = 4 * static_cast<int>(std::sqrt(size / 4));
    int const bands = static_cast<int>(size) / n_round;
    add("hexagons", round_circle(fixtures::honeycomb(bands, n_round, 0.5, 10), n_round));
    out.back().setup.mesh.cell_layout = HM_CELLS_POLYGONS;
    add("triangles, conductivity 1/d", triangles, HM_WEIGHTED, 1);
    add("triangles, conductivity 1/d^2", triangles, HM_WEIGHTED, 2);
    add("quads, first layer 1e-7, conductivity 1/d^2", layers, HM_WEIGHTED, 2);
    fixtures::Case slipping = layers;
    slipping.set_slip(fixtures::far_field);
    add("quads, first layer 1e-7, slip at the far field", slipping);
    int const squares = 3 * static_cast<int>(std::sqrt(size) / 3);
    add("channel with slip walls", fixtures::slip_channel(squares, false));
    add("channel with slip walls, periodic", fixtures::slip_channel(squares, true));
    for (char const* const kind : {"iso", "viscous", "unstructured", "stretched100"})
        add((std::string(kind) + ", conformal").c_str(), round_airfoil(make_case(kind, n).mesh),
            HM_CONFORMAL);
    return out;
}

Index iterations(Trial& trial, Settings const& settings) {
    Options options{};
    options.engine = HM_MULTIGRID;
    options.operator_kind = trial.operator_kind;
    options.exponent = trial.exponent;
    options.executor = settings.executor;
    fixtures::Attempt const found(trial.setup.problem(), &options);
    require(found.status, found.error, trial.name.c_str());
    return found.report.iterations;
}

}  // namespace

void bench_iterations(Settings const& settings, Report& report) {
    Table table{"Iterations of multigrid to 1e-10", {"points", "mesh", "iterations"}, {}, {}};
    table.begin();
    for (Index const size : settings.sizes) {
        for (Trial& trial : trials_of(size)) {
            say(trial.name);
            Index const points = trial.setup.mesh.n_points(), found = iterations(trial, settings);
            table.add({count(points), trial.name, count(found)});
            if (trial.operator_kind != HM_CONFORMAL && found > max_iterations)
                table.notes.push_back("more than " + std::to_string(max_iterations) + ": " +
                                      trial.name + ", " + std::to_string(points) + " points");
        }
    }
    report.finish(table);
}

}  // namespace bench
