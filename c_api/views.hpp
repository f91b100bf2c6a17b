// Converts the caller's structs into views of the core, and reports of the core into the caller's
// structs.
#pragma once

#include <cstring>

#include "call.hpp"
#include "base/executor.hpp"
#include "bspline/bspline.hpp"
#include "bspline/fit.hpp"
#include "plan/analysis.hpp"

namespace harmorph {

// Tells whether the caller has set the size. The size must be a multiple of the alignment, so that
// the next struct of an array is aligned, too.
template <class T>
bool has_size(T const& given) noexcept {
    constexpr std::uint64_t largest_ever = 4096;
    return given.struct_size >= sizeof given.struct_size && given.struct_size <= largest_ever &&
           given.struct_size % alignof(T) == 0;
}

// Reads a caller's struct of any version: fields that the struct does not have are 0. Returns false
// if the size of the struct was never set.
template <class T>
bool read_struct(const T* given, T& out) noexcept {
    out = T{};
    if (!has_size(*given)) return false;
    std::memcpy(static_cast<void*>(&out), given,
                min<Size>(static_cast<Size>(given->struct_size), sizeof(T)));
    return true;
}

// Tells whether a caller with a newer header has set fields that this library does not know.
template <class T>
bool asks_for_more(const T* given) noexcept {
    const unsigned char* const bytes = reinterpret_cast<const unsigned char*>(given);
    for (Size k = sizeof(T); k < given->struct_size; ++k) {
        if (bytes[k] != 0) return true;
    }
    return false;
}

// Checks a report or another struct that the call writes; `name` is the name of the argument in the
// header. The caller must have set the size of the struct.
template <class T>
Status check_report(const T* to, const char* name, Fault& fault) noexcept {
    if (to == nullptr) return fault.refuse_argument(name, "% is NULL");
    if (has_size(*to)) return Status::ok;
    return fault.refuse_argument(name,
                                 "%.struct_size is not the size of the struct; begin with "
                                 "HM_INIT(%)");
}

// Does the same for a report that may be NULL, because the caller does not want the report.
template <class T>
Status check_report_if(const T* to, const char* name, Fault& fault) noexcept {
    return to == nullptr ? Status::ok : check_report(to, name, fault);
}

template <class T>
void write_struct(T filled, T* to) noexcept {
    filled.struct_size = to->struct_size;
    std::memcpy(static_cast<void*>(to), &filled,
                min<Size>(static_cast<Size>(to->struct_size), sizeof(T)));
}

// Returns element i of an array of structs. The first struct contains the size of all.
template <class T>
const T* element(const T* array, Index i) noexcept {
    const unsigned char* const bytes = reinterpret_cast<const unsigned char*>(array);
    return reinterpret_cast<const T*>(bytes +
                                      static_cast<Size>(i) * static_cast<Size>(array->struct_size));
}

template <class T>
T* element(T* array, Index i) noexcept {
    return const_cast<T*>(element(static_cast<const T*>(array), i));
}

// Writes element i of an array of structs, of which only the first needs to have its size.
template <class T>
void write_element(T filled, T* array, Index i) noexcept {
    T* const to = element(array, i);
    to->struct_size = array->struct_size;
    write_struct(filled, to);
}

// Returns the number of a point, cell or control point for a report, counted from index_base.
constexpr Index numbered(Index item, Index index_base) noexcept {
    return item == none ? none : item + index_base;
}

inline hm_curve struct_of(Curve const& curve) noexcept {
    return {sizeof(hm_curve), curve.degree, curve.n_indices, curve.indices, curve.knots};
}
inline hm_condition struct_of(Condition const& condition) noexcept {
    bool const slips =
        condition.kind == ConditionKind::slip;  // hm_basis_along gives the curves `along`
    return {sizeof(hm_condition),
            condition.marker,
            static_cast<std::int32_t>(condition.kind),
            slips ? 0 : condition.first_curve,
            condition.n_curves,
            condition.body,
            condition.partner,
            condition.centre.x,
            condition.centre.y,
            condition.piece,
            0,
            condition.near.x,
            condition.near.y,
            nullptr};
}

constexpr std::ptrdiff_t stride_of(std::int64_t given) noexcept {
    return given == 0 ? 1 : static_cast<std::ptrdiff_t>(given);
}
inline Points points_of(hm_points const& given) noexcept {
    return {given.x, given.y, stride_of(given.stride)};
}

// Views the coordinates of n points that a call reads or writes. `name` is the name of the argument
// in the header. The default n fits points of a mesh, which has more than one.
template <class Given, class View>
Status view_points(const Given* given, const char* name, View& points, Fault& fault,
                   Index n = 2) noexcept {
    if (given == nullptr) return fault.refuse_argument(name, "% is NULL");
    if (given->x == nullptr || given->y == nullptr)
        return fault.refuse_argument(name, "%.x or %.y is NULL");
    if (given->stride < 0) return fault.refuse_argument(name, "%.stride is negative");
    std::ptrdiff_t const stride = stride_of(given->stride);
    if (n > 1 && (given->y == given->x + stride || given->x == given->y + stride)) {
        return fault.refuse_argument(
            name, "%.x and %.y have numbers in common; set the stride to 2 for x,y pairs");
    }
    points = {given->x, given->y, stride};
    return Status::ok;
}
// Does the same for an argument that may be NULL; points then keeps its value.
inline Status view_points_if(const hm_points* given, const char* name, Points& points, Fault& fault,
                             Index n = 2) noexcept {
    return given == nullptr ? Status::ok : view_points(given, name, points, fault, n);
}

Status view_mesh(const hm_mesh* given, Mesh& mesh, CallFault& fault) noexcept;

// The caller's curves, with checked counts and pointers. curve() makes a view of one curve;
// checked_curve() also checks that the curve exists and is valid.
struct CurvesView {
    hm_curves set;
    Index count() const noexcept { return set.n_curves; }
    Status curve(Index number, Curve& out, Fault& fault) const noexcept;
    Status checked_curve(Index number, Curve& out, Fault& fault) const noexcept;
};
Status view_curves(const hm_curves* given, CurvesView& view, CallFault& fault) noexcept;

Status view_condition(const hm_condition* array, Index number, Condition& out,
                      Fault& fault) noexcept;
// If given is NULL, the executor has one thread.
Status view_executor(const hm_executor* given, Executor& executor, Fault& fault) noexcept;
Status view_options(const hm_options* given, Problem& problem, Fault& fault) noexcept;
Status view_fit_options(const hm_fit_options* given, FitOptions& options,
                        CallFault& fault) noexcept;
// Must be called with the number of points for which the caller has weights.
Status check_fit_weights(FitOptions const& options, Index n_points, Fault& fault) noexcept;

}  // namespace harmorph
