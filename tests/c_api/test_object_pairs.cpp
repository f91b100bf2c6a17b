// Tables state which kinds of bases each call takes, and which two bases go together in one call;
// the cells are the expected statuses. A refused call changes neither basis, and a call that
// succeeds changes only what it fills.
#include <harmorph_bases.h>
#include <harmorph_design.h>
#include <harmorph_space.h>
#include "private.h"
#include <harmorph_study.h>
#include <doctest/doctest.h>

#include <fixtures/memory.hpp>
#include <fixtures/kinds_of_bases.hpp>

using namespace fixtures;

namespace {

hm_status status_of(char letter) {
    switch (letter) {
        case '.': return HM_OK;
        case 'a': return HM_BAD_ARGUMENT;
        case 'b': return HM_BAD_BASIS;
        case 'm': return HM_BAD_MESH;
        default: return HM_UNSUPPORTED;  // u
    }
}

// Arrays that are long enough for every basis of these tests.
struct Arrays {
    std::vector<double> x = std::vector<double>(4000, 7), y = x,
                        move = std::vector<double>(400, 1e-3), gradient = move;
    std::vector<std::int64_t> sums = std::vector<std::int64_t>(4000);
    hm_points in{x.data(), y.data(), 1};
    hm_points_out out{x.data(), y.data(), 1};
};

// The size of a block, then the block.
template <class Size, class Init>
hm_status in_block(hm_error* error, Size const& size, Init const& init) {
    std::size_t bytes = 0;
    hm_status const status = size(&bytes, error);
    if (status < 0) return status;
    Guarded block(bytes);
    hm_status const made = init(block.data(), bytes, error);
    CHECK(block.guards_intact());
    return made;
}

struct World {
    Bases one, two;  // two of each kind, of equal problems
    Arrays arrays;
    Extruded space{one.setup.mesh, along_axis(2)};
    hm_space_mesh space_mesh = space.view();
    Plane plane{space_mesh};

    void restore() {
        for (Bases* bases : {&one, &two})
            for (std::size_t k = 0; k < bases->all.size(); ++k) bases->restore(k);
        REQUIRE(hm_plan_factor(one.solved.plan, nullptr, nullptr) == HM_OK);
    }
};

struct Call {
    const char* name;
    const char* expected;  // a letter for each kind of Bases, in their order
    bool fills;            // the basis
    std::function<hm_status(World&, hm_basis*, hm_error*)> run;
};

}  // namespace

// Kinds, from the left: whole, unsolved, share, unsolved share, rows, waiting rows, rows of all
// points, combined, by table, single, weighted alike, other conditions, renumbered mesh, rows of
// equations.
TEST_CASE("each call takes the kinds of bases that it can use") {
    World world;
    std::size_t const n = world.one.all.size();
    hm_plan* const plan = world.one.solved.plan;
    auto const with_plan = [&](auto const& size, auto const& run) {
        return [=](World& w, hm_basis* basis, hm_error* error) {
            return in_block(
                error, [&](std::size_t* bytes, hm_error* e) { return size(plan, basis, bytes, e); },
                [&](void* work, std::size_t bytes, hm_error* e) {
                    return run(w, basis, work, bytes, e);
                });
        };
    };
    Call const calls[] = {
        {"hm_basis_info_get", "..............", false,
         [](World&, hm_basis* b, hm_error* e) {
             hm_basis_info info = sized<hm_basis_info>();
             return hm_basis_info_get(b, &info, e);
         }},
        {"hm_basis_curves", "..............", false,
         [](World&, hm_basis* b, hm_error* e) {
             hm_curves curves = sized<hm_curves>();
             hm_curve curve[2] = {sized<hm_curve>(), sized<hm_curve>()};
             return hm_basis_curves(b, nullptr, nullptr, &curves, curve, 2, e);
         }},
        {"hm_basis_curves, moved", "..............", false,
         [](World& w, hm_basis* b, hm_error* e) {
             hm_curves curves = sized<hm_curves>();
             hm_curve curve[2] = {sized<hm_curve>(), sized<hm_curve>()};
             return hm_basis_curves(b, w.arrays.move.data(), w.arrays.x.data(), &curves, curve, 2,
                                    e);
         }},
        {"hm_basis_conditions", "..............", false,
         [](World&, hm_basis* b, hm_error* e) {
             hm_condition conditions[4] = {sized<hm_condition>()};
             std::int32_t found = 0;
             return hm_basis_conditions(b, conditions, 4, &found, e);
         }},
        {"hm_basis_values", ".b.b.b.......b", false,
         [](World& w, hm_basis* b, hm_error* e) {
             return hm_basis_values(b, 2, 0, w.arrays.x.data(), e);
         }},
        {"hm_basis_attach to the mesh", ".b.bbbb.....bb", false,
         [](World& w, hm_basis* b, hm_error* e) {
             const hm_basis* attached = nullptr;
             return hm_basis_attach(&attached, b, info_of(b).bytes, &w.one.mesh, e);
         }},
        {"hm_morph", ".bbb.b.......b", false,
         [](World& w, hm_basis* b, hm_error* e) {
             return hm_morph(b, w.arrays.move.data(), nullptr, &w.arrays.out, nullptr, e);
         }},
        {"hm_adjoint", ".bbb.b.......b", false,
         [](World& w, hm_basis* b, hm_error* e) {
             return hm_adjoint(b, &w.arrays.in, w.arrays.gradient.data(), nullptr, e);
         }},
        {"hm_private_adjoint_scale, _sums, _finish", ".bbb.b.......b", false,
         [](World& w, hm_basis* b, hm_error* e) {
             std::int32_t scale = 0;
             std::int64_t* const sums = w.arrays.sums.data();
             hm_status const scaled = hm_private_adjoint_scale(b, &w.arrays.in, &scale, nullptr, e);
             CHECK(hm_private_adjoint_sums(b, &w.arrays.in, scale, sums, nullptr, e) == scaled);
             CHECK(hm_private_adjoint_finish(b, scale, sums, w.arrays.gradient.data(), e) ==
                   scaled);
             return scaled;
         }},
        {"hm_boundary_error", "..............", false,
         [](World& w, hm_basis* b, hm_error* e) {
             double error = 0;
             return hm_boundary_error(b, w.arrays.move.data(), &w.arrays.in, &w.arrays.in, &error,
                                      nullptr, e);
         }},
        {"hm_assess, quality", "....bbb.....bb", false,
         [](World& w, hm_basis* b, hm_error* e) {
             hm_quality_report report = sized<hm_quality_report>();
             return hm_assess(b, &w.one.mesh, nullptr, nullptr, nullptr, nullptr, nullptr, &report,
                              e);
         }},
        {"hm_assess, step", "....bbb.....bb", false,
         [](World& w, hm_basis* b, hm_error* e) {
             hm_step_report report = sized<hm_step_report>();
             return hm_assess(b, &w.one.mesh, nullptr, &w.arrays.in, nullptr, nullptr, &report,
                              nullptr, e);
         }},
        {"hm_assess", "....bbb.....bb", false,
         [](World& w, hm_basis* b, hm_error* e) {
             hm_step_report step = sized<hm_step_report>();
             hm_quality_report quality = sized<hm_quality_report>();
             return hm_assess(b, &w.one.mesh, nullptr, &w.arrays.in, nullptr, nullptr, &step,
                              &quality, e);
         }},
        {"hm_single_init", ".bbb.b...u...b", false,
         [](World&, hm_basis* b, hm_error* error) {
             hm_basis* made = nullptr;
             return in_block(error, size_by(fixtures::single_size, b),
                             init_by(hm_single_init, &made, b));
         }},
        {"hm_combine", ".bbb.b...u...b", false,
         [](World&, hm_basis* b, hm_error* error) {
             hm_basis* made = nullptr;
             std::vector<double> const ones(100, 1.0);
             return in_block(error, size_by(fixtures::combine_size, b, 1, 1),
                             init_by(hm_combine, &made, b, 1, 1, ones.data()));
         }},
        {"hm_private_extract_init", ".b.b.b.......b", false,
         [](World&, hm_basis* b, hm_error* error) {
             hm_basis* made = nullptr;
             std::int32_t const list[] = {2, 0, 0};
             return in_block(error, size_by(hm_private_extract_size, b, 3),
                             init_by(hm_private_extract_init, &made, b, 3, list));
         }},
        {"hm_private_parcel_pack", ".b.b.b...u...b", false,
         [](World& w, hm_basis* b, hm_error* e) {
             std::int64_t doubles = 0;
             std::int32_t const list[] = {2, 0, 0};
             hm_status const status = hm_private_parcel_size(b, 3, &doubles, e);
             return status < 0 ? status : hm_private_parcel_pack(b, 3, list, w.arrays.x.data(), e);
         }},
        {"hm_plan_solve", "....bbb..ubbbb", true,
         [=](World&, hm_basis* b, hm_error* e) { return hm_plan_solve(plan, b, nullptr, e); }},
        {"hm_move_safe", ".bbbbbb..ubbbb", false,
         with_plan(safe_move_size,
                   [=](World& w, hm_basis* b, void* work, std::size_t bytes, hm_error* e) {
                       return safe_move(plan, b, w.arrays.move.data(), &w.arrays.out, nullptr, work,
                                        bytes, nullptr, nullptr, e);
                   })},
        {"hm_move_safe", ".bbbbbb.uubbbb", false,
         with_plan(safe_displace_size,
                   [=](World& w, hm_basis* b, void* work, std::size_t bytes, hm_error* e) {
                       std::vector<double> const zeros(4000, 0.0);
                       hm_points const wall{zeros.data(), zeros.data() + 1, 2};
                       std::int32_t const all = std::int32_t(given_points(plan).size());
                       return safe_displace(plan, b, nullptr, all, nullptr, &wall, &w.arrays.out,
                                            work, bytes, nullptr, nullptr, e);
                   })},
        {"hm_tabulate", ".bbbbbb..ubbbb", false,
         [=](World&, hm_basis* b, hm_error* e) {
             std::size_t bytes = 0;
             auto modes = sized<hm_modes>();
             modes.n_modes = modes.numbers = 1;
             modes.n = std::int32_t(given_points(plan).size());
             std::vector<double> const ones(std::size_t(modes.n), 1.0);
             modes.values = ones.data();
             hm_status const status = fixtures::tabulate_size(plan, b, &modes, &bytes, e);
             if (status < 0) return status;
             Guarded block(bytes);
             hm_basis* made = nullptr;
             return hm_tabulate(&made, fixtures::Memory(block.data(), bytes), plan, b, &modes,
                                nullptr, e);
         }},
        {"hm_plane_morph", ".bbbbb......bb", false,
         [](World& w, hm_basis* b, hm_error* e) {
             double* const x = w.arrays.x.data();
             hm_space_points_out const to{x, x + 1, x + 2, 3};
             return hm_plane_morph(w.plane.plane, b, w.arrays.move.data(), nullptr, &to, nullptr,
                                   e);
         }},
        {"hm_plane_adjoint", ".bbbbb......bb", false,
         [](World& w, hm_basis* b, hm_error* e) {
             double* const x = w.arrays.x.data();
             hm_space_points const dj{x, x + 1, x + 2, 3};
             return hm_plane_adjoint(w.plane.plane, b, &dj, w.arrays.gradient.data(), nullptr, e);
         }},
        {"hm_private_rows_get", "bbbbbbbbbbbbb.", false,
         [](World& w, hm_basis* b, hm_error* e) {
             return hm_private_rows_get(w.one.equations(), b, 0, w.arrays.x.data(), e);
         }},
        {"hm_private_rows_set", "bbbbbbbbbbbbb.", true,
         [](World& w, hm_basis* b, hm_error* e) {
             return hm_private_rows_set(w.one.equations(), b, 0, w.arrays.x.data(), e);
         }},
        {"hm_private_rows_residual", "bbbbbbbbbbbbb.", false,
         [](World& w, hm_basis* b, hm_error* e) {
             return hm_private_rows_residual(w.one.equations(), b, 0, w.arrays.x.data(), e);
         }},
        {"hm_private_rows_finish", "bbbbbbbbbbbbb.", true,
         [](World& w, hm_basis* b, hm_error* e) {
             return hm_private_rows_finish(w.one.equations(), b, 1, e);
         }},
    };
    for (Call const& call : calls) {
        REQUIRE(std::string(call.expected).size() == n);
        for (std::size_t k = 0; k < n; ++k) {
            hm_error error{};
            hm_status const status = call.run(world, world.one.all[k].basis, &error);
            INFO(std::string(call.name)
                 << ", " << std::string(world.one.all[k].name) << ": " << error.text);
            CHECK(status == status_of(call.expected[k]));
            CHECK(error.code == status);
            if (status < 0 || !call.fills) CHECK(world.one.is_untouched(k));
            world.restore();
        }
    }
}

namespace {

enum class Filled { neither, first };

struct PairOfBases {
    hm_basis *first, *second;
    Bases::Kind const *first_kind, *second_kind;
};

struct PairCall {
    const char* name;
    std::vector<const char*>
        expected;      // a row for each kind of the first basis, a letter for each of the second
    const char* same;  // letters for one basis as both arguments
    Filled filled;
    std::function<hm_status(World&, PairOfBases const&, hm_error*)> run;
};

// hm_move_safe with the basis, one other basis, and the derivative; the last two may be NULL.
hm_status safe_morph(World& w, hm_basis* basis, hm_basis* other, hm_basis* derivative,
                     hm_error* error) {
    hm_plan* const plan = w.one.solved.plan;
    hm_safe_options options = sized<hm_safe_options>();
    const hm_basis* const others[] = {other};
    options.n_others = other != nullptr ? 1 : 0;
    options.others = others;
    return in_block(
        error,
        [&](std::size_t* bytes, hm_error* e) { return safe_move_size(plan, basis, bytes, e); },
        [&](void* work, std::size_t bytes, hm_error* e) {
            return safe_move(plan, basis, w.arrays.move.data(), &w.arrays.out, derivative, work,
                             bytes, &options, nullptr, e);
        });
}

}  // namespace

TEST_CASE("two bases in one call: each pair of kinds, and one basis as both") {
    World world;
    std::size_t const n = world.one.all.size();
    PairCall const calls[] = {
        {"hm_transfer, to the first from the second",
         {".bbbbbbuuubbbb", ".bbbbbbuuubbbb", "bbbbbbbuuubbbb", "bbbbbbbuuubbbb", "bbbbbbbuuubbbb",
          "bbbbbbbuuubbbb", "bbbbbbbuuubbbb", "ubbbbbbuuuuubb", "ubbbbbbuuuuubb", "ubbbbbbuuuuubb",
          "bbbbbbbuuubbbb", "bbbbbbbuuubbbb", "bbbbbbbuuubbbb", "bbbbbbbuuubbbb"},
         "aaaaaaaaaaaaaa",
         Filled::first,
         [](World& w, PairOfBases const& pair, hm_error* error) {
             return in_block(
                 error,
                 [&](std::size_t* bytes, hm_error* e) {
                     return fixtures::transfer_size(w.one.solved.analysis, &w.one.mesh, bytes, e);
                 },
                 [&](void* work, std::size_t bytes, hm_error* e) {
                     return hm_transfer(pair.first, fixtures::Memory(work, bytes),
                                        w.one.solved.analysis, pair.second, &w.one.mesh, nullptr,
                                        e);
                 });
         }},
        {"hm_move_safe, the derivative and the basis",
         {".bbbbbbbbubbbb", ".bbbbbbbbubbbb", "bbbbbbbbbubbbb", "bbbbbbbbbubbbb", "bbbbbbbbbubbbb",
          "bbbbbbbbbubbbb", "bbbbbbbbbubbbb", "bbbbbbb.bubbbb", "bbbbbbbb.ubbbb", "ubbbbbbuuubbbb",
          "bbbbbbbbbubbbb", "bbbbbbbbbubbbb", "bbbbbbbbbubbbb", "bbbbbbbbbubbbb"},
         "ababbbbaaubbbb",
         Filled::first,
         [](World& w, PairOfBases const& pair, hm_error* e) {
             return safe_morph(w, pair.second, nullptr, pair.first, e);
         }},
        {"hm_move_safe, the derivative and another basis",
         {".bbbbbbbbu.bbb", ".bbbbbbbbu.bbb", "bbbbbbbbbbbbbb", "bbbbbbbbbbbbbb", "bbbbbbbbbbbbbb",
          "bbbbbbbbbbbbbb", "bbbbbbbbbbbbbb", "bbbbbbbbbbbbbb", "bbbbbbbbbbbbbb", "uuuuuuuuuuuuuu",
          "bbbbbbbbbbbbbb", "bbbbbbbbbbbbbb", "bbbbbbbbbbbbbb", "bbbbbbbbbbbbbb"},
         "aaaaaaaaaaaaaa",
         Filled::first,
         [](World& w, PairOfBases const& pair, hm_error* e) {
             return safe_morph(w, w.two.solved.basis, pair.second, pair.first, e);
         }},
        {"hm_move_safe, the basis and another basis",
         {".bbbbbbbbu.bbb", "bbbbbbbbbbbbbb", "bbbbbbbbbbbbbb", "bbbbbbbbbbbbbb", "bbbbbbbbbbbbbb",
          "bbbbbbbbbbbbbb", "bbbbbbbbbbbbbb", "bbbbbbb.bubbbb", "bbbbbbbb.ubbbb", "uuuuuuuuuuuuuu",
          "bbbbbbbbbbbbbb", "bbbbbbbbbbbbbb", "bbbbbbbbbbbbbb", "bbbbbbbbbbbbbb"},
         ".bbbbbb..ubbbb",
         Filled::neither,
         [](World& w, PairOfBases const& pair, hm_error* e) {
             return safe_morph(w, pair.first, pair.second, nullptr, e);
         }},
        {"hm_private_parcel_unpack to the first, packed from the second",
         {"bbbbbbbbbubbbb", "bbbbbbbbbubbbb", "bbbbbbbbbubbbb", "bbbbbbbbbubbbb", "bbbbbbbbbubbbb",
          ".bbbbb.bbubbbb", "bbbbbbbbbubbbb", "bbbbbbbbbubbbb", "bbbbbbbbbubbbb", "ubububuuuuuuub",
          "bbbbbbbbbubbbb", "bbbbbbbbbubbbb", "bbbbbbbbbubbbb", "bbbbbbbbbubbbb"},
         "bbbbbbbbbubbbb",
         Filled::first,
         [](World& w, PairOfBases const& pair, hm_error* e) {
             std::vector<std::int32_t> list = pair.first_kind->points;
             if (list.empty()) list = w.one.all_points();
             for (std::int32_t& point : list)
                 point = std::min(point, info_of(pair.second).points - 1);
             std::int64_t doubles = 0;
             std::int32_t const n_list = std::int32_t(list.size());
             hm_status status = hm_private_parcel_size(pair.second, n_list, &doubles, e);
             if (status < 0) return status;
             std::vector<double> parcel(static_cast<std::size_t>(doubles));
             status = hm_private_parcel_pack(pair.second, n_list, list.data(), parcel.data(), e);
             return status < 0 ? status
                               : hm_private_parcel_unpack(pair.first, parcel.data(), doubles, e);
         }},
    };
    for (PairCall const& call : calls) {
        REQUIRE(call.expected.size() == n);
        for (std::size_t first = 0; first < n; ++first) {
            for (std::size_t second = 0; second < n; ++second) {
                for (bool const same : {false, true}) {
                    if (same && first != second) continue;
                    Bases& of_second = same ? world.one : world.two;
                    PairOfBases const pair{world.one.all[first].basis, of_second.all[second].basis,
                                           &world.one.all[first], &of_second.all[second]};
                    hm_error error{};
                    hm_status const status = call.run(world, pair, &error);
                    std::string const which = std::string(call.name) + ": " +
                                              pair.first_kind->name + ", " +
                                              pair.second_kind->name + (same ? ", one object" : "");
                    INFO(which << ": " << error.text);
                    CHECK(status ==
                          status_of(same ? call.same[first] : call.expected[first][second]));
                    CHECK(error.code == status);
                    if (!same) CHECK(of_second.is_untouched(second));
                    if (status < 0 || call.filled == Filled::neither)
                        CHECK(world.one.is_untouched(first));
                    world.restore();
                }
            }
        }
    }
}
