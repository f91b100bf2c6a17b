// A safe morph accepts other bases whose functions are the same at the wall, modes of a table
// included.
#include <fixtures/single.hpp>
#include <fixtures/memory.hpp>
#include <fixtures/displaced.hpp>
#include <fixtures/parts.hpp>

using namespace fixtures;

namespace {

hm_status safe_morph(hm_plan* plan, const hm_basis* basis, const hm_basis* other,
                     std::size_t n_points, hm_error& error) {
    Guarded work = block_of(safe_move_size, plan, basis);
    auto options = sized<hm_safe_options>();
    options.n_others = 1;
    options.others = &other;
    hm_basis_info const info = info_of(basis);
    std::vector<double> x(n_points), y(n_points);
    std::vector<double> const move(std::size_t(2 * info.functions), 1e-3);
    return safe_move(plan, basis, move.data(), points_out(x, y), nullptr, work.data(), work.size(),
                     &options, nullptr, &error);
}

}  // namespace

TEST_CASE("another operator with the same table is accepted, and one number changed is refused") {
    for (bool const complex : {false, true}) {
        Case setup = curve_and_table();
        Options const options = options_of(complex ? HM_CONFORMAL : HM_LAPLACE);
        Options others = options_of(complex ? HM_CONFORMAL : HM_WEIGHTED);
        others.exponent = 1.5;
        Attempt const own(setup.problem(), &options);
        REQUIRE(own.status == HM_OK);
        Attempt const other(setup.problem(), &others);
        REQUIRE(other.status == HM_OK);
        std::size_t const n_wall = given_points(own.plan).size(), n_points = setup.mesh.x.size();
        std::vector<Field> modes = {some_field(n_wall, 5, 0.02), some_field(n_wall, 6, 0.02)};
        if (!complex)
            for (Field& mode : modes)
                for (Complex& value : mode) value = value.real();
        std::int32_t const numbers = complex ? 2 : 1;
        Tabulated const basis(own.plan, own.basis, modes, numbers);
        REQUIRE_MESSAGE(basis.status == HM_OK, basis.error.text);
        hm_error error{};
        {
            Tabulated const same(other.plan, other.basis, modes, numbers);
            REQUIRE_MESSAGE(same.status == HM_OK, same.error.text);
            CHECK(safe_morph(own.plan, basis.basis, same.basis, n_points, error) == HM_OK);
            INFO(error.text);
        }
        for (std::size_t mode = 0; mode < modes.size(); ++mode)
            for (std::size_t const point : {std::size_t{0}, n_wall / 2, n_wall - 1})
                for (std::int32_t part = 0; part < numbers; ++part) {
                    std::vector<Field> changed = modes;
                    changed[mode][point] += part == 0 ? Complex(1e-9, 0) : Complex(0, 1e-9);
                    Tabulated const different(other.plan, other.basis, changed, numbers);
                    REQUIRE(different.status == HM_OK);
                    CHECK(safe_morph(own.plan, basis.basis, different.basis, n_points, error) ==
                          HM_BAD_BASIS);
                }
    }
}

TEST_CASE("the derivative is cleared at the beginning and cannot be a basis that is read") {
    Case setup = curve_and_table();
    Options const options = options_of(HM_CONFORMAL);
    Attempt own(setup.problem(), &options), other(setup.problem(), &options),
        apart(setup.problem(), &options);
    REQUIRE(own.status == HM_OK);
    Guarded work = block_of(safe_move_size, own.plan, own.basis);
    std::vector<double> x(setup.mesh.x.size(), 7), y = x;
    std::vector<double> const move(std::size_t(2 * info_of(own.basis).functions), 1e-3);
    auto const morph = [&](std::vector<const hm_basis*> const& others, hm_basis* derivative,
                           hm_error& error) {
        auto safe = sized<hm_safe_options>();
        safe.n_others = std::int32_t(others.size());
        safe.others = others.data();
        return safe_move(own.plan, own.basis, move.data(), points_out(x, y), derivative,
                         work.data(), work.size(), &safe, nullptr, &error);
    };
    for (std::size_t place = 0; place < 2; ++place) {
        std::vector<const hm_basis*> others(2, apart.basis);
        others[place] = other.basis;
        std::vector<unsigned char> const before = bytes_of(other.basis);
        hm_error error{};
        CHECK(morph(others, other.basis, error) == HM_BAD_ARGUMENT);
        CHECK(std::string(error.text) ==
              "derivative must not be basis " + std::to_string(place) + " of options.others");
        CHECK(bytes_of(other.basis) == before);
        CHECK(x == std::vector<double>(x.size(), 7));
    }
    hm_error error{};
    CHECK(morph({apart.basis, own.basis}, other.basis, error) == HM_OK);
}
