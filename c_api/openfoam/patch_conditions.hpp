// Finds the condition of the library that belongs to each patch of a case: given displacements,
// fixed, with slip, periodic, or a side of a sliding interface.
#ifndef HARMORPH_PATCH_CONDITIONS_HPP
#define HARMORPH_PATCH_CONDITIONS_HPP

#include "gathered_mesh.hpp"
#include "pointFields.H"
#include "wordRes.H"

namespace Foam {

class PatchConditions {
public:
    // Collective. moving: the coefficient patches; slipping: the coefficient slip, for patches on
    // which pointDisplacement cannot say slip (cyclicAMI). Ends the program where a name matches no
    // patch, and where a type of pointDisplacement is not supported.
    PatchConditions(const pointVectorField& displacement, const wordRes& moving,
                    const wordRes& slipping);

    // Computes the values of all patches whose types set values, for the time as it is now. Other
    // patches are not evaluated: their points move as the library says.
    static void update(pointVectorField& displacement);
    // Ends the program where a patch that is not among the moving ones has displacements.
    void require_fixed(const pointVectorField& displacement) const;
    // The displacements of the points of the moving patches of this process.
    GatheredMesh::Values given(const pointVectorField& displacement) const;
    // For the mesh of the plane; axis: the number of the marker of the axis of a wedge.
    std::vector<hm_condition> conditions(const polyMesh& mesh, const hm_plane_info& plane,
                                         std::int32_t axis) const;

private:
    std::vector<std::int32_t> kinds_;  // HM_... of each patch; -1: none
};

}  // namespace Foam

#endif
