// Values of all kinds, real, complex and 2 x 2, have the same interface: basis, morph and adjoint.
#include <harmorph_bases.h>
#include <harmorph_design.h>

#include <fixtures/executors.hpp>
#include <fixtures/operators.hpp>
#include <fixtures/wrong.hpp>
#include <fixtures/memory.hpp>

using namespace fixtures;

namespace {

// A square with a hole on a polygon, and the settings that make the values real, complex or 2 x 2.
struct Kind {
    const char* name;
    std::int32_t operator_kind;
    bool rigid, slip;
    std::int32_t min_numbers;  // fewer cannot express the values
};
constexpr Kind kinds[] = {{"Laplace", HM_LAPLACE, false, false, 1},
                          {"weighted", HM_WEIGHTED, false, false, 1},
                          {"Laplace, rigid body", HM_LAPLACE, true, false, 2},
                          {"conformal", HM_CONFORMAL, false, false, 2},
                          {"conformal, rigid body", HM_CONFORMAL, true, false, 2},
                          {"Laplace, slip", HM_LAPLACE, false, true, 4},
                          {"conformal, slip", HM_CONFORMAL, true, true, 4}};

Case case_of(Kind const& kind) {
    Case out;
    if (kind.rigid) {
        out = two_body_case(Cells::hybrid, 4, 3);
        out.conditions.clear();
        out.put_on_curves(body, 0);
        out.set_rigid(second_body, 1.5, 0.5);
        if (kind.slip) out.set_slip(far_field);
    } else {
        out = tiny_case();
        if (kind.slip)
            for (std::int32_t const side : {bottom, right, top, left}) out.set_slip(side);
    }
    return out;
}

std::vector<double> numbers(const hm_basis* basis, std::int32_t function, std::int32_t number,
                            std::int32_t n_points) {
    std::vector<double> out(static_cast<std::size_t>(n_points));
    REQUIRE(hm_basis_values(basis, function, number, out.data(), nullptr) == HM_OK);
    return out;
}

}  // namespace

// The dense array has the numbers of each function, and its product with a movement is the
// displacement of the morph.
static void check_matrix(Solved const& solved, std::int32_t n_points) {
    hm_basis_info const info = solved.info();
    std::size_t const n = std::size_t(info.functions), points = std::size_t(n_points),
                      planes = std::size_t(info.numbers_per_value);
    std::vector<double> all(planes * points * n + 1, -3.0);
    REQUIRE(hm_basis_matrix(solved.basis, all.data(), nullptr) == HM_OK);
    CHECK(all.back() == -3.0);  // not written
    for (std::size_t p = 0; p < planes; ++p)
        for (std::size_t i = 0; i < n; ++i) {
            auto const one =
                numbers(solved.basis, std::int32_t(i), std::int32_t(p), std::int32_t(points));
            for (std::size_t k = 0; k < points; ++k) CHECK(all[(p * points + k) * n + i] == one[k]);
        }
    std::vector<double> move(2 * n), dx(points), dy(points);
    for (std::size_t k = 0; k < move.size(); ++k) move[k] = std::sin(3.0 * double(k) + 1);
    hm_points_out const to{dx.data(), dy.data(), 1};
    REQUIRE(hm_morph(solved.basis, move.data(), nullptr, &to, nullptr, nullptr) == HM_OK);
    auto const product = [&](std::size_t p, std::size_t k, std::size_t column) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i)
            sum += all[(p * points + k) * n + i] * move[2 * i + column];
        return sum;
    };
    double wrong = 0, largest = 0;
    for (std::size_t k = 0; k < points; ++k) {
        double x = product(0, k, 0), y = product(0, k, 1);
        if (planes == 2) x -= product(1, k, 1), y += product(1, k, 0);
        if (planes == 4) {
            x += product(1, k, 1);
            y = product(2, k, 0) + product(3, k, 1);
        }
        wrong = std::max({wrong, std::fabs(x - dx[k]), std::fabs(y - dy[k])});
        largest = std::max({largest, std::fabs(dx[k]), std::fabs(dy[k])});
    }
    CHECK(largest > 0.1);
    CHECK(wrong <= 1e-14 * largest);
}

TEST_CASE("the numbers of a value are the linear map that a morph applies") {
    for (Kind const& kind : kinds) {
        INFO(kind.name);
        Case setup = case_of(kind);
        Solved const solved(setup, options_of(kind.operator_kind));
        hm_basis_info const info = solved.info();
        CHECK(info.numbers_per_value >= kind.min_numbers);
        CHECK((info.numbers_per_value == 1 || info.numbers_per_value == 2 ||
               info.numbers_per_value == 4));
        CHECK(info.functions == setup.curves.n_control() + 2 * info.bodies);
        CHECK(info.bodies == (kind.rigid ? 1 : 0));
        for (std::int32_t i = 0; i < info.functions; ++i) {
            std::vector<std::vector<double>> value;
            for (std::int32_t p = 0; p < info.numbers_per_value; ++p)
                value.push_back(numbers(solved.basis, i, p, info.points));
            Field const by_x = displacement_by(solved, i, 1),
                        by_y = displacement_by(solved, i, {0, 1});
            for (std::size_t k = 0; k < by_x.size(); ++k) {
                double xx = value[0][k], xy = 0, yx = 0, yy = value[0][k];
                if (info.numbers_per_value == 2) {
                    yx = value[1][k];
                    xy = -yx;
                }
                if (info.numbers_per_value == 4) {
                    xy = value[1][k];
                    yx = value[2][k];
                    yy = value[3][k];
                }
                CHECK(by_x[k] == Complex(xx, yx));
                CHECK(by_y[k] == Complex(xy, yy));
            }
        }
        check_matrix(solved, setup.mesh.n_points());
        std::vector<double> to(std::size_t(info.points), 7);
        CHECK(hm_basis_values(solved.basis, 0, info.numbers_per_value, to.data(), nullptr) ==
              HM_BAD_ARGUMENT);
        CHECK(hm_basis_values(solved.basis, 0, -1, to.data(), nullptr) == HM_BAD_ARGUMENT);
        CHECK(hm_basis_values(solved.basis, info.functions, 0, to.data(), nullptr) ==
              HM_BAD_ARGUMENT);
        CHECK(to[0] == 7);
    }
}

TEST_CASE("the adjoint is the transpose of the morph for values of all kinds") {
    for (Kind const& kind : kinds) {
        INFO(kind.name);
        Case setup = case_of(kind);
        Solved const solved(setup, options_of(kind.operator_kind));
        std::int32_t const n = solved.info().functions;
        std::vector<double> const g = some_move(setup.mesh.n_points(), 1, 5);
        std::vector<double> gradient(2 * std::size_t(n), -1.0);
        REQUIRE(hm_adjoint(solved.basis, points_in(g.data(), g.data() + 1, 2), gradient.data(),
                           nullptr, nullptr) == HM_OK);
        for (std::int32_t k = 0; k < 2 * n; ++k) {  // each of its numbers
            Field const by =
                displacement_by(solved, k / 2, k % 2 == 0 ? Complex(1, 0) : Complex(0, 1));
            double expected = 0, size = 0;
            for (std::size_t p = 0; p < by.size(); ++p) {
                double const part[] = {g[2 * p] * by[p].real(), g[2 * p + 1] * by[p].imag()};
                expected += part[0] + part[1];
                size += std::fabs(part[0]) + std::fabs(part[1]);
            }
            CHECK(std::fabs(gradient[std::size_t(k)] - expected) <= 1e-14 * size);
        }
        Backwards backwards;
        hm_executor const executor = backwards.executor(3);
        std::vector<double> again(gradient.size());
        REQUIRE(hm_adjoint(solved.basis, points_in(g.data(), g.data() + 1, 2), again.data(),
                           &executor, nullptr) == HM_OK);
        CHECK(same_bits(again, gradient));
    }
}

TEST_CASE("adjoint and morph agree on meshes and functions beyond one block of either") {
    for (int const n : {9, 150}) {
        Case setup = ring_case(14, 300, 0.5, 2, Cells::hybrid, 3, n);
        Solved const solved(setup, options_of(HM_CONFORMAL));
        std::vector<double> const move = some_move(n, 1, 4),
                                  g = some_move(setup.mesh.n_points(), 1, 5);
        Field const moved = displacement(solved, move);
        std::vector<double> gradient(2 * std::size_t(n));
        REQUIRE(hm_adjoint(solved.basis, points_in(g.data(), g.data() + 1, 2), gradient.data(),
                           nullptr, nullptr) == HM_OK);
        double here = 0, there = 0, size = 0;
        for (std::size_t k = 0; k < moved.size(); ++k) {
            here += g[2 * k] * moved[k].real() + g[2 * k + 1] * moved[k].imag();
            size +=
                std::fabs(g[2 * k] * moved[k].real()) + std::fabs(g[2 * k + 1] * moved[k].imag());
        }
        for (std::size_t k = 0; k < move.size(); ++k) there += gradient[k] * move[k];
        CHECK(std::fabs(here - there) <= 1e-14 * size);
        CHECK(std::fabs(here) > 1e-3 * size / std::sqrt(4500.0));  // the test could have failed
    }
}

TEST_CASE("zero movement keeps every bit, and a movement that is not finite is refused") {
    for (Kind const& kind : kinds) {
        INFO(kind.name);
        Case setup = case_of(kind);
        Solved const solved(setup, options_of(kind.operator_kind));
        std::vector<double> move(2 * std::size_t(solved.info().functions), -0.0);
        std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
        x[3] = -0.0;
        std::vector<double> const before = x;
        REQUIRE(hm_morph(solved.basis, move.data(), points_in(x, y), points_out(x, y), nullptr,
                         nullptr) == HM_OK);
        CHECK(same_bits(x, before));
        CHECK(same_bits(y, setup.mesh.y));
        move.back() = std::nan("");
        CHECK(hm_morph(solved.basis, move.data(), points_in(x, y), points_out(x, y), nullptr,
                       nullptr) == HM_BAD_ARGUMENT);
        CHECK(same_bits(x, before));
    }
}

TEST_CASE("saving and attaching keep values of all kinds, and damaged values are refused") {
    for (Kind const& kind : kinds) {
        INFO(kind.name);
        Case setup = case_of(kind);
        Solved const solved(setup, options_of(kind.operator_kind));
        std::size_t const bytes = std::size_t(solved.info().bytes);
        std::vector<double> const move = some_move(solved.info().functions, 0.1, 6);
        Guarded whole(bytes, 8);
        std::memcpy(whole.data(), solved.basis, bytes);
        hm_mesh const mesh = setup.mesh.view();
        const hm_basis* copy = nullptr;
        REQUIRE(hm_basis_attach(&copy, whole.data(), bytes, &mesh, nullptr) == HM_OK);
        CHECK(displacement(copy, move) == displacement(solved, move));
        Wrong accepted;  // at which size; with which byte changed
        for (std::size_t size = 0; size < bytes; size += size < 800 ? 1 : 61) {
            Guarded part(size);
            if (size > 0) std::memcpy(part.data(), whole.data(), size);
            accepted.compare(size, hm_basis_attach(&copy, part.data(), size, &mesh, nullptr),
                             HM_BAD_BASIS);
        }
        CHECK(accepted == 0);
        for (std::size_t k = 0; k < bytes; k += k < 800 ? 1 : 13) {
            unsigned char& byte = whole.data()[k];
            byte = static_cast<unsigned char>(byte ^ 0x10);
            accepted.compare(k, hm_basis_attach(&copy, whole.data(), bytes, &mesh, nullptr),
                             HM_BAD_BASIS);
            byte = static_cast<unsigned char>(byte ^ 0x10);
        }
        CHECK(accepted == 0);
        CHECK(hm_basis_attach(&copy, whole.data(), bytes, &mesh, nullptr) == HM_OK);
    }
}

TEST_CASE("a basis gives back the conditions and options it was solved with") {
    Case setup = two_body_case(Cells::hybrid, 4, 3);
    setup.conditions.clear();
    setup.put_on_curves(body, 0);
    setup.set_rigid(second_body, 1.25, 0.75);
    setup.set_slip(far_field);
    Options options = options_of(HM_CONFORMAL, 1.25);
    options.offset_correction = 1;
    Solved const solved(setup, &options);
    hm_basis_info const info = solved.info();
    CHECK(info.operator_kind == HM_CONFORMAL);
    CHECK(info.exponent == 1.25);
    CHECK(info.offset_correction == 1);
    CHECK(info.scheme == HM_COMPACT);
    CHECK(info.engine == HM_DIRECT);
    CHECK(info.bodies == 1);
    CHECK(info.numbers_per_value == 4);
    hm_condition found[4];
    std::memset(static_cast<void*>(found), 0x55, sizeof found);
    std::int32_t n = -1;
    found[0].struct_size = sizeof found[0];
    CHECK(hm_basis_conditions(solved.basis, found, 2, &n, nullptr) == HM_BAD_ARGUMENT);
    CHECK(n == 3);
    found[0].struct_size = sizeof found[0];
    REQUIRE(hm_basis_conditions(solved.basis, found, 4, &n, nullptr) == HM_OK);
    REQUIRE(n == 3);
    CHECK(found[3].marker == 0x55555555);
    for (std::size_t k = 0; k < 3; ++k) {
        hm_condition const& expected = setup.conditions[k];
        CHECK(found[k].struct_size == sizeof found[k]);
        CHECK(found[k].marker == expected.marker);
        CHECK(found[k].kind == expected.kind);
        CHECK(found[k].first_curve == expected.first_curve);
        CHECK(found[k].n_curves == expected.n_curves);
        CHECK(found[k].body == expected.body);
        CHECK(found[k].partner == expected.partner);
        CHECK(found[k].x == expected.x);
        CHECK(found[k].y == expected.y);
    }
    // Together with curves and parameters, the conditions define the problem, and so the basis,
    // again.
    auto curves = sized<hm_curves>();
    hm_curve shape[2];
    REQUIRE(hm_basis_curves(solved.basis, nullptr, nullptr, &curves, shape, 2, nullptr) == HM_OK);
    std::vector<std::int32_t> points, on;
    std::vector<double> u;
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        if (info.point_curve[k] >= info.curves) continue;
        points.push_back(info.curve_point[k]);
        on.push_back(info.point_curve[k]);
        u.push_back(info.point_u[k]);
    }
    hm_mesh const mesh = setup.mesh.view();
    auto problem = sized<hm_problem>();
    problem.mesh = &mesh;
    problem.curves = &curves;
    problem.n_conditions = n;
    problem.conditions = found;
    problem.n_known = std::int32_t(points.size());
    problem.known_points = points.data();
    problem.known_curves = on.data();
    problem.known_u = u.data();
    Solved const again(problem, &options);
    REQUIRE(again.info().bytes == info.bytes);
    CHECK(std::memcmp(again.basis, solved.basis, std::size_t(info.bytes)) == 0);
}

TEST_CASE("a plan does not solve the basis of another operator, exponent or correction") {
    Case setup = tiny_case();
    auto const plan_of = [&](Attempt& attempt, Options const& options) {
        REQUIRE(attempt.analyse(setup.problem(), &options));
        REQUIRE(attempt.prepare());
        REQUIRE(hm_plan_factor(attempt.plan, nullptr, nullptr) == HM_OK);
    };
    Options const options[] = {options_of(HM_WEIGHTED, 1), options_of(HM_WEIGHTED, 1.5),
                               options_of(HM_LAPLACE), options_of(HM_CONFORMAL, 1),
                               options_of(HM_CONFORMAL, 1.5)};
    for (Options const& of_plan : options)
        for (Options const& of_basis : options) {
            Attempt a, b;
            plan_of(a, of_plan);
            plan_of(b, of_basis);
            bool const same = &of_plan == &of_basis;
            CHECK(hm_plan_solve(a.plan, b.basis, nullptr, nullptr) ==
                  (same ? HM_OK : HM_BAD_BASIS));
        }
}

TEST_CASE("blocks of the stated size suffice at any alignment; smaller ones are refused") {
    for (Kind const& kind : kinds) {
        INFO(kind.name);
        Case setup = case_of(kind);
        Options const options = options_of(kind.operator_kind);
        hm_problem const problem = setup.problem();
        for (std::size_t const shift : {std::size_t{0}, std::size_t{1}, std::size_t{13}}) {
            Attempt attempt;
            REQUIRE(attempt.analyse(problem, &options, shift));
            REQUIRE(attempt.prepare(shift));
            REQUIRE(attempt.solve());
            CHECK(attempt.guards_intact());
            hm_plan* plan = nullptr;
            hm_basis* basis = nullptr;
            Guarded less_plan(attempt.plan_block->size() - 64),
                less_basis(attempt.basis_block->size() - 64);
            CHECK(hm_plan_init(&plan, fixtures::Memory(less_plan.data(), less_plan.size()),
                               attempt.analysis, nullptr) == HM_BLOCK_TOO_SMALL);
            CHECK(hm_basis_init(&basis, fixtures::Memory(less_basis.data(), less_basis.size()),
                                attempt.analysis, nullptr) == HM_BLOCK_TOO_SMALL);
            CHECK(less_plan.guards_intact());
            CHECK(less_basis.guards_intact());
            CHECK(plan == nullptr);
            CHECK(basis == nullptr);
        }
    }
}
