// Bad input of hm_displace and hm_displace_adjoint: refused by name, and nothing is written.
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/displaced.hpp>
#include <fixtures/traps.hpp>

#include <functional>
#include <limits>

using namespace fixtures;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// The arguments of one call; a test spoils one of them.
struct Arguments {
    Case setup = given_instead(tiny_case());
    Displaced displaced{setup};
    std::int32_t n_fields = 2;
    std::vector<std::int32_t> list = displaced.points;
    std::vector<double> wall = std::vector<double>(32, 0.125),
                        mesh = std::vector<double>(4 * setup.mesh.x.size(), 0.5);
    std::vector<hm_points> given, dj;
    std::vector<hm_points_out> to, gradient;
    hm_solve_report report{};
    Guarded work = displaced.work_for(2);
    std::size_t bytes = work.size();
    const std::int32_t* points = list.data();
    std::int32_t n = std::int32_t(list.size());
    std::vector<double> out = std::vector<double>(mesh.size(), 77);

    Arguments() {
        report.struct_size = sizeof report;
        std::size_t const n_mesh = setup.mesh.x.size();
        for (std::size_t field = 0; field < 2; ++field) {
            given.push_back({&wall[16 * field], &wall[16 * field + 8], 1});
            dj.push_back({&mesh[2 * n_mesh * field], &mesh[2 * n_mesh * field + n_mesh], 1});
            to.push_back({&out[2 * n_mesh * field], &out[2 * n_mesh * field + n_mesh], 1});
            gradient.push_back({&out[16 * field], &out[16 * field + 8], 1});
        }
    }
    hm_status displace(hm_error& error) {
        return hm_displace(displaced.plan, n, points, n_fields, given.data(), nullptr, to.data(),
                           fixtures::Memory(work.data(), bytes), &report, &error);
    }
    hm_status adjoint(hm_error& error) {
        return hm_displace_adjoint(displaced.plan, n, points, n_fields, dj.data(), gradient.data(),
                                   fixtures::Memory(work.data(), bytes), &report, &error);
    }
};

enum class Call { displace, adjoint, either };

struct Spoiled {
    hm_status status;
    const char* named;
    std::int32_t item;
    Call call;
    std::function<void(Arguments&)> spoil;
};

}  // namespace

TEST_CASE("spoiled arguments of displacements and of the adjoint") {
    constexpr std::int32_t any = -2;
    std::vector<Spoiled> const all = {
        {HM_BAD_ARGUMENT, "n_fields", -1, Call::either, [](Arguments& a) { a.n_fields = 0; }},
        {HM_BAD_ARGUMENT, "n_fields", -3, Call::either, [](Arguments& a) { a.n_fields = -3; }},
        {HM_BLOCK_TOO_SMALL, "more bytes", 1, Call::either, [](Arguments& a) { --a.bytes; }},
        {HM_BAD_ARGUMENT, "a list may have 0 to", -5, Call::either, [](Arguments& a) { a.n = -5; }},
        {HM_BAD_CONDITION, "but not in the list", any, Call::either, [](Arguments& a) { --a.n; }},
        {HM_BAD_CONDITION, "but on no marker with given displacements", 0, Call::either,
         [](Arguments& a) { a.list[3] = 0; }},
        {HM_BAD_CONDITION, "but not in the list", any, Call::either,
         [](Arguments& a) { a.list[3] = a.list[4]; }},
        {HM_BAD_ARGUMENT, "which is not in the mesh", 2, Call::either,
         [](Arguments& a) { a.list[2] = 48; }},
        {HM_BAD_ARGUMENT, "which is not in the mesh", 2, Call::either,
         [](Arguments& a) { a.list[2] = -1; }},
        {HM_BAD_ARGUMENT, "n is 7", 7, Call::either,
         [](Arguments& a) { a.points = nullptr, a.n = 7; }},
        {HM_BAD_ARGUMENT, "struct_size", -1, Call::either,
         [](Arguments& a) { a.report.struct_size = 0; }},
        {HM_BAD_ARGUMENT, "wall", -1, Call::displace, [](Arguments& a) { a.given[1].y = nullptr; }},
        {HM_BAD_ARGUMENT, "to", -1, Call::displace, [](Arguments& a) { a.to[1].x = nullptr; }},
        {HM_BAD_ARGUMENT, "dj", -1, Call::adjoint, [](Arguments& a) { a.dj[1].x = nullptr; }},
        {HM_BAD_ARGUMENT, "gradient", -1, Call::adjoint,
         [](Arguments& a) { a.gradient[1].x = nullptr; }},
        {HM_BAD_ARGUMENT, "in field 1 is not finite", any, Call::displace,
         [](Arguments& a) { a.wall[17] = not_a_number; }},
        {HM_BAD_ARGUMENT, "in field 0 exceeds 1e100 in magnitude", any, Call::displace,
         [](Arguments& a) { a.wall[2] = 2e100; }},
        {HM_BAD_ARGUMENT, "in field 0 is not finite", 9, Call::adjoint,
         [](Arguments& a) { a.mesh[9] = not_a_number; }},
    };
    for (Spoiled const& bad : all)
        for (Call const call : {Call::displace, Call::adjoint}) {
            if (bad.call != Call::either && bad.call != call) continue;
            Arguments arguments;
            std::vector<double> const before = arguments.out;
            bad.spoil(arguments);
            hm_error error{};
            hm_status const status =
                call == Call::displace ? arguments.displace(error) : arguments.adjoint(error);
            INFO(std::string(bad.named) << ": " << error.text);
            CHECK(status == bad.status);
            if (bad.item != any) CHECK(fixtures::found(error) == bad.item);
            CHECK(says(error, bad.named));
            CHECK(arguments.out == before);
        }
    Arguments good;
    hm_error error{};
    CHECK(good.displace(error) == HM_OK);
    CHECK(good.adjoint(error) == HM_OK);
}

TEST_CASE("one field may be added in place; of several fields none may be in the arrays of from") {
    Arguments apart, in_place;
    auto const displace = [&](Arguments& a, std::int32_t n_fields, hm_points_out const* to) {
        std::vector<double>&x = a.setup.mesh.x, &y = a.setup.mesh.y;
        hm_points const from{x.data(), y.data(), 1};
        hm_error error{};
        hm_status const status =
            hm_displace(a.displaced.plan, a.n, a.points, n_fields, a.given.data(), &from, to,
                        fixtures::Memory(a.work.data(), a.bytes), &a.report, &error);
        if (status == HM_BAD_ARGUMENT) CHECK(says(error, "to and from have numbers in common"));
        return status;
    };
    std::vector<double> const x = apart.setup.mesh.x;
    hm_points_out const same{in_place.setup.mesh.x.data(), in_place.setup.mesh.y.data(), 1};
    REQUIRE(displace(apart, 1, apart.to.data()) == HM_OK);
    REQUIRE(displace(in_place, 1, &same) == HM_OK);
    for (std::size_t k = 0; k < x.size(); ++k) CHECK(in_place.setup.mesh.x[k] == apart.to[0].x[k]);
    apart.to[1] = {apart.setup.mesh.x.data(), apart.setup.mesh.y.data(), 1};
    CHECK(displace(apart, 2, apart.to.data()) == HM_BAD_ARGUMENT);
    CHECK(apart.setup.mesh.x == x);
    apart.to[1] = apart.to[0];
    CHECK(hm_displace(apart.displaced.plan, apart.n, apart.points, 2, apart.given.data(), nullptr,
                      apart.to.data(), fixtures::Memory(apart.work.data(), apart.bytes),
                      &apart.report, nullptr) == HM_BAD_ARGUMENT);
    hm_points_out const shifted{apart.setup.mesh.x.data() + 1, apart.out.data(), 1};
    CHECK(displace(apart, 1, &shifted) == HM_BAD_ARGUMENT);
    CHECK(apart.setup.mesh.x == x);
}

TEST_CASE("displacements are not given with the schemes of nodal gradients") {
    Case setup = given_instead(tiny_case());
    Options nodal = laplace();
    nodal.scheme = HM_NODAL_GRADIENT;
    CHECK(Attempt(setup.problem(), &nodal).status == HM_UNSUPPORTED);
}
