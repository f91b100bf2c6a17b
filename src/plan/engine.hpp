// The engine of a plan: one of a closed list, chosen by Method::engine, with one interface for all.
// tests/plan/test_plan.cpp covers this file.
#pragma once

#include <new>

#include "plan/direct_engine.hpp"
#include "plan/fas_engine.hpp"
#include "plan/multigrid_engine.hpp"

namespace harmorph {

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
    // Both are called once for an analysis: init() before the matrix has a sparsity pattern,
    // take_pattern() after that.
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
