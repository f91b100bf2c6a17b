// The motion solver harmorph: moves meshes one cell thick by the library harmorph. README.md in
// this folder says what the coefficients are.
#ifndef HARMORPH_MOTION_SOLVER_HPP
#define HARMORPH_MOTION_SOLVER_HPP

#include "displacementMotionSolver.H"
#include "plane_motion.hpp"

namespace Foam {

class harmorphMotionSolver : public displacementMotionSolver {
public:
    TypeName("harmorph");

    harmorphMotionSolver(const polyMesh& mesh, const IOdictionary& dict);
    harmorphMotionSolver(const polyMesh& mesh, const IOdictionary& dict,
                         const pointVectorField& displacement, const pointIOField& points0);
    harmorphMotionSolver(const harmorphMotionSolver&) = delete;
    void operator=(const harmorphMotionSolver&) = delete;
    ~harmorphMotionSolver() override = default;

    tmp<pointField> curPoints() const override;
    void solve() override;
    // Refuses: the functions belong to one topology.
    void updateMesh(const mapPolyMesh& map) override;

private:
    // Reads the coefficients, gathers the mesh and factors the matrix. This waits until the first
    // solution, when the mesh and all fields exist.
    void begin();
    MotionSettings settings() const;
    void restore();
    void report() const;

    // The displacement on which the matrix was factored, for restarts with equal bits.
    pointVectorField reference_;
    std::unique_ptr<GatheredMesh> gathered_;
    std::unique_ptr<PatchConditions> patches_;
    std::unique_ptr<PlaneMotion> motion_;  // on the master
    label report_interval_ = 0, n_solved_ = 0;
};

}  // namespace Foam

#endif
