// The options of the solution: operator, scheme, engine, precision; and the kind of values that
// they lead to.
#pragma once

#include "boundary/conditions.hpp"
#include "simd/cpu.hpp"
#include "base/value_kind.hpp"

namespace harmorph {

// The numbers are those of the C header, which explains them.
enum class Operator : std::int32_t { conformal = 0, laplace = 1, weighted = 2 };
enum class Scheme : std::int32_t {
    compact = 0,
    nodal_gradient = 1,
    bounded = 2,
    nodal_gradient_plain = 3
};
enum class Precision : std::int32_t { in_double = 0, in_single = 1 };
enum class Engine : std::int32_t { direct = 0, multigrid = 1, fas = 2 };

// What an analysis and a refinement must know of an engine: a row for each. The engines themselves:
// plan/engine.hpp.
struct EngineTraits {
    // It factors the matrix: unknowns are in the order of a nested dissection, and solutions are
    // refined. Otherwise they are in the order of an advancing front, and the engine itself
    // iterates to a tolerance.
    bool factors;
};
inline constexpr EngineTraits engine_traits[] = {
    {true},   // direct
    {false},  // multigrid
    {false},  // fas
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
        return conformal() || demands.bodies > 0 || demands.rotation ? ValueKind::complex
                                                                     : ValueKind::real;
    }
    // A row of values has one or two lines, each with the numbers of one unknown.
    Index components(Demands const& demands) const noexcept { return demands.slip ? 2 : 1; }
};

}  // namespace harmorph
