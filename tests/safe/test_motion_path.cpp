// The way of the control points in several steps: similarities on the way, exact at its end, and
// its derivative.
#include <fixtures/channels.hpp>
#include <fixtures/core.hpp>
#include <fixtures/operators.hpp>
#include <fixtures/guarded.hpp>

#include "safe/motion_path.hpp"

using namespace fixtures;
using harmorph::Index;
using harmorph::MovementPath;
using harmorph::Vec2;

namespace {

Complex number(Vec2 z) { return {z.x, z.y}; }
Vec2 vec(Complex z) { return {z.real(), z.imag()}; }

class Path {
public:
    Path(Solved const& solved, std::vector<double> const& move) : n_(solved.info().functions) {
        REQUIRE(move.size() == 2 * std::size_t(n_));
        harmorph::Basis const basis = harmorph::Basis::view(static_cast<const void*>(solved.basis));
        block_ = laid_out_part(path, basis.header->counts);
        path.init(basis, move.data());
        CHECK(block_->guards_intact());
    }
    // Movements at t, as complex numbers.
    Field at(double t) const {
        std::vector<double> movement(2 * std::size_t(n_), -9.0);
        path.at(t, span(movement));
        Field out;
        for (std::size_t k = 0; k < movement.size(); k += 2)
            out.push_back({movement[k], movement[k + 1]});
        return out;
    }
    std::vector<double> numbers_at(double t) const {
        std::vector<double> out;
        for (Complex const z : at(t)) out.insert(out.end(), {z.real(), z.imag()});
        return out;
    }
    MovementPath path;

private:
    Index n_;
    std::unique_ptr<Guarded> block_;
};

Options const conformal = options_of(HM_CONFORMAL);

}  // namespace

TEST_CASE("powers r^t by square roots go along the shorter way round 0") {
    for (double const size : {0.05, 1.0, 1e-8, 1e8, 3.7})
        for (double const angle : {0.0, 0.1, 1.5, 3.1, -3.1, -0.7, pi / 2})
            for (double const t : {0.0, 1e-3, 0.1, 0.25, 1 / 3.0, 0.5, 0.75, 0.99, 1.0}) {
                Complex const r = std::polar(size, angle),
                              expected = std::polar(std::pow(size, t), t * angle);
                CHECK(std::abs(number(complex_power(vec(r), t)) - expected) <
                      1e-10 * std::abs(expected));
            }
    CHECK(std::abs(number(harmorph::complex_power({-1, 0}, 0.5)) - Complex(0, 1)) <
          1e-15);  // both ways are as short
    CHECK(std::abs(number(harmorph::complex_power({-1, -0.0}, 0.25)) - std::polar(1.0, pi / 4)) <
          1e-14);
}

TEST_CASE("the path begins with zero, ends with the bits of the target, and is continuous") {
    Case setup = two_body_case(Cells::quads, 4, 3);
    Solved const solved(setup, &conformal);
    std::vector<double> const move = some_move(20, 0.5, 3);
    Path const path(solved, move);
    CHECK(same_bits(path.numbers_at(1), move));
    CHECK(same_bits(path.numbers_at(1.5), move));
    for (Complex const z : path.at(0)) CHECK(std::abs(z) < 1e-15);
    CHECK(largest_difference(path.at(1), path.at(1 - 1e-9)) < 1e-7);
    for (double t = 0; t < 1; t += 0.05)
        CHECK(largest_difference(path.at(t), path.at(t + 1e-7)) < 1e-6);
}

TEST_CASE("a similarity proceeds at an even rate: half of the way is half of the angle") {
    Case setup = ring_case(4, 16, 0.5, 2);
    Solved const solved(setup, &conformal);
    for (double const angle : {0.5, 3.1, -2.0})
        for (double const scale : {1.0, 2.0, 0.3}) {
            Complex const s = std::polar(scale, angle), shift(0.4, -0.9);
            Path const path(solved, similarity_move(setup.curves, s, {0, 0},
                                                    shift));  // about the middle of the points
            for (double const t : {0.25, 0.5, 0.9}) {
                std::vector<double> const expected = similarity_move(
                    setup.curves, std::polar(std::pow(scale, t), t * angle), {0, 0}, t * shift);
                std::vector<double> const found = path.numbers_at(t);
                CHECK(largest_difference(found, expected) < 1e-11);
            }
        }
    Path const half(solved, similarity_move(setup.curves, std::polar(1.0, pi * (1 - 1e-12))));
    CHECK(largest_difference(half.numbers_at(0.5), similarity_move(setup.curves, {0, 1})) < 1e-11);
}

TEST_CASE("a translation, a body that collapses, and functions with real values go straight") {
    Case setup = ring_case(4, 16, 0.5, 2);
    Solved const with_complex(setup, &conformal), with_real(setup);
    for (Complex const s : {Complex(1, 0), Complex(0, 0), Complex(0.01, 0.02), Complex(-1, 1)}) {
        std::vector<double> const move = similarity_move(setup.curves, s, 0, {2, 3});
        Path const path(s.real() < 0 ? with_real : with_complex, move);
        for (double const t : {0.1, 0.5, 0.8}) {
            std::vector<double> expected;
            for (double const m : move) expected.push_back(t * m);
            CHECK(largest_difference(path.numbers_at(t), expected) < 1e-14);
        }
        for (Index i = 0; i < 8; ++i)
            CHECK(std::abs(number(path.path.weight(i, 0.3)) - 0.3) < 1e-15);
    }
}

TEST_CASE("each body has its own similarity, and curves that share control points are one body") {
    Case setup = two_body_case(Cells::quads, 4, 3);
    Solved const solved(setup, &conformal);
    Complex const a = std::polar(1.0, 2.0), b = std::polar(0.7, -1.0), middle_a(0.5, 0.5),
                  middle_b(1.5, 0.5);
    auto const move_of = [&](Complex by_a, Complex by_b) {
        std::vector<double> out;
        for (std::size_t k = 0; k < setup.curves.control.size(); k += 2) {
            Complex const z(setup.curves.control[k], setup.curves.control[k + 1]);
            Complex const d =
                k < 22 ? (by_a - 1.0) * (z - middle_a) : (by_b - 1.0) * (z - middle_b);
            out.insert(out.end(), {d.real(), d.imag()});
        }
        return out;
    };
    Path const two(solved, move_of(a, b));
    CHECK(largest_difference(two.numbers_at(0.5),
                             move_of(std::polar(1.0, 1.0), std::polar(std::sqrt(0.7), -0.5))) <
          1e-12);

    Case tiny =
        tiny_case();  // the hole's sides as two curves with common ends, named in either order
    for (bool const first_low : {false, true}) {
        tiny.curves = CurveSet{};
        tiny.curves.control = {2, 2, 4, 2, 4, 4, 2, 4};
        if (first_low) tiny.curves.add_over(1, {0, 1}, {0, 0, 1, 1});
        tiny.curves.add_over(1, {1, 2, 3, 0}, {0, 0, 1, 2, 3, 3});
        if (!first_low) tiny.curves.add_over(1, {0, 1}, {0, 0, 1, 1});
        tiny.conditions.clear();
        tiny.put_on_curves(body, 0, 2);
        Solved const one(tiny, &conformal);
        Path const path(one, similarity_move(tiny.curves, std::polar(1.0, 1.0), {3, 3}));
        CHECK(largest_difference(path.numbers_at(0.5),
                                 similarity_move(tiny.curves, std::polar(1.0, 0.5), {3, 3})) <
              1e-12);
    }

    Case rigid = two_body_case(Cells::quads, 4, 3);
    rigid.conditions.pop_back();
    rigid.set_rigid(second_body, 1.5, 0.5);
    Solved const with_flap(rigid, &conformal);
    std::vector<double> move(44, 0.0);
    move[40] = 0.2;
    move[42] = b.real() - 1;
    move[43] = b.imag();
    Path const flap(with_flap, move);
    Field const middle = flap.at(0.5);
    CHECK(std::abs(middle[20] - 0.1) < 1e-15);
    CHECK(std::abs(middle[21] - (std::polar(std::sqrt(0.7), -0.5) - 1.0)) < 1e-12);
    move[42] = -1;  // shrunk to nothing: straight, and all numbers finite
    move[43] = 0;
    Path const vanishing(with_flap, move);
    CHECK(std::abs(vanishing.at(0.25)[21] + 0.25) < 1e-15);
    CHECK(number(vanishing.path.weight(21, 0.5)) == 0.5);
}

TEST_CASE("a wall that ends on another boundary goes straight, and held points stay to the bit") {
    Case setup = channel(6, 4, 0.1, 6);
    Solved const solved(setup, &conformal);
    std::vector<double> move = some_move(6, 0.2, 8);
    move[0] = move[1] = move[10] = move[11] = 0;
    Path const path(solved, move);
    CHECK_FALSE(path.path.is_bent());
    for (double const t : {0.2, 0.7}) {
        Field const at = path.at(t);
        for (std::size_t k = 0; k < at.size(); ++k)
            CHECK(at[k] == t * Complex(move[2 * k], move[2 * k + 1]));
    }
}

TEST_CASE("curves round one body turn as one, though they share no control point") {
    Case setup = tiny_case();
    setup.curves = CurveSet{};
    setup.curves.control = {2, 2, 4, 2, 4, 2, 4, 4, 2, 4, 2, 2};
    setup.curves.add_over(1, {0, 1}, {0, 0, 1, 1});
    setup.curves.add_over(1, {2, 3, 4, 5}, {0, 0, 1, 2, 3, 3});
    setup.conditions.clear();
    setup.put_on_curves(body, 0, 2);
    Solved const solved(setup, &conformal);
    std::vector<double> move = similarity_move(setup.curves, std::polar(1.0, 1.0), {3, 3});
    Path path(solved, move);
    CHECK(path.path.is_bent());
    Field const half = path.at(0.5);
    auto const at = [&](std::size_t k) {
        return Complex(setup.curves.control[2 * k], setup.curves.control[2 * k + 1]);
    };
    for (std::size_t k = 1; k < 6; ++k) {  // turned by half as much, wherever its middle is then
        Complex const before = at(k) - at(0), now = before + half[k] - half[0];
        CHECK(std::abs(now - std::polar(1.0, 0.5) * before) < 1e-12);
    }
    path.path.straighten(harmorph::Basis::view(static_cast<const void*>(solved.basis)));
    CHECK_FALSE(path.path.is_bent());
    for (double& number : move) number *= 0.5;
    CHECK(largest_difference(path.numbers_at(0.5), move) < 1e-15);
}

TEST_CASE("weights are the derivative by the target with the similarities held") {
    Case setup = two_body_case(Cells::quads, 4, 3);
    Solved const solved(setup, &conformal);
    std::vector<double> move =
        similarity_move(setup.curves, std::polar(1.2, 1.3), {0.7, 0.1}, {0.2, 0});
    std::vector<double> const extra = some_move(20, 0.05, 5);
    for (std::size_t k = 0; k < move.size(); ++k) move[k] += extra[k];
    Path const path(solved, move);
    for (double const t : {0.2, 0.6, 0.95}) {
        Field const before = path.at(t);
        for (Index i = 0; i < 20; ++i) {
            Complex const by(0.06, 0.08);  // the way is affine in it
            // The same similarities with a changed target: only D_i changes, by dP_i / r.
            MovementPath changed = path.path;
            std::vector<Vec2> drift(20);
            for (Index k = 0; k < 20; ++k) drift[std::size_t(k)] = path.path.drift[k];
            Vec2 const ratio = path.path.groups[path.path.group_of[i]].ratio;
            drift[std::size_t(i)] = vec(number(drift[std::size_t(i)]) + by / number(ratio));
            changed.drift = span(drift);
            std::vector<double> moved(40);
            changed.at(t, span(moved));
            std::size_t const from_place = std::size_t(i);
            Complex const found =
                (Complex(moved[2 * from_place], moved[2 * from_place + 1]) - before[from_place]) /
                by;
            CHECK(std::abs(found - number(path.path.weight(i, t))) < 1e-13);
        }
    }
    for (Index i = 0; i < 20; ++i) {
        CHECK(number(path.path.weight(i, 0)) == 0.0);
        CHECK(std::abs(number(path.path.weight(i, 1)) - 1.0) <
              1e-15);  // the steps' weights sum up to 1
    }
}

TEST_CASE("the middle of the way of a polygon turns its sides by half, and bends nothing else") {
    std::vector<Vec2> from, to, bulge(48);
    auto const find = [&](auto const& target) {
        from.clear();
        to.clear();
        for (int k = 0; k < 48; ++k) {
            // a thin wedge from x = 0 to 1: 20 sides below, 20 above, 8 at its base
            double const s = k < 20 ? k / 20.0 : k < 40 ? (40 - k) / 20.0 : 0;
            double const y = k < 20 ? -1 : k < 40 ? 1 : 1 - (k - 40) / 4.0;
            Complex const p(s, 0.01 * (1 - s) * y);
            from.push_back(vec(p));
            to.push_back(vec(target(p)));
        }
        find_bulge(span(from), span(to), span(bulge));
        double largest = 0;
        for (Vec2 const& b : bulge) largest = std::max(largest, std::abs(number(b)));
        return largest;
    };
    CHECK(find([](Complex p) { return p; }) < 1e-15);
    CHECK(find([](Complex p) { return p + Complex(3, -2); }) < 1e-12);
    // a stretched polygon goes straight, as no side turns
    CHECK(find([](Complex p) { return 4.0 * p; }) < 1e-12);
    for (double const angle : {-120.0, -90.0, 60.0, 120.0}) {
        Complex const turn = std::polar(1.0, angle * pi / 180), half = std::sqrt(turn);
        double const largest = find([&](Complex p) {
            return p.real() < 0.5 ? p : 0.5 + (p - 0.5) * turn;  // a hinge at x = .5
        });
        CHECK(largest > 0.05);
        for (int k = 0; k < 48; ++k) {
            int const next = (k + 1) % 48;
            bool const turns = number(from[k]).real() >= 0.5 && number(from[next]).real() >= 0.5;
            bool const stays = number(from[k]).real() < 0.5 && number(from[next]).real() < 0.5;
            if (!turns && !stays) continue;
            auto const middle = [&](int i) {
                return 0.5 * (number(from[i]) + number(to[i])) + number(bulge[i]);
            };
            Complex const side = number(from[next]) - number(from[k]);
            Complex const wanted = turns ? side * half : side;
            double const error = std::abs(middle(next) - middle(k) - wanted);
            CHECK(error < (turns ? 0.05 : 1e-12) * std::abs(side));
        }
    }
}
