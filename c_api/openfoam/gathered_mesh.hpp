// The mesh of all processes on the master, as the library reads it: points, the faces in one of the
// two planes, and the faces between the planes with their patches.
#ifndef HARMORPH_GATHERED_MESH_HPP
#define HARMORPH_GATHERED_MESH_HPP

#include "polyMesh.H"

#include <harmorph_space.h>
#include <vector>

namespace Foam {

// Points, faces and sides of the master are in an order that depends on the coordinates of the
// points and on the patches alone: a case that is decomposed in another way has the same arrays,
// and its points move by the same bits. Only points at one place and on one patch (a plate without
// thickness) keep the order of the processes.
class GatheredMesh {
public:
    // Collective: all processes construct. `points` are the coordinates of the points of this
    // process. Ends the program (FatalError) where the mesh has no empty or wedge patch, or is not
    // one cell thick.
    GatheredMesh(const polyMesh& mesh, const pointField& points);

    // A view of the arrays, which are empty on all processes but the master.
    hm_space_mesh view() const;
    label size() const { return static_cast<label>(points_.size()); }
    const point& position(label place) const { return points_[static_cast<std::size_t>(place)]; }

    // Values of some points of this process on their way to the master.
    struct Values {
        labelList points;
        vectorField vectors;
    };
    // Collective. On the master, field [size()] receives the values of the lists of all processes
    // in their order: where several lists have a point, the last value counts. is_given, if not
    // null, receives 1 for these points; other entries of both stay as they are.
    void gather(const Values& own, std::vector<vector>& field, std::vector<char>* is_given) const;
    // Collective. Returns the values of the points of this process from the master's field.
    tmp<vectorField> scatter(const std::vector<vector>& field) const;

private:
    void number(const polyMesh& mesh, const pointField& points);
    void order();

    std::vector<point> points_;
    std::vector<std::int32_t> face_start_, face_points_, side_points_, side_markers_;
    // On the master: the place in points_ of each point of each process.
    List<labelList> places_;
};

}  // namespace Foam

#endif
