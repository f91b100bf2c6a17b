// Displacements that are given at points of the wall: fields, their transpose, modes as functions
// of a second basis, and the safe way. Lists of points, fields and memory are right or wrong; what
// succeeds has the given bits at the wall, is linear, and is the transpose of the transpose.
#include <harmorph_bases.h>
#include "describe.hpp"
#include <fixtures/memory.hpp>
#include "exceptions.hpp"
#include "reference.hpp"
#include "solution.hpp"
#include "target.hpp"

#include <cmath>

namespace fuzz {
namespace {

using Numbers = std::vector<double>;

struct Field {
    Numbers x, y;
    explicit Field(std::size_t n, double value = 0) : x(n, value), y(n, value) {}
    hm_points in() const { return {x.data(), y.data(), 1}; }
    hm_points_out out() { return {x.data(), y.data(), 1}; }
    double largest() const {
        double most = 0;
        for (double const value : x) most = std::max(most, std::abs(value));
        for (double const value : y) most = std::max(most, std::abs(value));
        return most;
    }
    bool operator==(Field const& other) const { return x == other.x && y == other.y; }
};

// The walls move by given displacements: all of them, or some.
void give_walls(Problem& problem, Input& input) {
    bool const all = !input.one_in(3);
    bool any_curve = false;
    for (hm_condition& condition : problem.conditions) {
        bool const moves = condition.kind == HM_ON_CURVE || condition.kind == HM_RIGID;
        if (moves && (all || input.one_in(2))) {
            hm_condition given{};
            given.struct_size = sizeof given;
            given.marker = condition.marker;
            given.kind = HM_GIVEN;
            condition = given;
        }
        any_curve = any_curve || condition.kind == HM_ON_CURVE;
    }
    if (!any_curve) problem.problem.curves = nullptr;
}

class Given {
public:
    Given(Solution& solution, Input& input)
        : its_(solution), input_(input), n_(solution.problem.domain.points.size()) {
        std::int32_t n = 0;
        hm_status status = hm_given_points(its_.plan, nullptr, 0, &n, &error_);
        expect(n >= 0 && status == (n > 0 ? HM_BAD_ARGUMENT : HM_OK), "the number of given points");
        points_.resize(at(n));
        expect(hm_given_points(its_.plan, points_.data(), n, &n, &error_) == HM_OK,
               "no given points");
        is_direct_ = its_.problem.options.engine == HM_DIRECT;
    }

    Outcome run() {
        if (points_.empty()) return Outcome::refused;
        shuffle();
        if (input_.one_in(4)) return broken();
        Field wall(points_.size());
        double const far = its_.problem.size() * input_.any_of({1e-6, 0.01, 1.0});
        for (std::size_t k = 0; k < points_.size(); ++k)
            wall.x[k] = far * input_.between(-1, 1), wall.y[k] = far * input_.between(-1, 1);
        Field moved(n_, 7);
        hm_status const status = displace(wall, moved);
        if (status < 0) return Outcome::refused;
        is_direct_ = is_direct_ && status == HM_OK;
        wall_has(wall, moved);
        linear(wall, moved);
        if (is_direct_ && its_.status == HM_OK) transpose(wall, moved);
        if (input_.one_in(3)) tabulated(wall);
        if (input_.one_in(3)) safe(wall);
        its_.blocks.expect_intact();
        return Outcome::done;
    }

private:
    void shuffle() {
        if (input_.one_in(2)) {
            for (std::size_t k = points_.size(); k > 1; --k)
                std::swap(points_[k - 1], points_[input_.below(static_cast<std::uint32_t>(k))]);
        }
    }
    std::size_t place(std::size_t k) const { return at(points_[k] - its_.problem.mesh.index_base); }
    std::int32_t count() const { return static_cast<std::int32_t>(points_.size()); }

    hm_status displace(Field const& wall, Field& to) {
        hm_points const given = wall.in();
        hm_points_out const out = to.out();
        Exceptions::clear();
        hm_status const status = its_.blocks.make(
            error_, size_by(fixtures::displace_size, its_.plan, 1),
            [&](void* memory, std::size_t bytes, hm_error* e) {
                return hm_displace(its_.plan, count(), points_.data(), 1, &given, nullptr, &out,
                                   fixtures::Memory(memory, bytes), nullptr, e);
            });
        if (status < 0) expect(to == Field(n_, 7), "a refused displacement has written");
        else Exceptions::expect_none("hm_displace");
        return status;
    }

    void wall_has(Field const& wall, Field const& moved) const {
        for (std::size_t k = 0; k < points_.size(); ++k) {
            expect(moved.x[place(k)] == wall.x[k], "a point of the wall has other bits");
            expect(moved.y[place(k)] == wall.y[k], "a point of the wall has other bits");
        }
        for (std::size_t k = 0; k < n_; ++k)
            expect(std::isfinite(moved.x[k]) && std::isfinite(moved.y[k]),
                   "a displacement is not finite");
    }

    // Two further fields are three times the first one, and zero.
    void linear(Field const& wall, Field const& moved) {
        Field farther = wall;
        for (std::size_t k = 0; k < points_.size(); ++k) farther.x[k] *= 3, farther.y[k] *= 3;
        Field three(n_, 7), none(n_, 7);
        if (displace(farther, three) == HM_OK && is_direct_ && its_.status == HM_OK) {
            double const size = std::max(moved.largest(), wall.largest());
            for (std::size_t k = 0; k < n_; ++k) {
                expect(std::abs(three.x[k] - 3 * moved.x[k]) <= 1e-7 * size,
                       "displacements are not linear");
                expect(std::abs(three.y[k] - 3 * moved.y[k]) <= 1e-7 * size,
                       "displacements are not linear");
            }
        }
        if (displace(Field(points_.size()), none) >= 0)
            for (std::size_t k = 0; k < n_; ++k)
                expect(none.x[k] == 0 && none.y[k] == 0, "moved by nothing");
    }

    // <g, displacement> = <gradient, wall>.
    void transpose(Field const& wall, Field const& moved) {
        Field g(n_), gradient(points_.size(), 7);
        for (std::size_t k = 0; k < n_; ++k)
            g.x[k] = input_.between(-1, 1), g.y[k] = input_.between(-1, 1);
        hm_points const dj = g.in();
        hm_points_out const out = gradient.out();
        std::size_t bytes = 0;
        expect(fixtures::displace_size(its_.plan, 1, &bytes, &error_) == HM_OK, "no size");
        hm_status const status = hm_displace_adjoint(
            its_.plan, count(), points_.data(), 1, &dj, &out,
            fixtures::Memory(its_.blocks.take(bytes).data(), bytes), nullptr, &error_);
        expect_told(status, error_);
        if (status != HM_OK) return;
        Wide left = 0, right = 0, size = 0;
        for (std::size_t k = 0; k < n_; ++k) {
            left += Wide(g.x[k]) * moved.x[k] + Wide(g.y[k]) * moved.y[k];
            size += std::abs(Wide(g.x[k]) * moved.x[k]) + std::abs(Wide(g.y[k]) * moved.y[k]);
        }
        for (std::size_t k = 0; k < points_.size(); ++k) {
            right += Wide(gradient.x[k]) * wall.x[k] + Wide(gradient.y[k]) * wall.y[k];
            size += std::abs(Wide(gradient.x[k]) * wall.x[k]) +
                    std::abs(Wide(gradient.y[k]) * wall.y[k]);
        }
        expect(
            std::abs(left - right) <= 1e-7L * size,
            "the adjoint is not the transpose: " + std::to_string(double((left - right) / size)));
    }

    // A mode as a function: its amplitude moves the points as the field does.
    void tabulated(Field const& wall) {
        Field one = wall, moved(n_, 7), by_mode(n_, 7);
        std::fill(one.y.begin(), one.y.end(), 0.0);
        auto modes = sized<hm_modes>();
        modes.n_modes = modes.numbers = 1;
        modes.n = count();
        modes.points = points_.data();
        modes.values = one.x.data();
        std::size_t bytes = 0;
        hm_status status = fixtures::tabulate_size(its_.plan, its_.basis, &modes, &bytes, &error_);
        expect_told(status, error_);
        if (status < 0) return;
        hm_basis* all = nullptr;
        Block& memory = its_.blocks.take(bytes);
        auto const tabulate = [&](std::size_t room) {
            return hm_tabulate(&all, fixtures::Memory(memory.data(), room), its_.plan, its_.basis,
                               &modes, nullptr, &error_);
        };
        expect(tabulate(bytes - 1) < 0, "a block that is one byte too small is taken");
        status = tabulate(bytes);
        expect_told(status, error_);
        if (status < 0 || displace(one, moved) < 0) return;
        Numbers move(2 * at(info_of(all).functions));
        move[move.size() - 2] = 1;
        hm_points_out const out = by_mode.out();
        expect(hm_morph(all, move.data(), nullptr, &out, nullptr, &error_) == HM_OK,
               "no displacement by a mode");
        if (!is_direct_ || status != HM_OK || its_.status != HM_OK) return;
        double const size = std::max(moved.largest(), one.largest());
        for (std::size_t k = 0; k < n_; ++k) {
            expect(std::abs(by_mode.x[k] - moved.x[k]) <= 1e-7 * size,
                   "a mode moves otherwise than its field");
            expect(std::abs(by_mode.y[k] - moved.y[k]) <= 1e-7 * size,
                   "a mode moves otherwise than its field");
        }
    }

    void safe(Field const& wall) {
        Field moved(n_, 7);
        hm_points const given = wall.in();
        hm_points_out const out = moved.out();
        hm_safe_options options = sized<hm_safe_options>();
        options.max_resolves = input_.from(-1, 2);
        hm_status const status =
            its_.blocks.make(error_, size_by(fixtures::safe_displace_size, its_.plan, its_.basis),
                             [&](void* memory, std::size_t bytes, hm_error* e) {
                                 return fixtures::safe_displace(
                                     its_.plan, its_.basis, nullptr, count(), points_.data(),
                                     &given, &out, memory, bytes, &options, nullptr, e);
                             });
        if (status < 0) {
            expect(moved == Field(n_, 7), "a refused displacement has written");
            return;
        }
        std::vector<Point> at;
        for (std::size_t k = 0; k < n_; ++k) at.push_back({moved.x[k], moved.y[k]});
        expect(inverted_cells(judge_by_header(its_.problem.domain), at) == 0,
               "a safe displacement has inverted cells");
    }

    // One thing about the call is wrong.
    Outcome broken() {
        Field wall(points_.size() + 3), to(n_, 7);
        std::vector<std::int32_t> list = points_;
        list.resize(list.size() + 3, points_[0]);
        std::int32_t n = count(), fields = 1;
        std::size_t bytes = 0;
        expect(fixtures::displace_size(its_.plan, 1, &bytes, &error_) == HM_OK, "no size");
        hm_points given = wall.in();
        hm_points_out out = to.out();
        std::int32_t const what = input_.from(0, 8);
        switch (what) {
            case 0:
                wall.x[input_.below(static_cast<std::uint32_t>(count()))] = input_.wild();
                break;
            case 1:
                list[input_.below(static_cast<std::uint32_t>(count()))] = input_.wild_index();
                break;
            case 2: n = input_.any_of({-1, 0, count() - 1, count() + 1, count() + 3}); break;
            case 3: fields = input_.any_of({-1, 0, 1 << 21}); break;
            case 4: bytes = input_.below(static_cast<std::uint32_t>(bytes)); break;
            case 5: given.stride = -1; break;
            case 6: out.stride = -2; break;
            case 7: given.y = nullptr; break;
            default: out.x = nullptr;
        }
        hm_status const status =
            hm_displace(its_.plan, n, list.data(), fields, &given, nullptr, &out,
                        fixtures::Memory(its_.blocks.take(bytes).data(), bytes), nullptr, &error_);
        expect_told(status, error_);
        if (what >= 3) expect(status < 0, "a wrong argument is taken");
        if (status < 0) expect(to == Field(n_, 7), "a refused displacement has written");
        its_.blocks.expect_intact();
        return status < 0 ? Outcome::refused : Outcome::done;
    }

    Solution& its_;
    Input& input_;
    std::size_t n_;
    std::vector<std::int32_t> points_;
    hm_error error_{};
    bool is_direct_;
};

}  // namespace

Outcome run_given(Input& input) {
    std::unique_ptr<Problem> const problem = make_problem(input);
    give_walls(*problem, input);
    if (input.one_in(4)) break_something(*problem, input);
    Solution solution(*problem, input);
    if (solution.status < 0) return Outcome::refused;
    return told(*problem, [&] { return Given(solution, input).run(); });
}

}  // namespace fuzz
