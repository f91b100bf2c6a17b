// Checks the lists of points with given displacements, which several calls have as arguments.
#pragma once

#include "handles.hpp"
#include "morph/displacement.hpp"

namespace harmorph {

inline Status require_given_points(Plan const& plan, Fault& fault) noexcept {
    if (!plan.given().point.empty()) return Status::ok;
    return fault.refuse(Status::bad_condition,
                        "no marker has the condition HM_GIVEN, so no displacements can be given");
}

// If points is NULL, the list is that of hm_given_points.
inline Status view_given_list(Plan const& plan, Index n, const Index* points, PointList& list,
                              Fault& fault) noexcept {
    HARMORPH_TRY(PointList::check_length(n, fault));
    Index const n_given = plan.given().point.count();
    if (points == nullptr && n != n_given) {
        return fault.refuse(Status::bad_argument,
                            "n is #, but @ points have given displacements; where `points` is "
                            "NULL, n must be their number",
                            plain(n), plain(n_given));
    }
    list = {0, plan.given().point};
    if (points != nullptr) list = {plan.mesh().index_base, {points, static_cast<Size>(n)}};
    return list.check(plan.mesh().n_points, fault);
}

}  // namespace harmorph
