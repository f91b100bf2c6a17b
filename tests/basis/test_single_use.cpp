// Bases in single precision as blocks that are copied, attached and damaged, and values that single
// precision does not hold.
#include <harmorph_bases.h>

#include <fixtures/single.hpp>

#include "basis/derived_basis.hpp"

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
        CHECK(std::fabs(values_of(Single(solved.basis).basis, 0)[0] - tiny) <= 0x1p-150);
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
