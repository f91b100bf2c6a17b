// The options of the solution: operator, scheme, engine; and the kind of values to which
// they lead. tests/c_api/test_options.cpp and tests/c_api/test_refused_problems.cpp cover this
// file.
#pragma once

#include "base/vec2.hpp"
#include "boundary/conditions.hpp"
#include "simd/cpu.hpp"

namespace harmorph {

// The value of a function at a mesh point is the linear map from the movement of the control point
// to the movement of the mesh point.

// Each kind is the count of numbers in one value. Rows store values in planes: the first numbers of
// all functions, then the second numbers, and so on.
//   real     f               dX = f dP
//   complex  a, b            dX = (a + i b) dP, where points are complex numbers
//   matrix   xx, xy, yx, yy  dX = [xx xy; yx yy] dP
enum class ValueKind : std::int32_t { real = 1, complex = 2, matrix = 4 };

constexpr Index numbers_of(ValueKind kind) noexcept { return static_cast<Index>(kind); }

// Returns the displacement dX for the movement dP = move and a value that is 1 in this plane and 0
// in the others.
constexpr Vec2 moved_by(ValueKind kind, Index plane, Vec2 move) noexcept {
    if (kind != ValueKind::matrix) return plane == 0 ? move : Vec2{-move.y, move.x};
    Real const from = plane % 2 == 0 ? move.x : move.y;
    return plane < 2 ? Vec2{from, 0} : Vec2{0, from};
}

// Holds the numbers of a complex value in plane[k], k < numbers_of(kind). For the kind `real`, the
// imaginary part must be 0.
struct Numbers {
    Real plane[4];
};
constexpr Numbers numbers_of(ValueKind kind, Vec2 value) noexcept {
    if (kind == ValueKind::matrix) return {{value.x, -value.y, value.y, value.x}};
    return {{value.x, value.y, 0, 0}};
}

// The C header has the same numbers, and explains them; the tables below have a row for each.
enum class Operator : std::int32_t { conformal = 0, laplace = 1, weighted = 2 };
enum class Scheme : std::int32_t {
    compact = 0,
    nodal_gradient = 1,
    bounded = 2,
    nodal_gradient_plain = 3
};
enum class Precision : std::int32_t { in_double = 0, in_single = 1 };
enum class Engine : std::int32_t { direct = 0, multigrid = 1, fas = 2 };

// The combinations of engines, schemes and operators. A combination that a table does not contain
// is refused with the sentence of the table.
struct EngineTraits {
    // The engine factors the matrix: unknowns are in the order of a nested dissection, and
    // solutions are refined. Otherwise the unknowns are in the order of an advancing front, and the
    // engine itself iterates to a tolerance.
    bool factors;
    bool takes_slip;
    // The engine starts from the functions that a basis contains already.
    bool continues;
};
inline constexpr EngineTraits engine_traits[] = {
    {true, true, false},    // direct
    {false, true, true},    // multigrid
    {false, false, false},  // fas
};

struct SchemeTraits {
    unsigned engines;
    const char* other_engines;  // The sentence that refuses the other engines.
    bool takes_slip, takes_given;
};
inline constexpr SchemeTraits scheme_traits[] = {
    // compact
    {set_of(Engine::direct, Engine::multigrid, Engine::fas), "", true, true},
    // nodal_gradient
    {set_of(Engine::direct, Engine::fas),
     "the engine multigrid does not solve schemes of nodal gradients; the engine fas does", false,
     false},
    // bounded
    {set_of(Engine::direct), "the bounded scheme needs the direct engine", false, true},
    // nodal_gradient_plain
    {set_of(Engine::fas),
     "the scheme of nodal gradients without correction (plain) needs the engine fas", false, false},
};

struct OperatorTraits {
    bool is_complex;  // Values are a + ib, even without rigid bodies.
    std::int32_t
        default_exponent_quarters;  // The default q of k = d^-q is this number divided by 4.
    bool has_weight;
    bool takes_free;  // The operator admits boundaries where points may leave their line.
    bool takes_offset_correction;
    unsigned schemes;
    const char* other_schemes;
    unsigned engines;
    const char* other_engines;
};
inline constexpr OperatorTraits operator_traits[] = {
    // conformal
    {true, 6, true, false, true, set_of(Scheme::compact),
     "the conformal operator needs the compact scheme; the operator laplace admits all schemes",
     set_of(Engine::direct, Engine::multigrid),
     "the conformal operator needs the direct engine or multigrid; the operators laplace and "
     "weighted admit all engines"},
    // laplace
    {false, 0, false, true, false,
     set_of(Scheme::compact, Scheme::nodal_gradient, Scheme::bounded, Scheme::nodal_gradient_plain),
     "", set_of(Engine::direct, Engine::multigrid, Engine::fas), ""},
    // weighted
    {false, 4, true, true, false, set_of(Scheme::compact, Scheme::bounded),
     "the schemes of nodal gradients need the operator laplace",
     set_of(Engine::direct, Engine::multigrid, Engine::fas), ""},
};

// The sentences for numbers without a row name all constants of the C header.
inline constexpr const char* unknown_operator =
    "options.operator_kind is #, but it must be HM_CONFORMAL, HM_LAPLACE or HM_WEIGHTED";
inline constexpr const char* unknown_scheme =
    "options.study.scheme is #, but it must be HM_COMPACT, HM_BOUNDED, HM_NODAL_GRADIENT or "
    "HM_NODAL_GRADIENT_PLAIN";
inline constexpr const char* unknown_engine =
    "options.engine is #, but it must be HM_DIRECT, HM_MULTIGRID or HM_FAS";

struct Method {
    Operator operator_kind = Operator::conformal;
    Scheme scheme = Scheme::compact;
    Engine engine = Engine::direct;
    Kernel kernel = Kernel::automatic;   // automatic but in the equations of a plan
    std::int32_t exponent_quarters = 0;  // The weight is k = d^(-exponent_quarters / 4).
    // If this is 1, the offset of a wall point from its curve rotates with the curve.
    std::int32_t offset_correction = 0;
    Real tolerance = 1e-10;

    EngineTraits const& traits() const noexcept {
        return engine_traits[static_cast<std::int32_t>(engine)];
    }
    OperatorTraits const& operator_row() const noexcept {
        return operator_traits[static_cast<std::int32_t>(operator_kind)];
    }
    SchemeTraits const& scheme_row() const noexcept {
        return scheme_traits[static_cast<std::int32_t>(scheme)];
    }
    bool conformal() const noexcept { return operator_kind == Operator::conformal; }
    bool bounded() const noexcept { return scheme == Scheme::bounded; }
    bool nodal_gradients() const noexcept {
        return scheme == Scheme::nodal_gradient || scheme == Scheme::nodal_gradient_plain;
    }

    // Tells whether both methods lead to the same functions but for rounding.
    bool agrees_with(Method const& other) const noexcept {
        return operator_kind == other.operator_kind && scheme == other.scheme &&
               exponent_quarters == other.exponent_quarters &&
               offset_correction == other.offset_correction;
    }

    // Returns the smallest kind of value that can express the demands.
    ValueKind value_kind(Demands const& demands) const noexcept {
        if (demands.slip) return ValueKind::matrix;
        bool const is_complex = operator_row().is_complex || demands.bodies > 0 || demands.rotation;
        return is_complex ? ValueKind::complex : ValueKind::real;
    }
    // A row of values has one or two lines, each with the numbers of one unknown.
    Index components(Demands const& demands) const noexcept { return demands.slip ? 2 : 1; }
};

}  // namespace harmorph
