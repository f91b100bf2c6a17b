// The bytes that a block held before have no influence: every call of the C interface gives the
// same bits, whatever bytes the block and the outputs held, and no call that succeeds raises a
// floating-point exception that a debugging build would trap.
#include <harmorph_design.h>
#include "private.h"
#include <harmorph_study.h>

#include "basis/options.hpp"
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/executors.hpp>
#include <fixtures/operators.hpp>
#include <fixtures/single.hpp>
#include <fixtures/displaced.hpp>

#include <cfenv>
#include <functional>

using namespace fixtures;

namespace {

// All that calls gave, in their order.
class Record {
public:
    template <class Number>
    void add(std::vector<Number> const& numbers) {
        add_bytes(numbers.data(), numbers.size() * sizeof(Number));
    }
    // Statuses, numbers, and reports: structs of this interface have no padding.
    template <class Plain>
    void add(Plain const& plain) {
        add_bytes(&plain, sizeof plain);
    }
    // The bytes after the end of the text have no meaning.
    void add_outcome(hm_status status, hm_error const& error) {
        add(status);
        add(error.item);
        add(error.value);
        add_bytes(error.text, std::strlen(error.text));
    }
    void add_solution(Attempt const& attempt) {
        add_outcome(attempt.status, attempt.error);
        add(attempt.report);
        if (attempt.status >= 0) add(bytes_of(attempt.basis));
    }
    std::vector<unsigned char> const& bytes() const { return bytes_; }

private:
    void add_bytes(const void* begin, std::size_t n) {
        if (n == 0) return;
        const unsigned char* const bytes = static_cast<const unsigned char*>(begin);
        bytes_.insert(bytes_.end(), bytes, bytes + n);
    }
    std::vector<unsigned char> bytes_;
};

template <class Number>
std::vector<Number> filled(std::size_t n) {
    std::vector<Number> out(n);
    if (n > 0) std::memset(out.data(), Guarded::fill, n * sizeof(Number));
    return out;
}
template <class Report>
Report filled_report() {
    Report out;
    std::memset(&out, Guarded::fill, sizeof out);
    out.struct_size = sizeof out;
    return out;
}

void check_fills(std::function<void(Record&)> const& calls) {
    std::vector<unsigned char> expected;
    for (int const fill : {0x00, 0xFF, 0x7F}) {  // 0, NaN, nearly the largest number
        Guarded::fill = static_cast<unsigned char>(fill);
        Record record;
        std::feclearexcept(FE_ALL_EXCEPT);
        calls(record);
        int const raised = std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
        Guarded::fill = Guarded::mark;
        REQUIRE(!record.bytes().empty());
        if (expected.empty()) expected = record.bytes();
        INFO("blocks of bytes " << fill);
        CHECK(record.bytes() == expected);
        CHECK((raised & FE_INVALID) == 0);
        CHECK((raised & FE_DIVBYZERO) == 0);
        CHECK((raised & FE_OVERFLOW) == 0);
    }
}

struct Way {
    std::string name;
    Options options;
};

// Every operator with every scheme and engine that the tables of basis/options.hpp have for it,
// with what an option adds to it.
std::vector<Way> ways() {
    using namespace harmorph;
    std::vector<Way> out;
    for (std::int32_t kind = 0; has_row(operator_traits, kind); ++kind)
        for (std::int32_t scheme = 0; has_row(scheme_traits, scheme); ++scheme)
            for (std::int32_t engine = 0; has_row(engine_traits, engine); ++engine) {
                if (!contains(operator_traits[kind].schemes, scheme) ||
                    !contains(operator_traits[kind].engines, engine) ||
                    !contains(scheme_traits[scheme].engines, engine))
                    continue;
                Way way{"operator " + std::to_string(kind) + ", scheme " + std::to_string(scheme) +
                            ", engine " + std::to_string(engine),
                        options_of(kind)};
                way.options.scheme = scheme;
                way.options.engine = engine;
                out.push_back(way);
            }
    REQUIRE(out.size() >= 13);
    Way offset = out[0];
    offset.name = "conformal, offset correction";
    offset.options.offset_correction = 1;
    out.push_back(offset);
    for (Way& each : out)
        if (each.options.engine == HM_FAS)
            each.options.max_iterations = 5;  // enough to touch all that an iteration has
    return out;
}

// A block of 0.2 x 0.12 in a square of 15 x 15 cells.
Case block() {
    Case out;
    out.mesh = square(15, Cells::hybrid, 3, 3);
    out.curves = polyline({{0.4, 0.4}, {0.6, 0.4}, {0.6, 0.6}, {0.4, 0.6}});
    out.put_on_curves(body);
    return out;
}

}  // namespace

TEST_CASE("analysis, plan and basis do not depend on old bytes for any operator and engine") {
    for (Way& way : ways())
        for (std::int32_t const threads : {1, 3}) {
            INFO(way.name << ", " << threads << " threads");
            check_fills([&](Record& record) {
                Case setup = ring_case(12, 60, 0.5, 2, Cells::hybrid);
                Backwards order;
                hm_executor const executor = order.executor(threads);
                Options options = way.options;
                std::vector<double> history = filled<double>(8);
                if (options.engine != HM_DIRECT) {
                    options.history = history.data();
                    options.history_length = 8;
                }
                options.executor = &executor;
                Attempt const attempt(setup.problem(), &options);
                record.add_solution(attempt);
                if (options.engine == HM_DIRECT) return;
                for (std::int32_t k = 0; k <= std::min(attempt.report.iterations, 7); ++k)
                    record.add(history[std::size_t(k)]);
                if (options.engine == HM_MULTIGRID) return;  // hm_plan_level is for HM_FAS
                std::vector<std::int32_t> cells = filled<std::int32_t>(setup.mesh.x.size());
                std::int32_t n = -1;
                record.add(hm_plan_level(attempt.plan, 1, cells.data(), &n, nullptr));
                record.add(cells);
                record.add(n);
            });
        }
}

TEST_CASE("all calls with a basis do not depend on old bytes for any kind of value") {
    for (KindOfProblem const& problem : problems_and_a_cut())
        check_fills([&](Record& record) {
            Case setup = problem.setup;
            Attempt const solved(setup.problem(), &problem.options);
            record.add_solution(solved);
            REQUIRE(solved.status >= 0);
            hm_mesh const& mesh = setup.mesh_view();
            std::size_t const n = setup.mesh.x.size();
            std::int32_t const functions = info_of(solved.basis).functions,
                               numbers = info_of(solved.basis).numbers_per_value;
            std::vector<double> const move = some_move(functions, 0.01, 3),
                                      gradient = some_move(mesh.n_points, 1, 4);
            std::vector<double> x = filled<double>(n), y = filled<double>(n);
            record.add(hm_morph(solved.basis, move.data(), points_in(setup.mesh.x, setup.mesh.y),
                                points_out(x, y), nullptr, nullptr));
            record.add(x);
            record.add(y);
            double error = 0;
            std::int32_t point = 0;
            record.add(hm_boundary_error(solved.basis, move.data(),
                                         points_in(setup.mesh.x, setup.mesh.y), points_in(x, y),
                                         &error, &point, nullptr));
            record.add(error);
            // The array of a report is the caller's, so that its address differs from run to run.
            std::vector<double> cells = filled<double>(std::size_t(setup.mesh.n_cells()));
            hm_quality_report quality = filled_report<hm_quality_report>();
            quality.cell_quality = cells.data();
            record.add(hm_assess(solved.basis, &mesh, points_in(x, y), nullptr,
                                 points_in(setup.mesh.x, setup.mesh.y), nullptr, nullptr, &quality,
                                 nullptr));
            quality.cell_quality = nullptr;
            record.add(quality);
            record.add(cells);
            record.add(
                hm_morph(solved.basis, move.data(), nullptr, points_out(x, y), nullptr, nullptr));
            record.add(x);
            hm_step_report step = filled_report<hm_step_report>();
            record.add(hm_assess(solved.basis, &mesh, nullptr, points_in(x, y), nullptr, nullptr,
                                 &step, nullptr, nullptr));
            record.add(step);
            quality = filled_report<hm_quality_report>();
            quality.cell_quality = nullptr;
            record.add(hm_assess(solved.basis, &mesh, nullptr, points_in(x, y), nullptr, nullptr,
                                 &step, &quality, nullptr));
            record.add(step);
            record.add(quality);
            std::vector<double> sums = filled<double>(2 * std::size_t(functions));
            record.add(hm_adjoint(solved.basis, points_in(&gradient[0], &gradient[1], 2),
                                  sums.data(), nullptr, nullptr));
            record.add(sums);
            std::int32_t scale = 0;
            std::vector<std::int64_t> parts =
                filled<std::int64_t>(4 * std::size_t(functions * numbers));
            record.add(hm_private_adjoint_scale(
                solved.basis, points_in(&gradient[0], &gradient[1], 2), &scale, nullptr, nullptr));
            record.add(hm_private_adjoint_sums(solved.basis,
                                               points_in(&gradient[0], &gradient[1], 2), scale,
                                               parts.data(), nullptr, nullptr));
            record.add(parts);
            sums = filled<double>(sums.size());
            record.add(
                hm_private_adjoint_finish(solved.basis, scale, parts.data(), sums.data(), nullptr));
            record.add(sums);

            Single const single(solved.basis);
            record.add(bytes_of(single.basis));
            std::vector<std::vector<std::int32_t>> const lists = random_parts(mesh.n_points, 2, 5);
            Rows const rows(solved.basis, lists[0]);
            record.add(bytes_of(rows.basis));
            std::unique_ptr<Guarded> blocks[2];
            hm_basis* shares[2] = {};
            for (std::int32_t k = 0; k < 2; ++k) {
                std::int32_t first = -1, held = -1;
                std::size_t bytes = 0;
                REQUIRE(hm_private_share_of(solved.analysis, k, 2, &first, &held, nullptr) ==
                        HM_OK);
                REQUIRE(hm_private_share_size(solved.analysis, first, held, &bytes, nullptr) ==
                        HM_OK);
                blocks[k] = std::make_unique<Guarded>(bytes);
                REQUIRE(hm_private_share_init(&shares[k], blocks[k]->data(), bytes, solved.analysis,
                                              first, held, nullptr) == HM_OK);
                hm_solve_report report = filled_report<hm_solve_report>();
                record.add(hm_plan_solve(solved.plan, shares[k], &report, nullptr));
                record.add(report);
                record.add(bytes_of(shares[k]));
            }
            Rows const joined(shares[0], lists[1]);
            for (hm_basis const* share : shares) {
                std::int64_t doubles = 0;
                std::int32_t const n_points = std::int32_t(lists[1].size());
                REQUIRE(hm_private_parcel_size(share, n_points, &doubles, nullptr) == HM_OK);
                std::vector<double> parcel = filled<double>(std::size_t(doubles));
                record.add(hm_private_parcel_pack(share, n_points, lists[1].data(), parcel.data(),
                                                  nullptr));
                record.add(parcel);
                record.add(hm_private_parcel_unpack(joined.basis, parcel.data(), doubles, nullptr));
            }
            record.add(bytes_of(joined.basis));
        });
}

TEST_CASE("coarse to fine") {
    for (KindOfProblem const& problem : kinds_of_problems())
        check_fills([&](Record& record) {
            Case coarse = problem.setup, fine = problem.setup;
            perturb(fine.mesh, 0.1, 8);
            Solved const solved(coarse, &problem.options);
            TransferAttempt attempt;
            std::memset(&attempt.transfer, Guarded::fill, sizeof attempt.transfer);
            attempt.transfer.struct_size = sizeof attempt.transfer;
            REQUIRE(attempt.open(fine.problem(), &problem.options));
            REQUIRE(attempt.fill_from(solved.basis, coarse.mesh_view()));
            record.add(attempt.transfer);
            record.add(bytes_of(attempt.basis));
        });
}

TEST_CASE("fits of every closure, and the points of a curve") {
    for (bool const is_blunt : {false, true})
        for (std::int32_t const closed : {HM_CLOSED_AUTO, HM_OPEN, HM_TIED, HM_PERIODIC}) {
            check_fills([&](Record& record) {
                Naca4 naca;
                naca.blunt = is_blunt;
                Outline const outline = naca4(naca, 30);
                double const* const xy = &outline.points[0].x;
                std::int32_t const n = std::int32_t(outline.points.size());
                auto options = sized<hm_fit_options>();
                options.closed = closed;
                Guarded block = block_of(fixtures::fit_size, n, &options);
                hm_fit_report report = filled_report<hm_fit_report>();
                const hm_curves* curves = nullptr;
                hm_error error{};
                hm_status const status =
                    hm_fit(&curves, fixtures::Memory(block.data(), block.size()),
                           points_in(xy, xy + 1, 2), n, 1, &options, &report, &error);
                record.add_outcome(status, error);
                if (status < 0) return;
                record.add(report);
                record.add(
                    std::vector<double>(curves->control, curves->control + 2 * curves->n_control));
                for (std::int32_t k = 0; k < curves->n_curves; ++k) {
                    hm_curve const& curve = curves->curve[k];
                    record.add(std::vector<double>(
                        curve.knots, curve.knots + curve.n_indices + curve.degree + 1));
                    if (curve.indices != nullptr)
                        record.add(std::vector<std::int32_t>(curve.indices,
                                                             curve.indices + curve.n_indices));
                    double u = 0, distance = 0;
                    record.add(hm_curve_project(curves, k, 0.3, 0.2, &u, &distance, nullptr));
                    record.add(u);
                    record.add(distance);
                    std::vector<double> values = filled<double>(24), at = filled<double>(6);
                    std::vector<std::int32_t> control = filled<std::int32_t>(6);
                    values.resize(3 * std::size_t(curve.degree + 1));
                    control.resize(std::size_t(curve.degree + 1));
                    record.add(
                        hm_curve_basis(curves, k, u, 2, control.data(), values.data(), nullptr));
                    record.add(hm_curve_point(curves, k, u, 2, at.data(), nullptr));
                    record.add(control);
                    record.add(values);
                    record.add(at);
                }
            });
        }
}

TEST_CASE("the boundary of a mesh, and its report") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid})
        check_fills([&](Record& record) {
            Case setup = airfoil_case(30, 12, kind);
            Attempt attempt;
            REQUIRE(attempt.analyse(setup.problem()));
            hm_mesh_report report = filled_report<hm_mesh_report>();
            record.add(hm_analysis_report(attempt.analysis, &report, nullptr));
            record.add(report);
            std::vector<std::int32_t> points = filled<std::int32_t>(500);
            std::int32_t const marker = body;
            std::int32_t n = 0, is_loop = -1;
            record.add(hm_analysis_boundary(attempt.analysis, 1, &marker, 0, points.data(), 500, &n,
                                            &is_loop, nullptr));
            REQUIRE(n > 0);
            record.add(std::vector<std::int32_t>(points.begin(), points.begin() + n));
            record.add(is_loop);
        });
}

// Far turns, so that every strategy is tried: bounded functions, which cannot be solved again,
// leave the rest to untangling.
TEST_CASE("safe morphs do not depend on old bytes for any operator, scheme or strategy") {
    for (Way& way : ways()) {
        if (way.options.engine != HM_DIRECT) continue;
        for (double const degrees : {20.0, 75.0, 100.0})
            for (std::int32_t const skipped :
                 {0, 1 << HM_STRATEGY_SUBSTEPS, 1 << HM_STRATEGY_UNTANGLED}) {
                INFO(way.name << ", turned by " << degrees << " degrees, without the strategies "
                              << skipped);
                check_fills([&](Record& record) {
                    Case setup = block();
                    Solved const solved(setup, &way.options);
                    Attempt derivative;
                    REQUIRE(derivative.analyse(setup.problem(), &way.options));
                    REQUIRE(derivative.prepare());
                    Guarded work = block_of(safe_move_size, solved.plan, solved.basis);
                    std::vector<double> const move = similarity_move(
                        setup.curves, std::polar(1.0, degrees * pi / 180), {0.5, 0.5}, 0.03);
                    std::vector<double> x = filled<double>(setup.mesh.x.size()), y = x,
                                        reached = filled<double>(move.size());
                    auto options = sized<hm_safe_options>();
                    options.skipped_strategies = skipped;
                    options.max_resolves = 3;
                    options.heights = 0.5;
                    options.reached = reached.data();
                    hm_safe_report report = filled_report<hm_safe_report>();
                    hm_error error{};
                    hm_status const status = safe_move(
                        solved.plan, solved.basis, move.data(), points_out(x, y), derivative.basis,
                        work.data(), work.size(), &options, &report, &error);
                    REQUIRE(status >= 0);
                    record.add_outcome(status, error);
                    record.add(report);
                    record.add(reached);
                    record.add(x);
                    record.add(y);
                    record.add(bytes_of(derivative.basis));
                });
            }
    }
}

TEST_CASE("improvements: of a mesh with layers, and of one whose sides slide") {
    for (bool const slides : {false, true}) {
        check_fills([&](Record& record) {
            Case setup = slides ? block() : airfoil_case(20, 8);
            if (slides) setup.set_slip(top);
            Solved const solved(setup);
            Guarded work = block_of(fixtures::improve_size, solved.plan);
            std::vector<double> const move = similarity_move(setup.curves, std::polar(1.0, 0.04),
                                                             {0.5, slides ? 0.5 : 0.0}, 0.01);
            std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
            REQUIRE(hm_morph(solved.basis, move.data(), points_in(x, y), points_out(x, y), nullptr,
                             nullptr) == HM_OK);
            auto options = sized<hm_improve_options>();
            hm_points const reference = {setup.mesh.x.data(), setup.mesh.y.data(), 1};
            options.reference = &reference;
            hm_improve_report report = filled_report<hm_improve_report>();
            hm_error error{};
            hm_status const status =
                hm_improve(solved.plan, points_in(x, y), points_out(x, y),
                           fixtures::Memory(work.data(), work.size()), &options, &report, &error);
            INFO(error.text);
            REQUIRE(status == HM_OK);
            record.add_outcome(status, error);
            record.add(report);
            record.add(x);
            record.add(y);
        });
    }
}
