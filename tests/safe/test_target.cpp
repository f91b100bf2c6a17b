// Decides from the boundary alone whether there can be a mesh at the target.
#include <fixtures/core.hpp>
#include <fixtures/operators.hpp>

#include "safe/target.hpp"

using namespace fixtures;
using harmorph::Crossing;
using harmorph::Fault;
using harmorph::Index;
using harmorph::KnownEnd;
using harmorph::Status;

namespace {

// The target positions of the boundary of a case; inner points stay, and their target is not known.
struct Aim {
    explicit Aim(Case wanted)
        : setup(wanted), attempt(setup.problem()), x(setup.mesh.x), y(setup.mesh.y) {
        REQUIRE(attempt.status == HM_OK);
        harmorph::Analysis const& analysis = inside(attempt.analysis);
        for (Index k = 0; k < Index(x.size()); ++k) {
            bool const is_inner = analysis.kinds()[k] == harmorph::PointKind::inside;
            ends.push_back(is_inner ? KnownEnd::unknown : KnownEnd::prescribed);
        }
    }
    template <class Map>
    void map(std::int32_t marker, Map const& map_point) {
        for (std::int32_t const point : points_on(setup.mesh, marker)) {
            Complex const z = map_point(to_complex(setup.mesh.point(point)));
            x[std::size_t(point)] = z.real();
            y[std::size_t(point)] = z.imag();
        }
    }
    Status check() {
        harmorph::Analysis const& analysis = inside(attempt.analysis);
        harmorph::Boundary const& boundary = analysis.boundary();
        harmorph::Points const start{setup.mesh.x.data(), setup.mesh.y.data(), 1},
            at_target{x.data(), y.data(), 1};
        fault = {};
        crossing = {};
        return harmorph::check_target({analysis.topology(),
                                       {boundary.point.first(boundary.count),
                                        boundary.loop_start.first(boundary.n_loops + 1)},
                                       span(ends),
                                       start,
                                       at_target},
                                      crossing, fault);
    }
    bool says(const char* words) const {
        return std::string(fault.sentence).find(words) != std::string::npos;
    }

    Case setup;
    Attempt attempt;
    std::vector<double> x, y;
    std::vector<KnownEnd> ends;
    Crossing crossing;
    Fault fault;
};

}  // namespace

TEST_CASE("the start is possible, and so are holes that turn, grow and move without contact") {
    Aim aim(tiny_case());  // a hole [2, 4] x [2, 4] in [0, 6] x [0, 6]
    CHECK(aim.check() == Status::ok);
    aim.map(body, [](Complex z) {
        return Complex(3.1, 2.8) + 1.3 * std::polar(1.0, 0.6) * (z - Complex(3, 3));
    });
    CHECK(aim.check() == Status::ok);
    CHECK(!aim.crossing.found);
}

TEST_CASE("faces that cross are named with the place") {
    Aim aim(tiny_case());
    aim.map(body, [](Complex z) { return z + 3.0; });  // half of it beyond the right side
    CHECK(aim.check() == Status::crossing);
    CHECK(aim.says("crosses itself"));
    CHECK(aim.crossing.found);
    CHECK(aim.fault.item.number == aim.crossing.first[0]);
    CHECK(aim.fault.other.number == aim.crossing.second[0]);
    CHECK(aim.fault.place[0] == aim.x[std::size_t(aim.fault.item.number)]);
    CHECK(aim.fault.place[1] == aim.y[std::size_t(aim.fault.item.number)]);
}

TEST_CASE("a target outside, inside out or within another body is impossible without crossing") {
    Aim outside(tiny_case());
    outside.map(body, [](Complex z) { return z + 10.0; });
    CHECK(outside.check() == Status::crossing);
    CHECK(outside.says("is outside the boundary"));
    CHECK(!outside.crossing.found);

    Aim reflected(tiny_case());
    reflected.map(body,
                  [](Complex z) { return Complex(3, 3) + 0.9 * std::conj(z - Complex(3, 3)); });
    CHECK(reflected.check() == Status::crossing);
    CHECK(reflected.says("inside out"));

    Aim two(two_body_case(Cells::quads, 16, 10));
    Complex centre = 0, other = 0;
    std::vector<std::int32_t> const first = points_on(two.setup.mesh, body),
                                    second = points_on(two.setup.mesh, second_body);
    for (std::int32_t const k : first)
        centre += to_complex(two.setup.mesh.point(k)) / double(first.size());
    for (std::int32_t const k : second)
        other += to_complex(two.setup.mesh.point(k)) / double(second.size());
    two.map(second_body, [&](Complex z) { return centre + 0.1 * (z - other); });
    CHECK(two.check() == Status::crossing);
    CHECK(two.says("is inside the one"));
}

TEST_CASE("a corner with three prescribed points may be inverted though no face crosses") {
    Aim aim(tiny_case());
    REQUIRE(aim.check() == Status::ok);
    aim.x[0] = aim.y[0] =
        0.9;  // the corner of the domain, beyond the line through its neighbours (1, 0) and (0, 1)
    CHECK(aim.check() == Status::crossing);
    CHECK(aim.says("is inverted by its points on the boundary"));
    CHECK(aim.fault.other.number == 0);
    CHECK(!aim.crossing.found);
}

TEST_CASE("nothing is reported about points whose target is not known") {
    Aim aim(tiny_case());
    aim.map(body, [](Complex z) { return z + 3.0; });
    for (std::int32_t const k : points_on(aim.setup.mesh, body))
        aim.ends[std::size_t(k)] = KnownEnd::unknown;
    CHECK(aim.check() == Status::ok);
    aim.map(body, [](Complex z) { return z + 10.0; });
    CHECK(aim.check() == Status::ok);
}
