// Reads a problem from the caller's structs, before anything is laid out: mesh, options, curves,
// conditions.
#pragma once

#include "handles.hpp"

namespace harmorph {

struct Request {
    Problem problem;
    CurvesView curves;
    Index n_curves = 0;
    const hm_condition* condition = nullptr;
    Index n_conditions = 0;

    // Reads mesh, options, curves and conditions. The known parameters count from the index base of
    // the mesh.
    Status read(const hm_problem* given, const hm_options* options, CallFault& fault) noexcept;
    // Reads everything except the mesh.
    Status read_without_mesh(const hm_problem* given, const hm_options* options,
                             CallFault& fault) noexcept;
    Index n_control() const noexcept { return n_curves > 0 ? curves.set.n_control : 0; }
    Status copy_to(Span<Curve> to_curves, Span<Curve> to_slip, Span<Condition> to_conditions,
                   CallFault& fault) const noexcept;

private:
    Status read_rest(hm_problem const& p, const hm_options* options, CallFault& fault) noexcept;
    Status read_conditions(hm_problem const& p, Fault& fault) noexcept;
    Status read_fluxes(hm_problem const& p, Fault& fault) noexcept;
    const hm_curves* along_of(Index number) const noexcept;
    Status check_rotation(Fault& fault) const noexcept;
};

}  // namespace harmorph
