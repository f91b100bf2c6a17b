// Calls with a plan or a basis refuse wrong arguments with a whole sentence: room in arrays,
// numbers out of range, objects that do not belong together, steps in the wrong order.
#include <harmorph_bases.h>
#include <harmorph_design.h>
#include "private.h"
#include <harmorph_study.h>
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/displaced.hpp>
#include <fixtures/refused.hpp>
#include <fixtures/memory.hpp>

#include "base/arena.hpp"

#include <algorithm>
#include <limits>

using namespace fixtures;

namespace {

struct Objects {
    Case setup = tiny_case();
    hm_mesh mesh = setup.mesh_view();
    Solved solved{setup.problem(mesh)};
    hm_basis* basis = solved.basis;
    std::vector<double> x = setup.mesh.x, y = setup.mesh.y, move = std::vector<double>(8, 0.0);
    hm_points points{x.data(), y.data(), 1};
    hm_points_out out{x.data(), y.data(), 1};
};

}  // namespace

TEST_CASE("a problem that is too large for the addresses of the machine") {
    harmorph::Arena arena;
    harmorph::Span<double> numbers;
    arena.take(numbers, std::numeric_limits<std::size_t>::max() / 24);
    arena.take(numbers, std::numeric_limits<std::size_t>::max() / 24);
    harmorph::Fault fault;
    CHECK(arena.verify(0, fault) == harmorph::Status::bad_argument);
    CHECK(std::string(fault.sentence) ==
          "the problem needs a block of ~ bytes, which is too large for this machine's addresses");
    CHECK(fault.value >= double(std::numeric_limits<std::size_t>::max() / 2));
}

TEST_CASE("room for fewer than there are, and numbers that there are not") {
    Objects o;
    std::int32_t n = 0, is_loop = 0;
    std::int32_t const marker = body, nobody = 77;
    auto const boundary = [&](std::int32_t n_markers, std::int32_t piece, hm_error* e) {
        return hm_analysis_boundary(o.solved.analysis, n_markers, &marker, piece, nullptr, 0, &n,
                                    &is_loop, e);
    };
    auto curves = sized<hm_curves>();
    auto curve = sized<hm_curve>();
    auto condition = sized<hm_condition>();
    check_texts({
        {HM_BAD_ARGUMENT, "points has room for 0 points, but this piece of the boundary has 8",
         [&](hm_error* e) { return boundary(1, 0, e); }},
        {HM_BAD_CONDITION,
         "the given markers form 1 pieces of the boundary, so piece 1 does not exist",
         [&](hm_error* e) { return boundary(1, 1, e); }},
        {HM_BAD_CONDITION,
         "no face of the boundary has one of the given markers, the first of which is 77",
         call_by(hm_analysis_boundary, o.solved.analysis, 1, &nobody, 0, nullptr, 0, &n, &is_loop)},
        {HM_BAD_ARGUMENT,
         "n_markers is 0 and capacity is 0; n_markers must be at least 1, and capacity at least 0",
         [&](hm_error* e) { return boundary(0, 1, e); }},
        {HM_BAD_ARGUMENT, "curve has room for 0 curves, but the basis has 1",
         call_by(hm_basis_curves, o.basis, nullptr, nullptr, &curves, &curve, 0)},
        {HM_BAD_ARGUMENT, "capacity must be at least 0, not -1",
         call_by(hm_basis_conditions, o.basis, &condition, -1, &n)},
        {HM_BAD_ARGUMENT, "out has room for 0 conditions, but the basis has 1",
         call_by(hm_basis_conditions, o.basis, &condition, 0, &n)},
        {HM_BAD_ARGUMENT, "number 1 does not exist; numbers_per_value of this basis is 1",
         call_by(hm_basis_values, o.basis, 0, 1, o.x.data())},
        {HM_BAD_ARGUMENT, "number -1 does not exist; numbers_per_value of this basis is 1",
         call_by(hm_basis_values, o.basis, 0, -1, o.x.data())},
        {HM_BAD_ARGUMENT, "function 4 does not exist; the basis has 4",
         call_by(hm_basis_values, o.basis, 4, 0, o.x.data())},
        {HM_BAD_ARGUMENT, "function -2147483648 does not exist; the basis has 4",
         call_by(hm_basis_values, o.basis, std::numeric_limits<std::int32_t>::min(), 0,
                 o.x.data())},
    });
}

TEST_CASE("where room is missing, the number is told and nothing is filled in") {
    Objects o;
    Case given = given_instead(tiny_case());
    Displaced displaced(given);
    std::int32_t const marker = body;
    std::vector<std::int32_t> list(9, -7);
    std::int32_t n = 0, is_loop = -7;
    for (std::int32_t capacity = 0; capacity <= 8; ++capacity) {
        bool const fits = capacity == 8;
        n = 0;
        CHECK(hm_analysis_boundary(o.solved.analysis, 1, &marker, 0, list.data(), capacity, &n,
                                   &is_loop, nullptr) == (fits ? HM_OK : HM_BAD_ARGUMENT));
        CHECK(n == 8);
        CHECK(is_loop == (fits ? 1 : -7));
        CHECK(std::count(list.begin(), list.end(), -7) == (fits ? 1 : 9));
    }
    list.assign(9, -7);
    for (std::int32_t capacity = -1; capacity <= 8; ++capacity) {
        bool const fits = capacity == 8;
        n = 0;
        CHECK(hm_given_points(displaced.plan, list.data(), capacity, &n, nullptr) ==
              (fits ? HM_OK : HM_BAD_ARGUMENT));
        CHECK(n == 8);
        CHECK(std::count(list.begin(), list.end(), -7) == (fits ? 1 : 9));
    }
    // Nothing is stated about pieces that do not exist.
    list.assign(9, -7);
    n = is_loop = -7;
    for (std::int32_t const piece : {-1, 1, std::numeric_limits<std::int32_t>::max()})
        CHECK(hm_analysis_boundary(o.solved.analysis, 1, &marker, piece, list.data(), 9, &n,
                                   &is_loop, nullptr) == HM_BAD_CONDITION);
    CHECK((n == -7 && is_loop == -7 && list == std::vector<std::int32_t>(9, -7)));
}

TEST_CASE("combined functions, gradients in parts, parcels") {
    Objects o;
    std::int64_t sums[64], doubles = 0;
    std::int32_t scale = 0;
    hm_points const dj = o.points;
    REQUIRE(hm_private_adjoint_scale(o.basis, &dj, &scale, nullptr, nullptr) == HM_OK);
    std::string const too_small = "scale is " + std::to_string(scale - 1) +
                                  ", but these points need at least " + std::to_string(scale) +
                                  "; take the largest scale of all parts";
    hm_basis *share = nullptr, *rows = nullptr;
    Guarded share_block = block_of(hm_private_share_size, o.solved.analysis, 0, 2);
    REQUIRE(hm_private_share_init(&share, share_block.data(), share_block.size(), o.solved.analysis,
                                  0, 2, nullptr) == HM_OK);
    REQUIRE(hm_plan_solve(o.solved.plan, share, nullptr, nullptr) == HM_OK);
    std::int32_t const list[] = {20, 30};
    Guarded block = block_of(hm_private_extract_size, share, 2);
    REQUIRE(hm_private_extract_init(&rows, block.data(), block.size(), share, 2, list, nullptr) ==
            HM_OK);
    REQUIRE(hm_private_parcel_size(share, 2, &doubles, nullptr) == HM_OK);
    std::vector<double> parcel(static_cast<std::size_t>(doubles));
    REQUIRE(hm_private_parcel_pack(share, 2, list, parcel.data(), nullptr) == HM_OK);
    hm_basis* const few = share;  // for all points, but no rows of all functions
    std::int64_t n_few = 0;
    std::vector<std::int32_t> everywhere(48);
    for (std::size_t k = 0; k < 48; ++k) everywhere[k] = std::int32_t(k);
    REQUIRE(hm_private_parcel_size(share, 48, &n_few, nullptr) == HM_OK);
    std::vector<double> of_few(static_cast<std::size_t>(n_few));
    REQUIRE(hm_private_parcel_pack(share, 48, everywhere.data(), of_few.data(), nullptr) == HM_OK);
    check_texts({
        {HM_BAD_ARGUMENT,
         "scale is 100000, but it must be a number that hm_private_adjoint_scale returned",
         call_by(hm_private_adjoint_sums, o.basis, &dj, 100000, sums, nullptr)},
        {HM_BAD_ARGUMENT, too_small.c_str(),
         call_by(hm_private_adjoint_sums, o.basis, &dj, scale - 1, sums, nullptr)},
        {HM_BAD_BASIS,
         "a parcel needs rows of all functions, but these rows have a share of the functions",
         call_by(hm_private_parcel_unpack, few, of_few.data(), n_few)},
        {HM_BAD_BASIS, "the parcel is truncated: it is shorter than its label",
         call_by(hm_private_parcel_unpack, rows, parcel.data(), 1)},
        {HM_BAD_BASIS, "the length of the parcel does not fit the rows that its label announces",
         call_by(hm_private_parcel_unpack, rows, parcel.data(), doubles - 1)},
    });
}

TEST_CASE("steps in the wrong order") {
    Case setup = tiny_case();
    Attempt attempt;
    REQUIRE(attempt.analyse(setup.problem()));
    REQUIRE(attempt.prepare());
    std::int32_t cells[100], n_cells = 0;
    hm_points const wall{setup.mesh.x.data(), setup.mesh.y.data(), 1};
    hm_points_out const to{setup.mesh.x.data(), setup.mesh.y.data(), 1};
    Case given = given_instead(tiny_case());
    Attempt of_given;
    REQUIRE(of_given.analyse(given.problem()));
    REQUIRE(of_given.prepare());
    std::int32_t n = 0;
    hm_given_points(of_given.plan, nullptr, 0, &n, nullptr);
    std::size_t bytes = 0;
    Guarded work = block_of(fixtures::displace_size, of_given.plan, 1);
    check_texts({
        {HM_BAD_CONDITION, "no marker has the condition HM_GIVEN, so no displacements can be given",
         call_by(fixtures::displace_size, attempt.plan, 1, &bytes)},
        {HM_BAD_ARGUMENT, "the plan has no factor; call hm_plan_factor first",
         call_by(hm_plan_solve, attempt.plan, attempt.basis, nullptr)},
        {HM_BAD_ARGUMENT, "the plan has no factor; call hm_plan_factor first",
         call_by(hm_displace, of_given.plan, n, nullptr, 1, &wall, nullptr, &to,
                 fixtures::Memory(work.data(), work.size()), nullptr)},
        {HM_BAD_ARGUMENT,
         "the plan has no merged cells; hm_plan_factor makes them for the engine fas",
         call_by(hm_plan_level, attempt.plan, 0, cells, &n_cells)},
    });
}

TEST_CASE("modes: numbers, lists, and what they do not go with") {
    Case setup = given_instead(tiny_case());
    Displaced displaced(setup);
    std::size_t bytes = 0;
    hm_basis* made = nullptr;
    std::int32_t const n = std::int32_t(displaced.points.size());
    std::vector<double> modes(200, 1.0);
    std::vector<std::int32_t> list(100, displaced.points[0]), twice = displaced.points;
    twice.push_back(twice[0]);
    std::vector<double> dx(twice.size(), 0.0), dy(twice.size(), 0.0), x = setup.mesh.x,
                                                                      y = setup.mesh.y;
    dx.back() = 1;
    hm_points const wall{dx.data(), dy.data(), 1},
        from{setup.mesh.x.data(), setup.mesh.y.data(), 1};
    hm_points_out const to{x.data(), y.data(), 1};
    Guarded room = displaced.work_for(1);
    std::vector<double> far(twice.size(), 0.0);
    far[0] = 5;  // across the body
    hm_points const across{far.data(), dy.data(), 1};
    hm_error crossing{};
    CHECK(hm_displace(displaced.plan, n, nullptr, 1, &across, &from, &to,
                      fixtures::Memory(room.data(), room.size()), nullptr,
                      &crossing) == HM_CROSSING);
    CHECK(std::string(crossing.text)
              .find("the moved boundary crosses itself: the faces that begin at points ") == 0);
    auto real = sized<hm_modes>();
    real.n_modes = real.numbers = 1;
    real.n = n;
    real.values = modes.data();
    hm_modes many = real, other = real;
    many.n = 97;
    many.points = list.data();
    other.numbers = 3;
    hm_modes reserved = real;
    reserved.reserved = 7;
    REQUIRE(fixtures::tabulate_size(displaced.plan, displaced.basis, &real, &bytes, nullptr) ==
            HM_OK);
    Guarded block(bytes);
    check_texts({
        {HM_BAD_ARGUMENT, "modes.numbers must be 1 (real values) or 2 (complex values), not 3",
         call_by(fixtures::tabulate_size, displaced.plan, displaced.basis, &other, &bytes)},
        {HM_BAD_ARGUMENT, "modes.reserved must be 0, not 7",
         call_by(fixtures::tabulate_size, displaced.plan, displaced.basis, &reserved, &bytes)},
        {HM_BAD_ARGUMENT, "point 17 has two different displacements in field 0",
         call_by(hm_displace, displaced.plan, n + 1, twice.data(), 1, &wall, nullptr, &to,
                 fixtures::Memory(room.data(), room.size()), nullptr)},
        {HM_BAD_ARGUMENT, "n is 97, but the list may have at most twice as many points as the mesh",
         call_by(hm_tabulate, &made, fixtures::Memory(block.data(), bytes), displaced.plan,
                 displaced.basis, &many, nullptr)},
    });
    REQUIRE(hm_tabulate(&made, fixtures::Memory(block.data(), block.size()), displaced.plan,
                        displaced.basis, &real, nullptr, nullptr) == HM_OK);
    TransferAttempt transfer;
    REQUIRE(transfer.open(setup.problem()));
    CHECK_FALSE(transfer.fill_from(made, setup.mesh_view()));
    CHECK(transfer.status == HM_UNSUPPORTED);
    CHECK(std::string(transfer.error.text) ==
          "the basis contains functions that a table gives, but this call needs a basis without "
          "such functions");
}

TEST_CASE("options of the safe morph and of better cells") {
    Objects o;
    Guarded work = block_of(safe_move_size, o.solved.plan, o.basis);
    Guarded room = block_of(fixtures::improve_size, o.solved.plan);
    hm_basis* derivative = nullptr;  // of two functions
    double matrix[] = {1, 0, 0, 1, 0, 0, 0, 0};
    Guarded combined = block_of(fixtures::combine_size, o.basis, 2, 1);
    REQUIRE(hm_combine(&derivative, fixtures::Memory(combined.data(), combined.size()), o.basis, 2,
                       1, matrix, nullptr) == HM_OK);
    struct {
        hm_safe_options safe;
        double more;
    } younger{};
    younger.safe.struct_size = sizeof younger;
    younger.more = 1;
    struct {
        hm_improve_options better;
        double more;
    } younger_better{};
    younger_better.better.struct_size = sizeof younger_better;
    younger_better.more = 1;
    std::vector<double> folded = o.setup.mesh.x;
    folded[8] = 5;
    hm_points const reference{folded.data(), o.setup.mesh.y.data(), 1};
    auto none_left = sized<hm_safe_options>();
    none_left.skipped_strategies = 15;
    auto reserved = sized<hm_safe_target>();
    reserved.move = o.move.data();
    reserved.reserved = 7;
    hm_improve_options better{};
    better.struct_size = sizeof better;
    better.reference = &reference;
    check_texts({
        {HM_UNSUPPORTED,
         "options contains fields that are set but unknown to this version of the library; use the "
         "header of this version",
         call_by(safe_move, o.solved.plan, o.basis, o.move.data(), &o.out, nullptr, work.data(),
                 work.size(), &younger.safe, nullptr)},
        {HM_UNSUPPORTED,
         "options contains fields that are set but unknown to this version of the library; use the "
         "header of this version",
         call_by(hm_improve, o.solved.plan, &o.points, &o.out,
                 fixtures::Memory(room.data(), room.size()), &younger_better.better, nullptr)},
        {HM_BAD_ARGUMENT,
         "options.skipped_strategies is 15, which leaves no strategy that moves the mesh",
         call_by(safe_move, o.solved.plan, o.basis, o.move.data(), &o.out, nullptr, work.data(),
                 work.size(), &none_left, nullptr)},
        {HM_BAD_ARGUMENT, "target.reserved must be 0, not 7",
         call_by(hm_move_safe, o.solved.plan, o.basis, &reserved, &o.out,
                 fixtures::Memory(work.data(), work.size()), nullptr, nullptr)},
        {HM_BAD_BASIS, "the basis for the derivative has other functions than the basis",
         call_by(safe_move, o.solved.plan, o.basis, o.move.data(), &o.out, derivative, work.data(),
                 work.size(), nullptr, nullptr)},
        {HM_BAD_MESH, "cell 1 of the reference mesh is inverted",
         call_by(hm_improve, o.solved.plan, &o.points, &o.out,
                 fixtures::Memory(room.data(), room.size()), &better, nullptr)},
    });
}

TEST_CASE("a safe displacement that turns a body inside out") {
    Case setup = given_instead(tiny_case());
    Displaced displaced(setup);
    std::vector<double> dx, dy(displaced.points.size(), 0.0), x = setup.mesh.x, y = setup.mesh.y;
    for (std::int32_t const point : displaced.points)
        dx.push_back(2 * (3 - setup.mesh.point(point).x));
    hm_points const wall{dx.data(), dy.data(), 1};
    hm_points_out const to{x.data(), y.data(), 1};
    Guarded work = block_of(safe_displace_size, displaced.plan, displaced.basis);
    hm_error error{};
    CHECK(safe_displace(displaced.plan, displaced.basis, nullptr, std::int32_t(dx.size()),
                        displaced.points.data(), &wall, &to, work.data(), work.size(), nullptr,
                        nullptr, &error) == HM_CROSSING);
    CHECK(std::string(error.text) ==
          "the boundary through point 17 at (3, 2) is turned inside out");
    CHECK(x == setup.mesh.x);
}
