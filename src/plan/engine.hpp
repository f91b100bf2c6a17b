// The engine of a plan: one of a closed list, chosen by Method::engine, with one interface for all.
// tests/plan/test_plan.cpp covers this file.
#pragma once

#include <new>

#include "direct/multifrontal.hpp"
#include "multigrid/full_approximation.hpp"
#include "multigrid/iteration.hpp"
#include "multigrid/multigrid.hpp"
#include "plan/equations.hpp"

namespace harmorph {

// The common members of all engines that iterate on levels.

// Iterative is a BlockIteration, which iterates to the given tolerance, so solutions are not
// refined.
template <class Iterative>
struct LevelEngine {
    static constexpr bool trusted = true;

    Iterative iteration;

    void lay_out(Arena& arena, Analysis const& analysis, Index columns) noexcept {
        Index const n = analysis.graph().n;
        Offset const entries = analysis.matrix_sizes().entries;
        bool const is_complex = analysis.matrix_sizes().kind == MatrixKind::complex;
        iteration.lay_out(arena, n, is_complex ? 2 * columns : columns,
                          analysis.problem().iteration, analysis.problem().executor);
        auto const shared = arena.mark();
        iteration.lay_out_work(arena, n, entries);
        arena.release(shared);
        iteration.lay_out_vectors(arena, n);
        arena.release(shared);
    }
    void init(Analysis const&) const noexcept {}
    void take_pattern(Analysis const&, Matrix const&) const noexcept {}
    Status examine(Equations const&, Span<Real>, Fault&) const noexcept { return Status::ok; }
    Status correct(Rows const&, Fault&) const noexcept { return Status::ok; }
    Offset idle_bytes() const noexcept { return 0; }
    const Agglomeration* levels() const noexcept { return nullptr; }
};

// The direct engine of a plan: a multifrontal factor of the matrix, which also serves iterative
// refinement.

// AnyEngine describes the members.
struct DirectEngine {
    Multifrontal factor;
    bool trusted = false;  // Nothing cancelled in the factor, so solutions need no refinement.

    void lay_out(Arena& arena, Analysis const& analysis, Index columns) noexcept;
    void init(Analysis const& analysis) noexcept;
    void take_pattern(Analysis const&, Matrix const&) const noexcept {}
    Status set_up(Equations const& equations, Points points, Progress const& progress,
                  Fault& fault) noexcept;
    // `work` [n] is overwritten.
    Status examine(Equations const& equations, Span<Real> work, Fault& fault) noexcept;
    Status solve(Equations const& equations, DofValues const& dofs, Progress const& progress,
                 IterationReport& report, Fault& fault) noexcept;
    Status correct(Rows const& rows, Fault& fault) noexcept {
        return factor.solve(rows, Progress{}, fault);
    }
    // Returns the size of the memory that only set_up() needs.
    Offset idle_bytes() const noexcept;
    const Agglomeration* levels() const noexcept { return nullptr; }
};

// The engine fas of a plan: the paper's iteration, for the compact scheme and for nodal gradients.
struct FasEngine : LevelEngine<FullApproximation> {
    Span<std::uint8_t> faces;  // [entries] Tells which of the matrix's entries are mesh edges.

    void lay_out(Arena& arena, Analysis const& analysis, Index columns) noexcept {
        Method const& method = analysis.problem().method;
        if (method.nodal_gradients()) {
            iteration.use_scheme(analysis.problem().mesh.n_points,
                                 method.scheme == Scheme::nodal_gradient);
        }
        arena.take(faces, analysis.matrix_sizes().entries);
        LevelEngine::lay_out(arena, analysis, columns);
    }
    void take_pattern(Analysis const& analysis, Matrix const& matrix) noexcept {
        matrix.mark_faces(analysis.topology().edges, faces);
    }
    const Agglomeration* levels() const noexcept { return &iteration.levels; }
    Status set_up(Equations const& equations, Points points, Progress const&,
                  Fault& fault) noexcept {
        iteration.volumes.measure(equations.cells(), points, equations.matrix().rows_of_dofs());
        return iteration.set_up(equations.matrix().rows(faces), fault);
    }
    Status solve(Equations const& equations, DofValues const& dofs, Progress const& progress,
                 IterationReport& report, Fault& fault) noexcept {
        bool const nodal_gradients = equations.method().nodal_gradients();
        if (nodal_gradients)
            equations.nodal().set_right_hand_sides(dofs, dofs.columns(equations.matrix()));
        NodalGradient const* const scheme = nodal_gradients ? &equations.nodal().scheme : nullptr;
        return iteration.solve(dofs.rows(equations.matrix()), scheme, progress, report, fault);
    }
};

// The engine multigrid of a plan: conjugate gradients with algebraic multigrid.
struct MultigridEngine : LevelEngine<Multigrid> {
    void lay_out(Arena& arena, Analysis const& analysis, Index columns) noexcept {
        iteration.lay_out_levels(arena, analysis.graph().n, analysis.matrix_sizes().entries);
        LevelEngine::lay_out(arena, analysis, columns);
    }
    Status set_up(Equations const& equations, Points, Progress const&, Fault& fault) noexcept {
        Matrix const& matrix = equations.matrix();
        iteration.kernel = equations.method().kernel;
        return iteration.set_up(matrix.rows({}), matrix.imaginary_rows(), fault);
    }
    Status solve(Equations const& equations, DofValues const& dofs, Progress const& progress,
                 IterationReport& report, Fault& fault) noexcept {
        return iteration.solve(equations.matrix(), dofs, progress, report, fault);
    }
};

// A new engine is a type with these members in a header, a line of the union and of visit(), and a
// row of engine_traits.
struct AnyEngine {
    Engine kind = Engine::direct;
    union {
        DirectEngine direct;
        MultigridEngine multigrid;
        FasEngine fas;
    };

    template <class Self, class Body>
    static auto visit(Self& self, Body const& body) noexcept {
        switch (self.kind) {
            case Engine::direct: return body(self.direct);
            case Engine::multigrid: return body(self.multigrid);
            case Engine::fas: break;
        }
        return body(self.fas);
    }

    AnyEngine() noexcept : direct() {}
    void choose(Engine chosen) noexcept {
        kind = chosen;
        visit(*this, [](auto& engine) { start(engine); });
    }

    // Working space that only set_up() or solve() needs is laid out last, so that the arrays laid
    // out next may overlap with it. `columns` is the number of right-hand sides of all functions.
    void lay_out(Arena& arena, Analysis const& analysis, Index columns) noexcept {
        visit(*this, [&](auto& engine) { engine.lay_out(arena, analysis, columns); });
    }
    // init() and take_pattern() are called once for an analysis: init() before the matrix has a
    // sparsity pattern, take_pattern() after that.
    void init(Analysis const& analysis) noexcept {
        visit(*this, [&](auto& engine) { engine.init(analysis); });
    }
    void take_pattern(Analysis const& analysis, Matrix const& matrix) noexcept {
        visit(*this, [&](auto& engine) { engine.take_pattern(analysis, matrix); });
    }

    // Computes the factor or the levels of assembled equations. On Status::not_positive, fault.item
    // is a position of the elimination.
    Status set_up(Equations const& equations, Points points, Progress const& progress,
                  Fault& fault) noexcept {
        return visit(
            *this, [&](auto& engine) { return engine.set_up(equations, points, progress, fault); });
    }
    // Decides whether solutions are accurate without refinement. work [n] is overwritten.
    Status examine(Equations const& equations, Span<Real> work, Fault& fault) noexcept {
        return visit(*this, [&](auto& engine) { return engine.examine(equations, work, fault); });
    }
    bool trusted() const noexcept {
        return visit(*this, [](auto const& engine) { return bool{engine.trusted}; });
    }
    // Replaces the right-hand sides of the unknowns by the functions, in place.
    Status solve(Equations const& equations, DofValues const& dofs, Progress const& progress,
                 IterationReport& report, Fault& fault) noexcept {
        return visit(*this, [&](auto& engine) {
            return engine.solve(equations, dofs, progress, report, fault);
        });
    }
    // Replaces residuals by corrections, in place; only engines that factor do so.
    Status correct(Rows const& rows, Fault& fault) noexcept {
        return visit(*this, [&](auto& engine) { return engine.correct(rows, fault); });
    }

    // Returns the number of bytes that only set_up() or solve() needs; refinement may use them
    // without making the plan larger.
    Offset idle_bytes() const noexcept {
        return visit(*this, [](auto const& engine) { return engine.idle_bytes(); });
    }
    // Returns the levels of agglomeration, or null if there are none.
    const Agglomeration* levels() const noexcept {
        return visit(*this, [](auto const& engine) { return engine.levels(); });
    }

private:
    template <class Chosen>
    static void start(Chosen& engine) noexcept {
        ::new (&engine) Chosen();
    }
};

}  // namespace harmorph
