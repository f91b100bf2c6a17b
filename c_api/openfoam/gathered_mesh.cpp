#include "gathered_mesh.hpp"

#include "emptyPolyPatch.H"
#include "globalIndex.H"
#include "globalMeshData.H"
#include "IPstream.H"
#include "ListOps.H"
#include "SubField.H"
#include "OPstream.H"
#include "processorCyclicPolyPatch.H"
#include "wedgePolyPatch.H"

#include <algorithm>
#include <limits>
#include <numeric>

namespace Foam {

namespace {

const std::int32_t no_patch = std::numeric_limits<std::int32_t>::max();

// The direction to which faces of empty patches must point to be in the chosen plane: the normal of
// some face, with the sign that makes its largest component positive.
vector plane_normal(const polyMesh& mesh) {
    vectorField found(Pstream::nProcs(), Zero);
    for (const polyPatch& patch : mesh.boundaryMesh()) {
        if (isA<emptyPolyPatch>(patch) && patch.size() > 0) {
            found[Pstream::myProcNo()] = patch.faceAreas()[0];
            break;
        }
    }
    Pstream::gatherList(found);
    Pstream::scatterList(found);
    for (const vector& area : found) {
        if (mag(area) == 0) continue;
        direction largest = 0;
        for (direction k = 1; k < 3; ++k) {
            if (std::abs(area[k]) > std::abs(area[largest])) largest = k;
        }
        return area[largest] > 0 ? area : -area;
    }
    return Zero;
}

// The patch whose faces are sides of the plane: the patch itself, or the cyclic patch to which the
// faces belonged before the case was decomposed; -1: the faces are inside the mesh or in a plane.
label patch_of_sides(const polyPatch& patch) {
    if (isA<emptyPolyPatch>(patch) || isA<wedgePolyPatch>(patch)) return -1;
    if (isA<processorCyclicPolyPatch>(patch))
        return refCast<const processorCyclicPolyPatch>(patch).referPatchID();
    return isA<processorPolyPatch>(patch) ? -1 : patch.index();
}

// The faces of this process as rows of global point numbers; the first number of a row is the patch
// of a side, or -1 for a face in the plane.
void add_rows(const polyMesh& mesh, const labelList& to_global, DynamicList<labelList>& rows) {
    const vector normal = plane_normal(mesh);
    const auto add = [&](const face& points, label patch) {
        labelList row(points.size() + 1, patch);
        forAll(points, k) row[k + 1] = to_global[points[k]];
        rows.append(row);
    };
    bool in_wedge = false;  // one of the two planes is enough
    for (const polyPatch& patch : mesh.boundaryMesh()) {
        const bool empty = isA<emptyPolyPatch>(patch), wedge = isA<wedgePolyPatch>(patch);
        const label sides = patch_of_sides(patch);
        forAll(patch, k) {
            const bool chosen =
                (empty && (patch.faceAreas()[k] & normal) > 0) || (wedge && !in_wedge);
            if (chosen || sides >= 0) add(patch[k], sides);
        }
        in_wedge = in_wedge || wedge;
    }
}

void require_one_cell_thick(const polyMesh& mesh, const DynamicList<labelList>& rows) {
    label faces = 0, cells = mesh.nCells();
    for (const labelList& row : rows) {
        if (row[0] < 0) {
            ++faces;
        } else if (row.size() > 5) {
            FatalErrorInFunction << "A face of the patch " << mesh.boundaryMesh()[row[0]].name()
                                 << " has " << row.size() - 1
                                 << " points. Faces between the two planes must have 4."
                                 << exit(FatalError);
        }
    }
    reduce(faces, sumOp<label>());
    reduce(cells, sumOp<label>());
    if (faces == 0) {
        FatalErrorInFunction << "The mesh has no patch of the type empty or wedge. The motion "
                                "solver harmorph moves meshes that are one cell thick."
                             << exit(FatalError);
    }
    if (faces != cells) {
        FatalErrorInFunction << "The mesh has " << cells << " cells, but " << faces
                             << " faces lie in one plane of the empty or wedge patches. The motion "
                                "solver harmorph moves meshes that are one cell thick."
                             << exit(FatalError);
    }
}

}  // namespace

GatheredMesh::GatheredMesh(const polyMesh& mesh, const pointField& points) {
    number(mesh, points);
    if (Pstream::master()) order();
}

// Sends points and faces to the master, which stores them in the order of the processes.
void GatheredMesh::number(const polyMesh& mesh, const pointField& points) {
    labelList to_global(identity(points.size())), unique(to_global);
    if (Pstream::parRun()) mesh.globalData().mergePoints(to_global, unique);

    DynamicList<labelList> own_rows;
    add_rows(mesh, to_global, own_rows);
    require_one_cell_thick(mesh, own_rows);

    List<pointField> all_points(Pstream::nProcs());
    List<labelListList> all_rows(Pstream::nProcs());
    places_.setSize(Pstream::nProcs());
    all_points[Pstream::myProcNo()] = pointField(points, unique);
    all_rows[Pstream::myProcNo()] = labelListList(own_rows);
    places_[Pstream::myProcNo()] = to_global;
    Pstream::gatherList(all_points);
    Pstream::gatherList(all_rows);
    Pstream::gatherList(places_);
    if (!Pstream::master()) return;

    for (const pointField& part : all_points)
        points_.insert(points_.end(), part.begin(), part.end());
    face_start_.push_back(0);
    for (const labelListList& rows : all_rows) {
        for (const labelList& row : rows) {
            std::vector<std::int32_t>& to = row[0] < 0 ? face_points_ : side_points_;
            to.insert(to.end(), row.begin() + 1, row.end());
            if (row[0] < 0) {
                face_start_.push_back(static_cast<std::int32_t>(face_points_.size()));
                continue;
            }
            if (row.size() == 4) to.push_back(row[3]);  // a triangle repeats a point
            side_markers_.push_back(row[0]);
        }
    }
}

void GatheredMesh::order() {
    const std::size_t n = points_.size();
    std::vector<std::int32_t> patch(n, no_patch), by_place(n), place(n);
    for (std::size_t k = 0; k < side_points_.size(); ++k) {
        std::int32_t& lowest = patch[static_cast<std::size_t>(side_points_[k])];
        lowest = std::min(lowest, side_markers_[k / 4]);
    }
    std::iota(by_place.begin(), by_place.end(), 0);
    std::sort(by_place.begin(), by_place.end(), [&](std::int32_t a, std::int32_t b) {
        const std::size_t i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
        for (direction k = 0; k < 3; ++k) {
            if (points_[i][k] != points_[j][k]) return points_[i][k] < points_[j][k];
        }
        return patch[i] != patch[j] ? patch[i] < patch[j] : a < b;
    });
    std::vector<point> sorted(n);
    for (std::size_t k = 0; k < n; ++k) {
        sorted[k] = points_[static_cast<std::size_t>(by_place[k])];
        place[static_cast<std::size_t>(by_place[k])] = static_cast<std::int32_t>(k);
    }
    points_.swap(sorted);
    for (labelList& part : places_) {
        for (label& number : part) number = place[static_cast<std::size_t>(number)];
    }

    // Faces and sides begin at their lowest point, and are in the order of their points.
    using Row = std::vector<std::int32_t>;
    const auto row_of = [&](const Row& all, std::size_t begin, std::size_t end) {
        Row row;
        for (std::size_t k = begin; k < end; ++k)
            row.push_back(place[static_cast<std::size_t>(all[k])]);
        std::rotate(row.begin(), std::min_element(row.begin(), row.end()), row.end());
        return row;
    };
    std::vector<Row> faces, sides;
    for (std::size_t k = 0; k + 1 < face_start_.size(); ++k)
        faces.push_back(row_of(face_points_, static_cast<std::size_t>(face_start_[k]),
                               static_cast<std::size_t>(face_start_[k + 1])));
    for (std::size_t k = 0; k < side_markers_.size(); ++k) {
        sides.push_back(row_of(side_points_, 4 * k, 4 * k + 4));
        sides.back().push_back(side_markers_[k]);
    }
    std::sort(faces.begin(), faces.end());
    std::sort(sides.begin(), sides.end());
    face_points_.clear();
    for (std::size_t k = 0; k < faces.size(); ++k) {
        face_points_.insert(face_points_.end(), faces[k].begin(), faces[k].end());
        face_start_[k + 1] = static_cast<std::int32_t>(face_points_.size());
    }
    for (std::size_t k = 0; k < sides.size(); ++k) {
        std::copy_n(sides[k].begin(), 4, side_points_.begin() + static_cast<std::ptrdiff_t>(4 * k));
        side_markers_[k] = sides[k][4];
    }
}

hm_space_mesh GatheredMesh::view() const {
    hm_space_mesh space;
    HM_INIT(space);
    if (points_.empty()) return space;
    space.n_points = static_cast<std::int32_t>(points_.size());
    const scalar* const first = points_.front().cdata();
    space.points = {first, first + 1, first + 2, 3};
    space.n_faces = static_cast<std::int32_t>(face_start_.size()) - 1;
    space.face_start = face_start_.data();
    space.face_points = face_points_.data();
    space.n_sides = static_cast<std::int32_t>(side_markers_.size());
    space.side_points = side_points_.data();
    space.side_markers = side_markers_.data();
    return space;
}

void GatheredMesh::gather(const Values& own, std::vector<vector>& field,
                          std::vector<char>* is_given) const {
    List<labelList> points(Pstream::nProcs());
    List<vectorField> vectors(Pstream::nProcs());
    points[Pstream::myProcNo()] = own.points;
    vectors[Pstream::myProcNo()] = own.vectors;
    Pstream::gatherList(points);
    Pstream::gatherList(vectors);
    if (!Pstream::master()) return;
    forAll(points, process) {
        forAll(points[process], k) {
            const std::size_t place =
                static_cast<std::size_t>(places_[process][points[process][k]]);
            field[place] = vectors[process][k];
            if (is_given) (*is_given)[place] = 1;
        }
    }
}

tmp<vectorField> GatheredMesh::scatter(const std::vector<vector>& field) const {
    if (!Pstream::master()) {
        IPstream from_master(Pstream::commsTypes::scheduled, Pstream::masterNo());
        return tmp<vectorField>::New(from_master);
    }
    tmp<vectorField> own;
    forAll(places_, process) {
        tmp<vectorField> values = tmp<vectorField>::New(places_[process].size());
        forAll(places_[process], k) values.ref()[k] =
            field[static_cast<std::size_t>(places_[process][k])];
        if (process == Pstream::masterNo()) {
            own = values;
        } else {
            OPstream to_process(Pstream::commsTypes::scheduled, process);
            to_process << values();
        }
    }
    return own;
}

}  // namespace Foam
