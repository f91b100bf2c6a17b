#include "work/shared_points.hpp"

#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"

#include <algorithm>

namespace cli {

namespace {

struct Names {
    const hm_basis_info& info;
    const std::vector<hm_condition>& conditions;
    const Mesh& mesh;

    std::string of_condition(std::int32_t number) const {
        if (number < 0 || place(number) >= conditions.size()) return "another marker";
        const std::string name = mesh.name_of(conditions[place(number)]);
        return name.front() == '"' ? name : "'" + name + "'";
    }
    std::string of_point(std::int32_t point) const {
        return "point " + std::to_string(point) + " (" + brief(mesh.x[place(point)]) + ", " +
               brief(mesh.y[place(point)]) + ")";
    }
    // Returns both conditions of the shared point with this number.
    std::string of_both(std::int32_t shared) const {
        const std::int32_t first = info.shared_condition[2 * shared],
                           second = info.shared_condition[2 * shared + 1];
        if (first == second) return "both ends of the curve of " + of_condition(first);
        return of_condition(first) + " and to " + of_condition(second);
    }
    std::string remedy(std::int32_t shared) const {
        const auto is_rigid = [&](std::int32_t number) {
            return number >= 0 && conditions[place(number)].kind == HM_RIGID;
        };
        const std::int32_t* const both = info.shared_condition + 2 * shared;
        if (both[0] == both[1]) return "fit a tied curve, the ends of which are one control point";
        if (is_rigid(both[0]) && is_rigid(both[1])) return "make both markers one body";
        return "fit one curve through both markers (--marker A,B), or give the curves a common "
               "control point";
    }
};

}  // namespace

void warn_of_shared_points(const hm_basis_info& info, const std::vector<hm_condition>& conditions,
                           const Mesh& mesh) {
    constexpr std::int32_t max_told = 4;
    const Names names = {info, conditions, mesh};
    for (std::int32_t k = 0; k < std::min(info.shared_points, max_told); ++k) {
        warn(names.of_point(info.shared_point[k]) + " belongs to " + names.of_both(k) +
             ", which do not move it alike; a movement that takes them apart is refused: " +
             names.remedy(k));
    }
    if (info.shared_points > max_told) {
        warn(plural(info.shared_points - max_told, "more point") +
             " belong to two conditions that do not move them alike");
    }
}

std::string why_torn(const hm_basis_info& info, const std::vector<hm_condition>& conditions,
                     const Mesh& mesh, std::int32_t point, std::int32_t second, double distance) {
    const Names names = {info, conditions, mesh};
    for (std::int32_t k = 0; k < info.shared_points; ++k) {
        if (info.shared_point[k] != point || info.shared_condition[2 * k + 1] != second) continue;
        return "the movement tears the wall apart: " + names.of_point(point) + " belongs to " +
               names.of_both(k) + ", which would be " + brief(distance) + " apart there; " +
               names.remedy(k);
    }
    return "the movement tears the wall apart at " + names.of_point(point);
}

}  // namespace cli
