// The plan's equations for the coordinates at hand.
#include "harmorph/operators/bounded.hpp"
#include "harmorph/plan/plan.hpp"
#include "harmorph/operators/stiffness.hpp"

namespace harmorph {

Status Plan::assemble(Points points, Fault& fault) noexcept {
    return method.bounded() ? assemble_edges(points, fault) : assemble_cells(points, fault);
}

Status Plan::assemble_cells(Points points, Fault& fault) noexcept {
    if (!conductivity.empty()) {
        wall.build(points);
        weigh_cells(wall, mesh, points, method.quarters, conductivity, engine.executor);
    }
    Index const inverted =
        assemble_stiffness(mesh, points, reversed, conductivity, method.conformal(), matrix, engine.executor);
    if (inverted == none) return Status::ok;
    return fault.refuse(Status::bad_mesh, "cell # is inverted or empty at the given coordinates", Counts::mesh, inverted);
}

Status Plan::assemble_edges(Points points, Fault& fault) noexcept {
    if (coordinates_fingerprint(points, mesh.n_points) != analysed_coordinates) {
        return fault.refuse(Status::unsupported,
                            "bounded scheme: its triangles fit the analysed coordinates alone; analyse again");
    }
    if (!conductivity.empty()) {
        wall.build(points);
        weigh_edges(wall, delaunay_edges, points, method.quarters, conductivity, engine.executor);
    }
    Index const thin = assemble_bounded(delaunay_edges, points, conductivity, matrix);
    if (thin == none) return Status::ok;
    return fault.refuse(Status::bad_mesh, "a triangle at the points # and @ is too thin for its area to be computed",
                        Counts::mesh, delaunay_edges[thin].begin, delaunay_edges[thin].end);
}

}  // namespace harmorph
