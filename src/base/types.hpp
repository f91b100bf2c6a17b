// base: what every other folder is written with: types here; memory (arena), spans and sorts;
// scalars, 2-D vectors and exact predicates; sums with the same bits for any grouping; the caller's
// threads and progress callback. Nothing here knows meshes or curves, and nothing keeps state
// between calls. Sources are given where a method has one.
//
// This file: index and number types, status, and the fault that explains a refusal.
#pragma once

#include <cstddef>
#include <cstdint>

// Callers may trap floating-point exceptions. g++ heeds that; clang must be told, or it divides by
// c in c > 0 ? b / c : 0 before it looks at c. For some processors it cannot be told: there it
// ignores this.
#ifdef __clang__
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wignored-pragmas"
#pragma float_control(except, on)
#pragma clang diagnostic pop
#endif

namespace harmorph {

using Index = std::int32_t;  // points, cells, edges, unknowns
using Offset =
    std::int64_t;          // positions in arrays that may exceed 2^31: the factor, function values
using Size = std::size_t;  // bytes
using Real = double;

inline constexpr Index none = -1;
inline constexpr Index max_degree = 5;
inline constexpr Index max_order = max_degree + 1;  // functions that are not 0 at a parameter

// The numbers are those of the C header, which explains them.
enum class Status : std::int32_t {
    ok = 0,
    not_converged = 1,
    moved = 2,
    short_of_target = 3,
    backtracks = 4,
    far_from_curve = 5,
    poor = 6,
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

// What the numbers in a fault count: `mesh`, points and cells, which the caller counts from an
// index base of the mesh; `curves`, a control point as `item`, likewise, and a curve as `other`,
// which counts from 0 like everything else; `mesh_and_marker`, a point as `item` and a marker as
// `other`, whose number is the caller's own.
enum class Counts : std::int32_t { from_zero, mesh, curves, mesh_and_marker };

// Why a call was refused. In the sentence # stands for item, @ for other, ~ for value, $ for the
// place and % for argument.
struct Fault {
    Status status = Status::ok;
    Counts counts = Counts::from_zero;
    Index item = none;
    Index other = none;
    Real value = 0;
    const char* sentence = "";
    const char* argument = "";
    Real place[2] = {0, 0};  // coordinates

    Status refuse(Status why, const char* text, Counts base = Counts::from_zero, Index first = none,
                  Index second = none, Real found = 0) noexcept {
        *this = {why, base, first, second, found, text, "", {0, 0}};
        return why;
    }
    Status refuse_at(Real x, Real y, Status why, const char* text, Counts base = Counts::from_zero,
                     Index first = none, Index second = none, Real found = 0) noexcept {
        refuse(why, text, base, first, second, found);
        place[0] = x;
        place[1] = y;
        return why;
    }
    // An argument of the call that cannot be used as it is.
    Status refuse_argument(const char* name, const char* text) noexcept {
        refuse(Status::bad_argument, text);
        argument = name;
        return status;
    }
};

#define HARMORPH_TRY(call)                                             \
    do {                                                               \
        ::harmorph::Status const status_of_call = (call);              \
        if (::harmorph::failed(status_of_call)) return status_of_call; \
    } while (false)

}  // namespace harmorph
