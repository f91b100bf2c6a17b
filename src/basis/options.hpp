// The options of the solution: operator, scheme, engine, precision; and the kind of values that
// they lead to.
#pragma once

#include "boundary/conditions.hpp"
#include "simd/cpu.hpp"
#include "base/value_kind.hpp"

namespace harmorph {

// The numbers are those of the C header, which explains them, and those of the rows of the tables
// below.
enum class Operator : std::int32_t { conformal = 0, laplace = 1, weighted = 2 };
enum class Scheme : std::int32_t {
    compact = 0,
    nodal_gradient = 1,
    bounded = 2,
    nodal_gradient_plain = 3
};
enum class Precision : std::int32_t { in_double = 0, in_single = 1 };
enum class Engine : std::int32_t { direct = 0, multigrid = 1, fas = 2 };

// What engines, schemes and operators go with. Combinations that a table does not contain are
// refused, with its sentence.
struct EngineTraits {
    // It factors the matrix: unknowns are in the order of a nested dissection, and solutions are
    // refined. Otherwise they are in the order of an advancing front, and the engine itself
    // iterates to a tolerance.
    bool factors;
    bool takes_slip;
};
inline constexpr EngineTraits engine_traits[] = {
    {true, true},    // direct
    {false, true},   // multigrid
    {false, false},  // fas
};

struct SchemeTraits {
    unsigned engines;
    const char* other_engines;  // the sentence that refuses them
    bool takes_slip, takes_given;
};
inline constexpr SchemeTraits scheme_traits[] = {
    // compact
    {set_of(Engine::direct, Engine::multigrid, Engine::fas), "", true, true},
    // nodal_gradient
    {set_of(Engine::direct, Engine::fas),
     "nodal gradients do not go with the engine multigrid; fas goes with them", false, false},
    // bounded
    {set_of(Engine::direct), "the bounded scheme goes with the direct engine only", false, true},
    // nodal_gradient_plain
    {set_of(Engine::fas), "nodal gradients without correction (plain) go with the engine fas only",
     false, false},
};

struct OperatorTraits {
    bool is_complex;              // values are a + ib, also without rigid bodies
    std::int32_t usual_quarters;  // k = d^(-quarters / 4) where the caller gives no exponent
    bool has_weight;
    bool takes_free;  // boundaries where points may leave their line
    bool takes_offset_correction;
    unsigned schemes;
    const char* other_schemes;
    unsigned engines;
    const char* other_engines;
};
inline constexpr OperatorTraits operator_traits[] = {
    // conformal
    {true, 6, true, false, true, set_of(Scheme::compact),
     "the conformal operator goes with the compact scheme only; laplace goes with all schemes",
     set_of(Engine::direct),
     "the conformal operator goes with the direct engine only; laplace and weighted go with all"},
    // laplace
    {false, 0, false, true, false,
     set_of(Scheme::compact, Scheme::nodal_gradient, Scheme::bounded, Scheme::nodal_gradient_plain),
     "", set_of(Engine::direct, Engine::multigrid, Engine::fas), ""},
    // weighted
    {false, 4, true, true, false, set_of(Scheme::compact, Scheme::bounded),
     "nodal gradients go with the operator laplace only",
     set_of(Engine::direct, Engine::multigrid, Engine::fas), ""},
};

struct Method {
    Operator operator_kind = Operator::conformal;
    Scheme scheme = Scheme::compact;
    Engine engine = Engine::direct;
    Kernel kernel = Kernel::automatic;
    std::int32_t quarters = 0;           // k = d^(-quarters / 4)
    std::int32_t offset_correction = 0;  // 1: a wall off its curve turns with it
    Real tolerance = 1e-10;
    Precision precision = Precision::in_double;  // of the factor
    std::int32_t reserved = 0;  // fills the padding: the block is written and compared as bytes

    EngineTraits const& traits() const noexcept {
        return engine_traits[static_cast<std::int32_t>(engine)];
    }
    OperatorTraits const& operator_row() const noexcept {
        return operator_traits[static_cast<std::int32_t>(operator_kind)];
    }
    SchemeTraits const& scheme_row() const noexcept {
        return scheme_traits[static_cast<std::int32_t>(scheme)];
    }
    // Does every number stand in its table? Not so in damaged files.
    bool is_known() const noexcept {
        return has_row(operator_traits, static_cast<std::int32_t>(operator_kind)) &&
               has_row(scheme_traits, static_cast<std::int32_t>(scheme)) &&
               has_row(engine_traits, static_cast<std::int32_t>(engine));
    }
    bool conformal() const noexcept { return operator_kind == Operator::conformal; }
    bool bounded() const noexcept { return scheme == Scheme::bounded; }
    bool nodal_gradients() const noexcept {
        return scheme == Scheme::nodal_gradient || scheme == Scheme::nodal_gradient_plain;
    }

    // The same functions but for rounding?
    bool agrees_with(Method const& other) const noexcept {
        return operator_kind == other.operator_kind && scheme == other.scheme &&
               quarters == other.quarters && offset_correction == other.offset_correction;
    }

    // The smallest kind of value that can express what is asked for.
    ValueKind value_kind(Demands const& demands) const noexcept {
        if (demands.slip) return ValueKind::matrix;
        bool const is_complex = operator_row().is_complex || demands.bodies > 0 || demands.rotation;
        return is_complex ? ValueKind::complex : ValueKind::real;
    }
    // A row of values has one or two lines, each with the numbers of one unknown.
    Index components(Demands const& demands) const noexcept { return demands.slip ? 2 : 1; }
};

}  // namespace harmorph
