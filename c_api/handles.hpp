// Converts the caller's handles into the objects in the blocks, and checks the state that a call
// needs: an analysis with conditions, a solved or a complete basis.
#pragma once

#include "call.hpp"
#include "basis/basis.hpp"
#include "plan/plan.hpp"
#include "views.hpp"

namespace harmorph {

inline Status open_analysis(const hm_analysis* handle, const Analysis*& analysis,
                            CallFault& fault) noexcept {
    HARMORPH_TRY(require({{"analysis", handle}}, fault));
    analysis = reinterpret_cast<const Analysis*>(handle);
    fault.bases.set(analysis->problem().mesh);
    return Status::ok;
}

// Opens an analysis from which a plan and a basis can be made.
inline Status open_complete(const hm_analysis* handle, const Analysis*& analysis,
                            CallFault& fault) noexcept {
    HARMORPH_TRY(open_analysis(handle, analysis, fault));
    if (analysis->has_conditions()) return Status::ok;
    return fault.refuse(Status::bad_argument,
                        "the analysis covers the mesh only, because its problem has no curves, "
                        "rigid bodies or given displacements");
}

// Opens a plan. Handle is hm_plan and Object is Plan; either both are const or neither.
template <class Handle, class Object>
Status open_plan(Handle* handle, Object*& plan, CallFault& fault) noexcept {
    HARMORPH_TRY(require({{"plan", handle}}, fault));
    plan = reinterpret_cast<Object*>(handle);
    fault.bases.set(plan->mesh());
    return Status::ok;
}

// Opens a basis whose handle is not NULL.
inline Basis view_basis(const hm_basis* handle, CallFault& fault) noexcept {
    Basis const basis = Basis::view(static_cast<const void*>(handle));
    fault.bases.mesh = basis.header->index_base;
    return basis;
}
inline Status open_basis(const hm_basis* handle, Basis& basis, CallFault& fault) noexcept {
    HARMORPH_TRY(require({{"basis", handle}}, fault));
    basis = view_basis(handle, fault);
    return Status::ok;
}

inline Status open_solved(const hm_basis* handle, Basis& basis, CallFault& fault) noexcept {
    HARMORPH_TRY(open_basis(handle, basis, fault));
    if (basis.header->solved == 1) return Status::ok;
    return fault.refuse(Status::bad_basis,
                        "the basis has not been solved; call hm_plan_solve first");
}

// Opens a basis that is solved and has all functions.
inline Status open_complete(const hm_basis* handle, Basis& basis, CallFault& fault) noexcept {
    HARMORPH_TRY(open_solved(handle, basis, fault));
    BasisCounts const& counts = basis.header->counts;
    if (counts.complete()) return Status::ok;
    return fault.refuse(
        Status::bad_basis,
        "the basis is a share with only # of the @ functions, and this call needs all of them",
        plain(counts.stored), plain(counts.functions()));
}

// Makes a new basis with these functions of the analysis. The basis is not solved.
inline Status make_basis(Analysis const& analysis, BasisCounts const& counts, hm_memory* memory,
                         hm_basis** handle, Fault& fault) noexcept {
    Basis made;
    HARMORPH_TRY(place(memory, fault, [&](Arena& arena) { made.lay_out(arena, counts); }));
    HARMORPH_TRY(require({{"basis", handle}}, fault));
    init_basis(made, counts, analysis.basis_source(), analysis.problem().executor);
    *handle = reinterpret_cast<hm_basis*>(made.header);
    return Status::ok;
}

// Checks that the numbers of move [2 * functions] are finite.
inline Status check_move(Basis const& basis, const double* move, Fault& fault) noexcept {
    HARMORPH_TRY(require({{"move", move}}, fault));
    for (Index k = 0; k < 2 * basis.header->counts.functions(); ++k) {
        if (is_finite(move[k])) continue;
        return fault.refuse(Status::bad_argument,
                            "the movement of function # in `move` is not finite",
                            function_item(k / 2));
    }
    return Status::ok;
}

}  // namespace harmorph
