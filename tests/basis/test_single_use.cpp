// Bases in single storage as blocks: copied, attached, damaged; what they do not hold, and what
// refuses them.
#include <harmorph_bases.h>
#include <harmorph_parts.h>

#include <fixtures/single.hpp>

#include "basis/single_precision.hpp"

using namespace fixtures;

TEST_CASE("a single-precision basis is copied and attached like any basis, and damage is refused") {
    Case setup = tiny_case();
    Solved const solved(setup);
    Single const single(solved.basis);
    std::vector<unsigned char> const bytes = bytes_of(single.basis);
    CHECK(bytes == bytes_of(Single(solved.basis, 40).basis));
    Numbers block(bytes.size() / sizeof(double));
    std::memcpy(block.data(), bytes.data(), bytes.size());
    hm_mesh const mesh = setup.mesh.view();
    const hm_basis* attached = nullptr;
    REQUIRE(hm_basis_attach(&attached, block.data(), bytes.size(), &mesh, nullptr) == HM_OK);
    Numbers const move = some_move(solved.info().functions, 0.1, 1);
    Moved const expected = morphed(single.basis, setup.mesh, move),
                found = morphed(attached, setup.mesh, move);
    CHECK(same_bits(found.x, expected.x));
    CHECK(same_bits(found.y, expected.y));
    for (std::size_t size = 0; size < bytes.size(); size += 8)
        CHECK(hm_basis_attach(&attached, block.data(), size, nullptr, nullptr) == HM_BAD_BASIS);
    unsigned char* const data = reinterpret_cast<unsigned char*>(block.data());
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        data[k] = static_cast<unsigned char>(data[k] ^ 0x11);
        INFO("byte " << k);
        CHECK(hm_basis_attach(&attached, block.data(), bytes.size(), nullptr, nullptr) ==
              HM_BAD_BASIS);
        data[k] = bytes[k];
    }
}

TEST_CASE("values beyond single precision are refused if large, and tiny values keep the bound") {
    Case setup = tiny_case();
    Solved const solved(setup);
    harmorph::Basis const view = harmorph::Basis::view(static_cast<void*>(solved.basis));
    Numbers all(setup.mesh.x.size());
    for (double const tiny : {0x1.234567p-140, 0x1p-151, -0x1.8p-150}) {
        view.value[0] = tiny;  // point 0, function 0
        view.seal();
        REQUIRE(hm_basis_values(Single(solved.basis).basis, 0, 0, all.data(), nullptr) == HM_OK);
        CHECK(std::fabs(all[0] - tiny) <= 0x1p-150);
    }
    for (double const large : {0x1p+128, -1e300}) {
        view.value[0] = large;
        view.seal();
        Single const single(solved.basis);
        CHECK(refused(single.status, single.error));
        CHECK(single.basis == nullptr);
        CHECK(single.error.value == std::fabs(large));
    }
}

TEST_CASE("calls that need the functions in double precision refuse those in single precision") {
    Case setup = two_body_case();
    Solved const solved(setup);
    Single const single(solved.basis);
    hm_mesh const mesh = setup.mesh_view();
    hm_error error{};
    std::size_t bytes = 0;
    std::int64_t doubles = 0;
    std::int32_t const point = 0;
    CHECK(refused(hm_plan_solve(solved.plan, single.basis, nullptr, &error), error));
    CHECK(refused(hm_single_size(single.basis, &bytes, &error), error));
    Numbers room(100000);
    hm_basis* made = nullptr;
    CHECK(
        refused(hm_single_init(&made, room.data(), 8 * room.size(), single.basis, &error), error));
    CHECK(refused(hm_parcel_size(single.basis, 1, &doubles, &error), error));
    Numbers parcel(1000);
    CHECK(refused(hm_parcel_pack(single.basis, 1, &point, parcel.data(), &error), error));
    CHECK(refused(hm_parcel_unpack(single.basis, parcel.data(), 1000, &error), error));

    REQUIRE(hm_transfer_size(solved.analysis, &mesh, &bytes, nullptr) == HM_OK);
    std::vector<unsigned char> work(bytes);
    CHECK(refused(hm_transfer(solved.basis, work.data(), bytes, solved.analysis, single.basis,
                              &mesh, nullptr, &error),
                  error));
    CHECK(refused(hm_transfer(single.basis, work.data(), bytes, solved.analysis, solved.basis,
                              &mesh, nullptr, &error),
                  error));

    REQUIRE(hm_morph_safe_size(solved.plan, nullptr, &bytes, nullptr) == HM_OK);
    work.resize(bytes);
    Numbers const move = some_move(20, 1e-3, 1);
    Numbers x = setup.mesh.x, y = setup.mesh.y;
    auto const safe = [&](const hm_basis* by, hm_basis* derivative,
                          hm_safe_options const* options) {
        return hm_morph_safe(solved.plan, by, move.data(), points_out(x, y), derivative,
                             work.data(), bytes, options, nullptr, &error);
    };
    const hm_basis* const other = single.basis;
    auto options = sized<hm_safe_options>();
    options.n_others = 1;
    options.others = &other;
    CHECK(refused(safe(single.basis, nullptr, nullptr), error));
    CHECK(refused(safe(solved.basis, single.basis, nullptr), error));
    CHECK(refused(safe(solved.basis, nullptr, &options), error));
    CHECK(same_bits(x, setup.mesh.x));
    CHECK(morphed(single.basis, setup.mesh, move).x != setup.mesh.x);  // it has come to no harm
}

TEST_CASE("wrong arguments, shares, unsolved bases and blocks that are too small are refused") {
    Case setup = two_body_case();
    Solved const solved(setup);
    std::size_t need = 0;
    CHECK(hm_single_size(nullptr, &need, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_single_size(solved.basis, nullptr, nullptr) == HM_BAD_ARGUMENT);
    REQUIRE(hm_single_size(solved.basis, &need, nullptr) == HM_OK);
    hm_basis* made = nullptr;
    std::vector<unsigned char> room(need);
    CHECK(hm_single_init(nullptr, room.data(), need, solved.basis, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_single_init(&made, nullptr, need, solved.basis, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_single_init(&made, room.data(), need, nullptr, nullptr) == HM_BAD_ARGUMENT);
    for (std::size_t give = 0; give + 64 < need; give += 1024) {
        Guarded block(give);
        hm_error error{};
        CHECK(hm_single_init(&made, block.data(), give, solved.basis, &error) ==
              HM_BLOCK_TOO_SMALL);
        CHECK(made == nullptr);
        CHECK(block.guards_intact());
        CHECK(error.value == double(need - give));
    }
    std::size_t bytes = 0;
    REQUIRE(hm_share_size(solved.analysis, 0, 3, &bytes, nullptr) == HM_OK);
    std::vector<unsigned char> block(bytes);
    hm_basis* share = nullptr;
    REQUIRE(hm_share_init(&share, block.data(), bytes, solved.analysis, 0, 3, nullptr) == HM_OK);
    CHECK(hm_single_size(share, &bytes, nullptr) == HM_BAD_BASIS);  // not solved
    REQUIRE(hm_plan_solve(solved.plan, share, nullptr, nullptr) == HM_OK);
    CHECK(hm_single_size(share, &bytes, nullptr) == HM_BAD_BASIS);  // not all functions
    CHECK(hm_single_init(&made, room.data(), need, share, nullptr) == HM_BAD_BASIS);
}
