// The sparse pattern holds every pair that shares a cell, and adds up what it is given.
#include <doctest/doctest.h>

#include <fixtures/matrices.hpp>

using namespace fixtures;
using harmorph::Index;

TEST_CASE("conductances between the points of any cell arrive where a dense matrix has them") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Case setup = two_body_case(kind, 6, 4);
        setup.set_free(far_field);
        Analysed const seen(setup);
        AssembledMatrix sparse(*seen.operator->());
        harmorph::Analysis const& a = *seen.operator->();
        std::size_t const n = static_cast<std::size_t>(setup.mesh.n_points());
        DenseMatrix dense(n);  // by points
        std::mt19937 random(5);
        auto const add = [&](Index p, Index q) {
            double const conductance = uniform(random);
            sparse.matrix.add(p, q, conductance);
            std::size_t const i = static_cast<std::size_t>(p), j = static_cast<std::size_t>(q);
            dense.at(i, i) += conductance;
            dense.at(j, j) += conductance;
            dense.at(i, j) -= conductance;
            dense.at(j, i) -= conductance;
        };
        harmorph::Mesh const mesh = core_mesh(setup.mesh);
        for (Index c = 0; c < mesh.n_cells; ++c) {
            harmorph::Cell const cell = mesh.cell(c);
            for (Index i = 0; i < cell.n; ++i)
                for (Index j = 0; j < i; ++j)
                    i % 2 == 0 ? add(cell.point[i], cell.point[j])
                               : add(cell.point[j], cell.point[i]);
        }
        DenseMatrix const found = sparse.unknowns();
        double worst = 0;
        for (std::size_t i = 0; i < sparse.size(); ++i)
            for (std::size_t j = 0; j < sparse.size(); ++j) {
                std::size_t const p =
                    static_cast<std::size_t>(sparse.point_at(static_cast<Index>(i)));
                std::size_t const q =
                    static_cast<std::size_t>(sparse.point_at(static_cast<Index>(j)));
                worst = std::fmax(worst, std::fabs(found.at(i, j) - dense.at(p, q)));
            }
        CHECK(worst < 1e-14);
        for (Index slot = 0; slot < a.wall().count; ++slot) {
            std::vector<double> const column =
                sparse.couplings_times([&](Index s) { return s == slot ? 1.0 : 0.0; });
            for (std::size_t i = 0; i < column.size(); ++i) {
                std::size_t const p =
                    static_cast<std::size_t>(sparse.point_at(static_cast<Index>(i)));
                worst = std::fmax(
                    worst, std::fabs(column[i] -
                                     dense.at(p, static_cast<std::size_t>(a.wall().point[slot]))));
            }
        }
        CHECK(worst < 1e-14);
    }
}

TEST_CASE("rows hold later columns only, in order and once, and as many as were counted") {
    Case setup = two_body_case(Cells::hybrid, 6, 4);
    Analysed const seen(setup);
    AssembledMatrix const sparse(*seen.operator->());
    harmorph::Matrix const& m = sparse.matrix;
    CHECK(m.start[m.n] == seen->matrix_sizes().entries);
    for (Index row = 0; row < m.n; ++row)
        for (harmorph::Offset k = m.start[row]; k < m.start[row + 1]; ++k) {
            CHECK(m.column[k] > row);
            CHECK(m.column[k] < m.n);
            if (k > m.start[row]) CHECK(m.column[k] > m.column[k - 1]);
        }
    CHECK(m.coupling_start[seen->wall().count] == seen->matrix_sizes().couplings);
}

TEST_CASE("faces are the entries between the ends of an edge") {
    for (bool const slides : {false, true}) {
        Case setup = two_body_case(Cells::hybrid, 6, 4);
        if (slides) setup.set_slip(far_field);
        Analysed const seen(setup);
        AssembledMatrix const sparse(*seen.operator->());
        harmorph::Matrix const& m = sparse.matrix;
        Index const components = m.components();
        CHECK(components == (slides ? 2 : 1));
        std::vector<std::uint8_t> marked(static_cast<std::size_t>(m.start[m.n]), 2),
            expected(marked.size(), 0);
        m.mark_faces(seen->topology().edges, span(marked));
        harmorph::Mesh const mesh = core_mesh(setup.mesh);
        for (Index c = 0; c < mesh.n_cells; ++c) {
            harmorph::Cell const cell = mesh.cell(c);
            for (Index side = 0; side < cell.n; ++side)
                for (Index p = 0; p < components; ++p)
                    for (Index q = 0; q < components; ++q) {
                        Index const a = cell.point[side], b = cell.point[(side + 1) % cell.n];
                        if (p != q && !m.slips(a) && !m.slips(b)) continue;
                        Index const i = m.row_of(components * a + p),
                                    j = m.row_of(components * b + q);
                        if (i < 0 || j < 0) continue;
                        for (harmorph::Offset k = m.start[std::min(i, j)];
                             k < m.start[std::min(i, j) + 1]; ++k)
                            if (m.column[k] == std::max(i, j))
                                expected[static_cast<std::size_t>(k)] = 1;
                    }
        }
        CHECK(marked == expected);
    }
}

TEST_CASE("rows tell unknowns, wall points, and points whose value is 0") {
    Case setup = two_body_case(Cells::hybrid, 6, 4);
    setup.mesh.add_point({0.5, 0.5});  // used by no cell
    Analysed const seen(setup);
    AssembledMatrix const sparse(*seen.operator->());
    Index unknowns = 0, on_wall = 0, zero = 0;
    for (Index point = 0; point < setup.mesh.n_points(); ++point) {
        Index const place = sparse.matrix.row_of(point);
        if (place >= 0) {
            CHECK(sparse.point_at(place) == point);
            ++unknowns;
        } else if (harmorph::Matrix::is_wall(place)) {
            CHECK(seen->wall().point[harmorph::Matrix::wall(place)] == point);
            ++on_wall;
        } else {
            CHECK(place == harmorph::none);
            ++zero;
        }
    }
    CHECK(unknowns == seen->graph().n);
    CHECK(on_wall == 48);
    CHECK(zero == 24 + 12 + 1);  // 36 points of the rectangle's sides
}

TEST_CASE("circulations are stored above the diagonal for any order of the points") {
    Case setup = two_body_case(Cells::hybrid, 6, 4);
    Analysed const seen(setup);
    harmorph::Analysis const& a = *seen.operator->();
    AssembledMatrix sparse(a, true);
    CHECK(sparse.matrix.is_complex());
    CHECK_FALSE(AssembledMatrix(a).matrix.is_complex());
    ComplexDenseMatrix by_points(static_cast<std::size_t>(setup.mesh.n_points()));
    std::mt19937 random(6);
    harmorph::Mesh const mesh = core_mesh(setup.mesh);
    for (Index c = 0; c < mesh.n_cells; ++c) {
        harmorph::Cell const cell = mesh.cell(c);
        for (Index k = 0; k < cell.n; ++k) {
            Index const p = cell.point[k], q = cell.point[(k + 1) % cell.n];
            double const conductance = uniform(random), circulation = uniform(random);
            harmorph::Matrix const& m = sparse.matrix;
            for (Index const place : {m.row_of(p), m.row_of(q)})
                if (place >= 0) m.diagonal[place] += conductance;
            Index const part = m.n / 3;  // what two threads would add
            for (harmorph::RowRange const rows :
                 {harmorph::RowRange{0, part}, harmorph::RowRange{part, m.n}})
                m.add_off_diagonal<true>(rows, m.row_of(p), m.row_of(q), conductance, circulation);
            std::size_t const i = static_cast<std::size_t>(p), j = static_cast<std::size_t>(q);
            by_points.at(i, i) += conductance;
            by_points.at(j, j) += conductance;
            by_points.at(i, j) += std::complex<double>(-conductance, circulation);
            by_points.at(j, i) += std::complex<double>(-conductance, -circulation);
        }
    }
    ComplexDenseMatrix const found = sparse.complex_unknowns();
    harmorph::Matrix const& m = sparse.matrix;
    double worst = 0, size = 0;
    auto const point = [&](std::size_t i) {
        return static_cast<std::size_t>(sparse.point_at(static_cast<Index>(i)));
    };
    for (std::size_t i = 0; i < sparse.size(); ++i)
        for (std::size_t j = 0; j < sparse.size(); ++j)
            worst = std::fmax(worst, std::abs(found.at(i, j) - by_points.at(point(i), point(j))));
    for (Index slot = 0; slot < a.wall().count; ++slot)
        for (Index c = m.coupling_start[slot]; c < m.coupling_start[slot + 1]; ++c) {
            std::complex<double> const coupling(m.coupling_value[c], m.coupling_imaginary[c]);
            std::size_t const i = point(static_cast<std::size_t>(m.coupling_row[c]));
            worst = std::fmax(
                worst, std::abs(coupling -
                                by_points.at(i, static_cast<std::size_t>(a.wall().point[slot]))));
            size = std::fmax(size, std::fabs(coupling.imag()));
        }
    CHECK(worst < 1e-14);
    CHECK(size > 0.1);
    sparse.matrix.clear();
    for (double const imaginary : m.imaginary) CHECK(imaginary == 0);
    for (double const imaginary : m.coupling_imaginary) CHECK(imaginary == 0);
}
