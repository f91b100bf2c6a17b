// The room base contains what all other rooms use: types; memory (arena), spans and sorts; scalars,
// vectors and exact predicates; sums with the same bits for any grouping; the caller's threads and
// progress callback. The room does not know meshes or curves, and keeps no state between calls. A
// file names the source of its method, if the method has one.
//
// Below are index and number types, the status, and the fault that explains a refusal.
#pragma once

#include <cstddef>
#include <cstdint>

// Callers may trap floating-point exceptions. g++ respects that by default. clang needs this
// pragma; otherwise it may divide in c > 0 ? b / c : 0 before it compares c. clang ignores the
// pragma for processors for which it does not support it.
#ifdef __clang__
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wignored-pragmas"
#pragma float_control(except, on)
#pragma clang diagnostic pop
#endif

namespace harmorph {

using Index = std::int32_t;  // points, cells, edges, unknowns
// Positions in arrays that may exceed 2^31 elements: the factor and function values.
using Offset = std::int64_t;
using Size = std::size_t;  // bytes
using Real = double;

inline constexpr Index none = -1;
inline constexpr Index max_degree = 5;
// At most this number of B-spline basis functions are not 0 at a parameter.
inline constexpr Index max_order = max_degree + 1;

// The C header has the same values, and explains them.
enum class Status : std::int32_t {
    ok = 0,
    not_converged = 1,
    moved = 2,
    short_of_target = 3,
    backtracks = 4,
    far_from_curve = 5,
    poor = 6,
    torn = 7,
    far_from_points = 8,
    cancelled = -1,
    bad_argument = -2,
    bad_mesh = -3,
    bad_curve = -4,
    bad_condition = -5,
    bad_basis = -6,
    block_too_small = -7,
    not_positive = -8,
    unsupported = -9,
    crossing = -10
};

constexpr bool failed(Status status) noexcept { return static_cast<std::int32_t>(status) < 0; }

// An ItemKind says what the number in a fault counts. The C header has the same values, and
// explains them.
enum class ItemKind : std::int32_t {
    nothing,
    point,
    cell,
    side,
    marker,
    curve,
    control_point,
    condition,
    function,
    body,
    list,
    block,
    knot,
    variable,
    quantity,
    field,
    entry,
    global_point
};

// An Item is one thing that a fault concerns. Items count from 0; markers and global points have
// the caller's own numbers. A number without a kind, such as a count or an option, is in the text
// only.
struct Item {
    ItemKind kind = ItemKind::nothing;
    Offset number = 0;
};

constexpr Item plain(Index number) noexcept { return {ItemKind::nothing, number}; }
constexpr Item point_item(Index number) noexcept { return {ItemKind::point, number}; }
constexpr Item cell_item(Index number) noexcept { return {ItemKind::cell, number}; }
constexpr Item side_item(Index number) noexcept { return {ItemKind::side, number}; }
constexpr Item marker_item(Index number) noexcept { return {ItemKind::marker, number}; }
constexpr Item curve_item(Index number) noexcept { return {ItemKind::curve, number}; }
constexpr Item control_point_item(Index number) noexcept {
    return {ItemKind::control_point, number};
}
constexpr Item condition_item(Index number) noexcept { return {ItemKind::condition, number}; }
constexpr Item function_item(Index number) noexcept { return {ItemKind::function, number}; }
constexpr Item body_item(Index number) noexcept { return {ItemKind::body, number}; }
constexpr Item list_item(Index number) noexcept { return {ItemKind::list, number}; }
constexpr Item block_item(Index number) noexcept { return {ItemKind::block, number}; }
constexpr Item knot_item(Index number) noexcept { return {ItemKind::knot, number}; }
constexpr Item variable_item(Index number) noexcept { return {ItemKind::variable, number}; }
constexpr Item quantity_item(Index number) noexcept { return {ItemKind::quantity, number}; }
constexpr Item field_item(Index number) noexcept { return {ItemKind::field, number}; }
constexpr Item entry_item(Index number) noexcept { return {ItemKind::entry, number}; }
constexpr Item global_point_item(Offset number) noexcept {
    return {ItemKind::global_point, number};
}

// A Fault says why a call was refused. In the sentence, # stands for item, @ for other, ~ for
// value, $ for the place, % for argument and & for a second argument. A fault without a reason
// consists of zeros, so that the library has no initialised data for it.
struct Fault {
    Status status = Status::ok;
    Item item, other;
    Real value = 0;
    const char* sentence = nullptr;
    const char* argument = nullptr;
    const char* other_argument = nullptr;
    Real place[2] = {0, 0};  // coordinates

    Status refuse(Status why, const char* text, Item first = {}, Item second = {},
                  Real found = 0) noexcept {
        *this = {why, first, second, found, text, nullptr, nullptr, {0, 0}};
        return why;
    }
    Status refuse_at(Real x, Real y, Status why, const char* text, Item first = {},
                     Item second = {}, Real found = 0) noexcept {
        refuse(why, text, first, second, found);
        place[0] = x;
        place[1] = y;
        return why;
    }
    // Refuses an argument of the call; % in the text stands for its name.
    Status refuse_argument(const char* name, const char* text) noexcept {
        refuse(Status::bad_argument, text);
        argument = name;
        return status;
    }
    // Refuses two arguments together; & in the text stands for the name of the second one.
    Status refuse_arguments(const char* name, const char* second, const char* text) noexcept {
        refuse_argument(name, text);
        other_argument = second;
        return status;
    }
};

#define HARMORPH_TRY(call)                                             \
    do {                                                               \
        ::harmorph::Status const status_of_call = (call);              \
        if (::harmorph::failed(status_of_call)) return status_of_call; \
    } while (false)

// Names the sets of vector instructions for which kernels are compiled.

// The C header has the same numbers. Different kernels agree to rounding; one kernel always
// gives the same bits.
enum class Kernel : std::int32_t { automatic = 0, baseline = 1, avx2 = 2, avx512 = 3, neon = 4 };

// Supports tables with one row for each value of an enumeration, and sets of such values.
template <class... Values>
constexpr unsigned set_of(Values... values) noexcept {
    return ((1u << static_cast<unsigned>(values)) | ... | 0u);
}
template <class Value>
constexpr bool contains(unsigned set, Value value) noexcept {
    return (set >> static_cast<unsigned>(value) & 1u) != 0;
}
// Returns whether the table has a row with this number.
template <class Row, Size n>
constexpr bool has_row(Row const (&)[n], std::int32_t number) noexcept {
    return number >= 0 && static_cast<Size>(number) < n;
}

}  // namespace harmorph
