// One displacement of the wall, as a time step has it, against factor and solution of 20 functions.
#include "fixtures/memory.hpp"
#include "clock.hpp"
#include "ours.hpp"
#include "settings.hpp"

#include <map>

namespace bench {
namespace {

constexpr Index functions = 20;
constexpr Index several = 12;  // fields of one substitution

struct Operator {
    char const* name;
    Index number;
    double largest_share;  // of factor and solution that a displacement may cost
};
constexpr Operator operators[] = {{"laplace", HM_LAPLACE, 0.12}, {"conformal", HM_CONFORMAL, 0.20}};

// An analysis and a plan with one condition on the body.
class Plan {
public:
    Plan(Case const& mesh_case, Workspace& workspace, Settings const& settings, Index operator_kind,
         hm_curves const* curves)
        : workspace_(workspace) {
        hm_condition condition{};
        condition.struct_size = sizeof condition;
        condition.marker = fixtures::body;
        condition.kind = curves != nullptr ? HM_ON_CURVE : HM_GIVEN;
        condition.n_curves = curves != nullptr ? curves->n_curves : 0;
        hm_mesh const mesh = mesh_case.mesh.view();
        hm_problem problem{};
        problem.struct_size = sizeof problem;
        problem.mesh = &mesh;
        problem.curves = curves;
        problem.n_conditions = 1;
        problem.conditions = &condition;
        Options options{};
        options.operator_kind = operator_kind;
        options.executor = settings.executor;
        std::size_t bytes = 0;
        done(fixtures::analysis_size(&problem, &options, &bytes, &error_), "hm_analysis");
        void* block = workspace_.analysis.give(bytes);
        done(hm_analysis_init(&analysis_, fixtures::Memory(block, bytes), &problem, &options,
                              &error_),
             "hm_analysis_init");
        done(fixtures::plan_size(analysis_, &bytes, &error_), "hm_plan");
        block = workspace_.plan.give(bytes);
        done(hm_plan_init(&plan_, fixtures::Memory(block, bytes), analysis_, &error_),
             "hm_plan_init");
        done(fixtures::basis_size(analysis_, &bytes, &error_), "hm_basis");
        done(hm_basis_init(&basis_, fixtures::Memory(basis_block_.give(bytes), bytes), analysis_,
                           &error_),
             "hm_basis_init");
    }

    void factor() { done(hm_plan_factor(plan_, nullptr, &error_), "hm_plan_factor"); }
    void solve() { done(hm_plan_solve(plan_, basis_, nullptr, &error_), "hm_plan_solve"); }
    hm_plan* get() const { return plan_; }
    std::vector<Index> given_points() {
        Index n = 0;
        hm_given_points(plan_, nullptr, 0, &n, nullptr);
        std::vector<Index> out(at(n));
        done(hm_given_points(plan_, out.data(), n, &n, &error_), "hm_given_points");
        return out;
    }

private:
    Workspace& workspace_;
    Block basis_block_;
    hm_analysis* analysis_ = nullptr;
    hm_plan* plan_ = nullptr;
    hm_basis* basis_ = nullptr;
    hm_error error_{};

    void done(hm_status status, char const* call) const { require(status, error_, call); }
};

// A flexible trailing edge, a tenth of the chord up; and the arrays of all calls.
class Movement {
public:
    Movement(Case const& mesh_case, Plan& plan)
        : mesh_(mesh_case.mesh),
          plan_(plan.get()),
          points_(plan.given_points()),
          n_(mesh_case.mesh.x.size()),
          fields_(2 * n_ * several) {
        for (Index const point : points_) {
            double const x = mesh_case.mesh.x[at(point)];
            wall_.push_back(0);
            wall_.push_back(x > 0.6 ? 0.1 * (x - 0.6) * (x - 0.6) / 0.16 : 0);
        }
        for (std::size_t k = 0; k < several; ++k) {
            given_.push_back({wall_.data(), wall_.data() + 1, 2});
            to_.push_back({&fields_[2 * n_ * k], &fields_[2 * n_ * k + n_], 1});
            dj_.push_back({&fields_[2 * n_ * k], &fields_[2 * n_ * k + n_], 1});
        }
    }

    void displace(Index fields) {
        std::size_t bytes = 0;
        done(fixtures::displace_size(plan_, fields, &bytes, &error_), "hm_displace");
        void* const block = work_.give(bytes);
        done(hm_displace(plan_, static_cast<Index>(points_.size()), nullptr, fields, given_.data(),
                         nullptr, to_.data(), fixtures::Memory(block, bytes), nullptr, &error_),
             "hm_displace");
    }
    // Computes the adjoint of the fields that displace() has computed.
    void adjoint(Index fields) {
        std::size_t bytes = 0;
        done(fixtures::displace_size(plan_, fields, &bytes, &error_), "hm_displace");
        void* const block = work_.give(bytes);
        std::vector<double> gradient(2 * points_.size());
        std::vector<hm_points_out> const to(at(fields),
                                            {gradient.data(), gradient.data() + points_.size(), 1});
        done(hm_displace_adjoint(plan_, static_cast<Index>(points_.size()), nullptr, fields,
                                 dj_.data(), to.data(), fixtures::Memory(block, bytes), nullptr,
                                 &error_),
             "hm_displace_adjoint");
    }

    // Computes the areas that sides of cells, faces of the median dual and halves of sides sweep
    // from the mesh as it is to the place of the first field of displace().
    void sweep(hm_executor const* executor) {
        hm_mesh const mesh = mesh_.view();
        hm_points const to{&fields_[0], &fields_[n_], 1};
        std::int64_t n = 0;
        done(hm_swept_count(&mesh, &n, &error_), "hm_swept_count");
        areas_.resize(4 * static_cast<std::size_t>(n));
        done(hm_swept_areas(&mesh, nullptr, &to, &areas_[0], &areas_[static_cast<std::size_t>(n)],
                            &areas_[2 * static_cast<std::size_t>(n)], executor, &error_),
             "hm_swept_areas");
    }

private:
    fixtures::Mesh const& mesh_;
    hm_plan* plan_;
    std::vector<Index> points_;
    std::size_t n_;
    std::vector<double> wall_, fields_, areas_;
    std::vector<hm_points> given_, dj_;
    std::vector<hm_points_out> to_;
    Block work_;
    hm_error error_{};

    void done(hm_status status, char const* call) const { require(status, error_, call); }
};

}  // namespace

void bench_displace(Settings const& settings, Report& report) {
    std::string const threads = " (threads: " + std::to_string(settings.threads) + ")";
    Table ours{"One displacement of the wall [s]" + threads,
               {"mesh", "operator", "factor", "20 functions", "displacement", "% of both",
                "allowed %", "adjoint", "12 fields", "swept areas", "of one", "us/node", "growth"},
               {},
               {}};
    ours.begin();
    std::map<std::string, double> first;  // per node, of the smallest mesh of a kind
    Others others;
    for (std::string const& kind : settings.kinds)
        for (Index const size : settings.sizes) {
            Case const mesh_case = make_case(kind, size);
            double const nodes = mesh_case.mesh.n_points();
            for (Operator const& chosen : operators) {
                say(mesh_case.name() + ": " + chosen.name);
                Workspace workspace;
                Fit const fit(mesh_case, functions);
                double factor = 0, solve = 0;
                {
                    Plan curves(mesh_case, workspace, settings, chosen.number, &fit.curves());
                    factor = time_of([&] { curves.factor(); });
                    solve = time_of([&] { curves.solve(); });
                }
                Plan plan(mesh_case, workspace, settings, chosen.number, nullptr);
                plan.factor();
                Movement movement(mesh_case, plan);
                double const one = time_of([&] { movement.displace(1); });
                double const adjoint = time_of([&] { movement.adjoint(1); });
                double const swept = time_of([&] { movement.sweep(settings.executor); });
                double const many = time_of([&] { movement.displace(several); });
                double& per_node = first[kind + chosen.name];
                if (per_node == 0) per_node = one / nodes;
                ours.add({mesh_case.name(),
                          chosen.name,
                          seconds(factor),
                          seconds(solve),
                          seconds(one),
                          percent(one / (factor + solve)),
                          percent(chosen.largest_share),
                          seconds(adjoint),
                          seconds(many),
                          seconds(swept),
                          ratio(swept / one),
                          {1e6 * one / nodes, "%.3f"},
                          ratio(one / nodes / per_node)});
            }
        }
    ours.notes.push_back(
        "Medians, warm. 20 functions: hm_plan_solve. swept areas: all three arrays of "
        "hm_swept_areas; of one: in displacements. growth: us/node against the smallest mesh of "
        "the "
        "kind.");
    ours.notes.push_back(others.text());
    report.finish(ours);
}

}  // namespace bench
