#include "mesh/named_conditions.hpp"

#include "basics/place.hpp"
#include "mesh/boundary_loops.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

// The pieces of a marker, which are chains of its faces.
class Pieces {
public:
    Pieces(const Mesh& mesh, std::int32_t marker) : mesh_(mesh) {
        for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
            if (mesh.face_markers[face] != marker) continue;
            ends_.push_back(mesh.face_points[2 * face]);
            ends_.push_back(mesh.face_points[2 * face + 1]);
        }
        of_face_ = BoundaryLoops(ends_, mesh.points()).of_edge;
    }

    // Returns the number of the piece that is nearest to the place, or -1 without faces.
    std::int32_t nearest(double x, double y) const {
        double smallest = HUGE_VAL;
        std::int32_t piece = -1;
        for (std::size_t face = 0; face < of_face_.size(); ++face) {
            const double found = distance(face, x, y);
            if (found >= smallest) continue;
            smallest = found;
            piece = of_face_[face];
        }
        return piece;
    }

    // Calls visit(a, b) for the ends of the faces of a piece.
    template <class Visit>
    void for_each_face(std::int32_t piece, const Visit& visit) const {
        for (std::size_t face = 0; face < of_face_.size(); ++face)
            if (of_face_[face] == piece) visit(ends_[2 * face], ends_[2 * face + 1]);
    }

private:
    double distance(std::size_t face, double x, double y) const {
        const std::size_t a = place(ends_[2 * face]), b = place(ends_[2 * face + 1]);
        const double dx = mesh_.x[b] - mesh_.x[a], dy = mesh_.y[b] - mesh_.y[a],
                     square = dx * dx + dy * dy,
                     along = (x - mesh_.x[a]) * dx + (y - mesh_.y[a]) * dy,
                     t = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
        return std::hypot(mesh_.x[a] + t * dx - x, mesh_.y[a] + t * dy - y);
    }

    const Mesh& mesh_;
    std::vector<std::int32_t> ends_, of_face_;
};

}  // namespace

std::vector<hm_condition> ConditionsOfMesh::find(const std::string& list, std::int32_t kind) const {
    std::vector<hm_condition> found;
    for (const MarkerPiece& piece : mesh.find_pieces(list)) {
        if (piece.is_piece) add_of_piece(piece, kind, found);
        else add_of_marker(piece.marker, kind, found);
    }
    return found;
}

void ConditionsOfMesh::add_of_marker(std::int32_t marker, std::int32_t kind,
                                     std::vector<hm_condition>& found) const {
    const auto is_named = [&](const hm_condition& condition) {
        return condition.marker == marker && condition.kind == kind;
    };
    const auto is_whole = [&](const hm_condition& condition) {
        return is_named(condition) && condition.piece == 0;
    };
    const bool has_whole = std::any_of(conditions.begin(), conditions.end(), is_whole);
    for (const hm_condition& condition : conditions) {
        if (kind == HM_RIGID && has_whole ? is_whole(condition) : is_named(condition))
            found.push_back(condition);
    }
}

bool ConditionsOfMesh::moves_by(const hm_condition& condition, std::int32_t number) const {
    if (condition.kind == HM_RIGID) return number == n_curves + condition.body;
    return condition.first_curve <= number && number < condition.first_curve + condition.n_curves;
}

void ConditionsOfMesh::add_of_piece(const MarkerPiece& piece, std::int32_t kind,
                                    std::vector<hm_condition>& found) const {
    std::vector<hm_condition> of_marker;
    for (const hm_condition& condition : conditions) {
        if (condition.marker != piece.marker || condition.kind != kind) continue;
        if (condition.piece != 0 && condition.near_x == piece.x && condition.near_y == piece.y)
            return found.push_back(condition);
        of_marker.push_back(condition);
    }
    const Pieces pieces(mesh, piece.marker);
    const std::int32_t nearest = pieces.nearest(piece.x, piece.y);
    const hm_condition* on_piece = nullptr;
    for (const hm_condition& condition : of_marker) {
        bool is_here = condition.piece == 0 && on_piece == nullptr;
        if (mover.empty()) {
            is_here = is_here || (condition.piece != 0 &&
                                  pieces.nearest(condition.near_x, condition.near_y) == nearest);
        } else {
            // A shared point may be moved by the condition beside the piece; a whole face is not.
            is_here = false;
            pieces.for_each_face(nearest, [&](std::int32_t a, std::int32_t b) {
                is_here = is_here || (moves_by(condition, mover[place(a)]) &&
                                      moves_by(condition, mover[place(b)]));
            });
        }
        if (is_here) on_piece = &condition;
    }
    if (on_piece != nullptr) found.push_back(*on_piece);
}

}  // namespace cli
