#include "patch_conditions.hpp"

#include "basicSymmetryPointPatchField.H"
#include "calculatedPointPatchField.H"
#include "cyclicAMIPolyPatch.H"
#include "cyclicPolyPatch.H"
#include "emptyPolyPatch.H"
#include "processorPolyPatch.H"
#include "valuePointPatchField.H"
#include "wedgePolyPatch.H"
#include "zeroGradientPointPatchField.H"

namespace Foam {

namespace {

const std::int32_t no_condition = -1;

// The patches whose name, or the name of whose group, is in the list.
labelHashSet chosen(const polyBoundaryMesh& patches, const wordRes& names, const char* what) {
    for (const wordRe& name : names) {
        if (patches.patchSet(wordRes(1, name), false, true).empty()) {
            FatalErrorInFunction << "No patch has the name " << name << " of the coefficient "
                                 << what << ". The patches are " << patches.names()
                                 << exit(FatalError);
        }
    }
    return patches.patchSet(names, false, true);
}

std::int32_t kind_of(const polyPatch& patch, const pointPatchVectorField& field, bool moves,
                     bool slips) {
    if (isA<emptyPolyPatch>(patch) || isA<wedgePolyPatch>(patch) || isA<processorPolyPatch>(patch))
        return no_condition;
    const bool has_values = isA<valuePointPatchField<vector>>(field);
    if (moves && !has_values) {
        FatalErrorInFunction << "The patch " << patch.name()
                             << " shall move, but pointDisplacement has the type " << field.type()
                             << " there. A moving patch needs a type that sets values, such as "
                                "fixedValue."
                             << exit(FatalError);
    }
    if (moves) return HM_GIVEN;
    if (isA<cyclicPolyPatch>(patch)) {
        const cyclicPolyPatch& pair = refCast<const cyclicPolyPatch>(patch);
        if (!pair.owner()) return no_condition;
        return pair.transform() == cyclicPolyPatch::ROTATIONAL ? HM_ROTATION_PAIR
                                                               : HM_PERIODIC_PAIR;
    }
    if (slips || isA<basicSymmetryPointPatchField<vector>>(field)) return HM_SLIP;
    // A type derived from calculated, such as the types of couplings, is not a free boundary.
    if (isA<zeroGradientPointPatchField<vector>>(field) ||
        field.type() == calculatedPointPatchField<vector>::typeName)
        return HM_FREE;
    if (!has_values && !isA<cyclicAMIPolyPatch>(patch)) {
        FatalErrorInFunction << "The motion solver harmorph does not know the type " << field.type()
                             << " of pointDisplacement on the patch " << patch.name()
                             << ". It knows types that set values, symmetry, slip, calculated, "
                                "zeroGradient, cyclic and cyclicAMI."
                             << exit(FatalError);
    }
    return HM_FIXED;
}

bool is_first_side(const polyPatch& patch) {
    return isA<cyclicAMIPolyPatch>(patch) && refCast<const cyclicAMIPolyPatch>(patch).owner();
}

}  // namespace

PatchConditions::PatchConditions(const pointVectorField& displacement, const wordRes& moving,
                                 const wordRes& slipping) {
    const polyBoundaryMesh& patches = displacement.mesh()().boundaryMesh();
    const labelHashSet move = chosen(patches, moving, "patches");
    const labelHashSet slip = chosen(patches, slipping, "slip");
    forAll(patches, k) {
        const polyPatch& patch = patches[k];
        kinds_.push_back(
            kind_of(patch, displacement.boundaryField()[k], move.found(k), slip.found(k)));
    }
}

void PatchConditions::update(pointVectorField& displacement) {
    for (pointPatchVectorField& field : displacement.boundaryFieldRef()) {
        if (!isA<valuePointPatchField<vector>>(field)) continue;
        field.updateCoeffs();
        field.evaluate();  // after this, the next call computes the values again
    }
}

void PatchConditions::require_fixed(const pointVectorField& displacement) const {
    for (const pointPatchVectorField& field : displacement.boundaryField()) {
        const label k = field.patch().index();
        if (kinds_[static_cast<std::size_t>(k)] != HM_FIXED ||
            !isA<valuePointPatchField<vector>>(field))
            continue;
        for (const vector& value : refCast<const valuePointPatchField<vector>>(field)) {
            if (value == vector::zero) continue;
            FatalErrorInFunction << "The patch " << field.patch().name() << " has a displacement, "
                                 << value
                                 << ", but is not among the coefficient patches. Add the patch to "
                                    "the list."
                                 << exit(FatalError);
        }
    }
}

GatheredMesh::Values PatchConditions::given(const pointVectorField& displacement) const {
    DynamicList<label> points;
    DynamicList<vector> vectors;
    for (const pointPatchVectorField& field : displacement.boundaryField()) {
        if (kinds_[static_cast<std::size_t>(field.patch().index())] != HM_GIVEN) continue;
        points.append(field.patch().meshPoints());
        vectors.append(refCast<const valuePointPatchField<vector>>(field));
    }
    return {labelList(points), vectorField(vectors)};
}

std::vector<hm_condition> PatchConditions::conditions(const polyMesh& mesh,
                                                      const hm_plane_info& plane,
                                                      std::int32_t axis) const {
    std::vector<hm_condition> found;
    const auto add = [&](label marker, std::int32_t kind) -> hm_condition& {
        hm_condition condition;
        HM_INIT(condition);
        condition.marker = marker;
        condition.kind = kind;
        found.push_back(condition);
        return found.back();
    };
    const vector origin(plane.origin[0], plane.origin[1], plane.origin[2]);
    const vector x(plane.x_direction[0], plane.x_direction[1], plane.x_direction[2]);
    const vector y(plane.y_direction[0], plane.y_direction[1], plane.y_direction[2]);
    for (const polyPatch& patch : mesh.boundaryMesh()) {
        const std::int32_t kind = kinds_[static_cast<std::size_t>(patch.index())];
        if (is_first_side(patch)) {
            const cyclicAMIPolyPatch& side = refCast<const cyclicAMIPolyPatch>(patch);
            if (side.parallel()) add(patch.index(), HM_INTERFACE).partner = side.neighbPatchID();
        }
        if (kind == no_condition || kind == HM_FIXED) continue;
        hm_condition& condition = add(patch.index(), kind);
        if (!isA<cyclicPolyPatch>(patch)) continue;
        const cyclicPolyPatch& pair = refCast<const cyclicPolyPatch>(patch);
        condition.partner = pair.neighbPatchID();
        if (kind == HM_ROTATION_PAIR) {
            condition.x = (pair.rotationCentre() - origin) & x;
            condition.y = (pair.rotationCentre() - origin) & y;
        }
    }
    if (axis >= 0) add(axis, HM_SLIP);
    return found;
}

}  // namespace Foam
