// Functions in single precision: the wall moves as with double ones, the rest to the stated bound, and the adjoint is the
// transpose of that.
#include <doctest/doctest.h>

#include <fixtures/executors.hpp>
#include <fixtures/gradients.hpp>

#include <harmorph/single.hpp>

#include <cstring>

using namespace fixtures;

namespace {

using Numbers = std::vector<double>;

// In a block of exactly the size that was asked for.
class Single {
public:
    hm_basis* basis = nullptr;
    hm_status status = HM_OK;
    hm_error error{};

    explicit Single(const hm_basis* from, std::size_t shift = 0) {
        std::size_t bytes = 0;
        REQUIRE(hm_single_size(from, &bytes, nullptr) == HM_OK);
        block_ = std::make_unique<Guarded>(bytes, shift);
        status = hm_single_init(&basis, block_->data(), bytes, from, &error);
        CHECK(block_->guards_intact());
    }

private:
    std::unique_ptr<Guarded> block_;
};

// Rings of points whose last one repeats the first, bit by bit: a cut from a point of the wall where no function is 1.
Case cut_ring(int n_t = 30, int n_r = 14) {
    Case out = ring_case(1, n_t, 0.5, 1);
    out.given_points.clear(), out.given_curves.clear(), out.given_u.clear();
    Mesh& mesh = out.mesh = Mesh();
    for (int j = 0; j <= n_r; ++j)
        for (int i = 0; i <= n_t; ++i) {
            double const r = 0.5 * std::pow(1.15, j), angle = 2 * std::acos(-1.0) * (i % n_t) / n_t;
            mesh.add_point({r * std::cos(angle), r * std::sin(angle)});
        }
    int const row = n_t + 1, last = n_r * row;
    for (int j = 0; j < n_r; ++j)
        for (int k = j * row; k < j * row + n_t; ++k) mesh.add_cell({k, k + row, k + row + 1, k + 1});
    for (int i = 0; i < n_t; ++i) mesh.add_face(i + 1, i, body);
    for (int i = 0; i < n_t; ++i) mesh.add_face(last + i, last + i + 1, far_field);
    return out;
}

// The kinds of values, and a mesh with a cut that begins at the wall.
std::vector<KindOfProblem> problems() {
    std::vector<KindOfProblem> out = kinds_of_problems();
    out.emplace_back();
    out.back().its = cut_ring();
    out.back().options.operator_kind = HM_CONFORMAL;
    return out;
}

// Points of faces with a condition that gives them their values: curves and bodies, both sides of a cut.
std::vector<bool> wall_of(Case const& its) {
    std::vector<bool> out(its.mesh.x.size(), false);
    for (std::size_t face = 0; face < its.mesh.face_markers.size(); ++face)
        for (hm_condition const& condition : its.conditions)
            if (condition.marker == its.mesh.face_markers[face] && condition.kind <= HM_RIGID)
                for (std::size_t end = 0; end < 2; ++end)
                    out[static_cast<std::size_t>(its.mesh.faces[2 * face + end])] = true;
    return out;
}

struct Moved {
    Numbers x, y;
};

Moved morphed(const hm_basis* basis, Mesh const& mesh, Numbers const& move, const hm_executor* executor = nullptr) {
    Moved to{Numbers(mesh.x.size()), Numbers(mesh.x.size())};
    REQUIRE(hm_morph(basis, move.data(), mesh.x.data(), mesh.y.data(), 1, to.x.data(), to.y.data(), 1, executor, nullptr) ==
            HM_OK);
    return to;
}

Moved displacement(const hm_basis* basis, Numbers const& move) {
    std::size_t const n = static_cast<std::size_t>(info_of(basis).points);
    Moved to{Numbers(n, 7.0), Numbers(n, 7.0)};
    REQUIRE(hm_morph(basis, move.data(), nullptr, nullptr, 0, to.x.data(), to.y.data(), 1, nullptr, nullptr) == HM_OK);
    return to;
}

// sum_i |F_i| |dP_i| at a point, by x and by y.
struct Size {
    double x = 0, y = 0;

    Size(Matrices const& of, Numbers const& move, std::size_t k) {
        for (std::size_t i = 0; i < move.size() / 2; ++i) {
            auto const number = [&](int plane) { return std::fabs(of.plane[plane][i][k]); };
            double const dx = std::fabs(move[2 * i]), dy = std::fabs(move[2 * i + 1]);
            switch (of.info.numbers_per_value) {
                case 1: x += number(0) * dx, y += number(0) * dy; break;
                case 2: x += number(0) * dx + number(1) * dy, y += number(0) * dy + number(1) * dx; break;
                default: x += number(0) * dx + number(1) * dy, y += number(2) * dx + number(3) * dy;
            }
        }
    }
};

bool refused(hm_status status, hm_error const& error) {
    return status == HM_UNSUPPORTED && std::string(error.text).find("single precision") != std::string::npos;
}

}  // namespace

TEST_CASE("each number is the nearest one of single precision, and on the wall the number itself") {
    for (KindOfProblem& problem : problems()) {
        Solved const solved(problem.its, &problem.options);
        Single const single(solved.basis, 24);
        REQUIRE(single.status == HM_OK);
        hm_basis_info const info = info_of(single.basis), whole = solved.info();
        CHECK((info.storage == HM_SINGLE && whole.storage == HM_DOUBLE && info.solved == 1));
        CHECK((info.points == whole.points && info.cells == whole.cells && info.functions == whole.functions));
        CHECK((info.curve_points == whole.curve_points && info.numbers_per_value == whole.numbers_per_value));
        CHECK(same_bits<double>({info.point_u, info.point_u + info.curve_points},
                                {whole.point_u, whole.point_u + whole.curve_points}));
        if (problem.its.mesh.n_points() > 10 * whole.curve_points) CHECK(3 * info.bytes < 2 * whole.bytes);
        std::vector<bool> const wall = wall_of(problem.its);
        Matrices const before(solved.basis), after(single.basis);
        std::size_t wrong = 0, on_wall = 0, rounded = 0;
        for (std::int32_t p = 0; p < info.numbers_per_value; ++p)
            for (std::size_t i = 0; i < before.plane[p].size(); ++i)
                for (std::size_t k = 0; k < wall.size(); ++k) {
                    double const was = before.plane[p][i][k], is = after.plane[p][i][k];
                    if (is != (wall[k] ? was : static_cast<double>(static_cast<float>(was)))) ++wrong;
                    if (!(std::fabs(is - was) <= 0x1p-24 * std::fabs(was) + 0x1p-150)) ++wrong;
                    on_wall += wall[k] && was != static_cast<double>(static_cast<float>(was));
                    rounded += is != was;
                }
        CHECK(wrong == 0);
        CHECK((on_wall > 10 && rounded > 100));   // the test could have failed
    }
}

TEST_CASE("a morph moves the wall bit by bit as the double functions do, fixed points not at all, others to the bound") {
    for (KindOfProblem& problem : problems()) {
        Mesh const& mesh = problem.its.mesh;
        Solved const solved(problem.its, &problem.options);
        Single const single(solved.basis);
        Numbers const move = some_move(solved.info().functions, 0.05, 3);
        Moved const expected = morphed(solved.basis, mesh, move), found = morphed(single.basis, mesh, move);
        Moved const by = displacement(solved.basis, move), its = displacement(single.basis, move);
        std::vector<bool> const wall = wall_of(problem.its);
        Matrices const functions(solved.basis);
        std::size_t wrong = 0, differ = 0;
        for (std::size_t k = 0; k < wall.size(); ++k) {
            Size const size(functions, move, k);
            double const rounding = 1e-15;
            if (!(std::fabs(its.x[k] - by.x[k]) <= (0x1p-24 + rounding) * size.x)) ++wrong;
            if (!(std::fabs(its.y[k] - by.y[k]) <= (0x1p-24 + rounding) * size.y)) ++wrong;
            if (wall[k] && !(its.x[k] == by.x[k] && its.y[k] == by.y[k])) ++wrong;
            if (wall[k] && !(found.x[k] == expected.x[k] && found.y[k] == expected.y[k])) ++wrong;
            if (size.x + size.y == 0 && !(found.x[k] == mesh.x[k] && found.y[k] == mesh.y[k])) ++wrong;
            differ += its.x[k] != by.x[k];
        }
        CHECK(wrong == 0);
        CHECK(differ > wall.size() / 4);
        double error = 1;
        REQUIRE(hm_boundary_error(single.basis, move.data(), mesh.x.data(), mesh.y.data(), 1, found.x.data(), found.y.data(),
                                  1, &error, nullptr, nullptr) == HM_OK);
        CHECK(error < 1e-14);

        // In place, in pairs; and the movement 0 keeps every bit.
        Numbers xy, nothing(move.size(), 0.0);
        for (std::size_t k = 0; k < mesh.x.size(); ++k) xy.insert(xy.end(), {mesh.x[k], mesh.y[k]});
        xy[0] = -0.0;
        Numbers const start = xy;
        double *const x = xy.data(), *const y = x + 1;
        REQUIRE(hm_morph(single.basis, nothing.data(), x, y, 2, x, y, 2, nullptr, nullptr) == HM_OK);
        CHECK(same_bits(xy, start));
        xy[0] = mesh.x[0];
        REQUIRE(hm_morph(single.basis, move.data(), x, y, 2, x, y, 2, nullptr, nullptr) == HM_OK);
        std::size_t unequal = 0;
        for (std::size_t k = 0; k < mesh.x.size(); ++k) unequal += xy[2 * k] != found.x[k] || xy[2 * k + 1] != found.y[k];
        CHECK(unequal == 0);
    }
}

TEST_CASE("both sides of a cut move as one, on the wall and off it") {
    Case its = cut_ring(30);
    Solved const solved(its);
    CHECK(solved.info().curve_points == 30);   // 31 points of the mesh are on the curve
    Single const single(solved.basis);
    std::vector<std::int32_t> copy_alone = {30, 61, 5, 30};   // the wall's other side, and not the side with the parameter
    Rows const rows(single.basis, copy_alone);
    CHECK(info_of(rows.basis).curve_points == 2);
    Numbers const move = some_move(8, 0.05, 2);
    Moved const whole = displacement(solved.basis, move), by = displacement(single.basis, move),
                some = displacement(rows.basis, move);
    for (std::size_t k = 0; k < by.x.size(); k += 31) CHECK((by.x[k] == by.x[k + 30] && by.y[k] == by.y[k + 30]));
    for (std::size_t const k : {0u, 30u}) CHECK((by.x[k] == whole.x[k] && by.y[k] == whole.y[k]));
    CHECK(by.x[0] != static_cast<double>(static_cast<float>(by.x[0])));
    for (std::size_t const k : {0u, 3u}) CHECK((some.x[k] == whole.x[30] && some.y[k] == whole.y[30]));
}

TEST_CASE("the sum of the functions is 1 to single precision, on the curve to double") {
    Case its = ring_case(20, 60, 0.5, 2);
    its.set_free(far_field);   // then it is 1 everywhere
    Solved const solved(its);
    Single const single(solved.basis);
    Numbers move;
    for (std::int32_t i = 0; i < solved.info().functions; ++i) move.insert(move.end(), {1.0, 0.0});
    Moved const found = displacement(single.basis, move);
    std::vector<bool> const wall = wall_of(its);
    double worst = 0;
    for (std::size_t k = 0; k < wall.size(); ++k) {
        CHECK(std::fabs(found.x[k] - 1) <= (wall[k] ? 1e-15 : 0x1p-24 + 1e-10));   // solved to 1e-10
        worst = std::max(worst, std::fabs(found.x[k] - 1));
    }
    CHECK(worst > 1e-10);
}

TEST_CASE("the adjoint is the transpose: right to its bound, and <g, F m> = <F^T g, m>") {
    for (KindOfProblem& problem : problems()) {
        Solved const solved(problem.its, &problem.options);
        Single const single(solved.basis);
        Gradient const g(problem.its.mesh.x.size(), 3);
        Numbers const found = adjoint(single.basis, g);
        Matrices const exact(single.basis);
        for (std::size_t i = 0; i < found.size() / 2; ++i) {
            long double expected[2], bound[2];
            exact.gradient(i, g, expected, bound);
            CHECK(std::fabs(found[2 * i] - expected[0]) <= bound[0]);
            CHECK(std::fabs(found[2 * i + 1] - expected[1]) <= bound[1]);
        }
        Numbers const move = some_move(solved.info().functions, 1, 4);
        Moved const by = displacement(single.basis, move);
        double here = 0, there = 0, size = 0;
        for (std::size_t k = 0; k < by.x.size(); ++k) {
            here += g.x[k] * by.x[k] + g.y[k] * by.y[k];
            size += std::fabs(g.x[k] * by.x[k]) + std::fabs(g.y[k] * by.y[k]);
        }
        for (std::size_t k = 0; k < move.size(); ++k) there += found[k] * move[k];
        CHECK(std::fabs(here - there) <= 1e-14 * size);
        CHECK(std::fabs(here) > 1e-6 * size);
    }
}

TEST_CASE("more numbers in a row than one block of them, and threads change no bit") {
    for (int const n : {150, 9}) {
        Case its = ring_case(60, 300, 0.5, 2, Cells::quads, 3, n);   // 18300 points: several ranges
        Solved const solved(its);
        Single const single(solved.basis);
        Numbers const move = some_move(n, 0.01, 5);
        Gradient const g(its.mesh.x.size(), 6);
        Moved const expected = morphed(single.basis, its.mesh, move), exact = morphed(solved.basis, its.mesh, move);
        Numbers const gradient = adjoint(single.basis, g);
        CHECK(largest_difference(expected.x, exact.x) < 1e-8);
        for (std::int32_t const threads : {2, 5}) {
            Backwards order;
            hm_executor const executor = order.executor(threads);
            Moved const again = morphed(single.basis, its.mesh, move, &executor);
            CHECK((same_bits(again.x, expected.x) && same_bits(again.y, expected.y)));
            CHECK(same_bits(adjoint(single.basis, g, &executor), gradient));
            CHECK(order.tasks > 2);
        }
    }
}

TEST_CASE("parts: rows of single functions are the rows made single, and any parts give the same gradient") {
    for (KindOfProblem& problem : problems()) {
        Solved const solved(problem.its, &problem.options);
        Single const single(solved.basis);
        std::int32_t const n = problem.its.mesh.n_points();
        std::vector<std::int32_t> points = random_parts(n, 3, 8)[1];
        points.insert(points.end(), {solved.info().curve_point[3], points.front(), solved.info().curve_point[3]});
        Rows const of_single(single.basis, points), of_double(solved.basis, points);
        REQUIRE(of_single.status == HM_OK);
        CHECK(bytes_of(Single(of_double.basis).basis) == bytes_of(of_single.basis));

        Mesh here;   // the wall is exact wherever the list names it
        for (std::int32_t const k : points) here.add_point(problem.its.mesh.point(k));
        Numbers const move = some_move(solved.info().functions, 0.05, 3);
        Moved const all = morphed(single.basis, problem.its.mesh, move), some = morphed(of_single.basis, here, move);
        CHECK((same_bits(some.x, pick(all.x, points)) && same_bits(some.y, pick(all.y, points))));

        Gradient const g(problem.its.mesh.x.size(), 5);
        Numbers const expected = adjoint(single.basis, g);
        for (std::size_t const parts : {1u, 2u, 7u, 40u})
            CHECK(same_bits(adjoint_in_parts(single.basis, g, random_parts(n, parts, 17)), expected));
    }
}

TEST_CASE("copied, attached, truncated, damaged: like any basis") {
    Case its = tiny_case();
    Solved const solved(its);
    Single const single(solved.basis);
    std::vector<unsigned char> const bytes = bytes_of(single.basis);
    CHECK(bytes == bytes_of(Single(solved.basis, 40).basis));
    Numbers block(bytes.size() / sizeof(double));
    std::memcpy(block.data(), bytes.data(), bytes.size());
    hm_mesh const mesh = its.mesh.view();
    const hm_basis* attached = nullptr;
    REQUIRE(hm_basis_attach(&attached, block.data(), bytes.size(), &mesh, nullptr) == HM_OK);
    Numbers const move = some_move(solved.info().functions, 0.1, 1);
    Moved const expected = morphed(single.basis, its.mesh, move), found = morphed(attached, its.mesh, move);
    CHECK((same_bits(found.x, expected.x) && same_bits(found.y, expected.y)));
    for (std::size_t size = 0; size < bytes.size(); size += 8)
        CHECK(hm_basis_attach(&attached, block.data(), size, nullptr, nullptr) == HM_BAD_BASIS);
    unsigned char* const data = reinterpret_cast<unsigned char*>(block.data());
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        data[k] = static_cast<unsigned char>(data[k] ^ 0x11);
        INFO("byte " << k);
        CHECK(hm_basis_attach(&attached, block.data(), bytes.size(), nullptr, nullptr) == HM_BAD_BASIS);
        data[k] = bytes[k];
    }
}

TEST_CASE("values that single precision does not reach: too large ones are refused, tiny ones keep the absolute bound") {
    Case its = tiny_case();
    Solved const solved(its);
    harmorph::Basis const view = harmorph::Basis::view(static_cast<void*>(solved.basis));
    Numbers all(its.mesh.x.size());
    for (double const tiny : {0x1.234567p-140, 0x1p-151, -0x1.8p-150}) {
        view.value[0] = tiny;   // point 0, function 0
        view.seal();
        REQUIRE(hm_basis_values(Single(solved.basis).basis, 0, 0, all.data(), nullptr) == HM_OK);
        CHECK(std::fabs(all[0] - tiny) <= 0x1p-150);
    }
    for (double const large : {0x1p+128, -1e300}) {
        view.value[0] = large;
        view.seal();
        Single const single(solved.basis);
        CHECK(refused(single.status, single.error));
        CHECK((single.basis == nullptr && single.error.value == std::fabs(large)));
    }
}

TEST_CASE("calls that need the functions in double precision refuse single ones") {
    Case its = two_body_case();
    Solved const solved(its);
    Single const single(solved.basis);
    hm_mesh const mesh = its.mesh_view();
    hm_error error{};
    std::size_t bytes = 0;
    std::int64_t doubles = 0;
    std::int32_t const point = 0;
    CHECK(refused(hm_plan_solve(solved.plan, single.basis, nullptr, &error), error));
    CHECK(refused(hm_single_size(single.basis, &bytes, &error), error));
    Numbers room(100000);
    hm_basis* made = nullptr;
    CHECK(refused(hm_single_init(&made, room.data(), 8 * room.size(), single.basis, &error), error));
    CHECK(refused(hm_parcel_size(single.basis, 1, &doubles, &error), error));
    Numbers parcel(1000);
    CHECK(refused(hm_parcel_pack(single.basis, 1, &point, parcel.data(), &error), error));
    CHECK(refused(hm_parcel_unpack(single.basis, parcel.data(), 1000, &error), error));

    REQUIRE(hm_transfer_size(solved.analysis, &mesh, &bytes, nullptr) == HM_OK);
    std::vector<unsigned char> work(bytes);
    CHECK(refused(hm_transfer(solved.basis, work.data(), bytes, solved.analysis, single.basis, &mesh, nullptr, &error), error));
    CHECK(refused(hm_transfer(single.basis, work.data(), bytes, solved.analysis, solved.basis, &mesh, nullptr, &error), error));

    REQUIRE(hm_morph_safe_size(solved.plan, &bytes, nullptr) == HM_OK);
    work.resize(bytes);
    Numbers const move = some_move(20, 1e-3, 1);
    Numbers x = its.mesh.x, y = its.mesh.y;
    auto const safe = [&](const hm_basis* by, hm_basis* derivative, hm_safe_options const* options) {
        return hm_morph_safe(solved.plan, by, move.data(), x.data(), y.data(), 1, derivative, work.data(), bytes, options,
                             nullptr, &error);
    };
    const hm_basis* const other = single.basis;
    hm_safe_options options{};
    options.struct_size = sizeof options;
    options.n_others = 1;
    options.others = &other;
    CHECK(refused(safe(single.basis, nullptr, nullptr), error));
    CHECK(refused(safe(solved.basis, single.basis, nullptr), error));
    CHECK(refused(safe(solved.basis, nullptr, &options), error));
    CHECK(same_bits(x, its.mesh.x));
    CHECK(morphed(single.basis, its.mesh, move).x != its.mesh.x);   // it has come to no harm
}

TEST_CASE("wrong arguments, shares, bases that are not solved and blocks that are too small are refused") {
    Case its = two_body_case();
    Solved const solved(its);
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
        CHECK(hm_single_init(&made, block.data(), give, solved.basis, &error) == HM_BLOCK_TOO_SMALL);
        CHECK((made == nullptr && block.guards_intact() && error.value == static_cast<double>(need - give)));
    }
    std::size_t bytes = 0;
    REQUIRE(hm_share_size(solved.analysis, 0, 3, &bytes, nullptr) == HM_OK);
    std::vector<unsigned char> block(bytes);
    hm_basis* share = nullptr;
    REQUIRE(hm_share_init(&share, block.data(), bytes, solved.analysis, 0, 3, nullptr) == HM_OK);
    CHECK(hm_single_size(share, &bytes, nullptr) == HM_BAD_BASIS);   // not solved
    REQUIRE(hm_plan_solve(solved.plan, share, nullptr, nullptr) == HM_OK);
    CHECK(hm_single_size(share, &bytes, nullptr) == HM_BAD_BASIS);   // not all functions
    CHECK(hm_single_init(&made, room.data(), need, share, nullptr) == HM_BAD_BASIS);
}
