// Slip lines beside thin cells: the couplings of those drown all others in a diagonal, so nothing
// may depend on it.
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/channels.hpp>
#include <fixtures/o_mesh.hpp>

using namespace fixtures;

namespace {

constexpr std::int32_t operators[] = {HM_LAPLACE, HM_WEIGHTED, HM_CONFORMAL};

// Thin cells lie on the wall, which stands on the slip line.
Case thin_half_ring(double first, Cells kind = Cells::quads) {
    std::vector<double> radii = stretched(first, 1.5, 40);
    for (double& r : radii) r += 0.5;
    return half_ring(radii, 24, kind);
}

// Thin cells lie on the slip line as well, which goes on before and behind a flat wall from x = -1
// to 1.
Case thin_plate(double first, Cells kind = Cells::quads) {
    Case out;
    std::vector<double> const heights = stretched(first, 2, 40);
    int const n = 32, n_before = 8, n_wall = 16, row = n + 1;
    for (double const y : heights)
        for (int i = 0; i <= n; ++i) out.mesh.add_point({0.125 * (i - n_before) - 1, y});
    int const top_row = (int(heights.size()) - 1) * row;
    for (int k = 0; k < top_row; k += row)
        for (int i = 0; i < n; ++i)
            out.mesh.add_quad(k + i, k + i + 1, k + i + 1 + row, k + i + row, kind != Cells::quads);
    for (int i = 0; i < n; ++i) {
        bool const on_wall = i >= n_before && i < n_before + n_wall;
        out.mesh.add_face(i, i + 1, on_wall ? std::int32_t{body} : slip_line);
        out.mesh.add_face(top_row + i + 1, top_row + i, far_field);
    }
    for (int k = 0; k < top_row; k += row) {
        out.mesh.add_face(k + n, k + n + row, far_field);
        out.mesh.add_face(k + row, k, far_field);
    }
    out.curves = flat_wall();
    out.put_on_curves(body);
    out.set_slip(slip_line);
    for (int i = n_before; i <= n_before + n_wall; ++i) out.give(i, 1.0 * (i - n_before) / n_wall);
    return out;
}

}  // namespace

TEST_CASE("a shift along the line, the far field free: everything goes along, to rounding") {
    for (double const first : {1e-3, 1e-7, 1e-9, 1e-11})
        for (double const angle : {0.0, 0.4, 2.0}) {
            if (first < 1e-9 && angle > 0)
                continue;  // turned coordinates do not resolve the line's direction
            Complex const turn = std::polar(1.0, angle);
            for (Case const& straight :
                 {thin_half_ring(first), thin_plate(first), thin_plate(first, Cells::triangles)}) {
                for (std::int32_t const kind : {HM_LAPLACE, HM_WEIGHTED}) {
                    Case setup = similar(straight, turn, 0);
                    setup.set_free(far_field);
                    Options const options = options_of(kind);
                    Solved const solved(setup, &options);
                    Field const moved =
                        displacement(solved, similarity_move(setup.curves, 1, 0, turn));
                    INFO("first cell " << first << ", angle " << angle << ", "
                                       << solved.report.refinements << " steps");
                    CHECK(largest_difference(moved, Field(moved.size(), turn)) < 1e-9);
                }
            }
        }
}

TEST_CASE("the half with slip moves as the half of the whole does") {
    for (double const first : {1e-5, 1e-7, 1e-9})
        for (std::int32_t const kind : operators) {
            Case half_ring = thin_half_ring(first), whole = mirrored(half_ring);
            Options const options = options_of(kind);
            Solved const a(half_ring, &options), b(whole, &options);
            std::vector<double> const move = symmetric_move(4);
            Field of_whole = displacement(b, move);
            of_whole.resize(half_ring.mesh.x.size());
            CHECK(largest_difference(displacement(a, move), of_whole) < 1e-9);
        }
}

TEST_CASE("x moves as beside a free line and y as beside a fixed line, in any orientation") {
    for (double const first : {1e-5, 1e-7, 1e-9}) {
        std::vector<double> const move = some_move(6, 0.3, 8);
        Case setup = thin_plate(first), free = setup, fixed = setup;
        free.conditions.back().kind = HM_FREE;
        fixed.conditions.back().kind = HM_FIXED;
        for (std::int32_t const kind : operators) {
            Options const options = options_of(kind);
            Solved const solved(setup, &options);
            CHECK(solved.report.refinements >= 1);
            Field const moved = displacement(solved, move);
            Complex const turn = std::polar(1.0, 0.4);
            Case beside = similar(setup, turn, 0);
            Field of_turned = displacement(Solved(beside, &options), turned(move, turn));
            for (Complex& d : of_turned) d /= turn;
            CHECK(largest_difference(of_turned, moved) <
                  (first < 1e-8 ? 1e-6 : 1e-8));  // coordinates are rounded
            if (kind == HM_CONFORMAL) continue;
            Field const x = displacement(Solved(free, &options), move),
                        y = displacement(Solved(fixed, &options), move);
            Field both;
            for (std::size_t k = 0; k < x.size(); ++k) both.push_back({x[k].real(), y[k].imag()});
            CHECK(largest_difference(moved, both) < 1e-10);
        }
    }
}
