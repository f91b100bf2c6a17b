#include "safe/basis_match.hpp"

namespace harmorph {
namespace {

// Returns the bytes between the header and the values: curves, conditions and parameters.
Span<const unsigned char> problem_of(Basis const& basis) noexcept {
    auto const begin = reinterpret_cast<const unsigned char*>(basis.shape.data());
    auto const end = reinterpret_cast<const unsigned char*>(basis.value.data());
    return {begin, static_cast<Size>(end - begin)};
}

// Returns whether the modes of both bases move the given points alike.
bool same_modes(Basis const& basis, Basis const& other) noexcept {
    Index const modes = basis.header->counts.modes, n = basis.n_functions();
    if (modes > 0 && other.kind() != basis.kind()) return false;
    for (Index slot = 0; slot < basis.wall_point.count() && modes > 0; ++slot) {
        if (!basis.is_given(slot)) continue;
        auto const own = basis.row(basis.wall_point[slot]),
                   theirs = other.row(basis.wall_point[slot]);
        for (Index plane = 0; plane < numbers_of(basis.kind()); ++plane) {
            for (Index i = n - modes; i < n; ++i) {
                if (own[plane * n + i] != theirs[plane * n + i]) return false;
            }
        }
    }
    return true;
}

}  // namespace

Status check_other(Basis const& basis, Basis const& other, Fault& fault) noexcept {
    HARMORPH_TRY(other.require_double(fault));
    BasisCounts counts = other.header->counts;
    counts.kind = basis.header->counts.kind;
    Span<const unsigned char> const own = problem_of(basis), theirs = problem_of(other);
    bool const same = other.header->topology == basis.header->topology &&
                      std::memcmp(&counts, &basis.header->counts, sizeof counts) == 0 &&
                      theirs.size() == own.size() &&
                      std::memcmp(theirs.data(), own.data(), own.size()) == 0;
    if (same && other.header->solved == 1 && same_modes(basis, other)) return Status::ok;
    return fault.refuse(Status::bad_basis,
                        "one of the other bases is not solved, or belongs to another mesh or to "
                        "other curves");
}

Status check_derivative(Plan const& plan, Basis const& basis, Basis const& derivative,
                        Fault& fault) noexcept {
    HARMORPH_TRY(plan.check_fit(derivative, fault));
    BasisCounts const &own = basis.header->counts, &derivative_counts = derivative.header->counts;
    if (std::memcmp(&own, &derivative_counts, sizeof own) == 0) return Status::ok;
    return fault.refuse(Status::bad_basis,
                        "the basis for the derivative has other functions than the basis");
}

}  // namespace harmorph
