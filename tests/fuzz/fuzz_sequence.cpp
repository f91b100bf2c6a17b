// Calls in any order, with objects of two problems that may or may not belong together: solved and
// unsolved bases, shares of the functions, rows of some points, combined functions, functions in
// single precision. The same object may be several arguments of one call. Each call is refused with
// a reason and writes nothing, or succeeds. Calls that need something that an object lacks must
// refuse it.
#include <harmorph_space.h>
#include <harmorph_bases.h>
#include <harmorph_design.h>
#include "private.h"
#include <fixtures/memory.hpp>
#include <harmorph_study.h>
#include "solution.hpp"
#include "target.hpp"

#include <cmath>
#include <optional>

namespace fuzz {
namespace {

class Sequence {
public:
    explicit Sequence(Input& input)
        : input_(input), problem_{make_problem(input), make_problem(input)} {
        for (std::size_t k = 0; k < 2; ++k) {
            all_[k].emplace(*problem_[k], input);
            if (all_[k]->analysis == nullptr || all_[k]->basis == nullptr) continue;
            add_objects(*all_[k]);
        }
        std::size_t const most =
            std::max(problem_[0]->domain.points.size(), problem_[1]->domain.points.size());
        x_.assign(most, 7);
        y_.assign(most, 7);
        move_.resize(2 * most + 200);
        for (double& number : move_) number = 0.01 * input.between(-1, 1);
    }

    Outcome run() {
        bool any = false;
        for (std::int32_t k = input_.from(3, 20); k > 0; --k) {
            error_ = {};
            hm_status const status = call();
            if (status == none) continue;
            expect_told(status, error_);
            any = any || status >= 0;
            if (status < 0) expect_untouched(x_), expect_untouched(y_);
            std::fill(x_.begin(), x_.end(), 7.0);
            std::fill(y_.begin(), y_.end(), 7.0);
        }
        for (std::optional<Solution>& solution : all_) solution->blocks.expect_intact();
        return any ? Outcome::done : Outcome::refused;
    }

private:
    static constexpr hm_status none = 1000;

    enum class Kind { whole, share, rows, combined, single };
    struct Object {
        hm_basis* basis;
        Kind kind;
        bool is_solved() const { return info_of(basis).solved == 1; }
        bool has_all_functions() const { return kind != Kind::share; }
        // hm_transfer reads functions of control points in double precision at all points of a
        // mesh.
        bool can_be_transferred() const { return kind == Kind::whole && is_solved(); }
        std::vector<unsigned char> bytes() const {
            unsigned char const* const begin = reinterpret_cast<unsigned char const*>(basis);
            return {begin, begin + info_of(basis).bytes};
        }
    };

    template <class Size, class Init>
    void add(Solution& solution, Kind kind, hm_basis*& made, Size const& size, Init const& init) {
        std::size_t bytes = 0;
        if (size(&bytes, nullptr) < 0) return;
        if (init(solution.blocks.take(bytes).data(), bytes, nullptr) >= 0)
            objects_.push_back({made, kind});
    }
    void add_objects(Solution& solution) {
        objects_.push_back({solution.basis, Kind::whole});
        hm_basis* made = nullptr;
        add(solution, Kind::whole, made, size_by(fixtures::basis_size, solution.analysis),
            init_by(hm_basis_init, &made, solution.analysis));
        std::int32_t const n = solution.problem.functions();
        if (solution.status < 0 || n < 2 || !input_.one_in(2)) return;
        std::int32_t const first = input_.from(0, n - 1),
                           held = input_.from(0, n - 1 - first + (first > 0));
        add(solution, Kind::share, made,
            size_by(hm_private_share_size, solution.analysis, first, held),
            [&](void* block, std::size_t bytes, hm_error* e) {
                hm_status const status =
                    hm_private_share_init(&made, block, bytes, solution.analysis, first, held, e);
                return status < 0 || input_.one_in(4)
                           ? status
                           : hm_plan_solve(solution.plan, made, nullptr, e);
            });
        std::int32_t const base = solution.problem.mesh.index_base,
                           list[] = {base + 2, base, base + 1, base + 2};
        add(solution, Kind::rows, made, size_by(hm_private_extract_size, solution.basis, 4),
            init_by(hm_private_extract_init, &made, solution.basis, 4, &list[0]));
        std::vector<double> const ones(at(n), 1.0);
        add(solution, Kind::combined, made, size_by(fixtures::combine_size, solution.basis, 1, 1),
            init_by(hm_combine, &made, solution.basis, 1, 1, ones.data()));
        add(solution, Kind::single, made, size_by(fixtures::single_size, solution.basis),
            init_by(hm_single_init, &made, solution.basis));
    }

    Solution& some() { return *all_[input_.below(2)]; }
    Object const& some_object() {
        return objects_[input_.below(static_cast<std::uint32_t>(objects_.size()))];
    }

    // The status of a call that needs all functions, solved.
    static hm_status checked(Object const& object, hm_status status) {
        bool const complete = object.has_all_functions() && object.is_solved();
        expect((status >= 0) == complete,
               complete ? "a complete basis is refused" : "an incomplete basis is taken");
        return status;
    }

    hm_status call() {
        if (objects_.empty()) return none;
        Object const object = some_object();
        hm_basis* const basis = object.basis;
        hm_plan* const plan = some().plan;
        hm_mesh const& mesh = problem_[input_.below(2)]->mesh;
        hm_points_out const out{x_.data(), y_.data(), 1};
        hm_points const in{x_.data(), y_.data(), 1};
        if (plan == nullptr) return none;
        std::size_t bytes = 0;
        switch (input_.below(15)) {
            case 0: return hm_plan_factor(plan, nullptr, &error_);
            case 1: {
                hm_solve_report report = sized<hm_solve_report>();
                return hm_plan_solve(plan, basis, &report, &error_);
            }
            case 2:
                return checked(object,
                               hm_morph(basis, move_.data(), input_.one_in(2) ? &in : nullptr, &out,
                                        nullptr, &error_));
            case 3: {
                std::vector<double> gradient(move_.size());
                return checked(object, hm_adjoint(basis, &in, gradient.data(), nullptr, &error_));
            }
            case 4: {
                hm_quality_report report = sized<hm_quality_report>();
                return hm_assess(basis, &mesh, nullptr, nullptr, nullptr, nullptr, nullptr, &report,
                                 &error_);
            }
            case 5: {
                hm_step_report report = sized<hm_step_report>();
                return hm_assess(basis, &mesh, nullptr, &in, nullptr, nullptr, &report, nullptr,
                                 &error_);
            }
            case 6: {
                hm_status const status = fixtures::safe_move_size(plan, basis, &bytes, &error_);
                if (status < 0) return status;
                Block const work(bytes, 0, 0x7F);
                hm_safe_options options = sized<hm_safe_options>();
                const hm_basis* const other = some_object().basis;
                if (input_.one_in(3)) options.others = &other, options.n_others = 1;
                hm_basis* const derivative = input_.one_in(3) ? some_object().basis : nullptr;
                hm_status const moved =
                    fixtures::safe_move(plan, basis, move_.data(), &out, derivative, work.data(),
                                        bytes, &options, nullptr, &error_);
                if (derivative == nullptr) return moved;
                bool const is_read =
                    derivative == basis || (options.n_others > 0 && derivative == other);
                expect(!is_read || moved < 0, "a basis that is read receives the derivative");
                return moved;
            }
            case 7: {
                Solution& fine = some();
                if (fine.analysis == nullptr) return none;
                hm_status const size =
                    fixtures::transfer_size(fine.analysis, &mesh, &bytes, &error_);
                if (size < 0) return size;
                Block const work(bytes, 0, 0x7F);
                Object const coarse = some_object();
                bool const possible = coarse.can_be_transferred() && coarse.basis != basis;
                std::vector<unsigned char> const before = object.bytes();
                hm_status const status =
                    hm_transfer(basis, fixtures::Memory(work.data(), bytes), fine.analysis,
                                coarse.basis, &mesh, nullptr, &error_);
                expect(possible || status < 0, "a basis is transferred that cannot be");
                expect(possible || object.bytes() == before,
                       "a refused transfer has written into the basis");
                return status;
            }
            case 8: {
                double doubles[4096];
                std::int64_t n = 0;
                std::int32_t const points[] = {mesh.index_base, mesh.index_base + 1};
                hm_status const status = hm_private_parcel_size(basis, 2, &n, &error_);
                if (status < 0 || n > 4096) return status;
                return hm_private_parcel_pack(basis, 2, points, doubles, &error_);
            }
            case 9: {
                Solution& solution = some();
                if (solution.analysis == nullptr) return none;
                std::int32_t const functions = solution.problem.functions(),
                                   first = input_.from(-1, functions);
                hm_status const status = hm_private_share_size(
                    solution.analysis, first, input_.from(-1, functions + 1), &bytes, &error_);
                return status;
            }
            case 10: {  // all points of the boundary, in room for a random number of them
                std::int32_t const markers[] = {1, 2, 3, 4, 5, 6, 7};
                std::int32_t n = 0, is_loop = 7, capacity = input_.from(0, 60);
                std::vector<std::int32_t> points(61, 7);
                hm_analysis* const analysis = some().analysis;
                if (analysis == nullptr) return none;
                hm_status const status = hm_analysis_boundary(
                    analysis, input_.from(1, 7), markers, input_.any_of({0, 0, 1, -1}),
                    points.data(), capacity, &n, &is_loop, &error_);
                if (status < 0) expect_untouched(points);
                expect(status >= 0 || is_loop == 7, "a refused call has written");
                return status;
            }
            case 11: {
                std::int32_t n = 0, capacity = input_.from(-1, 3);
                std::vector<std::int32_t> points(61, 7);
                hm_status const status =
                    hm_given_points(plan, points.data(), capacity, &n, &error_);
                if (status < 0) expect_untouched(points);
                return status;
            }
            case 12:
                return hm_basis_values(basis, input_.wild_index(), input_.wild_index(), x_.data(),
                                       &error_);
            case 13: {  // distances that no array has
                if (mesh.cell_layout != HM_CELLS_BLOCKS) return none;
                std::int64_t const wild[] = {INT64_MIN, INT64_MAX, -1, (std::int64_t{1} << 40) + 1,
                                             INT64_MAX / 3};
                hm_block_points_out const block{x_.data(), y_.data(), wild[input_.below(5)],
                                                input_.one_in(2) ? 0 : wild[input_.below(5)]};
                hm_status const status =
                    hm_blocks_scatter(&mesh, 0, 1, &mesh.points, &block, &error_);
                expect(status < 0, "distances are taken that no array has");
                return status;
            }
            default: {
                double worst = 0;
                return hm_boundary_error(basis, move_.data(), &in, &in, &worst, nullptr, &error_);
            }
        }
    }

    Input& input_;
    std::unique_ptr<Problem> problem_[2];
    std::optional<Solution> all_[2];
    std::vector<Object> objects_;
    std::vector<double> x_, y_, move_;
    hm_error error_{};
};

}  // namespace

Outcome run_sequence(Input& input) { return Sequence(input).run(); }

}  // namespace fuzz
