// The corners of hm_step_gradient, and its derivatives, against the areas of corners.
#include <harmorph_quality.h>
#include "corner_area.hpp"
#include "solution.hpp"

namespace fuzz {
namespace {

void is_corner(hm_step_corner const& found, Problem const& problem, Judged const& judged,
               std::vector<Point> const& along) {
    std::int32_t const base = problem.mesh.index_base;
    std::int32_t const before = found.points[0] - base, here = found.points[1] - base,
                       after = found.points[2] - base;
    bool any = false, is_right = false;
    std::string why;
    for (JudgedCorner const& corner : judged.corners) {
        bool const is_same = corner.before == before && corner.after == after,
                   is_reversed = corner.before == after && corner.after == before;
        if (corner.cell != at(found.cell - base)) continue;
        // A triangle of a divided cell may be listed from any of its corners.
        bool const is_rotated =
            (corner.before == here && corner.here == after && corner.after == before) ||
            (corner.before == after && corner.here == before && corner.after == here) ||
            (corner.after == here && corner.here == before && corner.before == after) ||
            (corner.after == before && corner.here == after && corner.before == here);
        if (!(corner.here == here && (is_same || is_reversed)) && !is_rotated) continue;
        any = true;
        Area const area = area_of(corner, problem.domain.points, along, found.step);
        std::int32_t const own[3] = {corner.before, corner.here, corner.after};
        Wide error = 0, size = 0;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                if (found.points[j] - base != own[i]) continue;
                for (int axis = 0; axis < 2; ++axis) {
                    Wide const expected = -area.by_point[2 * i + axis] / area.rate;
                    error = std::max(error, std::abs(expected - found.by_from[2 * j + axis]));
                    size = std::max(size, std::abs(expected));
                }
            }
        // Where two roots nearly meet, or the sides are long, the root itself is inaccurate.
        Wide const steep = std::abs(area.rate) * found.step;
        Wide const within = 1e-9L + 1e3L * area.rounding / steep;
        is_right = is_right || error <= within * size || within > 1e-3L;
        why = shown(double(error / size));
    }
    expect(any, "a corner that the mesh does not have");
    expect(is_right, "the derivative of a step differs from that of the area by " + why);
}

}  // namespace

void check_step_corners(Solution& solved, Judged const& judged, std::vector<Point> const& along,
                        double step, Input& input) {
    Problem const& problem = solved.problem;
    hm_error error{};
    hm_points const from = in(problem.domain.points), by = in(along);
    std::vector<hm_step_corner> out(at(input.from(1, 6)));
    for (hm_step_corner& corner : out) corner.step = 7;
    double const closeness =
        input.one_in(8) ? input.any_of({double(NAN), -1.0, 1.1}) : input.between(0, 1);
    std::int32_t n = -7;
    hm_status const status = hm_step_gradient(
        solved.basis, &problem.mesh, input.one_in(2) ? &from : nullptr, &by, closeness,
        static_cast<std::int32_t>(out.size()), out.data(), &n, problem.options.executor, &error);
    expect_told(status, error);
    bool const is_legal = closeness >= 0 && closeness <= 1;
    expect(status < 0 || is_legal, "a closeness out of range is taken");
    if (status < 0) {
        expect(!is_legal || status == HM_BAD_MESH,
               std::string("corners of a step are refused: ") + error.text);
        for (hm_step_corner const& corner : out)
            expect(corner.step == 7, "a refused call has written");
        expect(n == -7, "a refused call has written");
        return;
    }
    expect((n > 0) == std::isfinite(step), "a step without corners");
    for (std::size_t k = 0; k < std::min(out.size(), at(n)); ++k) {
        hm_step_corner const& found = out[k];
        expect(k > 0 || std::abs(found.step - step) <= 1e-12 * step,
               "the first corner does not limit the step");
        expect(k == 0 || found.step >= out[k - 1].step, "corners are not in order");
        expect(found.step <= (1 + closeness) * step * (1 + 1e-12), "a corner is not close");
        is_corner(found, problem, judged, along);
    }
}

}  // namespace fuzz
