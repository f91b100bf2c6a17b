// Basis files have the block of the library, which hm_basis_attach takes, and after the block the
// names of the markers, because the block has only their numbers:
//
//     harmorph markers 2        (after a line feed)
//     far field                 marker 0
//     airfoil                   marker 1
#pragma once

#include "basics/library.hpp"
#include "curves/curves.hpp"
#include "files/text_file.hpp"
#include "mesh/mesh_file.hpp"
#include "options/arguments.hpp"

#include <complex>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace cli {

// A basis that is read from a file, or copied from a solution, and attached to its mesh. Refuses a
// file without names, a mesh with other markers, conditions on markers that the mesh does not have,
// and functions of design variables.
class Basis {
public:
    Basis(const std::string& path, const Mesh& mesh);
    Basis(const hm_basis* solved, const Mesh& mesh);
    Basis(const Basis&) = delete;

    const std::string& path() const { return path_; }
    const hm_basis* get() const { return basis_; }
    // Returns the curves on the mesh, which may have moved since the basis was solved. Throws a
    // Failure if the wall is on no curve.
    const hm_curves& curves() const;
    // Returns the curves that the basis was solved with.
    const hm_curves& curves_at_start() const { return curves_; }
    std::int32_t n_control() const { return curves_.n_control; }
    bool mesh_has_moved() const { return mesh_has_moved_; }
    // The reason why curves() throws; empty if the wall is on the curves.
    const std::string& why_on_no_curve() const { return why_on_no_curve_; }
    // For a mesh that has moved; see hm_recover_movement.
    double distance_from_curves() const { return distance_; }
    const hm_basis_info& info() const { return info_; }
    // Markers are those of the mesh.
    const std::vector<hm_condition>& conditions() const { return conditions_; }
    // The curves that conditions point to.
    const std::vector<std::shared_ptr<const CurveSet>>& slip_curves() const { return slip_curves_; }
    std::int32_t functions() const { return info_.functions; }
    // Returns scale times (cosine + i sine) of what the mesh has turned this body by since the
    // basis was solved; the functions of bodies belong to the places of that mesh. Throws a Failure
    // as curves() if the movement is unknown.
    std::complex<double> body_rotation(std::int32_t body) const;
    // Whether the mesh has moved a body since the basis was solved.
    bool has_moved_bodies() const { return has_moved_bodies_; }
    // Returns component `number` of the values of a function, at every point of the mesh.
    std::vector<double> values(std::int32_t function, std::int32_t number, const Mesh& mesh) const;

private:
    Basis(const TextFile& file, const Mesh& mesh);
    void find_movement(const Mesh& mesh);
    void find_slip_curves();

    std::string path_;
    TextFile file_;  // mapped into memory where that is possible
    const hm_basis* basis_ = nullptr;
    bool mesh_has_moved_ = false;
    std::string why_on_no_curve_;
    double distance_ = 0;
    bool has_moved_bodies_ = false;
    hm_basis_info info_;
    std::vector<hm_curve> curve_;
    hm_curves curves_, moved_curves_;
    std::vector<double> moved_control_;
    std::vector<double> recovered_;  // pairs [2*functions]; empty if the mesh has not moved
    std::vector<hm_condition> conditions_;
    std::vector<std::shared_ptr<const CurveSet>> slip_curves_;
};

// Calls visit(condition) once for each rigid body, with the first of its conditions.
template <class Visit>
void for_each_body(const std::vector<hm_condition>& conditions, std::int32_t n_bodies,
                   const Visit& visit) {
    std::vector<bool> is_visited(static_cast<std::size_t>(n_bodies));
    for (const hm_condition& condition : conditions) {
        if (condition.kind != HM_RIGID || is_visited[static_cast<std::size_t>(condition.body)])
            continue;
        is_visited[static_cast<std::size_t>(condition.body)] = true;
        visit(condition);
    }
}

void write_basis(std::ostream& out, const hm_basis* basis, const Mesh& mesh);

// What --storage writes: the basis as it was solved, or a copy in single precision in a separate
// block.
class Stored {
public:
    // The basis must outlive this object.
    Stored(const Arguments& arguments, const Mesh& mesh, const hm_basis* solved);

    const hm_basis* basis() const { return basis_; }
    std::size_t bytes() const;
    bool in_single() const { return block_.size() > 0; }

private:
    Block block_;
    const hm_basis* basis_;
};

}  // namespace cli
